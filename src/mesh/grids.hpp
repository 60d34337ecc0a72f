// grids.hpp: parametric meshes of a rectangle and of an annular sector.
//
//   rectangle  x = from + Q(angle) (u width, v height)        groups: bottom, right, top, left
//   ring       r = inner + u (outer - inner), angle = start + v (end - start)   groups: inner, end, outer, start
//
// u and v run from 0 to 1 in elements[0] and elements[1] steps; grading: ratio of the last step to the first
// (geometric). Nodes of quadratic elements lie on the arcs. Nodes are numbered from 1, first along u. A full ring (2 pi)
// is closed: it has neither start nor end.
#pragma once

#include <array>

#include "signorini/plane_mesh.hpp"

namespace signorini::mesh {

struct GridSpec {
  PlaneShape shape = PlaneShape::q4;
  std::array<int, 2> elements{1, 1};
  std::array<double, 2> grading{1.0, 1.0};
};
struct RectangleSpec {
  std::array<double, 2> from{0.0, 0.0}, size{1.0, 1.0};  ///< unit: length
  double angle = 0.0;                                    ///< rad, about `from`
};
struct RingSpec {
  std::array<double, 2> centre{0.0, 0.0};
  double inner = 0.0, outer = 0.0;  ///< radii; unit: length
  double start = 0.0, end = 0.0;    ///< rad, end > start
};

[[nodiscard]] PlaneMesh rectangle_mesh(const RectangleSpec& rectangle, const GridSpec& grid);
[[nodiscard]] PlaneMesh ring_mesh(const RingSpec& ring, const GridSpec& grid);

}  // namespace signorini::mesh
