// foot_releases.hpp: ends a step where a foot at rest is released from its friction limit, or begins to bear.
//
//   w . forces(t) = 0,   positive before        w: decide/resting_forces.hpp
//
// The condition contains the forces of several contacts, so it is not a guard of one contact, which engines locate. Its sign is
// examined at the ends of equal parts of a step: a condition that is negative only within one part is not found.
#pragma once

#include <vector>

#include "decide/resting_forces.hpp"
#include "engine/dense_output.hpp"
#include "engine/stepper.hpp"

namespace signorini::run {

class FootReleases {
 public:
  using Release = decide::RestingFeet::Release;

  FootReleases() = default;
  explicit FootReleases(std::vector<Release> conditions) : conditions_(std::move(conditions)) {}

  /// Ends the step at its first release, if there is one: an event of all guards that are released within the resolution of
  /// time. motion: that of the step. like: a point of the sizes that motion.evaluate() needs.
  void shorten(engine::Step& step, engine::DenseOutput& motion, const motion::Point& like) const;

 private:
  std::vector<Release> conditions_;
};

}  // namespace signorini::run
