// work_plan.hpp: the runs of a study: every engine at every setting of its accuracy.
//
//   run.rtol or run.dt, whichever limits the error of the engine (signorini/engine.hpp); none where only
//   rounding does
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// The key that says how accurate an engine of that name is: "run.rtol", "run.dt", or "".
[[nodiscard]] std::string accuracy_key(const std::string& engine);

/// One engine with one setting.
struct WorkPoint {
  std::string engine;
  std::optional<double> accuracy;  ///< value of accuracy_key()
  std::vector<Override> varied;    ///< other keys that differ from the reference

  /// "1e-06", or what `varied` says; empty for `exact` with nothing varied.
  [[nodiscard]] std::string setting() const;
  /// "ida rtol=1e-06 reduction.cutoff_omega=1e3"
  [[nodiscard]] std::string name() const;
  /// The line in pictures that it belongs to: the engine, and what is varied.
  [[nodiscard]] std::string line() const;
  /// The same, short: "ida cutoff_omega=1e3"
  [[nodiscard]] std::string label() const;
  /// Of the scene: engine, accuracy, varied keys.
  [[nodiscard]] std::vector<Override> changes() const;
};

struct WorkRanges {
  std::vector<std::string> engines;
  std::vector<double> rtol, dt;
  std::vector<std::vector<Override>> varied = {{}};  ///< at least one, maybe empty, point
};

/// Engine by engine, varied point by varied point, in the order of the ranges.
[[nodiscard]] std::vector<WorkPoint> work_points(const WorkRanges& ranges);

/// Five decades of steps from a fiftieth of the run on, on round numbers.
[[nodiscard]] std::vector<double> usual_steps(double t_end);

}  // namespace signorini
