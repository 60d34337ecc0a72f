// element_kinds.hpp: element types: conversion of each type of member to elements, and its lines for drawing.
#pragma once

#include "model/element/mesh.hpp"

namespace signorini::element {

struct ElementKind {
  MemberType type;
  /// Appends the nodes and elements of a member, an index into Scene::members. Errors: SceneError.
  void (*generate)(Mesh& mesh, const Scene& scene, std::size_t member);
  bool bends = false;   ///< lines of the member are drawn as cubics
  bool closed = false;  ///< a line joins the member's last node to its first
};

[[nodiscard]] const ElementKind& kind_of(MemberType type);

/// A drawn line of a member between two named nodes, and whether its ends rotate independently of the nodes.
struct MemberLine {
  std::string from, to;
  bool bends = false, hinged_from = false, hinged_to = false;
};
[[nodiscard]] std::vector<MemberLine> lines_of(const Member& member);

// Members of bars or beams: chains of pieces, each with elements of equal length.

/// Appends the inner nodes, pieces and elements of a member. Errors: SceneError.
void mesh_line_member(Mesh& mesh, const Scene& scene, std::size_t number);

/// True if the member's end at this node, an index into Member::nodes, is hinged; false for inner nodes.
[[nodiscard]] bool is_hinged(const Member& member, std::size_t node);

/// Returns the section that the member names; the section must exist.
[[nodiscard]] const Section& section_of(const Scene& scene, const Member& member);

}  // namespace signorini::element
