// run_limits.hpp: detects runs whose events no longer advance in time, and large motions. A run ends if one of these
// conditions is violated:
//
//   at one instant (ten resolutions of the clock)   at most max_events_at_once events
//   in the whole run                                10 000 successive events cover at least 1e-5 of the run
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "motion/point.hpp"

namespace signorini::run {

class StallDetector {
 public:
  /// most_at_once: RunSpec::max_events_at_once. unit: factor that converts times to the scene's unit in messages.
  StallDetector(double t_end, int most_at_once, double unit = 1.0)
      : t_end_(t_end), max_at_once_(most_at_once), unit_(unit) {}

  /// Counts an instant; times must not decrease. Returns the reason why the run must end; nullopt: it continues.
  /// contacts: contacts whose guards were triggered, or whose states the engine has changed.
  [[nodiscard]] std::optional<std::string> count(double t, double resolution,
                                                 const std::vector<std::size_t>& contacts = {});
  /// Contacts of the events that exceeded a limit, in ascending order.
  [[nodiscard]] std::vector<std::size_t> contacts() const { return {contacts_.begin(), contacts_.end()}; }

 private:
  using Contacts = std::set<std::size_t>;
  [[nodiscard]] std::optional<std::string> slow_progress(double t);

  double t_end_;
  int max_at_once_;
  double unit_;
  double cluster_ = 0.0;  // time of the first of the current simultaneous events
  int events_in_cluster_ = 0;
  double last_check_t_ = 0.0;  // time of the last check of progress
  int events_since_check_ = 0;
  Contacts in_cluster_, contacts_since_check_, contacts_;
};

// Detects motions beyond the range of small rotations.
//
//   |rotation| > 1/4 rad,   |ut| > R/4 of a pendulum:   cos differs from 1 by 3 %
//
// The model is linear: it sets cos = 1 for motions of any size. One warning per run reports the first large motion and the
// largest motion.

class LargeMotionDetector {
 public:
  /// Reduced models are not examined, because their unknowns are amplitudes of modes. The model must outlive the object.
  explicit LargeMotionDetector(const Model& model);

  /// Examines the motion at the end of a step.
  void examine(double t, const motion::Forcing& forcing, const motion::Point& now);
  /// Text of the warning; nullopt: all motions were small.
  [[nodiscard]] std::optional<std::string> warning() const;

 private:
  struct Large {
    std::string description;
    double t = 0.0, angle = 0.0;
  };
  void record(double t, double angle, const std::string& what);

  const Model& model_;
  std::vector<std::size_t> rotations_, pendulums_;
  std::optional<Large> first_;
  double greatest_ = 0.0;
  std::string greatest_description_;
};

}  // namespace signorini::run
