// cut.hpp: N, V and M where a finite element is cut, from the equilibrium of the part before the cut.
//
//   element  a ----- x ----- b,  y to its left;  f: forces of the nodes on its ends;  p: loads along it
//
//   N(x) = -f_ax - int_0^x p_x            tension is positive
//   V(x) =  f_ay + int_0^x p_y            V = dM/dx
//   M(x) = -m_a  + int_0^x V              positive where it stretches the right-hand side, y < 0
//
// With frozen axial forces (run.geometric) N v' is added to V, which stays square to the bent axis, so that V = dM/dx.
//
// Along it lie what is distributed, q, and with a consistent mass -rho times the acceleration, interpolated
// as the element's displacements are: linear along it (a bar: across it, too), cubic across. A lumped mass
// lies at the ends: N and V step at the nodes, and nothing is left between them.
#pragma once

#include <Eigen/Core>

#include "model/assembly/pieces.hpp"

namespace signorini {

/// Factors, by ux, uy, rz at a and b: of the forces on the ends, of the acceleration, of a load q = (x, y)
/// per length.
struct Cut {
  Eigen::Matrix<double, 6, 1> forces, acceleration;
  std::array<double, 2> load{0.0, 0.0};
  /// Of the displacements: what frozen axial forces add across the bent axis, V + N v', M + int_0^x N v'.
  Eigen::Matrix<double, 6, 1> deflection = Eigen::Matrix<double, 6, 1>::Zero();
};

/// At x from a, 0 <= x <= axis.length.
[[nodiscard]] Cut cut_at(const MeshElement& element, const Axis& axis, double mass_per_length,
                         OutputQuantity quantity, double x);

}  // namespace signorini
