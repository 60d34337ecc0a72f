// restart_order.hpp: a past for IDA, so that a segment begins at an order higher than one.
//
//   y(t0 + x) = sum_k y^(k)(t0) x^k / k!       from the jet at the segment's beginning
//
// IDA begins at order one, with steps far below its later ones, and raises both step by step. Its history is internal,
// but it calls a nonlinear solver for the solution at the end of each step. So IDA is started q steps of length h
// before the beginning, and its solver answers with the polynomials of the jet (StepNewton::rehearse): at t0 IDA has
// the history of a motion with the same derivatives, and continues at order q with the step h.
//
//   h = part ( (q + 1) / |y^(q+1)| )^(1/(q+1))     error of order q: h^(q+1) y^(q+1)/(q+1) = part^(q+1) tolerances
//
// The remainder of the polynomials in the past, (q h)^p y^(p)/p! with p = 5 (forces) to 7 (places), enters formulas and
// changes them by at most that. Norms: IDA's weighted norm.
#pragma once

#include <string>

#include "motion/jet.hpp"
#include "signorini/model.hpp"

namespace signorini::ida {

// The greatest BDF order for a scene, `max_order = "auto"`.
//
//   rtol <= 1e-4   5: the error test resolves the modes, whatever their damping
//   else           the greatest order that is stable for every mode at every step: acos(zeta) <= alpha_q,
//                  alpha_3 = 86.03, alpha_4 = 73.35, alpha_5 = 51.84 degrees; order 2 always is
//
// zeta: least damping ratio of all frequencies up to the highest, for all contact states; contact springs do not
// contribute to the damping beta K. Source of the angles: Hairer, Wanner, Solving Ordinary Differential Equations II,
// V.2.

struct OrderChoice {
  int max_order = 5;
  std::string reason;
};
[[nodiscard]] OrderChoice choose_order(const Model& model, const RunSpec& run);

struct RestartOrder {
  int steps = 0;        ///< q; 0: IDA begins at order one
  double length = 0.0;  ///< h

  /// Order of the start. Order 4 takes 5 % fewer steps on a beam, but more on bouncing bodies (measured).
  static constexpr int order = 3;
};

/// d^p/dx^p of sum_k row[k] x^k / k!, k up to `last`.
template <class Row>
[[nodiscard]] double taylor_derivative(const Row& row, Eigen::Index last, Eigen::Index p, double x) {
  double sum = 0.0;
  for (Eigen::Index k = last; k >= p; --k) sum = row[k] + sum * x / static_cast<double>(k - p + 1);
  return sum;
}
/// Highest known derivative of a place: without mass one or two less, so that the forces' derivatives count.
[[nodiscard]] inline Eigen::Index last_derivative(const motion::Jet& jet, bool massless) {
  return massless ? motion::Jet::orders : jet.u.cols() - 1;
}

/// Same for all rows, where `last` is that of every row.
inline void taylor_derivatives(const Eigen::MatrixXd& rows, Eigen::Index last, Eigen::Index p, double x,
                               Eigen::Ref<Vector> sums) {
  sums = rows.col(last);
  for (Eigen::Index k = last - 1; k >= p; --k) sums = rows.col(k) + sums * x / static_cast<double>(k - p + 1);
}

/// d^p/dx^p of all places, x after the jet's instant. is_massless: called with the degree of freedom of a place that
/// has one.
template <class IsMassless>
void displacement_derivatives(const motion::Jet& jet, Eigen::Index p, double x, bool any_massless,
                              const IsMassless& is_massless, Eigen::Ref<Vector> places) {
  taylor_derivatives(jet.u, last_derivative(jet, false), p, x, places);
  if (!any_massless) return;
  for (Eigen::Index i = 0; i < places.size(); ++i)
    if (is_massless(i)) places[i] = taylor_derivative(jet.u.row(i), last_derivative(jet, true), p, x);
}

}  // namespace signorini::ida
