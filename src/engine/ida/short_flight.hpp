// short_flight.hpp: flights of rigid contacts below the resolution of an integrator's tolerance.
//
//   after a rebound  g = vn t + an t^2/2 + ...  returns to zero at t*, and g < level up to t*
//
// An integrator's own polynomial is useless there: its error is as large as the flight is high. The Taylor series about
// the rebound gives the flight exactly (engine/exact/exact_engine.hpp), so it takes the step to the next hit. Without
// it a ball at the end of its bounces would penetrate the floor by a tolerance, and further.
#pragma once

#include <functional>
#include <memory>

#include "engine/exact/exact_engine.hpp"

namespace signorini::ida {

class ShortFlight {
 public:
  ShortFlight(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
              double t_end);

  /// The step to the hit, or to another event before it, if the segment begins with such a flight. level: gap of a
  /// contact from which on the integrator resolves it.
  [[nodiscard]] std::optional<engine::Step> take(const engine::Segment& segment,
                                                 const std::function<double(const Contact&)>& level);
  /// The motion and the works on the step returned by take().
  [[nodiscard]] exact::ExactEngine& motion() { return *series_; }
  [[nodiscard]] const exact::ExactEngine& motion() const { return *series_; }

 private:
  const Model& model_;
  std::unique_ptr<exact::ExactEngine> series_;
};

}  // namespace signorini::ida
