// gmsh_file.hpp: plane meshes of Gmsh, .msh 4.1 and 2.2, ASCII.
//
//   $PhysicalNames   dimension tag "name"        groups: of surfaces, curves and points
//   elements         1 line2  8 line3  15 point  2 t3  9 t6  3 q4  16 q8; others are refused
//
// A body consists of the elements of some physical surfaces, or of all. Its groups are the physical curves and points
// that touch it. Nodes that it does not use are omitted; a node that no element of the file uses is refused. If all
// elements run clockwise, they are reversed; if only some do, or a Jacobian is not positive at a node, the mesh folds
// and is refused.
// Source: Gmsh reference manual, sections "MSH file format version 4.1" and "version 2 (Legacy)".
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "signorini/plane_mesh.hpp"

namespace signorini {

/// surfaces: names of physical surfaces; empty: all. Errors: SceneError at the line of the file; `key` begins the
/// message.
[[nodiscard]] PlaneMesh read_gmsh(std::istream& in, const std::string& file, const std::string& key,
                                  const std::vector<std::string>& surfaces);

/// Checks the determinants of the Jacobian at nodes and integration points: all > 0, or a SceneError at the element's
/// place. Reverses the elements first if all run clockwise.
void check_elements(PlaneMesh& mesh, const std::string& key);

}  // namespace signorini
