// short_flight.hpp: flights of rigid contacts that are too low for the tolerance of an integrator.
//
//   after a rebound  g = vn t + an t^2/2 + ...  returns to zero at t*, and g < level up to t*
//
// The error of an integrator's polynomial is as large as the height of such a flight. The Taylor series about
// the rebound gives the flight exactly (engine/exact/exact_engine.hpp), so the series computes the step to the next impact.
// Without the series, a ball would penetrate the floor by a tolerance or more in its last bounces.
#pragma once

#include <functional>
#include <memory>

#include "engine/exact/exact_engine.hpp"

namespace signorini::ida {

class ShortFlight {
 public:
  /// All arguments except t_end must outlive the object.
  ShortFlight(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
              double t_end);

  /// Takes the step to the next impact, or to an earlier event. nullopt if the segment does not begin with a low flight. level:
  /// for each contact, the height above which the integrator resolves a flight.
  [[nodiscard]] std::optional<engine::Step> take(const engine::Segment& segment,
                                                 const std::function<double(const Contact&)>& level);
  /// Engine that gives the motion and the works on the step returned by take().
  [[nodiscard]] exact::ExactEngine& motion() { return *series_; }
  [[nodiscard]] const exact::ExactEngine& motion() const { return *series_; }

 private:
  const Model& model_;
  std::unique_ptr<exact::ExactEngine> series_;
};

}  // namespace signorini::ida
