// complementarity.hpp: the linear complementarity problem.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0
//
// Lemke's method: an artificial variable z0 with w = q + M z + d z0, d > 0, makes the start feasible, and the
// complement of what left the basis enters it until z0 leaves. The lexicographic ratio test excludes
// cycling. It ends in a solution, or in a ray; for M copositive-plus a ray means that there is none.
// Source: Cottle, Pang, Stone, The Linear Complementarity Problem, sections 4.4 and 4.9.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace signorini {

/// z (length n), or nothing where the method ends in a ray. M: n x n, any; rows of M and q should be of one
/// magnitude. d: by another one the method takes another way, where rounding has led it into a ray.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_complementarity(const Eigen::MatrixXd& M,
                                                                   const Eigen::VectorXd& q,
                                                                   const Eigen::VectorXd& d);
/// d = 1 in all rows.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_complementarity(const Eigen::MatrixXd& M,
                                                                   const Eigen::VectorXd& q);

}  // namespace signorini
