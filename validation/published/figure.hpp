// figure.hpp: a published number, the closed form behind it, and what a run says.
//
//   printed ~ exact (to its last digit, or not), ours(engine) ~ exact
//
// `exact` is evaluated in extended precision by formulas of its own, never by Signorini.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"

namespace signorini::published {

using Real = long double;

/// What a figure has where an engine gave another sequence of events.
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct Figure {
  std::string what;     ///< with its unit
  std::string printed;  ///< as the source has it, no unit; empty where only the formula is public
  Real exact;
  bool compared = true;  ///< false: the source's law is not ours, so no run can have this number
  double mesh = 0.0;     ///< the error that a scene's discretisation has, whatever the engine
};

/// How to run: an engine, and for engines with steps of given length their step.
struct Settings {
  std::string engine;
  double dt = 1e-3;
  std::string rtol = "1e-8";
};

struct Case {
  std::string name, source;
  double dt;  ///< of newmark; unit of the scene
  /// Errors that tests allow, ten times what they were: ida at rtol 1e-8, newmark with dt. exact: 1e-10.
  double ida, newmark;
  std::function<std::vector<Figure>()> figures;
  /// One number a figure, in their order; `missing` where a run has none.
  std::function<std::vector<double>(const Settings&)> ours;
};

std::vector<Case> code_aster_friction();
std::vector<Case> code_aster_impact();
std::vector<Case> den_hartog();
std::vector<Case> pascal();
std::vector<Case> housner();
std::vector<Case> newmark();
std::vector<Case> textbook();
/// All of them, in the order of the page.
[[nodiscard]] std::vector<Case> all_cases();

/// Relative to `exact`, absolute where that is zero.
[[nodiscard]] double error(const Figure& figure, double ours);
/// How far a printed number is off, in units of its last digit; up to 1 it is rounded or cut. Negative:
/// nothing printed.
[[nodiscard]] double last_digits_off(const Figure& figure);

}  // namespace signorini::published
