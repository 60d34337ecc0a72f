#include "model/element/element_kinds.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rounding.hpp"
#include "model/element/line_elements.hpp"

namespace signorini::element {
namespace {

constexpr std::array kinds = {ElementKind{MemberType::beam, mesh_line_member, true},
                              ElementKind{MemberType::bar, mesh_line_member}};

}  // namespace

const ElementKind& kind_of(MemberType type) {
  return *std::find_if(kinds.begin(), kinds.end(), [type](const ElementKind& k) { return k.type == type; });
}

std::vector<MemberLine> lines_of(const Member& member) {
  const ElementKind& kind = kind_of(member.type);
  std::vector<MemberLine> lines;
  for (std::size_t i = 1; i < member.nodes.size(); ++i)
    lines.push_back(
        {member.nodes[i - 1], member.nodes[i], kind.bends, is_hinged(member, i - 1), is_hinged(member, i)});
  if (kind.closed) lines.push_back({member.nodes.back(), member.nodes.front(), kind.bends});
  return lines;
}

namespace {

const Section& find_section(const Scene& scene, const Member& member, const std::string& key) {
  const auto it = std::find_if(scene.sections.begin(), scene.sections.end(),
                               [&](const Section& s) { return s.name == member.section; });
  if (it == scene.sections.end())
    throw SceneError(member.place, key + ".section", fmt::format("no section is named '{}'", member.section));
  const bool bends = member.type == MemberType::beam;
  if (!(it->EA > 0.0) || (bends && !(it->EI > 0.0)) || !(it->mass_per_length >= 0.0))
    throw SceneError(member.place, key + ".section",
                     fmt::format("section '{}' needs EA > 0{} and mass_per_length >= 0", it->name,
                                 bends ? ", EI > 0" : ""));
  return *it;
}

/// Point at the fraction s of a piece from a to b: on the straight line, or on the arc. An arc that bends to
/// the left lies on the right of the line.
std::array<double, 2> place_on_piece(const MeshNode& a, const MeshNode& b, const Member& member, double s) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  if (!member.bend) return {a.x + s * dx, a.y + s * dy};
  const double length = std::hypot(dx, dy), radius = std::abs(member.bend->radius);
  // Near a half circle, asin would amplify a rounding error of the node coordinates to its square root.
  const double sine = 0.5 * length / radius;
  const double half = sine < 1.0 - rounding::many_operations ? std::asin(sine) : 0.5 * std::numbers::pi;
  const double turn = (2.0 * s - 1.0) * half;
  const double along = 0.5 + radius * std::sin(turn) / length;
  // cos turn - cos half, without cancellation
  const double rise = 2.0 * std::sin(0.5 * (half + turn)) * std::sin(0.5 * (half - turn));
  const double out = (member.bend->radius > 0.0 ? radius : -radius) * rise / length;
  return {a.x + along * dx + out * dy, a.y + along * dy - out * dx};
}

std::shared_ptr<const FiniteElement> line_element(MemberType type, const LineData& data) {
  if (type == MemberType::bar) return std::make_shared<BarElement>(data);
  return std::make_shared<BeamElement>(data);
}

void add_piece(Mesh& mesh, const Scene& scene, std::size_t number, std::size_t piece, const Section& section,
               const std::string& key) {
  const Member& member = scene.members[number];
  const int a = find_node(mesh, member.nodes[piece], member.place, key + ".nodes");
  const int b = find_node(mesh, member.nodes[piece + 1], member.place, key + ".nodes");
  const MeshNode from = mesh.nodes[static_cast<std::size_t>(a)];
  const MeshNode to = mesh.nodes[static_cast<std::size_t>(b)];
  if (from.x == to.x && from.y == to.y)
    throw SceneError(member.place, key + ".nodes",
                     fmt::format("nodes '{}' and '{}' are at the same place", from.name, to.name));
  const int count =
      member.elements.empty() ? 1 : member.elements[std::min(piece, member.elements.size() - 1)];
  if (count < 1)
    throw SceneError(member.place, key + ".elements",
                     fmt::format("found {}, expected at least one element", count));
  if (count > 1 && member.type == MemberType::bar)
    throw SceneError(
        member.place, key + ".elements",
        fmt::format("found {}, expected 1: inner nodes of a bar would have no lateral stiffness", count));
  const bool hinged_a = is_hinged(member, piece), hinged_b = is_hinged(member, piece + 1);
  mesh.pieces.push_back({a, b, mesh.elements.size(), static_cast<std::size_t>(count)});
  int previous = a;
  for (int i = 1; i <= count; ++i) {
    int next = b;
    if (i < count) {
      const auto [x, y] = place_on_piece(from, to, member, static_cast<double>(i) / count);
      next = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back({fmt::format("{}-{}.{}", from.name, to.name, i), x, y});
    }
    const MeshNode &start = mesh.node(previous), &end = mesh.node(next);
    mesh.elements.push_back(
        line_element(member.type, {{previous, next},
                                   static_cast<int>(number),
                                   axis_between(end.x - start.x, end.y - start.y),
                                   section.EA,
                                   section.EI / (member.bend ? member.bend->flexibility : 1.0),
                                   section.mass_per_length,
                                   member.mass,
                                   hinged_a && i == 1,
                                   hinged_b && i == count}));
    previous = next;
  }
}

}  // namespace

bool is_hinged(const Member& member, std::size_t node) {
  const bool at_end = node == 0 || node + 1 == member.nodes.size();
  return at_end &&
         std::find(member.release.begin(), member.release.end(), member.nodes[node]) != member.release.end();
}

const Section& section_of(const Scene& scene, const Member& member) {
  return *std::find_if(scene.sections.begin(), scene.sections.end(),
                       [&](const Section& s) { return s.name == member.section; });
}

void mesh_line_member(Mesh& mesh, const Scene& scene, std::size_t number) {
  const Member& member = scene.members[number];
  const std::string key = fmt::format("members.{}", number + 1);
  if (member.nodes.size() < 2)
    throw SceneError(member.place, key + ".nodes", "a member needs at least two nodes");
  const Section& section = find_section(scene, member, key);
  for (std::size_t piece = 0; piece + 1 < member.nodes.size(); ++piece)
    add_piece(mesh, scene, number, piece, section, key);
}

}  // namespace signorini::element
