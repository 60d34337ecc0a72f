// locate.hpp: the time at which a guard reaches zero, to the resolution of time.
//
//   G(t) = guard(u(t), v(t), forces consistent with u(t), v(t) by the equations of the contact state) = 0
//
// At a root of the interpolated unknowns the equations of the contact state hold only to the integrator's
// tolerance. The decision computes its forces from u and v, and these must be at their limit. So the root is
// refined with forces that are recomputed from the interpolated u and v.
#pragma once

#include <vector>

#include "engine/events/step_history.hpp"
#include "engine/events/turning_points.hpp"
#include "engine/ida/bdf_integrator.hpp"
#include "motion/consistent_motion.hpp"
#include "motion/forcing.hpp"

namespace signorini::ida {

/// Refines `time`, a root of guard `slot` found on [begin, end] of the last step; returns it unchanged if the
/// recomputed guard does not cross zero there. Brackets by doubling, then Brent's method (GSL).
[[nodiscard]] double locate(BdfIntegrator& bdf, motion::ConsistentMotion& consistent,
                            const engine::Segment& segment, const Model& model, std::size_t slot,
                            double begin, double end, double time, double resolution);

// Extreme values of contacts inside a BDF step.
//
//   N, T, g and ut are linear in y, so their polynomials through the last steps are those of the step
//   ut = t.u - s(t) on a moving surface: p(x) - s(t_0 + h x), s in its own series, since no step follows it
//
// A polynomial is searched only if its Bernstein coefficients allow that it leaves its earlier range and is
// not monotone.

class HistoryTurningPoints {
 public:
  /// The scalars of the history from `first` on are those of the contacts, in the order of
  /// TurningPointDetector::watched_fields.
  HistoryTurningPoints(std::size_t contacts, std::size_t first)
      : contacts_(contacts), first_(first), detector_(contacts) {}

  /// Number of scalars of the contacts.
  [[nodiscard]] std::size_t count() const {
    return events::TurningPointDetector::watched_fields.size() * contacts_;
  }
  /// The forcing must outlive the segment.
  void start(const decide::Decision& decision, const motion::Forcing& forcing);
  /// Examines the part [0, x_end] of the last step. On a moving surface the history contains t.u in place of ut.
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
