// stepper.hpp: what an engine does: advance the motion in one mode, from a state to the next step's end.
//
// The loop (engine/loop.cpp) decides, applies and records; a stepper only advances:
//
//   start(segment) -> advance() -> advance() ... -> an event or segment.end -> start(next segment)
#pragma once

#include <string>

#include "engine/decide.hpp"
#include "engine/point.hpp"
#include "engine/watch.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// The stretch up to the next discontinuity of the forcing, in one mode.
struct Segment {
  double end = 0.0;
  const Decision* decision = nullptr;  ///< state, mode, jet and guards at the beginning
  const Forcing* forcing = nullptr;
  const Watch* watch = nullptr;  ///< which guards are armed
};

struct Step {
  enum class Kind { accepted, root, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;  ///< of the accepted step
  double root = 0.0;              ///< Kind::root: where a guard fell, begin < root <= end
  std::vector<Fired> fired;       ///< Kind::root
  int order = 1;                  ///< degree of the solution's polynomial on the step
  std::string reason;             ///< Kind::failed
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void start(const Segment& segment) = 0;
  [[nodiscard]] virtual Step advance() = 0;
  /// The solution inside the last accepted step.
  virtual void evaluate(double t, Point& point) = 0;
  /// Greatest entry of the residual of the equation of motion at the end of the last step. Unit: force.
  [[nodiscard]] virtual double residual() = 0;

  Counters counters;
};

}  // namespace signorini
