// contact_series.hpp: motion and forces of a contact on a time step, as polynomials of x.
//
//   f(t + s x) = sum_k f_k x^k  for N, T, g, ut, g', ut', g'', q', and ut of the touching body (slide)
//
// A guard is a linear form in these quantities, possibly plus products of such forms, so it is a polynomial, too. Polynomials
// of rates are computed from g and ut on request, because most guards contain no rates.
#pragma once

#include <array>
#include <limits>

#include "contact/law.hpp"
#include "motion/taylor.hpp"

namespace signorini::motion {

/// Value at x of a polynomial; a: its degree + 1 coefficients, in ascending order.
[[nodiscard]] inline double value_at(const double* a, std::size_t degree, double x) {
  double sum = a[degree];
  for (std::size_t k = degree; k-- > 0;) sum = sum * x + a[k];
  return sum;
}

/// Converts the coefficients about 0 in `a` to coefficients about x.
inline void shift(double* a, std::size_t degree, double x) {
  for (std::size_t j = 0; j < degree; ++j)
    for (std::size_t k = degree; k-- > j;) a[k] += x * a[k + 1];
}

/// Polynomials of one contact; each has degree + 1 coefficients.
class ContactSeries {
 public:
  enum Field : std::size_t { N, T, gap, ut, vn, vt, an, applied_normal_force_rate, slide, fields };

  /// Computes the polynomials of contact number `index` from a series of the structure.
  void fill(const Contact& contact, std::size_t index, const Series& series, std::size_t degree);
  /// Allocates polynomials to be filled by the caller; all are zero.
  void reset(std::size_t degree) {
    degree_ = degree;
    slide_row_ = slide;
    values_.assign(fields * stride(), 0.0);
    valid_.fill(true);
  }
  [[nodiscard]] double* mutable_coefficients(Field field) {
    return values_.data() + row_of(field) * stride();
  }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  [[nodiscard]] const double* coefficients(Field field) const {
    if (!valid_[field]) fill_rate(field);
    return values_.data() + row_of(field) * stride();
  }
  /// Sets the position x in the structure's series about which the coefficients are expanded. value() and integral() still
  /// take positions in the structure's series.
  void set_origin(double origin) { origin_ = origin; }
  [[nodiscard]] double origin() const { return origin_; }
  /// Computes upper bounds of |df/dx| up to a distance x from the origin, for the quantities whose extremes are searched: N, T,
  /// gap and slide.
  void bound_rates(double x);
  /// Upper bound of |df/dx| from bound_rates(); infinite if bound_rates() was not called after fill().
  [[nodiscard]] double rate(Field field) const { return rates_[field]; }
  /// Writes the coefficients of the form about the origin into out[0 .. degree()].
  void combine(const Form& form, double* out) const;
  /// Properties of a guard's polynomial about the origin.
  struct GuardSeries {
    std::size_t degree = 0;
    double truncation_bound = 0.0;  ///< upper bound of the sum of all omitted terms of higher order
    double terms = 0.0;             ///< sum of the magnitudes of the terms in products of forms
  };
  /// Writes the coefficients of the guard about the origin into out, which has room for most_degree + 1 numbers. reach: largest
  /// distance from the origin at which the polynomial is used.
  GuardSeries expand(const GuardForm& guard, double reach, std::size_t most_degree, double* out) const;
  /// Upper bound of the sum of the magnitudes of the form's terms, at distances up to `reach` from the origin.
  [[nodiscard]] double magnitude(const Form& form, double reach) const;
  [[nodiscard]] double value(Field field, double x) const {
    return value_at(coefficients(field), degree_, x - origin_);
  }
  /// Integral of the quantity over x, from the origin to the given x.
  [[nodiscard]] double integral(Field field, double x) const {
    const double* a = coefficients(field);
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
  /// Number of doubles from one row to the next. g and ut have two more coefficients, from which rates are computed.
  [[nodiscard]] std::size_t stride() const { return degree_ + 3; }
  [[nodiscard]] std::size_t row_of(Field field) const { return field == slide ? slide_row_ : field; }
  /// Fills the row of vn, vt or an from the coefficients of g and ut; fills the row of another rate with zeros.
  void fill_rate(Field field) const;

  std::size_t degree_ = 0;
  bool normal_force_given_ = false;
  double origin_ = 0.0, scale_ = 1.0;
  std::array<double, fields> rates_ = unbounded();
  std::size_t slide_row_ = slide;  // row of `slide`: that of ut if the body and the contact have the same ut
  mutable std::vector<double> values_;
  mutable std::array<bool, fields> valid_{};           // rows of values_ that contain valid coefficients
  mutable std::vector<double> factor_, other_factor_;  // coefficients of the factors of a product
};

}  // namespace signorini::motion
