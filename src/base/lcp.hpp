// lcp.hpp: linear complementarity problem.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0
//
// Lemke's method: an artificial variable z0 with w = q + M z + d z0, d > 0, makes the start feasible; then the
// complement of the variable that left the basis enters it, until z0 leaves. The lexicographic ratio test excludes
// cycling. The method ends in a solution or in a ray; for copositive-plus M a ray means that there is no solution.
// Source: Cottle, Pang, Stone, The Linear Complementarity Problem, sections 4.4 and 4.9.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace signorini::base {

/// z (length n), or nullopt if the method ends in a ray. M: n x n, any; rows of M and q should have similar magnitudes.
/// d: another d gives another sequence of pivots, useful if rounding has led to a ray.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                                                       const Eigen::VectorXd& d);
/// Uses d = 1 in all rows.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

}  // namespace signorini::base
