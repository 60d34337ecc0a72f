// thin_product.hpp: a great matrix times a few vectors, A x_1, A x_2, ..., in one pass through memory.
//
//   four rows and up to three vectors at once: what is loaded is used several times, and no sum waits for
//   its last term. Sums are taken in two halves, of even and odd places, in every build the same.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace signorini {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

namespace thin {

/// y[s][first + r] := row first + r times x[s], for Rows rows and Vectors vectors.
template <std::size_t Rows, std::size_t Vectors>
void block(const RowMatrix& a, Eigen::Index first, const Eigen::VectorXd* const* x,
           Eigen::VectorXd* const* y) {
  using Two = Eigen::Array2d;
  using Read = Eigen::Map<const Two>;
  std::array<std::array<Two, Vectors>, Rows> sum;
  std::array<const double*, Rows> row;
  for (std::size_t r = 0; r < Rows; ++r) {
    row[r] = a.data() + (first + static_cast<Eigen::Index>(r)) * a.cols();
    sum[r].fill(Two::Zero());
  }
  Eigen::Index k = 0;
  for (; k + 2 <= a.cols(); k += 2)
    for (std::size_t r = 0; r < Rows; ++r)
      for (std::size_t s = 0; s < Vectors; ++s) sum[r][s] += Read(row[r] + k) * Read(x[s]->data() + k);
  for (std::size_t r = 0; r < Rows; ++r)
    for (std::size_t s = 0; s < Vectors; ++s) {
      if (k < a.cols()) sum[r][s][0] += row[r][k] * (*x[s])[k];
      (*y[s])[first + static_cast<Eigen::Index>(r)] = sum[r][s][0] + sum[r][s][1];
    }
}

template <std::size_t Vectors>
void product(const RowMatrix& a, const Eigen::VectorXd* const* x, Eigen::VectorXd* const* y) {
  Eigen::Index i = 0;
  for (; i + 4 <= a.rows(); i += 4) block<4, Vectors>(a, i, x, y);
  for (; i < a.rows(); ++i) block<1, Vectors>(a, i, x, y);
}

}  // namespace thin

/// y[s] := a x[s]; no y may be an x.
inline void thin_product(const RowMatrix& a, const std::vector<const Eigen::VectorXd*>& x,
                         const std::vector<Eigen::VectorXd*>& y) {
  for (Eigen::VectorXd* out : y) out->resize(a.rows());
  for (std::size_t s = 0; s < x.size(); s += 3) {
    const std::size_t count = std::min<std::size_t>(3, x.size() - s);
    if (count == 3) thin::product<3>(a, x.data() + s, y.data() + s);
    if (count == 2) thin::product<2>(a, x.data() + s, y.data() + s);
    if (count == 1) thin::product<1>(a, x.data() + s, y.data() + s);
  }
}

}  // namespace signorini
