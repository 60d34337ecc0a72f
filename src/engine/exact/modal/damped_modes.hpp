// damped_modes.hpp: complex modes of a structure in its open modes, with springs, dashpots and constraints.
//
//   q_j'' + c_j q_j' + d_j q_j + sum_a u_ja lambda_a = p_j
//   lambda_a = (k_a + c_a d/dt) v_a . q     or, where a is rigid,   v_a . q = 0
//
//   q = x e^(l t),   P_j(l) = l^2 + c_j l + d_j:     T(l) (lambda, x_G) = 0
//   T = | 1 + kappa_a sum_j v_ja u_jb / P_j    -kappa_a v_ja |      j outside G in sums, inside in columns
//       | u_jb                                  P_j          |      kappa_a = k_a + l c_a
//
// Where a is rigid the 1 is absent and kappa = 1: the limit of infinite stiffness. G holds the modes whose P_j
// is small, so that nothing is divided by small differences. Roots are begun from a dense problem in doubles
// and made sharp by Newton's steps on T in extended precision; shapes follow from its null vectors. A mode that
// no term sees (v_j = 0) has its own two roots. Equal poles are turned so that as few as possible are seen;
// equal roots take all null vectors of T. Roots that are nearly equal and have one shape fail.
//
//   motion   q = Re sum_k shape_k y_k,  y_k' = l_k y_k + from_rate_k . p,   y = from_q q + from_rate q'
//
// Source: Guettel and Tisseur, Acta Numerica 26 (2017), 1 (Newton's method on nonlinear eigenproblems).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace signorini {

/// u: direction of the force, v: the form that it follows; of all modes.
struct ModalTerm {
  Eigen::VectorXd u, v;
  double stiffness = 0.0, damping = 0.0;
  bool rigid = false;
};

/// More columns of T than this are not handled: terms and modes in G.
inline constexpr std::size_t most_damped_terms = 9;

struct DampedModes {
  std::string failure;                 ///< why the modes cannot be used; empty: they can
  Eigen::VectorXcd root;               ///< im >= 0, |l| ascending; one of each pair
  Eigen::MatrixXcd shape;              ///< n x roots; a pair's is doubled, so that real parts add up
  Eigen::MatrixXcd force;              ///< terms x roots: lambda, likewise
  Eigen::MatrixXcd from_q, from_rate;  ///< roots x n
  double condition = 1.0;              ///< greatest |x| |y| of a root, 1 without damping and slip
  double round_trip = 0.0;             ///< greatest error of what the modes give back of a motion of size 1
};

/// square, decay: d_j, ascending, and c_j.
[[nodiscard]] DampedModes damped_modes(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                                       const std::vector<ModalTerm>& terms);

}  // namespace signorini
