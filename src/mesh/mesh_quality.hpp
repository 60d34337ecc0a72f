// mesh_quality.hpp: distortion of elements compared with squares and equilateral triangles.
//
//   angle at corner i   between its two edges, with corners joined by straight lines
//   aspect              longest edge / shortest edge
//
// Elements represent a constant stress exactly in any shape; errors of other stresses grow with 1/sin(angle) and the
// aspect.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "mesh/mortar.hpp"
#include "mesh/shape_functions.hpp"
#include "signorini/plane_mesh.hpp"

namespace signorini::mesh {

struct MeshQuality {
  struct Worst {
    double value = 0.0;
    long element = 0;  ///< PlaneMesh::Element::number
  };
  Worst min_angle{180.0}, max_angle, aspect;  ///< angles in degrees; aspect without unit
};

/// place: returns the position of a node of `elements`.
[[nodiscard]] MeshQuality measure_quality(const std::vector<PlaneMesh::Element>& elements,
                                          const NodePosition& place);

// The edges of a mesh, each once, with the number of adjacent elements.
//
//   1 element: edge on the boundary,   2 elements: edge inside the mesh

struct SharedEdge {
  /// Two ends, then the middle node if there is one. The element from which the edge was added first is on its left.
  std::vector<int> nodes;
  int elements = 0;
};
/// Edges by the numbers of their ends, the smaller one first.
using SharedEdges = std::map<std::pair<int, int>, SharedEdge>;

/// Adds the edges of `elements` to `edges`, and counts the elements at each edge.
inline void add_edges(const std::vector<PlaneMesh::Element>& elements, SharedEdges& edges) {
  for (const PlaneMesh::Element& element : elements)
    for (std::size_t i = 0; i < corner_count(element.shape); ++i) {
      std::vector<int> nodes = edge_nodes(element, i);
      const std::pair<int, int> ends = std::minmax(nodes[0], nodes[1]);
      ++edges.try_emplace(ends, SharedEdge{std::move(nodes), 0}).first->second.elements;
    }
}

}  // namespace signorini::mesh
