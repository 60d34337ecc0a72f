// large_motions.hpp: where a run leaves the range of small motions.
//
//   |rotation| > 1/4 rad,   |ut| > R/4 of a pendulum:   cos differs from 1 by 3 %
//
// All is computed with cos = 1 and sin = tan, whatever comes; so it is said once, with the first that leaves and the greatest
// of all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "motion/point.hpp"

namespace signorini {

class LargeMotions {
 public:
  /// Amplitudes of modes (reduced models) are not examined. The model must outlive the object.
  explicit LargeMotions(const Model& model);

  /// At the end of a step.
  void see(double t, const Forcing& forcing, const Point& now);
  /// A sentence; nothing: all stayed small.
  [[nodiscard]] std::optional<std::string> warning() const;

 private:
  struct Large {
    std::string what;
    double t = 0.0, angle = 0.0;
  };
  void note(double t, double angle, const std::string& what);

  const Model& model_;
  std::vector<std::size_t> rotations_, pendulums_;
  std::optional<Large> first_;
  double greatest_ = 0.0;
  std::string of_greatest_;
};

}  // namespace signorini
