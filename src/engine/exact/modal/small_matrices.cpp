#include "engine/exact/modal/small_matrices.hpp"

#include <algorithm>
#include <cstddef>

#include "base/simd.hpp"

namespace signorini::modal {
namespace {

constexpr std::size_t max_at_once = 3;

/// Computes y[s][first + i] := row_i . x[s] for `Rows` rows, which are consecutive in memory, and `Vectors` vectors.
template <std::size_t Rows, std::size_t Vectors>
[[gnu::always_inline]] inline void rows_times(const double* row, std::ptrdiff_t columns,
                                              const double* const* x, double* const* y,
                                              std::ptrdiff_t first) {
  base::Double4 sum[Rows][Vectors] = {};
  std::ptrdiff_t k = 0;
  for (; k + 4 <= columns; k += 4)
    for (std::size_t r = 0; r < Rows; ++r) {
      const base::Double4 entry =
          base::lanes_at<base::Double4>(row + static_cast<std::ptrdiff_t>(r) * columns + k).v;
      for (std::size_t s = 0; s < Vectors; ++s)
        sum[r][s] += entry * base::lanes_at<base::Double4>(x[s] + k).v;
    }
  for (std::size_t r = 0; r < Rows; ++r)
    for (std::size_t s = 0; s < Vectors; ++s) {
      for (std::ptrdiff_t rest = k; rest < columns; ++rest)
        sum[r][s][rest - k] += row[static_cast<std::ptrdiff_t>(r) * columns + rest] * x[s][rest];
      y[s][first + static_cast<std::ptrdiff_t>(r)] = base::sum_of_lanes(sum[r][s]);
    }
}

template <std::size_t Vectors>
[[gnu::always_inline]] inline void all_rows_times(const double* a, std::ptrdiff_t rows,
                                                  std::ptrdiff_t columns, const double* const* x,
                                                  double* const* y) {
  std::ptrdiff_t i = 0;
  for (; i + 4 <= rows; i += 4) rows_times<4, Vectors>(a + i * columns, columns, x, y, i);
  for (; i < rows; ++i) rows_times<1, Vectors>(a + i * columns, columns, x, y, i);
}

}  // namespace

SIGNORINI_WIDE_LANES void times_one(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns,
                                    const double* const* x, double* const* y) {
  all_rows_times<1>(a, rows, columns, x, y);
}
SIGNORINI_WIDE_LANES void times_two(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns,
                                    const double* const* x, double* const* y) {
  all_rows_times<2>(a, rows, columns, x, y);
}
SIGNORINI_WIDE_LANES void times_three(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns,
                                      const double* const* x, double* const* y) {
  all_rows_times<3>(a, rows, columns, x, y);
}

void thin_product(const RowMatrix& a, const std::vector<const Eigen::VectorXd*>& x,
                  const std::vector<Eigen::VectorXd*>& y) {
  constexpr void (*times[])(const double*, std::ptrdiff_t, std::ptrdiff_t, const double* const*,
                            double* const*) = {times_one, times_two, times_three};
  for (Eigen::VectorXd* out : y) out->resize(a.rows());
  for (std::size_t s = 0; s < x.size(); s += max_at_once) {
    const std::size_t count = std::min(max_at_once, x.size() - s);
    const double* from[max_at_once];
    double* to[max_at_once];
    for (std::size_t i = 0; i < count; ++i) {
      from[i] = x[s + i]->data();
      to[i] = y[s + i]->data();
    }
    times[count - 1](a.data(), a.rows(), a.cols(), from, to);
  }
}

}  // namespace signorini::modal
