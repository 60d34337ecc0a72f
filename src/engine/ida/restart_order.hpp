// restart_order.hpp: steps that IDA takes before a segment, so that the segment begins at an order higher than one.
//
//   y(t0 + x) = sum_k y^(k)(t0) x^k / k!       polynomials of the jet at the segment's beginning t0
//
// After a restart, IDA begins at order one with a very short step, and raises order and step length slowly. A caller cannot set
// IDA's history, but IDA calls a nonlinear solver for the solution at the end of each step. So IDA starts at t0 - q h and takes
// q steps of length h, in which this solver returns the polynomials of the jet (StepNewton::prescribe_jet). At t0, IDA then has
// the history of a motion with the derivatives of the jet, and continues at order q with step length h.
//
//   h = part ( (q + 1) / |y^(q+1)| )^(1/(q+1))     error of order q: h^(q+1) y^(q+1)/(q+1) = part^(q+1) tolerances
//
// |.| is IDA's weighted norm. The errors of this history are bounded by the remainder of the polynomials at t0 - q h:
// (q h)^p y^(p)/p! with p = 5 for forces to p = 7 for displacements.
#pragma once

#include <string>

#include "motion/jet.hpp"
#include "signorini/model.hpp"

namespace signorini::ida {

// The greatest BDF order for a scene, `max_order = "auto"`.
//
//   rtol <= 1e-4   5: the error test resolves all modes, whatever their damping
//   else           the greatest order that is stable for every mode at every step: acos(zeta) <= alpha_q,
//                  alpha_3 = 86.03, alpha_4 = 73.35, alpha_5 = 51.84 degrees; order 2 is always stable
//
// zeta: smallest damping ratio of all modes in all contact states. The stiffness of contact springs does not contribute to the
// damping beta K. Source of the angles: Hairer, Wanner, Solving Ordinary Differential Equations II,
// V.2.

struct OrderChoice {
  int max_order = 5;
  std::string reason;
};
/// Maximum order of BDF: run.max_order if it is given, otherwise the order for the scene as described above.
[[nodiscard]] OrderChoice choose_order(const Model& model, const RunSpec& run);

/// Number and length of the steps that IDA takes before a segment.
struct RestartOrder {
  int steps = 0;        ///< q; 0: IDA begins at order one at t0
  double length = 0.0;  ///< h, the step length; for q = 0 the length of the first step

  /// Order q at t0. With order 4, a beam needs 5 % fewer steps, but bouncing bodies need more (measured).
  static constexpr int order = 3;
};

/// Derivative d^p/dx^p of the polynomial sum row[k] x^k / k!, k = 0 .. last.
template <class Row>
[[nodiscard]] double taylor_derivative(const Row& row, Eigen::Index last, Eigen::Index p, double x) {
  double sum = 0.0;
  for (Eigen::Index k = last; k >= p; --k) sum = row[k] + sum * x / static_cast<double>(k - p + 1);
  return sum;
}
/// Order of the highest derivative of a degree of freedom that the jet contains. If the degree of freedom is massless, this is
/// the order of the forces, which is one or two less.
[[nodiscard]] inline Eigen::Index last_derivative(const motion::Jet& jet, bool massless) {
  return massless ? motion::Jet::orders : jet.u.cols() - 1;
}

/// Result of taylor_derivative() for all rows.
inline void taylor_derivatives(const Eigen::MatrixXd& rows, Eigen::Index last, Eigen::Index p, double x,
                               Eigen::Ref<Vector> sums) {
  sums = rows.col(last);
  for (Eigen::Index k = last - 1; k >= p; --k) sums = rows.col(k) + sums * x / static_cast<double>(k - p + 1);
}

/// Writes d^p/dx^p of all displacements at the time x after the jet's instant to `places`. is_massless(i): true if degree of
/// freedom i has no mass.
template <class IsMassless>
void displacement_derivatives(const motion::Jet& jet, Eigen::Index p, double x, bool any_massless,
                              const IsMassless& is_massless, Eigen::Ref<Vector> places) {
  taylor_derivatives(jet.u, last_derivative(jet, false), p, x, places);
  if (!any_massless) return;
  for (Eigen::Index i = 0; i < places.size(); ++i)
    if (is_massless(i)) places[i] = taylor_derivative(jet.u.row(i), last_derivative(jet, true), p, x);
}

}  // namespace signorini::ida
