// damped_modes.hpp: complex modes of a structure with springs, dashpots and constraints, expressed in its unconstrained modes.
//
//   q_j'' + c_j q_j' + d_j q_j + sum_a u_ja lambda_a = p_j
//   lambda_a = (k_a + c_a d/dt) v_a . q     or, if term a is rigid,   v_a . q = 0
//
//   q = x e^(l t),   P_j(l) = l^2 + c_j l + d_j:     T(l) (lambda, x_G) = 0
//   T = | 1 + kappa_a sum_j v_ja u_jb / P_j    -kappa_a v_ja |      sums over j outside G; columns for j in G
//       | u_jb                                  P_j          |      kappa_a = k_a + l c_a
//
// If term a is rigid, the 1 is absent and kappa = 1: the limit of infinite stiffness. G contains the modes whose P_j is small,
// so that no division by a small difference occurs.
//
// The roots of a dense eigenproblem in doubles are initial values. Newton steps on T in extended precision refine these roots,
// and the null vectors of T give the shapes. A mode that is coupled to no term (v_j = 0) has the two roots of P_j. Modes with
// equal poles are rotated so that as few as possible are coupled to terms. A multiple root has several null vectors of T. If
// nearly equal roots have nearly the same shape, no modes are computed (failure).
//
//   motion   q = Re sum_k shape_k y_k,  y_k' = l_k y_k + from_rate_k . p,   y = from_q q + from_rate q'
//
// Source: Guettel and Tisseur, Acta Numerica 26 (2017), 1 (Newton's method on nonlinear eigenproblems).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace signorini::modal {

/// A spring with a dashpot, or a constraint (rigid), in the unconstrained modes. u: direction of the force; v: form whose value
/// and rate determine the force. u and v have one entry for each mode.
struct ModalTerm {
  Eigen::VectorXd u, v;
  double stiffness = 0.0, damping = 0.0;
  bool rigid = false;
};

/// Largest number of terms (springs, dashpots, constraints) of a contact state for which complex modes are computed.
inline constexpr std::size_t max_damped_terms = 9;

struct DampedModes {
  std::string failure;                 ///< reason why the modes cannot be used; empty: no failure
  Eigen::VectorXcd root;               ///< l, one root of each conjugate pair (im >= 0), |l| ascending
  Eigen::MatrixXcd shape;              ///< n x roots; doubled for a pair, because only real parts are summed
  Eigen::MatrixXcd force;              ///< terms x roots: lambda, doubled for a pair
  Eigen::MatrixXcd from_q, from_rate;  ///< roots x n
  double condition = 1.0;              ///< greatest |x| |y| of right and left eigenvectors with y . x = 1
  double round_trip = 0.0;             ///< error of a motion of size 1 after conversion to modes and back
};

/// Computes the complex modes. square: d_j, ascending; decay: c_j.
[[nodiscard]] DampedModes damped_modes(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                                       const std::vector<ModalTerm>& terms);

}  // namespace signorini::modal
