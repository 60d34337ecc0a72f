// mesh.hpp: nodes and elements of a node scene.
//
// Named nodes come first, in the order of the file; then the inner nodes of the members, in the order
// of the file: on piece B-D of a member, "B-D.1", "B-D.2", ... from B to D.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

struct MeshNode {
  std::string name;
  double x = 0.0, y = 0.0;  ///< length
};

/// One beam or bar between two mesh nodes.
struct MeshElement {
  int a = 0, b = 0;
  int section = 0;  ///< index into Scene::sections
  MemberType type = MemberType::beam;
  MassKind mass = MassKind::consistent;
  bool hinged_a = false, hinged_b = false;  ///< its end has a rotation of its own
  int member = 0;                           ///< index into Scene::members
  double flexibility = 1.0;                 ///< of a bend: EI is divided by it
  double force_a = 0.0, force_b = 0.0;  ///< frozen axial force at its ends, tension positive (geometric.hpp)
};

/// A piece of a member between two named nodes; an arc has nodes on it, and chords as elements.
struct MeshPiece {
  int from = 0, to = 0;
  std::size_t first = 0, count = 0;  ///< of its elements
};

struct Mesh {
  std::vector<MeshNode> nodes;
  std::vector<MeshElement> elements;
  std::vector<MeshPiece> pieces;
  int named = 0;                                 ///< the first `named` nodes are those of the file
  std::unordered_map<std::string, int> by_name;  ///< of the named ones
};

[[nodiscard]] Mesh make_mesh(const Scene& scene);

/// Index of a named node. Errors: SceneError under `key`.
[[nodiscard]] int find_node(const Mesh& mesh, const std::string& name, const SourcePlace& place,
                            const std::string& key);

}  // namespace signorini
