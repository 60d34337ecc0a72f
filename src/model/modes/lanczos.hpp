// lanczos.hpp: the greatest eigenvalue of a symmetric operator that is only known by its products.
//
//   A x = mu x,   A: n x n, symmetric, positive semidefinite
#pragma once

#include <Eigen/Core>
#include <functional>

namespace signorini {

/// Relative accuracy `tolerance`. Returns the best estimate when the iteration does not settle.
[[nodiscard]] double greatest_eigenvalue(int n,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                         double tolerance);

}  // namespace signorini
