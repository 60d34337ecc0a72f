// contact_series.hpp: what contacts feel on a step, as polynomials.
//
//   f(t + s x) = sum_k f_k x^k  for N, T, g, ut, g', ut', g'', and the body's own ut
//
// A guard is a linear form on these, so it is a polynomial too. Rates are made of g and ut where they are asked for: most
// guards have none.
#pragma once

#include <array>
#include <limits>

#include "contact/law.hpp"
#include "motion/taylor.hpp"

namespace signorini {

/// Value at x of a polynomial of degree + 1 coefficients, ascending.
[[nodiscard]] inline double value_at(const double* a, std::size_t degree, double x) {
  double sum = a[degree];
  for (std::size_t k = degree; k-- > 0;) sum = sum * x + a[k];
  return sum;
}

/// Its coefficients about x from those about 0.
inline void shift(double* a, std::size_t degree, double x) {
  for (std::size_t j = 0; j < degree; ++j)
    for (std::size_t k = degree; k-- > j;) a[k] += x * a[k + 1];
}

/// Polynomials of one contact; each has `degree + 1` coefficients.
class ContactSeries {
 public:
  enum Field : std::size_t { N, T, gap, ut, vn, vt, an, pressing_rate, slide, fields };

  void fill(const Contact& contact, std::size_t index, const Series& series, std::size_t degree);
  /// Room for polynomials that are known otherwise; all are zero.
  void reset(std::size_t degree) {
    degree_ = degree;
    slide_row_ = slide;
    values_.assign(fields * stride(), 0.0);
    there_.fill(true);
  }
  [[nodiscard]] double* place(Field field) { return values_.data() + row_of(field) * stride(); }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const double* of(Field field) const {
    if (!there_[field]) derive(field);
    return values_.data() + row_of(field) * stride();
  }
  /// Where x is 0 for its coefficients, in the series of the structure: value() and integral() take x there.
  void set_origin(double origin) { origin_ = origin; }
  [[nodiscard]] double origin() const { return origin_; }
  /// Bounds the rates of what turns are sought of, up to x from the origin.
  void bound_rates(double x);
  /// At most |f'| there; infinite where nobody has bounded it since fill().
  [[nodiscard]] double rate(Field field) const { return rates_[field]; }
  /// out[0 .. degree]: coefficients of the form, about the origin.
  void combine(const Form& form, double* out) const;
  /// The guard's polynomial, about the origin.
  struct GuardSeries {
    std::size_t degree = 0;
    double cut = 0.0;    ///< at most what its terms of higher orders amount to
    double terms = 0.0;  ///< sum of the magnitudes of those that products are made of
  };
  /// out[0 .. most_degree]: its coefficients; reach: the greatest distance from the origin.
  GuardSeries expand(const GuardForm& guard, double reach, std::size_t most_degree, double* out) const;
  /// Sum of the magnitudes of the form's terms there.
  [[nodiscard]] double magnitude(const Form& form, double reach) const;
  [[nodiscard]] double value(Field field, double x) const {
    return value_at(of(field), degree_, x - origin_);
  }
  /// Integral from the origin to x.
  [[nodiscard]] double integral(Field field, double x) const {
    const double* a = of(field);
    x -= origin_;
    double sum = 0.0;
    for (std::size_t k = degree_ + 1; k-- > 0;) sum = sum * x + a[k] / static_cast<double>(k + 1);
    return sum * x;
  }

 private:
  [[nodiscard]] static constexpr std::array<double, fields> unbounded() {
    std::array<double, fields> rates{};
    rates.fill(std::numeric_limits<double>::infinity());
    return rates;
  }
  /// From one row to the next: g and ut have two orders more, for their rates.
  [[nodiscard]] std::size_t stride() const { return degree_ + 3; }
  [[nodiscard]] std::size_t row_of(Field field) const { return field == slide ? slide_row_ : field; }
  void derive(Field field) const;

  std::size_t degree_ = 0;
  double origin_ = 0.0, scale_ = 1.0;
  std::array<double, fields> rates_ = unbounded();
  std::size_t slide_row_ = slide;  // ut's, where the body's is the same
  mutable std::vector<double> values_;
  mutable std::array<bool, fields> there_{};           // of values_
  mutable std::vector<double> factor_, other_factor_;  // of a product
};

}  // namespace signorini
