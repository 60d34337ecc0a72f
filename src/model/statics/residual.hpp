// residual.hpp: unbalanced forces of an equilibrium, summed in extended precision and rounded once.
//
//   R = P - K u - sum_j F_j d_j
//
// A sum in double precision has the error eps |K| |u|, and a solve makes of it eps cond(K) |u|: on a soft spring beside a
// stiff frame a million roundings of u. Corrections (K')^-1 R with this R leave the rounding of u itself (iterative
// refinement; K' may differ from K, as long as it is near).
// Source: Higham, Accuracy and Stability of Numerical Algorithms, chapter 12 (extra precise residuals).
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini::statics {

/// form . u in extended precision.
[[nodiscard]] long double exact_dot(const Combination& form, const Vector& u);
/// Gap g0 + n . u of a contact in extended precision.
[[nodiscard]] inline long double exact_gap(const Contact& contact, const Vector& u) {
  return exact_dot(contact.normal, u) + static_cast<long double>(contact.gap);
}

class Residual {
 public:
  explicit Residual(const Vector& load);
  /// R -= K u
  void subtract(const SparseMatrix& k, const Vector& u);
  /// R -= F d
  void subtract(const Combination& form, long double force);
  [[nodiscard]] Vector rounded() const;

 private:
  std::vector<long double> sums_;
};

}  // namespace signorini::statics
