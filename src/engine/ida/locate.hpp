// locate.hpp: locates the time at which a guard reaches zero, to the resolution of time.
//
//   G(t) = guard(u(t), v(t), forces consistent with u(t), v(t) by the equations of the contact state) = 0
//
// At a root of the interpolated unknowns, the equations of the contact state are satisfied only to the integrator's tolerance.
// But the decision at the event computes the forces from u and v, and needs a force exactly at its limit. So the root is
// refined with forces that are recomputed from the interpolated u and v.
#pragma once

#include <vector>

#include "engine/events/step_history.hpp"
#include "engine/events/turning_points.hpp"
#include "engine/ida/bdf_integrator.hpp"
#include "motion/consistent_motion.hpp"
#include "motion/forcing.hpp"

namespace signorini::ida {

/// Refines `time`, a root of guard `slot` in the last step [begin, end]. Returns `time` unchanged if the recomputed guard does
/// not cross zero in [begin, end]. A bracket grows by factors of 4 until it contains the root. Brent's method (GSL) follows.
[[nodiscard]] double locate(BdfIntegrator& bdf, motion::ConsistentMotion& consistent,
                            const engine::Segment& segment, const Model& model, std::size_t slot,
                            double begin, double end, double time, double resolution);

// Extreme values of contact quantities inside a BDF step.
//
//   N, T, g and t.u are linear in y: the polynomial through their last values is exactly that of the BDF step
//   ut = t.u - s(t) on a moving surface: p(x) - s(t_0 + h x), with a Taylor series for s, which is not part of y
//
// A polynomial is searched for extremes only if its Bernstein coefficients do not exclude values beyond the earlier range, and
// do not prove that the polynomial is monotone.

class HistoryTurningPoints {
 public:
  /// first: index of the first contact scalar in the history. The scalars of each contact are in the order of
  /// TurningPointDetector::watched_fields.
  HistoryTurningPoints(std::size_t contacts, std::size_t first)
      : contacts_(contacts), first_(first), detector_(contacts) {}

  /// Number of contact scalars in the history.
  [[nodiscard]] std::size_t count() const {
    return events::TurningPointDetector::watched_fields.size() * contacts_;
  }
  /// Begins a segment. The forcing must stay valid until its end.
  void start(const decide::Decision& decision, const motion::Forcing& forcing);
  /// Finds the turning points in the part [0, x_end] of the last step. On a moving surface the history contains t.u instead of
  /// ut.
  void find(const events::StepHistory& history, double x_end);
  [[nodiscard]] const std::vector<events::TurningPointDetector::TurningPoint>& turning_points() const {
    return detector_.turning_points();
  }
  /// Times of the turning points of the last step, ascending.
  [[nodiscard]] const std::vector<double>& times() const { return detector_.times(); }

 private:
  void search(std::size_t shown, const events::StepHistory& history, double x_end);
  void search_slide(std::size_t contact, const events::StepHistory& history, double x_end);

  std::size_t contacts_, first_;
  events::TurningPointDetector detector_;
  const motion::Forcing* forcing_ = nullptr;
  std::vector<std::size_t> moving_surfaces_;  // contacts whose surface moves
  std::vector<double> series_, of_surface_;
};

}  // namespace signorini::ida
