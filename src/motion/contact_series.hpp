// contact_series.hpp: what contacts feel on a step, as polynomials.
//
//   f(t + s x) = sum_k f_k x^k  for N, T, g, ut, g', ut', g'', and the body's own ut
//
// A guard is a linear form on these, so it is a polynomial too.
#pragma once

#include "motion/taylor.hpp"

namespace signorini {

/// Value at x of a polynomial of degree + 1 coefficients, ascending.
[[nodiscard]] inline double value_at(const double* a, std::size_t degree, double x) {
  double sum = a[degree];
  for (std::size_t k = degree; k-- > 0;) sum = sum * x + a[k];
  return sum;
}

/// Polynomials of one contact; rows of `degree + 1` coefficients.
class ContactSeries {
 public:
  enum Field : std::size_t { N, T, gap, ut, vn, vt, an, pressing_rate, slide, fields };

  void fill(const Contact& contact, std::size_t index, const Series& series, std::size_t degree);
  /// Room for polynomials that are known otherwise; all are zero.
  void reset(std::size_t degree) {
    degree_ = degree;
    values_.assign(fields * (degree + 1), 0.0);
  }
  [[nodiscard]] double* place(Field field) { return values_.data() + field * (degree_ + 1); }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const double* of(Field field) const { return values_.data() + field * (degree_ + 1); }
  /// out[0 .. degree]: coefficients of the form.
  void combine(const Form& form, double* out) const;
  [[nodiscard]] double value(Field field, double x) const { return value_at(of(field), degree_, x); }
  /// Integral from 0 to x.
  [[nodiscard]] double integral(Field field, double x) const {
    const double* a = of(field);
    double sum = 0.0;
    for (std::size_t k = degree_ + 1; k-- > 0;) sum = sum * x + a[k] / static_cast<double>(k + 1);
    return sum * x;
  }

 private:
  std::size_t degree_ = 0;
  std::vector<double> values_;
  std::vector<double> normal_, tangent_;
};

}  // namespace signorini
