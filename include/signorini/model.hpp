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

/// A drawn piece of the structure: dofs (ux, uy, rz) at both ends, -1 where fixed or absent.
struct DrawnElement {
  double x1, y1, x2, y2;
  int dofs[6];
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
  Vector u0, v0;  ///< initial state (static equilibrium where asked)
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
