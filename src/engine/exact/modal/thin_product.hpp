// thin_product.hpp: a large matrix times a few vectors, A x_1, A x_2, ..., in one pass through memory.
//
//   four rows and up to three vectors at once: loaded entries are used several times, and sums do not wait for
//   their last term. Sums are taken in four parts, of places k, k + 4, ..., identical in every build.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace signorini {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// y[s] := a x[s]; no y may be an x.
void thin_product(const RowMatrix& a, const std::vector<const Eigen::VectorXd*>& x,
                  const std::vector<Eigen::VectorXd*>& y);

}  // namespace signorini
