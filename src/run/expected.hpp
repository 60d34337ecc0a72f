// expected.hpp: estimated cost of a run, and of engine exact in its place, before either runs.
//
// Costs are orders of magnitude (effort.hpp); loads that vary faster than the structure are included.
#pragma once

#include <optional>
#include <string>

#include "run/effort.hpp"
#include "signorini/result.hpp"

namespace signorini {

struct Expected {
  long unknowns = 0;
  double omega_max = 0.0;  ///< of the structure with all contacts sticking, and of harmonic loads
  Effort effort;
};

/// Cost with `method`, that of run.engine, which is not automatic.
[[nodiscard]] Expected expected(const Model& model, const RunSpec& run, const Method& method);
/// Cost with the engine's own method. Errors: SceneError if a step is required and not given.
[[nodiscard]] Expected expected(const Model& model, const RunSpec& run);

/// True if engine `exact` accepts this model, and may be chosen for it without being named: laws made of data run in its
/// series only where a scene asks for it.
[[nodiscard]] bool exact_takes(const Model& model, const RunSpec& run);

/// Seconds with exact instead of ida; nullopt: another engine, a scene that exact does not accept, or an unknown cost.
[[nodiscard]] std::optional<double> exact_instead(const Model& model, const RunSpec& run);

/// Duration as text: "about 3", "less than 0.1".
[[nodiscard]] std::string about_seconds(double seconds);

}  // namespace signorini
