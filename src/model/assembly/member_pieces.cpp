#include "model/assembly/member_pieces.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "scene/outlines.hpp"

namespace signorini::assembly {

std::pair<const element::MeshPiece*, bool> piece_between(const DofMap& map, const std::string& a,
                                                         const std::string& b, const SourcePlace& place,
                                                         const std::string& key) {
  const int from = element::find_node(map.mesh, a, place, key),
            to = element::find_node(map.mesh, b, place, key);
  const element::MeshPiece* found = nullptr;
  for (const element::MeshPiece& piece : map.mesh.pieces) {
    const bool joins = (piece.from == from && piece.to == to) || (piece.from == to && piece.to == from);
    if (!joins) continue;
    if (found)
      throw SceneError(place, key, fmt::format("two members join nodes '{}' and '{}', expected one", a, b));
    found = &piece;
  }
  if (!found)
    throw SceneError(place, key, fmt::format("no member has nodes '{}' and '{}' next to each other", a, b));
  return {found, found->from != from};
}

std::array<double, 2> along_line(const LoadSpec& spec, const element::Axis& axis, bool backwards) {
  const auto& q = spec.direction.vector;
  if (!spec.member_axes) return q;
  const double turn = backwards ? -1.0 : 1.0;
  return {turn * (q[0] * axis.c - q[1] * axis.s), turn * (q[0] * axis.s + q[1] * axis.c)};
}

namespace {

DrawnNode drawn_node(const DofMap& map, std::size_t i) {
  const element::MeshNode& at = map.mesh.nodes[i];
  DrawnNode node{at.name, at.x, at.y, {-1, -1, -1}, i < static_cast<std::size_t>(map.mesh.named) && at.listed,
                 false};
  for (std::size_t c = 0; c < 3; ++c) {
    node.dofs[c] = std::max(map.number[i][c], -1);
    node.held = node.held || map.number[i][c] == DofMap::fixed;
  }
  return node;
}

DrawnElement between(const std::vector<DrawnNode>& nodes, int a, int b, DrawnElement::Kind kind) {
  const DrawnNode& from = nodes[static_cast<std::size_t>(a)];
  const DrawnNode& to = nodes[static_cast<std::size_t>(b)];
  DrawnElement e{from.x, from.y, to.x, to.y, {}, {a, b}, kind};
  std::copy(std::begin(from.dofs), std::end(from.dofs), e.dofs);
  std::copy(std::begin(to.dofs), std::end(to.dofs), e.dofs + 3);
  return e;
}

void draw_element(const Scene& scene, const DofMap& map, std::size_t i, Model& model) {
  const element::FiniteElement& e = map.mesh.element(i);
  const std::vector<element::ElementUnknown> unknowns = e.unknowns();
  for (const auto& [from, to, bends] : e.lines()) {
    const bool of_body = static_cast<std::size_t>(e.member()) >= scene.members.size();
    const auto kind = bends     ? DrawnElement::Kind::beam
                      : of_body ? DrawnElement::Kind::mesh
                                : DrawnElement::Kind::bar;
    DrawnElement& drawn =
        model.drawing.emplace_back(between(model.drawn_nodes, e.nodes()[from], e.nodes()[to], kind));
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (!unknowns[j].internal) continue;
      if (unknowns[j].local_node == from) drawn.dofs[unknowns[j].component] = map.internal.at({i, j});
      if (unknowns[j].local_node == to) drawn.dofs[3 + unknowns[j].component] = map.internal.at({i, j});
    }
  }
}

int node_named(const element::Mesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.nodes.begin(), mesh.nodes.begin() + mesh.named,
                                  [&](const element::MeshNode& node) { return node.name == name; });
  return found == mesh.nodes.begin() + mesh.named ? -1 : static_cast<int>(found - mesh.nodes.begin());
}

DrawnContact drawn_contact(const ContactSpec& spec, const DofMap& map) {
  DrawnContact c;
  const Direction* direction = spec.normal ? &*spec.normal : spec.tangent ? &*spec.tangent : nullptr;
  if (!direction) return c;
  c.node = node_named(map.mesh, direction->node);
  const double length = std::hypot(direction->vector[0], direction->vector[1]);
  if (c.node < 0 || !(length > 0.0)) return c;
  c.x = map.mesh.nodes[static_cast<std::size_t>(c.node)].x;
  c.y = map.mesh.nodes[static_cast<std::size_t>(c.node)].y;
  const double x = direction->vector[0] / length, y = direction->vector[1] / length;
  // t = (ny, -nx), so n = (-ty, tx).
  c.nx = spec.normal ? x : -y;
  c.ny = spec.normal ? y : x;
  c.tx = c.ny;
  c.ty = -c.nx;
  return c;
}

}  // namespace

void add_drawing(const Scene& scene, const DofMap& map, Model& model) {
  for (std::size_t i = 0; i < map.mesh.nodes.size(); ++i) model.drawn_nodes.push_back(drawn_node(map, i));
  for (std::size_t i = 0; i < map.mesh.elements.size(); ++i) draw_element(scene, map, i, model);
  for (const Spring& s : scene.springs) {
    if (s.against.empty() || (s.stiffness == 0.0 && s.damping == 0.0)) continue;
    const int a = node_named(map.mesh, s.node), b = node_named(map.mesh, s.against);
    model.drawing.push_back(between(model.drawn_nodes, a, b, DrawnElement::Kind::spring));
  }
  for (const RigidBody& body : scene.rigid)
    for (const auto& [from, to] : scene::outline_of(scene, body))
      model.drawing.push_back(between(model.drawn_nodes, node_named(map.mesh, from), node_named(map.mesh, to),
                                      DrawnElement::Kind::rigid));
  for (const ContactSpec& spec : scene.contacts) model.drawn_contacts.push_back(drawn_contact(spec, map));
}

}  // namespace signorini::assembly
