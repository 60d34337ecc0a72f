// rehearsal.hpp: a past for IDA, so that a segment begins at a higher order than one.
//
//   y(t0 + x) = sum_k y^(k)(t0) x^k / k!       of the jet at the segment's beginning
//
// IDA begins at order one, with steps far below those that it takes later, and raises both step by step. Its history is its
// own; but it asks a nonlinear solver for the solution at the end of each step. So it is started q steps of length h before
// the beginning, and its solver answers with the polynomials of the jet (StepNewton::rehearse): at t0 IDA has the history
// of a motion with the same derivatives, and goes on at order q with the step h.
//
//   h = part ( (q + 1) / |y^(q+1)| )^(1/(q+1))     the local error of order q, h^(q+1) y^(q+1)/(q+1), is part^(q+1) tolerances
//
// What the polynomials leave out of the past, (q h)^p y^(p)/p! with p = 5 (forces) to 7 (places), enters formulas that differ
// by no more than that. Norms: IDA's weighted one.
#pragma once

#include "motion/jet.hpp"
#include "motion/point.hpp"

namespace signorini {

struct Rehearsal {
  int steps = 0;        ///< q; 0: IDA begins at order one
  double length = 0.0;  ///< h

  /// Order of the start. Order 4 takes 5 % fewer steps on a beam, and more on bodies that bounce (measured).
  static constexpr int order = 3;
};

/// d^p/dx^p of sum_k row[k] x^k / k!, k up to `last`.
template <class Row>
[[nodiscard]] double on_polynomial(const Row& row, Eigen::Index last, Eigen::Index p, double x) {
  double sum = 0.0;
  for (Eigen::Index k = last; k >= p; --k) sum = row[k] + sum * x / static_cast<double>(k - p + 1);
  return sum;
}
/// The derivative up to which a place is known: without mass one or two less, wherefore those of forces count.
[[nodiscard]] inline Eigen::Index last_derivative(const Jet& jet, bool massless) {
  return massless ? Jet::orders : jet.u.cols() - 1;
}

/// The motion x after the jet's instant, on its polynomials. is_massless: by degree of freedom.
template <class IsMassless>
void on_polynomials(const Jet& jet, double x, const IsMassless& is_massless, Point& point) {
  point.u.resize(jet.u.rows());
  point.v.resize(jet.u.rows());
  point.a.resize(jet.u.rows());
  point.forces.resize(jet.forces.rows());
  for (Eigen::Index i = 0; i < jet.u.rows(); ++i) {
    const Eigen::Index last = last_derivative(jet, is_massless(i));
    const auto row = jet.u.row(i);
    point.u[i] = on_polynomial(row, last, 0, x);
    point.v[i] = on_polynomial(row, last, 1, x);
    point.a[i] = on_polynomial(row, last, 2, x);
  }
  for (Eigen::Index i = 0; i < jet.forces.rows(); ++i)
    point.forces[i] = on_polynomial(jet.forces.row(i), Jet::orders, 0, x);
}

}  // namespace signorini
