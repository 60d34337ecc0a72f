// run_limits.hpp: detects events without progress in time, and large motions. Many events alone are no error.
//
//   at one instant   at most max_events_at_once, an instant being ten resolutions of the clock
//   altogether       10 000 events take at least 1e-5 of the run
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "motion/point.hpp"

namespace signorini::run {

class StallDetector {
 public:
  /// unit: factor that converts times for messages.
  StallDetector(double t_end, int most_at_once, double unit = 1.0)
      : t_end_(t_end), max_at_once_(most_at_once), unit_(unit) {}

  /// Counts an instant; times must not decrease. Returns the reason for ending the run; nullopt if it
  /// continues. contacts: those whose guards were triggered, or whose states an engine has changed.
  [[nodiscard]] std::optional<std::string> count(double t, double resolution,
                                                 const std::vector<std::size_t>& contacts = {});
  /// Contacts of the instants that exceeded a limit, ascending.
  [[nodiscard]] std::vector<std::size_t> contacts() const { return {contacts_.begin(), contacts_.end()}; }

 private:
  using Contacts = std::set<std::size_t>;
  [[nodiscard]] std::optional<std::string> slow_progress(double t);

  double t_end_;
  int max_at_once_;
  double unit_;
  double cluster_ = 0.0;  // time of the first of the simultaneous events
  int at_once_ = 0;
  double mark_ = 0.0;  // time of the last check of progress
  int since_mark_ = 0;
  Contacts in_cluster_, after_mark_, contacts_;
};

// Detects motions beyond the range of small rotations.
//
//   |rotation| > 1/4 rad,   |ut| > R/4 of a pendulum:   cos differs from 1 by 3 %
//
// All computations use cos = 1 and sin = tan for motions of any size; one warning per run therefore reports the first
// large motion and the largest one.

class LargeMotionDetector {
 public:
  /// Amplitudes of modes (reduced models) are not examined. The model must outlive the object.
  explicit LargeMotionDetector(const Model& model);

  /// Examines the end of a step.
  void examine(double t, const motion::Forcing& forcing, const motion::Point& now);
  /// Text of the warning; nullopt: all motions stayed small.
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
