// plane_mesh.hpp: nodes, elements and groups of a plane mesh.
//
//   t3  1, 2, 3        t6  corners, then the middles of 1-2, 2-3, 3-1
//   q4  1, 2, 3, 4     q8  corners, then the middles of 1-2, 2-3, 3-4, 4-1
//
// Corners run counter-clockwise. The nodes of an edge are its two end nodes and then its middle node, if it has one; seen
// from the first to the second end node, the body is on the left.
#pragma once

#include <string>
#include <vector>

#include "signorini/error.hpp"

namespace signorini {

enum class PlaneShape : unsigned char { t3, t6, q4, q8 };

struct PlaneMesh {
  struct Node {
    double x = 0.0, y = 0.0;  ///< length
    long number = 0;          ///< number in the file; in a grid, row by row from 1
    SourcePlace place = {};
  };
  struct Element {
    PlaneShape shape = PlaneShape::t3;
    std::vector<int> nodes = {};  ///< indices into `nodes`
    long number = 0;
    SourcePlace place = {};
  };
  struct Edge {
    std::vector<int> nodes = {};  ///< two or three indices
  };
  /// A named boundary (with edges), or a named set of nodes (without edges).
  struct Group {
    std::string name = {};
    std::vector<int> nodes = {};  ///< indices into PlaneMesh::nodes, each once
    std::vector<Edge> edges = {};
  };

  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::vector<Group> groups;
};

}  // namespace signorini
