// [[seams]]: boundaries of bodies in contact; each node of the slave becomes a contact.

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "mesh/mesh_quality.hpp"
#include "mesh/mortar.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

// [[surfaces]]: boundaries of a structure given by [matrices], for seams.

namespace {

/// Index of the node in Scene::surface_nodes; a new node is added. Surfaces may share a node (the tip of a crack) with
/// the same position and degrees of freedom.
int index_of(const Table& table, const SurfaceNode& node, Scene& scene) {
  const auto same =
      std::find_if(scene.surface_nodes.begin(), scene.surface_nodes.end(), [&](const SurfaceNode& other) {
        return (!node.ux.empty() && node.ux == other.ux) || (!node.uy.empty() && node.uy == other.uy);
      });
  if (same == scene.surface_nodes.end()) {
    scene.surface_nodes.push_back(node);
    return static_cast<int>(scene.surface_nodes.size()) - 1;
  }
  if (same->ux != node.ux || same->uy != node.uy || same->x != node.x || same->y != node.y)
    table.fail(
        node.ux == same->ux ? "ux" : "uy",
        fmt::format("found \"{}\" at two places, [{:.9g}, {:.9g}] and [{:.9g}, {:.9g}], expected one place",
                    node.ux == same->ux ? node.ux : node.uy, same->x, same->y, node.x, node.y));
  return static_cast<int>(same - scene.surface_nodes.begin());
}

std::vector<SurfaceNode> read_surface_nodes(Table& table, const Names& dofs) {
  const auto x = table.numbers("x"), y = table.numbers("y");
  for (const char* key : {"x", "y"}) table.require(key, "");
  const std::vector<std::string> ux = table.texts("ux"), uy = table.texts("uy");
  const std::pair<const char*, std::size_t> counts[] = {
      {"y", y->size()}, {"ux", ux.size()}, {"uy", uy.size()}};
  for (const auto& [key, count] : counts)
    if (count != x->size())
      table.fail(key, fmt::format("found {}, expected {}, one for each entry of x",
                                  base::count_text(count, "entry"), x->size()));
  std::vector<SurfaceNode> nodes;
  for (std::size_t i = 0; i < x->size(); ++i) {
    for (const auto& [key, name] : {std::pair{"ux", &ux[i]}, std::pair{"uy", &uy[i]}})
      if (!name->empty())
        static_cast<void>(check_known(*name, dofs, "degree of freedom", table.place(key), table.path(key)));
    nodes.push_back({(*x)[i], (*y)[i], ux[i], uy[i]});
  }
  return nodes;
}

/// Edges between consecutive nodes; with quadratic edges every second node is a middle node.
std::vector<PlaneMesh::Edge> edges_of(Table& table, std::vector<int> nodes) {
  const bool quadratic = table.flag("quadratic"), closed = table.flag("closed");
  if (closed) nodes.push_back(nodes.front());
  const std::size_t step = quadratic ? 2 : 1;
  if (nodes.size() < step + 1 || (nodes.size() - 1) % step != 0)
    table.fail(
        "x", fmt::format("found {}, expected {}", base::count_text(nodes.size() - (closed ? 1 : 0), "place"),
                         !quadratic ? "two or more"
                         : closed   ? "an even number of places: end, middle, end, middle, ..."
                                    : "an odd number of places, at least 3: end, middle, end, ..."));
  std::vector<PlaneMesh::Edge> edges;
  for (std::size_t i = 0; i + step < nodes.size(); i += step) {
    edges.push_back({{nodes[i], nodes[i + step]}});
    if (quadratic) edges.back().nodes.push_back(nodes[i + 1]);
  }
  return edges;
}

}  // namespace

void read_surfaces(Table& top, Scene& scene, ResolvedScene& record) {
  Names names, dofs;
  if (scene.matrices)
    for (const std::string& name : scene.matrices->dofs) dofs.add(name);
  for (Table& table : tables_of(top, "surfaces")) {
    if (!scene.matrices)
      table.fail("", "has no meaning without [matrices]: boundaries of [[bodies]] are their groups");
    SurfaceSpec surface;
    surface.place = table.place();
    surface.name = table.text("name");
    if (!names.add(surface.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each surface to have its own name", surface.name));
    std::vector<int> nodes;
    for (const SurfaceNode& node : read_surface_nodes(table, dofs))
      nodes.push_back(index_of(table, node, scene));
    surface.edges = edges_of(table, std::move(nodes));
    for (const PlaneMesh::Edge& edge : surface.edges) {
      const auto at = [&](int i) -> const SurfaceNode& {
        return scene.surface_nodes[static_cast<std::size_t>(edge.nodes[static_cast<std::size_t>(i)])];
      };
      if (at(0).x == at(1).x && at(0).y == at(1).y)
        table.fail(
            "x", fmt::format("found the place [{:.9g}, {:.9g}] at both ends of an edge, expected two places",
                             at(0).x, at(0).y));
    }
    surface.thickness = table.number("thickness");
    table.finish();
    scene.surfaces.push_back(std::move(surface));
    record.add("surfaces", "[[surfaces]]", table.record());
  }
}

namespace {

/// Contact law of a seam; its stiffnesses and its damping are per area.
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
      table.fail("layer",
                 fmt::format("these values give a stiffness of {}, expected a finite number > 0", k));
  table.record("layer", layer.record().inline_table());
}

void read_springs_of(Table& table, SeamLaw& law) {
  law.normal_damping = table.number("normal_damping");
  if (table.has("layer")) return read_layer(table, law);
  table.require("normal_stiffness", " (required for law = \"compliant\" without layer)");
  law.normal_stiffness = table.number("normal_stiffness");
  if (!law.contact.friction.any()) {
    static_cast<void>(table.optional_number("tangential_stiffness"));  // no effect without friction
    return;
  }
  table.require("tangential_stiffness", " (required for law = \"compliant\" with friction, without layer)");
  law.tangential_stiffness = table.number("tangential_stiffness");
  if (law.contact.friction.stribeck_velocity)
    table.fail("friction",
               "found a stribeck_velocity, expected none with tangential_stiffness: the sliding point has "
               "no mass, so its motion is not unique if friction decreases with the slip rate");
}

/// True if the key has this word as its value. The key is not recorded here; its reader records it.
bool is_word(Table& table, const char* key, std::string_view word) {
  return table.has(key) && table.raw(key)->value_or(std::string()) == word;
}

SeamLaw read_seam_law(Table& table, const Scene& scene) {
  SeamLaw law;
  ContactSpec& contact = law.contact;
  contact.place = table.place();
  contact.table = table.path();
  contact.law = table.choice("law") == "rigid" ? Law::rigid : Law::compliant;
  contact.friction = read_friction(table);
  if (contact.friction.is_load_dependent())
    table.fail(
        "friction",
        "found light, heavy and force, expected one coefficient, because the force at a node of a seam "
        "depends on the mesh");
  contact.normal_force = constant_history(0.0);
  if (contact.law == Law::rigid && is_word(table, "contact_mass", "none")) {
    // A contact without mass does not rebound, so there is no restitution to read.
  } else if (contact.law == Law::rigid) {
    contact.restitution = table.number("restitution");
    contact.capture_velocity = table.optional_number("capture_velocity");
  } else {
    read_springs_of(table, law);
  }
  law.gap = table.optional_number("gap");
  contact.surface_velocity =
      read_number_or_history(table, "surface_velocity", scene, RecordQuantity::velocity);
  return law;
}

/// A boundary of a body, or a surface of [matrices], which has no body.
struct Boundary {
  const std::vector<PlaneMesh::Edge>* edges;
  double thickness;
  std::optional<std::size_t> body;
};

Boundary find_seam_boundary(const Table& table, std::string_view key, const std::string& name,
                            const Scene& scene) {
  if (!scene.matrices) {
    const BoundaryRef found = find_boundary(table, key, name, scene);
    return {&found.group->edges, scene.bodies[found.body].thickness, found.body};
  }
  std::vector<std::string> there;
  for (const SurfaceSpec& surface : scene.surfaces) {
    if (surface.name == name) return {&surface.edges, surface.thickness, {}};
    there.push_back(surface.name);
  }
  table.fail(key, fmt::format("no surface is named \"{}\"; known: {}", name,
                              there.empty() ? "none" : base::join_quoted(there, 8)));
}

/// Outer edges of the slave's body; for [matrices] the edges of the slave surface.
std::vector<PlaneMesh::Edge> outline_of(const Boundary& side, const Scene& scene) {
  if (!side.body) return *side.edges;
  mesh::SharedEdges all;
  mesh::add_edges(scene.bodies[*side.body].mesh.elements, all);
  std::vector<PlaneMesh::Edge> outline;
  for (auto& [ends, edge] : all)
    if (edge.elements == 1) outline.push_back({std::move(edge.nodes)});
  return outline;
}

mesh::PlanePoint place_in(const Scene& scene, int n) {
  const auto i = static_cast<std::size_t>(n);
  if (scene.matrices) return {scene.surface_nodes[i].x, scene.surface_nodes[i].y};
  return {scene.nodes[i].x, scene.nodes[i].y};
}

std::string mesh_name(int n, const Scene& scene) {
  const auto i = static_cast<std::size_t>(n);
  if (!scene.matrices) return scene.nodes[i].name;
  return fmt::format("[{:.9g}, {:.9g}]", scene.surface_nodes[i].x, scene.surface_nodes[i].y);
}

std::vector<std::string> mesh_names(const std::vector<int>& nodes, const Scene& scene) {
  std::vector<std::string> names;
  for (const int n : nodes) names.push_back(mesh_name(n, scene));
  return names;
}

/// Removes contacts at nodes that both boundaries share (the tip of a crack), because they can never open.
void remove_shared_nodes(const Table& table, const Scene& scene, mesh::MortarSeam& seam) {
  std::set<int> master;
  for (const mesh::MortarNode& k : seam.nodes)
    for (const auto& [node, weight] : k.master) master.insert(node);
  const std::string first = mesh_name(seam.nodes.front().node, scene);
  std::erase_if(seam.nodes, [&](const mesh::MortarNode& k) { return master.contains(k.node); });
  if (seam.nodes.empty())
    table.fail("master",
               fmt::format("node {} and all other slave nodes are also master nodes: expected meshes that "
                           "share no nodes there, except at the tip of a crack",
                           first));
}

/// Reads master or line of a seam, and computes its contacts: nodes, weights and gaps.
mesh::MortarSeam read_mortar(Table& table, const Boundary& slave, const Scene& scene) {
  const mesh::NodePosition place = [&](int n) { return place_in(scene, n); };
  if (table.has("master") == table.has("line"))
    table.fail("master", table.has("line") ? "cannot be combined with line; give only one of them"
                                           : "missing, expected master or line");
  mesh::MortarSeam seam;
  if (table.has("line")) {
    Table line = table.child("line");
    const auto point = line.vector("point");
    seam = mesh::mortar_on_line(*slave.edges, point, read_unit_vector(line, "normal"), place);
    line.finish();
    table.record("line", line.record().inline_table());
  } else if (const std::string master = table.text("master"); master == "ground") {
    seam = mesh::mortar_on_ground(*slave.edges, place);
  } else {
    const Boundary other = find_seam_boundary(table, "master", master, scene);
    if (other.edges == slave.edges)
      table.fail("master", "found the slave boundary itself, expected another boundary");
    seam = mesh::mortar_between(*slave.edges, *other.edges, place, outline_of(slave, scene));
  }
  if (!seam.negative.empty())
    table.fail(
        "slave",
        fmt::format(
            "no length of the seam belongs to node{} {}, at the end of a quadratic edge that the master "
            "covers only in part: end the master at a node of the slave, or exchange slave and master",
            seam.negative.size() == 1 ? "" : "s", base::join_quoted(mesh_names(seam.negative, scene), 3)));
  if (!seam.corners.empty())
    table.fail("slave", fmt::format("the boundary has a corner of more than 45 degrees at node{} {}: give "
                                    "each side of a corner its own seam",
                                    seam.corners.size() == 1 ? "" : "s",
                                    base::join_quoted(mesh_names(seam.corners, scene), 3)));
  if (seam.nodes.empty()) table.fail("master", "the master faces no part of the slave boundary");
  remove_shared_nodes(table, scene, seam);
  return seam;
}

/// For [matrices]: the relative displacement n . (u_k - sum_l w_kl u_l) as factors of named degrees of freedom.
Direction surface_form(const mesh::MortarNode& k, const std::array<double, 2>& n, const Scene& scene) {
  Direction form;
  const auto add = [&](int node, double factor) {
    const SurfaceNode& at = scene.surface_nodes[static_cast<std::size_t>(node)];
    for (const auto& [dof, along] : {std::pair{&at.ux, n[0]}, std::pair{&at.uy, n[1]}})
      if (!dof->empty() && factor * along != 0.0) form.dofs.emplace_back(*dof, factor * along);
  };
  add(k.node, 1.0);
  for (const auto& [node, weight] : k.master) add(node, -weight);
  return form;
}

void set_forms(const mesh::MortarNode& k, const Scene& scene, ContactSpec& contact) {
  Direction normal;
  if (scene.matrices) {
    normal = surface_form(k, k.normal, scene);
    contact.tangent = surface_form(k, {k.normal[1], -k.normal[0]}, scene);
    contact.tangent->place = contact.place;
  } else {
    normal.node = mesh_name(k.node, scene);
    normal.vector = k.normal;
    for (const auto& [node, weight] : k.master) normal.against.emplace_back(mesh_name(node, scene), weight);
    contact.tangent = tangent_of(normal);
    contact.tangent->place = contact.place;
  }
  normal.place = contact.place;
  contact.normal = std::move(normal);
}

ContactSpec contact_of(const mesh::MortarNode& k, const SeamLaw& law, double thickness, const Scene& scene) {
  ContactSpec contact = law.contact;
  const double area = k.length * thickness;
  set_forms(k, scene, contact);
  contact.gap = law.gap.value_or(k.gap);
  contact.normal_stiffness = law.normal_stiffness * area;
  contact.normal_damping = law.normal_damping * area;
  if (law.tangential_stiffness) contact.tangential_stiffness = *law.tangential_stiffness * area;
  return contact;
}

/// Reads a seam with law = "tied": the nodes of the slave follow the master, whatever the gap.
void read_tied(Table& table, const std::string& name, Scene& scene) {
  static_cast<void>(table.choice("law"));
  if (scene.matrices)
    table.fail("law", "found \"tied\", expected compliant or rigid: with [matrices] a seam cannot be tied");
  const Boundary slave = find_seam_boundary(table, "slave", table.text("slave"), scene);
  if (table.has("line") || is_word(table, "master", "ground"))
    table.fail(
        "law",
        "found \"tied\" to a fixed surface: expected a boundary as master, or [[supports]] on the slave");
  const mesh::MortarSeam mortar = read_mortar(table, slave, scene);
  for (const mesh::MortarNode& k : mortar.nodes) {
    TieSpec tie{name, k.node, k.master, table.place()};
    for (const TieSpec& other : scene.ties)
      if (other.node == k.node)
        table.fail(
            "slave",
            fmt::format("node {} is tied by seam \"{}\" already, expected at most one tied seam at a node",
                        scene.nodes[static_cast<std::size_t>(k.node)].name, other.seam));
    scene.ties.push_back(std::move(tie));
  }
}

}  // namespace

void read_seams(Table& top, Scene& scene, ResolvedScene& record) {
  Names names = contact_names(scene), seams;
  for (Table& table : tables_of(top, "seams")) {
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
    const Boundary slave = find_seam_boundary(table, "slave", table.text("slave"), scene);
    const mesh::MortarSeam mortar = read_mortar(table, slave, scene);
    const SeamLaw law = read_seam_law(table, scene);
    seam.thickness = slave.thickness;
    seam.first_contact = scene.contacts.size();
    for (const mesh::MortarNode& k : mortar.nodes) {
      ContactSpec contact = contact_of(k, law, slave.thickness, scene);
      contact.name = fmt::format("{}.{}", seam.name, seam.nodes.size() + 1);
      add_contact(table, std::move(contact), names, scene);
      seam.nodes.push_back({k.node, place_in(scene, k.node), k.length, k.normal});
    }
    if (table.choice("contact_mass") == "none") {
      if (!slave.body)
        table.fail("contact_mass",
                   "found \"none\", which is not allowed with [matrices]: the mass of the nodes is given, "
                   "and may be zero");
      std::vector<int>& massless = scene.bodies[*slave.body].massless;
      for (const mesh::MortarNode& k : mortar.nodes) massless.push_back(k.node);
    }
    table.finish(fmt::format("is not allowed with law = \"{}\"; remove it",
                             law.contact.law == Law::rigid ? "rigid" : "compliant"));
    scene.seams.push_back(std::move(seam));
    record.add("seams", "[[seams]]", table.record());
  }
}

}  // namespace signorini::scene
