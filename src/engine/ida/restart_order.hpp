// restart_order.hpp: steps of IDA before a segment, so that the segment begins at an order higher than one.
//
//   y(t0 + x) = sum_k y^(k)(t0) x^k / k!       from the jet at the segment's beginning
//
// IDA begins at order one with a very short step, and raises order and step length slowly. Its history is
// internal, but it calls a nonlinear solver for the solution at the end of each step. So IDA starts q steps
// of length h before t0, and this solver returns the polynomials of the jet (StepNewton::prescribe_jet). At
// t0 IDA has the history of a motion with the same derivatives, and continues at order q with the step h.
//
//   h = part ( (q + 1) / |y^(q+1)| )^(1/(q+1))     error of order q: h^(q+1) y^(q+1)/(q+1) = part^(q+1) tolerances
//
// The remainder of the polynomials before t0, (q h)^p y^(p)/p! with p = 5 (forces) to 7 (displacements),
// bounds the errors of this history. Norms: IDA's weighted norm.
#pragma once

#include <string>

#include "motion/jet.hpp"
#include "signorini/model.hpp"

namespace signorini::ida {

// The greatest BDF order for a scene, `max_order = "auto"`.
//
//   rtol <= 1e-4   5: the error test resolves all modes, whatever their damping
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
/// The given max_order, or the choice above.
[[nodiscard]] OrderChoice choose_order(const Model& model, const RunSpec& run);

/// The steps that IDA takes before a segment.
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
/// Order of the highest known derivative of a degree of freedom. Without mass it is that of the forces, which
/// is one or two less.
[[nodiscard]] inline Eigen::Index last_derivative(const motion::Jet& jet, bool massless) {
  return massless ? motion::Jet::orders : jet.u.cols() - 1;
}

/// taylor_derivative() of all rows, with one `last`.
inline void taylor_derivatives(const Eigen::MatrixXd& rows, Eigen::Index last, Eigen::Index p, double x,
                               Eigen::Ref<Vector> sums) {
  sums = rows.col(last);
  for (Eigen::Index k = last - 1; k >= p; --k) sums = rows.col(k) + sums * x / static_cast<double>(k - p + 1);
}

/// d^p/dx^p of all displacements, x after the jet's instant. is_massless(i): true if degree of freedom i has
/// no mass.
template <class IsMassless>
void displacement_derivatives(const motion::Jet& jet, Eigen::Index p, double x, bool any_massless,
                              const IsMassless& is_massless, Eigen::Ref<Vector> places) {
  taylor_derivatives(jet.u, last_derivative(jet, false), p, x, places);
  if (!any_massless) return;
  for (Eigen::Index i = 0; i < places.size(); ++i)
    if (is_massless(i)) places[i] = taylor_derivative(jet.u.row(i), last_derivative(jet, true), p, x);
}

}  // namespace signorini::ida
