#include "motion/column_lanes.hpp"

#include "base/wide_lanes.hpp"

namespace signorini {
namespace {

struct Columns {
  const double *a, *b;
  std::size_t rows, columns;
  const double *u, *w;
  double factor;
};

/// Rows i to i + count lanes of T.
template <class T, std::size_t count>
[[gnu::always_inline]] inline void some_rows(const Columns& c, std::size_t i, double* y) {
  constexpr std::size_t lanes = sizeof(T) / sizeof(double);
  T sum[count] = {};
  const double *a = c.a + i, *b = c.b + i;
  for (std::size_t j = 0; j < c.columns; ++j, a += c.rows, b += c.rows) {
    const double u = c.u[j], v = c.factor * c.w[j];
    for (std::size_t k = 0; k < count; ++k)
      sum[k] += lanes_at<T>(a + k * lanes).v * u + lanes_at<T>(b + k * lanes).v * v;
  }
  for (std::size_t k = 0; k < count; ++k) lanes_at<T>(y + i + k * lanes).v = sum[k];
}

}  // namespace

SIGNORINI_WIDE_LANES void both_products(const double* a, const double* b, std::size_t rows,
                                        std::size_t columns, const double* u, const double* w, double factor,
                                        double* y) {
  const Columns c{a, b, rows, columns, u, w, factor};
  std::size_t i = 0;
  for (; i + 16 <= rows; i += 16) some_rows<Four, 4>(c, i, y);
  if (i + 8 <= rows) {
    some_rows<Four, 2>(c, i, y);
    i += 8;
  }
  if (i + 4 <= rows) {
    some_rows<Four, 1>(c, i, y);
    i += 4;
  }
  for (; i < rows; ++i) some_rows<double, 1>(c, i, y);
}

}  // namespace signorini
