// member_pieces.hpp: the pieces of members between named nodes, and forces along them.
#pragma once

#include <array>
#include <utility>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

/// Returns the piece of a member between nodes a and b, and true if the piece runs from b to a. Errors: SceneError if no
/// member, or more than one, has such a piece.
[[nodiscard]] std::pair<const element::MeshPiece*, bool> piece_between(const DofMap& map,
                                                                       const std::string& a,
                                                                       const std::string& b,
                                                                       const SourcePlace& place,
                                                                       const std::string& key);

/// Components along x and y of a distributed load of unit amplitude on an element. backwards: the load names the ends
/// of the piece in the order opposite to the element's direction.
[[nodiscard]] std::array<double, 2> along_line(const LoadSpec& spec, const element::Axis& axis,
                                               bool backwards);

// Data for drawings of deformed shapes.
//
//   position on a beam = x + u,  u between the ends: linear along the beam, cubic across it

/// Fills drawing, drawn_nodes and drawn_contacts of a node scene; the contacts must exist already.
void add_drawing(const Scene& scene, const DofMap& map, Model& model);

}  // namespace signorini::assembly
