// mesh_quality.hpp: distortion of elements compared with squares and equilateral triangles.
//
//   angle at corner i: between its two edges, with corners joined by straight lines;  aspect: longest edge / shortest
// edge
//
// Elements represent a constant stress exactly in any shape; errors of other stresses grow with 1/sin(angle) and the
// aspect.
#pragma once

#include "mesh/mortar.hpp"
#include "signorini/plane_mesh.hpp"

namespace signorini {

struct MeshQuality {
  struct Worst {
    double value = 0.0;
    long element = 0;  ///< its number
  };
  Worst least_angle{180.0}, greatest_angle, aspect;  ///< degrees, degrees, 1
};

/// place: position of each index in `elements`.
[[nodiscard]] MeshQuality quality_of(const std::vector<PlaneMesh::Element>& elements, const PlaceOf& place);

}  // namespace signorini
