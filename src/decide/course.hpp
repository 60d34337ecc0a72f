// course.hpp: one decision on its way from the states before to those after.
//
//   look at the guards of `mode` -> `failed` -> the next mode -> ...       until none fails
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "decide/at_once.hpp"
#include "decide/touching.hpp"

namespace signorini {

/// Times noise and resolution, where decisions go in circles, or an engine and a decision contradict.
inline constexpr double unlucky = 16.0;

/// One decision under way.
struct DecisionCourse {
  Instant instant;
  const Forcing& after;
  Decision decision;
  Mode mode;                    // tried last
  std::vector<MotionJet> jets;  // in it
  std::vector<Failure> failed;  // there
  std::vector<Mode> seen;       // for recognising a circle
  std::vector<ContactMotion> noise_before;
  Findings found;
  std::vector<std::size_t> undecided;  // blocks that rounding cannot decide: their states stay
  bool blurred = false;
  Vector given = {};                       // at a start: u as it is given, before parts without mass move
  std::vector<MotionJet> so_far = {};      // up to the instant; empty where no limit has rested
  std::optional<TouchOnWay> touched = {};  // in this round, by parts without mass that move at once
  std::vector<std::size_t> slid = {};      // contacts that have slid at once and stopped
  std::optional<std::vector<std::size_t>> open =
      {};                            // contacts whose guards are not all clearly positive; else: any
  const Forcing* forcing = nullptr;  // under which the mode tried last was evaluated,
  double blur = 0.0;                 // how blurred
  Eigen::VectorXd held = {};         // what holds the mode tried last; Decision::captures

  /// Where parts without mass begin that move at once.
  [[nodiscard]] const Vector& comes_from() const { return instant.start ? given : instant.u; }

  /// Zeros were told by one sample of rounding, and by the clock, perhaps too sharply. False: they were blurred before.
  bool make_blurred() {
    if (std::exchange(blurred, true)) return false;
    instant.blur = unlucky;
    instant.resolution *= unlucky;
    return true;
  }
};

}  // namespace signorini
