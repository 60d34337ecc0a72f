// mesh_quality.hpp: how far elements are from squares and even triangles.
//
//   angle at corner i: between its two edges, corners joined by straight lines;  aspect: longest edge / shortest edge
//
// Exact elements keep a constant stress at any shape; errors of others grow with 1/sin(angle) and with the aspect.
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

/// place: of the indices in `elements`.
[[nodiscard]] MeshQuality quality_of(const std::vector<PlaneMesh::Element>& elements, const PlaceOf& place);

}  // namespace signorini
