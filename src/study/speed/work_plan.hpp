// work_plan.hpp: the runs of a study: every engine with every setting of its accuracy.
//
// Setting of the accuracy: run.rtol or run.dt, depending on the engine (signorini/engine.hpp); none if only
// rounding limits the accuracy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::speed {

// Parses settings on a logarithmic scale.
//
//   1e-4:1e-12      1e-4, 1e-5, ..., 1e-12: factor 1/10; the stop is included if it is reached
//   1e-2:1e-3:2     1e-2, 5e-3, 2.5e-3, 1.25e-3: the third number is the factor between neighbours
//   1e-3,4e-4       a list

/// Positive numbers in the given order. Errors: UsageError, whose message begins with `option`, for invalid
/// text, for repeated numbers and for more than 100 numbers.
[[nodiscard]] std::vector<double> parse_decades(const std::string& option, const std::string& text);

/// The value rounded to few digits, as a user would write it: 1e-05, not 1.0000000000000003e-05.
[[nodiscard]] double rounded_decimal(double value);

/// Path of the key that sets the accuracy of the engine with this name: "run.rtol" or "run.dt"; "" if there is none.
[[nodiscard]] std::string accuracy_key(const std::string& engine);

/// An engine with a setting.
struct WorkPoint {
  std::string engine;
  std::optional<double> accuracy;  ///< value of accuracy_key()
  std::vector<Override> varied;    ///< other keys that differ from the reference

  /// "rtol=1e-06", followed by the keys in `varied`; empty for `exact` without varied keys.
  [[nodiscard]] std::string setting() const;
  /// Name of the run: "ida rtol=1e-06 reduction.cutoff_omega=1e3".
  [[nodiscard]] std::string name() const;
  /// Name of the point's line in pictures: engine and varied keys.
  [[nodiscard]] std::string line() const;
  /// Short name of the point's line: "ida cutoff_omega=1e3".
  [[nodiscard]] std::string label() const;
  /// Overrides of the scene: engine, accuracy, varied keys.
  [[nodiscard]] std::vector<Override> changes() const;
};

struct WorkRanges {
  std::vector<std::string> engines;
  std::vector<double> rtol, dt;
  std::vector<std::vector<Override>> varied = {{}};  ///< at least one set of changed keys, which may be empty
};

/// All combinations of engines, varied keys and accuracies, in this order and in the order of the ranges.
[[nodiscard]] std::vector<WorkPoint> work_points(const WorkRanges& ranges);

/// Five time steps, each a tenth of the previous step; the first is the largest power of ten up to t_end / 50.
[[nodiscard]] std::vector<double> usual_steps(double t_end);

}  // namespace signorini::speed
