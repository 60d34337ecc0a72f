// lcp.hpp: linear complementarity problem.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0
//
// Lemke's method: an artificial variable z0 with w = q + M z + d z0, d > 0, makes the start feasible. Then the complement of
// the variable that left the basis enters the basis, until z0 leaves the basis. The lexicographic ratio test excludes cycling.
// The method ends with a solution or with a ray; for a copositive-plus M a ray means that there is no solution.
// Source: Cottle, Pang, Stone, The Linear Complementarity Problem, sections 4.4 and 4.9.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace signorini::base {

/// Returns z (length n); nullopt: the method ends with a ray. M: any n x n matrix; rows of M and q should have similar
/// magnitudes. d: length n, > 0. If rounding errors lead to a ray, another d may lead to a
/// solution, because the sequence of pivots is different.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                                                       const Eigen::VectorXd& d);
/// Solves the problem with d = 1 in all rows.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

}  // namespace signorini::base
