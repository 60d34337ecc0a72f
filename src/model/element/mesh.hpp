// mesh.hpp: nodes and elements of a node scene.
//
// Named nodes come first, then the inner nodes of the members, both in the order of the file. Inner nodes on piece B-D of a
// member are named "B-D.1", "B-D.2", ... from B to D.
#pragma once

#include <string>
#include <unordered_map>

#include "model/element/line_elements.hpp"

namespace signorini::element {

struct MeshNode {
  std::string name;
  double x = 0.0, y = 0.0;  ///< unit: length
  bool listed = true;       ///< true: the node has columns in history.csv; false inside a body's mesh
};

/// Mass of an element that is moved to other nodes: its mass matrix becomes weights^T m weights
/// (body_mesh.hpp).
struct MovedMass {
  std::vector<int> nodes;   ///< nodes of the mesh, two unknowns each
  Eigen::MatrixXd weights;  ///< W, size: unknowns of the element x 2 nodes.size()
};

/// A piece of a member of bars or beams between two named nodes. An arc has inner nodes; its elements are chords.
struct MeshPiece {
  int from = 0, to = 0;
  std::size_t first = 0, count = 0;  ///< indices of its elements, which all are LineElement
};

struct Mesh {
  std::vector<MeshNode> nodes;
  std::vector<std::shared_ptr<const FiniteElement>> elements;
  std::vector<MeshPiece> pieces;
  std::unordered_map<std::size_t, MovedMass> moved;  ///< by element index; only with contact_mass = "none"
  int named = 0;                                     ///< the first `named` nodes are those of Scene::nodes
  std::unordered_map<std::string, int> by_name;      ///< indices of named nodes

  [[nodiscard]] const FiniteElement& element(std::size_t i) const { return *elements[i]; }
  /// The i-th element, which must be a line.
  [[nodiscard]] const LineElement& line(std::size_t i) const {
    return static_cast<const LineElement&>(*elements[i]);
  }
  [[nodiscard]] const MeshNode& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
};

[[nodiscard]] Mesh make_mesh(const Scene& scene);

/// Index of a named node. Errors: SceneError under `key`.
[[nodiscard]] int find_node(const Mesh& mesh, const std::string& name, const SourcePlace& place,
                            const std::string& key);

}  // namespace signorini::element
