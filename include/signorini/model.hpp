// model.hpp: the scene as matrices.
//
//   M u'' + C u' + K u = P(t) - sum_k ( n_k N_k + t_k T_k ),   P(t) = sum_i d_i f_i(t)
//
// K holds no contact springs. Only degrees of freedom that exist and are not fixed are numbered;
// those whose row of M is zero are massless. Shapes: n degrees of freedom, all vectors of length n.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "signorini/contact.hpp"
#include "signorini/scene.hpp"

namespace signorini {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major, both triangles stored

struct Dof {
  std::string displacement;  ///< "A.ux", "A.rz", "d0.u"; elements' inner nodes: "B-D.3.ux"
  std::string velocity;      ///< "A.vx", "A.wz", "d0.v"
  bool rotation = false;
  bool massless = false;
};

/// A column of history.csv.
struct Column {
  std::string name;
  int dof = 0;
  bool velocity = false;
};

struct Load {
  std::string name;  ///< "gravity", "load 1", ...
  Combination direction;
  History history;         ///< amplitude included
  bool is_static = false;  ///< counts for initial = "static": gravity and constants that hold since ever
};

/// Typical magnitudes, from which absolute tolerances follow. Units in the names.
struct Scales {
  double displacement = 1.0, rotation = 1.0, velocity = 1.0, angular_velocity = 1.0, force = 1.0;
};

/// What the static start found (initial = "static").
struct StaticStart {
  std::vector<double> reactions;          ///< -N a contact, >= 0
  std::vector<std::string> free_motions;  ///< "horizontal motion held at contact 'first'"
};

// What deformed shapes are drawn from; empty in matrix scenes. dofs (ux, uy, rz): -1 where fixed or absent.

/// A node of the mesh, inner ones of beams included.
struct DrawnNode {
  std::string name;
  double x = 0.0, y = 0.0;
  int dofs[3] = {-1, -1, -1};
  bool named = true;  ///< stands in the scene file
  bool held = false;  ///< by a support
};

/// A beam, a bar, or a spring between two nodes; dofs at both ends.
struct DrawnElement {
  enum class Kind : unsigned char { beam, bar, spring };
  double x1, y1, x2, y2;
  int dofs[6];
  int nodes[2] = {-1, -1};  ///< indices into Model::drawn_nodes
  Kind kind = Kind::beam;
};

/// Where a contact acts and along which unit vectors.
struct DrawnContact {
  int node = -1;
  double x = 0.0, y = 0.0;
  double nx = 0.0, ny = 0.0, tx = 0.0, ty = 0.0;
};

struct Model {
  std::string title;
  Units units;
  std::vector<Dof> dofs;
  SparseMatrix mass, damping, stiffness;
  std::vector<Load> loads;
  std::vector<Contact> contacts;
  std::vector<Column> columns;
  std::vector<DrawnElement> drawing;
  std::vector<DrawnNode> drawn_nodes;
  std::vector<DrawnContact> drawn_contacts;  ///< one a contact
  Vector u0, v0;                             ///< initial state (static equilibrium where asked)
  bool static_start = false;
  StaticStart statics;
  Scales scales;
  double alpha = 0.0, beta = 0.0;  ///< Rayleigh factors in force
  double omega1 = 0.0;             ///< lowest circular frequency, initially closed contacts held; 0: none
  double omega_max = 0.0;          ///< highest circular frequency, all contacts held by their springs

  [[nodiscard]] int size() const { return static_cast<int>(dofs.size()); }
};

/// Assembles, finds frequencies, damping, initial state and scales. Errors: SceneError.
[[nodiscard]] Model build_model(const Scene& scene);

}  // namespace signorini
