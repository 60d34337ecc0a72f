// hard_cases.hpp: scenes on which event-driven programs usually fail, each with an answer known beforehand.
//
//   error = |computed - exact| in the unit named, or the number of events that are wrong
//
// The tests run them short, validation/hard-cases long (100 times as many cycles).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace signorini::tests {

struct HardCase {
  std::string name, what;  ///< what: the measure of the error, and its unit
  double ida, exact;       ///< greatest error allowed at rtol 1e-10
  /// The error under an engine; `cycles` scales the long ones.
  std::function<double(const std::string& engine, double cycles)> error;
};

[[nodiscard]] const std::vector<HardCase>& hard_cases();

}  // namespace signorini::tests
