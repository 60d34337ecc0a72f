#include "mesh/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/shape_functions.hpp"

namespace signorini::mesh {

MeshQuality measure_quality(const std::vector<PlaneMesh::Element>& elements, const NodePosition& place) {
  MeshQuality quality;
  for (const PlaneMesh::Element& e : elements) {
    const std::size_t corners = corner_count(e.shape);
    double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
    for (std::size_t i = 0; i < corners; ++i) {
      const PlanePoint at = place(e.nodes[i]), next = place(e.nodes[(i + 1) % corners]),
                       before = place(e.nodes[(i + corners - 1) % corners]);
      const double ax = next[0] - at[0], ay = next[1] - at[1], bx = before[0] - at[0], by = before[1] - at[1];
      const double angle = std::atan2(ax * by - ay * bx, ax * bx + ay * by) * 180.0 / std::numbers::pi;
      if (angle < quality.min_angle.value) quality.min_angle = {angle, e.number};
      if (angle > quality.max_angle.value) quality.max_angle = {angle, e.number};
      shortest = std::min(shortest, std::hypot(ax, ay));
      longest = std::max(longest, std::hypot(ax, ay));
    }
    if (longest / shortest > quality.aspect.value) quality.aspect = {longest / shortest, e.number};
  }
  return quality;
}

}  // namespace signorini::mesh
