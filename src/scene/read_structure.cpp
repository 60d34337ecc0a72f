// Nodes and members.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "base/rounding.hpp"
#include "scene/readers.hpp"

namespace signorini {

namespace {

constexpr int most_elements = 1'000'000;
constexpr int elements_of_arc = 8;  // for a quarter circle; the chords are 0.16 % shorter than the arc

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
      table.fail("elements", fmt::format("found {}, expected one number, or one for each of the {}",
                                         describe(*node), count_of(pieces, "piece")));
    }
    for (std::size_t i = 0; i < pieces; ++i) elements[i] = count(array[i]);
  } else if (node) {
    std::fill(elements.begin(), elements.end(), count(*node));
  }
  if (arcs && *std::min_element(elements.begin(), elements.end()) < 2)
    table.fail("elements", "found 1, expected at least 2 on an arc, which they follow as chords");
  std::vector<std::string> texts;
  for (const int n : elements) texts.push_back(std::to_string(n));
  table.record("elements", toml_array(texts));
  return elements;
}

/// The inner nodes of a chain of bars would be free to move sideways.
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

void read_nodes(Table& top, Scene& scene, RecordedScene& record) {
  Table nodes = top.child("nodes");
  for (const Entry& entry : entries_of(nodes.node())) {
    check_name(entry.name, entry.place(), nodes.path(entry.name));
    const auto [x, y] = nodes.vector(entry.name);
    scene.nodes.push_back({entry.name, x, y, entry.place()});
  }
  if (!scene.nodes.empty()) record.add("nodes", "[nodes]", nodes.record());
}

void read_lines(Table& top, Scene& scene, RecordedScene& record) {
  Names names;
  for (const Node& node : scene.nodes) names.add(node.name);
  for (Table& table : tables_of(top, "lines")) {
    const std::string name = table.text("name");
    const auto from = table.vector("from"), to = table.vector("to");
    const int pieces = table.integer("pieces");
    if (pieces > most_elements - static_cast<int>(scene.nodes.size()))
      table.fail("pieces", fmt::format("found {}, expected at most {} nodes in all", pieces, most_elements));
    for (int i = 0; i <= pieces; ++i) {
      const double s = static_cast<double>(i) / pieces;
      const std::string own = fmt::format("{}{}", name, i);
      if (!names.add(own)) table.fail("name", fmt::format("node \"{}\" exists already", own));
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
    table.fail("release", fmt::format("found \"{}\", which is the member's first and last node: expected a "
                                      "member with two ends",
                                      member.nodes.front()));
  if (member.release.size() == 2 && member.release[0] == member.release[1])
    table.fail("release", "found \"" + member.release[0] + "\" twice");
}

void read_strains(Table& table, Member& member, const Scene& scene) {
  if (table.has("temperature") && !table.has("thermal_expansion"))
    table.fail("temperature", "needs thermal_expansion beside it");
  member.thermal_expansion = table.number("thermal_expansion");
  member.temperature = read_standing_history(table, "temperature", scene);
  member.initial_strain = read_standing_history(table, "initial_strain", scene);
}

}  // namespace

namespace {

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
    if (!(std::abs(radius) >= half * (1.0 - rounding::of_many)))
      keys.fail("radius",
                fmt::format("found {}, expected at least half the distance of \"{}\" and \"{}\", {:.9g}",
                            shortest(radius), a.name, b.name, half));
  }
  Bend bend = section.pipe_wall > 0.0 ? factors_of_pipe(section, radius) : Bend{radius};
  bend.flexibility = keys.optional_number("flexibility").value_or(bend.flexibility);
  bend.intensification = keys.optional_number("sif").value_or(bend.intensification);
  keys.finish();
  table.record("bend", keys.record().inline_table());
  return bend;
}

}  // namespace

void read_members(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
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
      table.fail("section",
                 fmt::format("section \"{}\" has no EI, expected one with EI for a beam", section.name));
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

}  // namespace signorini
