// Nodes, lines, members, sections and rigid bodies.

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {
namespace {

constexpr int most_elements = 1'000'000;
// Elements of a quarter circle; the chords are then 0.16 % shorter than the arc.
constexpr int elements_of_arc = 8;

void check_pieces(const Table& table, const Scene& scene, const std::vector<std::size_t>& nodes) {
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Node& a = scene.nodes[nodes[i]];
    const Node& b = scene.nodes[nodes[i + 1]];
    const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    if (!(std::hypot(b.x - a.x, b.y - a.y) > 1e-12 * size)) {
      table.fail("nodes", fmt::format("nodes \"{}\" and \"{}\" coincide, expected a piece with a length",
                                      a.name, b.name));
    }
  }
}

std::vector<int> read_elements(Table& table, std::size_t pieces, bool arcs) {
  const toml::node* node = table.raw("elements");
  const auto count = [&](const toml::node& item) {
    const auto* number = item.as_integer();
    if (!number || number->get() < 1 || number->get() > most_elements) {
      refuse(place_of(item), table.path("elements"),
             fmt::format("found {}, expected an integer from 1 to {}", describe(item), most_elements));
    }
    return static_cast<int>(number->get());
  };
  std::vector<int> elements(pieces, arcs ? elements_of_arc : 1);
  if (node && node->is_array()) {
    const toml::array& array = *node->as_array();
    if (array.size() != pieces) {
      table.fail("elements",
                 fmt::format("found {}, expected an integer, or an array of {}, one for each piece",
                             describe(*node), base::count_text(pieces, "integer")));
    }
    for (std::size_t i = 0; i < pieces; ++i) elements[i] = count(array[i]);
  } else if (node) {
    std::fill(elements.begin(), elements.end(), count(*node));
  }
  if (arcs && *std::min_element(elements.begin(), elements.end()) < 2)
    table.fail("elements", "found 1, expected at least 2 on an arc, because elements are chords of the arc");
  std::vector<std::string> texts;
  for (const int n : elements) texts.push_back(std::to_string(n));
  table.record("elements", toml_array(texts));
  return elements;
}

/// Refuses bars of several elements: nothing would prevent their inner nodes from moving sideways.
void check_bar(const Table& table, const Member& member) {
  if (member.type != MemberType::bar) return;
  for (const int n : member.elements) {
    if (n > 1) {
      table.fail(
          "elements",
          fmt::format("found {}, expected 1: inner nodes of a bar would have no lateral stiffness", n));
    }
  }
}

}  // namespace

void read_nodes(Table& top, Scene& scene, ResolvedScene& record) {
  Table nodes = top.child("nodes");
  for (const Entry& entry : entries_of(nodes.node())) {
    check_name(entry.name, entry.place(), nodes.path(entry.name));
    const auto [x, y] = nodes.vector(entry.name);
    scene.nodes.push_back({entry.name, x, y, entry.place()});
  }
  if (!scene.nodes.empty()) record.add("nodes", "[nodes]", nodes.record());
}

void read_lines(Table& top, Scene& scene, ResolvedScene& record) {
  Names names;
  for (const Node& node : scene.nodes) names.add(node.name);
  for (Table& table : tables_of(top, "lines")) {
    const std::string name = table.text("name");
    const auto from = table.vector("from"), to = table.vector("to");
    const int pieces = table.integer("pieces");
    if (pieces > most_elements - static_cast<int>(scene.nodes.size()))
      table.fail("pieces",
                 fmt::format("found {}, expected fewer pieces, because a scene can have at most {} nodes",
                             pieces, most_elements));
    for (int i = 0; i <= pieces; ++i) {
      const double s = static_cast<double>(i) / pieces;
      const std::string own = fmt::format("{}{}", name, i);
      if (!names.add(own))
        table.fail("name", fmt::format("node \"{}\" exists already; expected another name", own));
      scene.nodes.push_back(
          {own, from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]), table.place("name")});
    }
    table.finish();
    record.add("lines", "[[lines]]", table.record());
  }
}

namespace {

void read_release(Table& table, Member& member) {
  member.release = table.texts("release");
  for (const std::string& end : member.release)
    if (end != member.nodes.front() && end != member.nodes.back())
      table.fail("release", fmt::format("found \"{}\", expected \"{}\" or \"{}\", the member's ends", end,
                                        member.nodes.front(), member.nodes.back()));
  if (!member.release.empty() && member.type == MemberType::bar)
    table.fail("release", "has no meaning for a bar, which is hinged at both ends");
  if (!member.release.empty() && member.nodes.front() == member.nodes.back())
    table.fail("release",
               fmt::format("found \"{}\", which is the first and the last node of the member; expected a "
                           "member with two different ends",
                           member.nodes.front()));
  if (member.release.size() == 2 && member.release[0] == member.release[1])
    table.fail("release", "found \"" + member.release[0] + "\" twice, expected each end once");
}

void read_strains(Table& table, Member& member, const Scene& scene) {
  if (table.has("temperature") && !table.has("thermal_expansion"))
    table.fail("temperature", "needs thermal_expansion in the same table");
  member.thermal_expansion = table.number("thermal_expansion");
  member.temperature = read_number_or_history(table, "temperature", scene);
  member.initial_strain = read_number_or_history(table, "initial_strain", scene);
}

/// Bend factors of a pipe, ASME B31: h = t R / r^2, flexibility 1.65 / h, in-plane intensification 0.9 / h^(2/3), not
/// below 1.
Bend factors_of_pipe(const Section& section, double radius) {
  const double h = section.pipe_wall * std::abs(radius) / (section.pipe_radius * section.pipe_radius);
  return {radius, std::max(1.0, 1.65 / h), std::max(1.0, 0.9 / std::cbrt(h * h))};
}

Bend read_bend(Table& table, const Member& member, const Section& section, const Scene& scene) {
  if (member.type == MemberType::bar) table.fail("bend", "has no meaning for a bar, which is straight");
  Table keys = table.child("bend");
  const double radius = keys.number("radius");
  Names nodes;
  for (const Node& node : scene.nodes) nodes.add(node.name);
  for (std::size_t i = 0; i + 1 < member.nodes.size(); ++i) {
    const Node &a = scene.nodes[*nodes.index(member.nodes[i])],
               &b = scene.nodes[*nodes.index(member.nodes[i + 1])];
    const double half = 0.5 * std::hypot(b.x - a.x, b.y - a.y);
    if (!(std::abs(radius) >= half * (1.0 - rounding::many_operations)))
      keys.fail("radius",
                fmt::format("found {}, expected at least half the distance between \"{}\" and \"{}\", {:.9g}",
                            base::format_number(radius), a.name, b.name, half));
  }
  Bend bend = section.pipe_wall > 0.0 ? factors_of_pipe(section, radius) : Bend{radius};
  bend.flexibility = keys.optional_number("flexibility").value_or(bend.flexibility);
  bend.intensification = keys.optional_number("sif").value_or(bend.intensification);
  keys.finish();
  table.record("bend", keys.record().inline_table());
  return bend;
}

}  // namespace

void read_members(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names sections;
  for (const Section& section : scene.sections) sections.add(section.name);
  long total = 0;
  for (Table& table : tables_of(top, "members")) {
    Member member;
    member.place = table.place();
    if (!table.has("nodes")) table.require("nodes", "");
    member.nodes = read_node_names(table, "nodes", space);
    if (member.nodes.size() < 2) table.wrong("nodes", "the names of two or more nodes");
    std::vector<std::size_t> nodes;
    for (const std::string& name : member.nodes) nodes.push_back(*space.names.index(name));
    check_pieces(table, scene, nodes);
    member.type = table.choice("type") == "bar" ? MemberType::bar : MemberType::beam;
    member.section = table.text("section");
    const Section& section = scene.sections[check_known(member.section, sections, "section",
                                                        table.place("section"), table.path("section"))];
    if (member.type == MemberType::beam && section.EI == 0.0) {
      table.fail(
          "section",
          fmt::format("section \"{}\" has no EI, expected a section with EI, because the member is a beam",
                      section.name));
    }
    if (table.has("bend")) member.bend = read_bend(table, member, section, scene);
    member.elements = read_elements(table, member.nodes.size() - 1, member.bend.has_value());
    check_bar(table, member);
    for (const int n : member.elements) total += n;
    if (total > most_elements) {
      table.fail("elements",
                 fmt::format("found {} elements up to here, expected at most {}", total, most_elements));
    }
    member.mass = table.choice("mass") == "lumped" ? MassKind::lumped : MassKind::consistent;
    read_release(table, member);
    read_strains(table, member, scene);
    table.finish();
    scene.members.push_back(std::move(member));
    record.add("members", "[[members]]", table.record());
  }
}

// Sections: stiffness and mass as given, or from a shape.
//
//   EA = E A,  EI = E I,  mass per length = density A + content A_inside + insulation,  W = I / (height/2)
//
//   pipe   D, t, d = D - 2t   A = pi t (D - t)                I = A (D^2 + d^2)/16
//   round  D                  A = pi D^2/4                    I = A D^2/16
//   box    b, h, t            A = b h - (b - 2t)(h - 2t)      I = (b h^3 - (b - 2t)(h - 2t)^3)/12
//   i      b, h, s, t         A = 2 b t + (h - 2t) s          strong: I = (b h^3 - (b - s)(h - 2t)^3)/12
//                                                             weak:   I = (2 t b^3 + (h - 2t) s^3)/12

namespace {

/// Cross-section: area, second moment of area, distance of the outermost fibre from the neutral axis.
struct Shape {
  double area = 0.0, moment = 0.0, reach = 0.0;
  double additional_mass = 0.0;  ///< mass per length in addition to that of the material
};

constexpr const char* all_shapes[] = {"pipe", "box", "i", "round"};

double ring(double thickness, double inner_diameter) {
  return std::numbers::pi * thickness * (inner_diameter + thickness);
}

/// Reads a wall thickness; refuses a wall that does not fit within `width`.
double read_wall(Table& table, const char* key, double width, const char* of) {
  const double wall = table.number(key);
  if (!(2.0 * wall < width))
    table.fail(key, fmt::format("found {}, expected less than half of the {} {}", base::format_number(wall),
                                of, base::format_number(width)));
  return wall;
}

Shape read_pipe(Table& table, Section& section) {
  const double outer = table.number("diameter"), wall = read_wall(table, "wall", outer, "diameter");
  const double inner = outer - 2.0 * wall;
  Shape shape;
  shape.area = ring(wall, inner);
  shape.moment = shape.area * (outer * outer + inner * inner) / 16.0;
  shape.reach = 0.5 * outer;
  shape.additional_mass = table.number("content") * std::numbers::pi * inner * inner / 4.0;
  if (table.has("insulation")) {
    Table insulation = table.child("insulation");
    shape.additional_mass += insulation.number("density") * ring(insulation.number("thickness"), outer);
    insulation.finish();
    table.record("insulation", insulation.record().inline_table());
  }
  section.pipe_wall = wall;
  section.pipe_radius = 0.5 * (outer - wall);
  return shape;
}

Shape read_round(Table& table) {
  const double diameter = table.number("diameter"), area = std::numbers::pi * diameter * diameter / 4.0;
  return {area, area * diameter * diameter / 16.0, 0.5 * diameter};
}

Shape read_box(Table& table) {
  const double b = table.number("width"), h = table.number("height");
  if (!table.has("wall")) return {b * h, b * h * h * h / 12.0, 0.5 * h};
  const double t = read_wall(table, "wall", std::min(b, h), b < h ? "width" : "height");
  const double inside = b - 2.0 * t, between = h - 2.0 * t;
  return {b * h - inside * between, (b * h * h * h - inside * between * between * between) / 12.0, 0.5 * h};
}

Shape read_i(Table& table) {
  const double b = table.number("width"), h = table.number("height");
  const double t = read_wall(table, "flange", h, "height"), s = table.number("web"), between = h - 2.0 * t;
  if (!(s <= b))
    table.fail("web", fmt::format("found {}, expected at most the width {}", base::format_number(s),
                                  base::format_number(b)));
  const double area = 2.0 * b * t + between * s;
  if (table.choice("axis") == "weak")
    return {area, (2.0 * t * b * b * b + between * s * s * s) / 12.0, 0.5 * b};
  return {area, (b * h * h * h - (b - s) * between * between * between) / 12.0, 0.5 * h};
}

void read_shape(Table& table, const std::string& name, Section& section) {
  for (const char* key : {"EA", "EI", "mass_per_length", "area", "modulus"})
    if (table.has(key)) table.fail(key, fmt::format("follows from {0}; remove {1} or {0}", name, key));
  Table dimensions = table.child(name);
  const Shape shape = name == "pipe"  ? read_pipe(dimensions, section)
                      : name == "box" ? read_box(dimensions)
                      : name == "i"   ? read_i(dimensions)
                                      : read_round(dimensions);
  const double E = dimensions.number("E");
  section.EA = E * shape.area;
  section.EI = E * shape.moment;
  section.mass_per_length = dimensions.number("density") * shape.area + shape.additional_mass;
  section.area = shape.area;
  section.modulus = shape.moment / shape.reach;
  dimensions.finish();
  table.record(name, dimensions.record().inline_table());
}

}  // namespace

void read_sections(Table& top, Scene& scene, ResolvedScene& record) {
  Table sections = top.child("sections");
  for (const Entry& entry : entries_of(sections.node())) {
    check_name(entry.name, entry.place(), sections.path(entry.name));
    if (!entry.node->is_table()) sections.wrong(entry.name, "a table [sections." + entry.name + "]");
    Table table(entry.node->as_table(), "sections.*", sections.path(entry.name), place_of(*entry.node));
    Section section;
    section.name = entry.name;
    std::string shape;
    for (const char* name : all_shapes) {
      if (!table.has(name)) continue;
      if (!shape.empty())
        table.fail(name, fmt::format("cannot be combined with {}; give only one shape", shape));
      shape = name;
    }
    if (!shape.empty()) {
      read_shape(table, shape, section);
    } else {
      for (const char* key : {"EA", "mass_per_length"}) table.require(key, "");
      section.EA = table.number("EA");
      section.EI = table.optional_number("EI").value_or(0.0);
      section.mass_per_length = table.number("mass_per_length");
      section.area = table.optional_number("area").value_or(0.0);
      section.modulus = table.optional_number("modulus").value_or(0.0);
    }
    scene.sections.push_back(section);
    record.add("sections", "[sections." + toml_key(entry.name) + "]", table.record());
  }
}

// Rigid bodies: nodes that move rigidly with a centre.

namespace {

/// Reads the box of a rigid body: m = density width height thickness,  J = m (width^2 + height^2)/12
void read_box(Table& table, PointMass& mass) {
  for (const char* key : {"mass", "inertia"})
    if (table.has(key))
      table.fail(
          key,
          fmt::format("cannot be combined with box, which defines mass and inertia; remove {} or box", key));
  Table box = table.child("box");
  const double width = box.number("width"), height = box.number("height");
  mass.mass = box.number("density") * width * height * box.number("thickness");
  mass.inertia = mass.mass * (width * width + height * height) / 12.0;
  box.finish();
  table.record("box", box.record().inline_table());
}

/// Reads the centre: an existing node, or a position [x, y], which becomes a new node with the name of the body.
/// Returns the name of the node.
std::string read_centre(Table& table, const std::string& name, Scene& scene, Names& nodes) {
  table.require("centre", "");
  if (!table.raw("centre")->is_array()) {
    const std::string centre = table.text("centre");
    check_known(centre, nodes, "node", table.place("centre"), table.path("centre"));
    return centre;
  }
  const auto [x, y] = table.vector("centre");
  if (!nodes.add(name))
    table.fail("name", fmt::format("found \"{}\", which is the name of a node; expected another name, "
                                   "because the centre becomes a node with the name of the body",
                                   name));
  scene.nodes.push_back({name, x, y, table.place("centre")});
  return name;
}

}  // namespace

void read_rigid(Table& top, Scene& scene, ResolvedScene& record) {
  Names bodies;
  for (Table& table : tables_of(top, "rigid")) {
    const NameScope space = name_scope(scene);
    Names nodes = space.names;
    RigidBody body;
    body.name = table.text("name");
    if (!bodies.add(body.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each rigid body to have its own name", body.name));
    for (const BodySpec& other : scene.bodies)
      if (other.name == body.name)
        table.fail("name",
                   fmt::format("found \"{}\", which is the name of one of [[bodies]]; expected another name",
                               body.name));
    table.require("nodes", "");
    body.place = table.place("nodes");
    body.nodes = read_node_names(table, "nodes", space);
    if (body.nodes.empty()) table.wrong("nodes", "names of nodes");
    body.centre = read_centre(table, body.name, scene, nodes);
    std::erase(body.nodes, body.centre);
    if (body.nodes.empty())
      table.fail(
          "nodes",
          "found only the centre, expected other nodes; for a single node with inertia use [[masses]]");
    PointMass mass;
    mass.place = table.place();
    mass.key = table.path();
    mass.node = body.centre;
    if (table.has("box")) {
      read_box(table, mass);
    } else {
      for (const char* key : {"mass", "inertia"}) table.require(key, " (required without box)");
      mass.mass = table.number("mass");
      mass.inertia = table.number("inertia");
    }
    table.finish();
    scene.masses.push_back(std::move(mass));
    scene.rigid.push_back(std::move(body));
    record.add("rigid", "[[rigid]]", table.record());
  }
}

}  // namespace signorini::scene
