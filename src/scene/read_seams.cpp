// [[seams]]: boundaries of bodies in contact; each node of the slave becomes a contact.
#include <fmt/core.h>

#include <cmath>
#include <set>

#include "base/listed.hpp"
#include "base/number.hpp"
#include "mesh/mortar.hpp"
#include "scene/contact_tables.hpp"

namespace signorini {

namespace {

/// Of contacts, for each area.
struct SeamLaw {
  ContactSpec contact;
  double normal_stiffness = 0.0, normal_damping = 0.0;
  std::optional<double> tangential_stiffness, gap;
};

void read_layer(Table& table, SeamLaw& law) {
  for (const char* key : {"normal_stiffness", "tangential_stiffness"})
    if (table.has(key)) table.fail(key, "cannot be combined with layer; give only one of them");
  Table layer = table.child("layer");
  if (law.contact.friction.any()) layer.require("G", " (required with friction)");
  const double E = layer.number("E"), thickness = layer.number("thickness");
  const std::optional<double> G = layer.optional_number("G");
  layer.finish();
  law.normal_stiffness = E / thickness;
  if (G && law.contact.friction.any()) law.tangential_stiffness = *G / thickness;
  for (const double k : {law.normal_stiffness, law.tangential_stiffness.value_or(1.0)})
    if (!std::isnormal(k))
      table.fail("layer", fmt::format("found a stiffness of {}, expected a number > 0", k));
  table.record("layer", layer.record().inline_table());
}

void read_springs_of(Table& table, SeamLaw& law) {
  law.normal_damping = table.number("normal_damping");
  if (table.has("layer")) return read_layer(table, law);
  table.require("normal_stiffness", " (required for law = \"compliant\" without layer)");
  law.normal_stiffness = table.number("normal_stiffness");
  if (!law.contact.friction.any()) return;
  table.require("tangential_stiffness", " (required for law = \"compliant\" with friction, without layer)");
  law.tangential_stiffness = table.number("tangential_stiffness");
  if (law.contact.friction.stribeck_velocity)
    table.fail("friction",
               "found a stribeck_velocity, expected none beside tangential_stiffness: the sliding point has "
               "no mass, so "
               "friction that falls with its rate leaves its motion undecided");
}

SeamLaw read_seam_law(Table& table, const Scene& scene) {
  SeamLaw law;
  ContactSpec& contact = law.contact;
  contact.place = table.place();
  contact.table = table.path();
  contact.law = table.choice("law") == "rigid" ? Law::rigid : Law::compliant;
  contact.friction = read_friction(table);
  contact.normal_force = constant_history(0.0);
  if (contact.law == Law::rigid) {
    contact.restitution = table.number("restitution");
    contact.capture_velocity = table.optional_number("capture_velocity");
  } else {
    read_springs_of(table, law);
  }
  law.gap = table.optional_number("gap");
  contact.surface_velocity = read_standing_history(table, "surface_velocity", scene);
  return law;
}

std::vector<std::string> mesh_names(const std::vector<int>& nodes, const Scene& scene) {
  std::vector<std::string> names;
  for (const int n : nodes) names.push_back(scene.nodes[static_cast<std::size_t>(n)].name);
  return names;
}

/// A node of both boundaries, the tip of a crack, never opens and is no contact.
void leave_out_shared(const Table& table, const Scene& scene, MortarSeam& seam) {
  std::set<int> master;
  for (const MortarNode& k : seam.nodes)
    for (const auto& [node, weight] : k.master) master.insert(node);
  const std::string first = scene.nodes[static_cast<std::size_t>(seam.nodes.front().node)].name;
  std::erase_if(seam.nodes, [&](const MortarNode& k) { return master.contains(k.node); });
  if (seam.nodes.empty())
    table.fail("master",
               fmt::format("node {} and all others belong to both boundaries: expected meshes that share no "
                           "nodes there, but for the tip of a crack",
                           first));
}

/// The mortar of a table, checked.
MortarSeam read_mortar(Table& table, const BoundaryRef& slave, const Scene& scene) {
  const PlaceOf place = [&](int n) {
    const Node& node = scene.nodes[static_cast<std::size_t>(n)];
    return PlanePoint{node.x, node.y};
  };
  if (table.has("master") == table.has("line")) table.fail("master", "expected one of master and line");
  MortarSeam seam;
  if (table.has("line")) {
    Table line = table.child("line");
    const auto point = line.vector("point");
    seam = mortar_on_line(slave.group->edges, point, read_unit_vector(line, "normal"), place);
    line.finish();
    table.record("line", line.record().inline_table());
  } else if (const std::string master = table.text("master"); master == "ground") {
    seam = mortar_on_ground(slave.group->edges, place);
  } else {
    const BoundaryRef other = find_boundary(table, "master", master, scene);
    if (other.group == slave.group)
      table.fail("master", "found the slave boundary itself, expected another one");
    seam = mortar_between(slave.group->edges, other.group->edges, place);
  }
  if (!seam.negative.empty())
    table.fail(
        "slave",
        fmt::format("node {} lies at the end of a quadratic edge of which the master covers a part, and "
                    "would have no length: end the master at a node of the slave, or exchange the two",
                    listed(mesh_names(seam.negative, scene), 3)));
  if (!seam.corners.empty())
    table.fail("slave",
               fmt::format("the boundary has a corner of more than 45 degrees at node {}: give each side a "
                           "seam of its own",
                           listed(mesh_names(seam.corners, scene), 3)));
  if (seam.nodes.empty()) table.fail("master", "it faces no part of the slave boundary");
  leave_out_shared(table, scene, seam);
  return seam;
}

ContactSpec contact_of(const MortarNode& k, const SeamLaw& law, double thickness, const Scene& scene) {
  ContactSpec contact = law.contact;
  const double area = k.length * thickness;
  Direction normal;
  normal.node = scene.nodes[static_cast<std::size_t>(k.node)].name;
  normal.vector = k.normal;
  normal.place = contact.place;
  for (const auto& [node, weight] : k.master)
    normal.against.emplace_back(scene.nodes[static_cast<std::size_t>(node)].name, weight);
  contact.tangent = tangent_of(normal);
  contact.normal = std::move(normal);
  contact.gap = law.gap.value_or(k.gap);
  contact.normal_stiffness = law.normal_stiffness * area;
  contact.normal_damping = law.normal_damping * area;
  if (law.tangential_stiffness) contact.tangential_stiffness = *law.tangential_stiffness * area;
  return contact;
}

/// Not recorded: whoever reads the key does that.
bool is_word(Table& table, const char* key, std::string_view word) {
  return table.has(key) && table.raw(key)->value_or(std::string()) == word;
}

/// law = "tied": nodes of the slave follow the master, at any gap.
void read_tied(Table& table, const std::string& name, Scene& scene) {
  static_cast<void>(table.choice("law"));
  const BoundaryRef slave = find_boundary(table, "slave", table.text("slave"), scene);
  if (table.has("line") || is_word(table, "master", "ground"))
    table.fail("law",
               "found \"tied\" to what rests: expected a boundary as master, or [[supports]] on the slave");
  const MortarSeam mortar = read_mortar(table, slave, scene);
  for (const MortarNode& k : mortar.nodes) {
    TieSpec tie{name, k.node, k.master, table.place()};
    for (const TieSpec& other : scene.ties)
      if (other.node == k.node)
        table.fail("slave", fmt::format("node {} is tied by seam \"{}\" already",
                                        scene.nodes[static_cast<std::size_t>(k.node)].name, other.seam));
    scene.ties.push_back(std::move(tie));
  }
}

}  // namespace

void read_seams(Table& top, Scene& scene, RecordedScene& record) {
  Names names = names_of(scene), seams;
  for (Table& table : tables_of(top, "seams")) {
    if (scene.matrices) table.fail("", "has no meaning with [matrices]");
    SeamSpec seam;
    seam.place = table.place();
    seam.name = table.text("name");
    if (!seams.add(seam.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each seam to have its own name", seam.name));
    if (is_word(table, "law", "tied")) {
      read_tied(table, seam.name, scene);
      table.finish("is not allowed with law = \"tied\"; remove it");
      record.add("seams", "[[seams]]", table.record());
      continue;
    }
    const BoundaryRef slave = find_boundary(table, "slave", table.text("slave"), scene);
    const MortarSeam mortar = read_mortar(table, slave, scene);
    const SeamLaw law = read_seam_law(table, scene);
    BodySpec& body = scene.bodies[slave.body];
    seam.thickness = body.thickness;
    seam.first_contact = scene.contacts.size();
    for (const MortarNode& k : mortar.nodes) {
      ContactSpec contact = contact_of(k, law, body.thickness, scene);
      contact.name = fmt::format("{}.{}", seam.name, seam.nodes.size() + 1);
      add_contact(table, std::move(contact), names, scene);
      seam.nodes.push_back({k.node, k.length, k.normal});
    }
    if (table.choice("contact_mass") == "none")
      for (const MortarNode& k : mortar.nodes) body.massless.push_back(k.node);
    table.finish(fmt::format("is not allowed with law = \"{}\"; remove it",
                             law.contact.law == Law::rigid ? "rigid" : "compliant"));
    scene.seams.push_back(std::move(seam));
    record.add("seams", "[[seams]]", table.record());
  }
}

}  // namespace signorini
