// thin_product.hpp: a great matrix times a few vectors, A x_1, A x_2, ..., in one pass through memory.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace signorini {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// y[s] := a x[s]; no y may be an x.
inline void thin_product(const RowMatrix& a, const std::vector<const Eigen::VectorXd*>& x,
                         const std::vector<Eigen::VectorXd*>& y) {
  for (Eigen::VectorXd* out : y) out->resize(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (std::size_t s = 0; s < x.size(); ++s) (*y[s])[i] = a.row(i).dot(*x[s]);
}

}  // namespace signorini
