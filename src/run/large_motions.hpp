// large_motions.hpp: detects motions beyond the range of small rotations.
//
//   |rotation| > 1/4 rad,   |ut| > R/4 of a pendulum:   cos differs from 1 by 3 %
//
// All computations use cos = 1 and sin = tan for motions of any size; one warning per run therefore reports the first
// large motion and the largest one.
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

  /// Examines the end of a step.
  void see(double t, const Forcing& forcing, const Point& now);
  /// Text of the warning; nullopt: all motions stayed small.
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
