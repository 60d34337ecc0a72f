// expected.hpp: what a run will cost, and what exact would cost in its place, known before either runs.
//
// By order of magnitude (effort.hpp); loads that vary faster than the structure count.
#pragma once

#include <optional>
#include <string>

#include "run/effort.hpp"
#include "signorini/result.hpp"

namespace signorini {

struct Expected {
  long unknowns = 0;
  double omega_max = 0.0;  ///< of the structure with its contacts stuck, and of harmonic loads
  Effort effort;
};

/// `method`: of run.engine, which is not automatic.
[[nodiscard]] Expected expected(const Model& model, const RunSpec& run, const Method& method);
/// The same of the engine's own method. Errors: SceneError where a step is needed and not given.
[[nodiscard]] Expected expected(const Model& model, const RunSpec& run);

/// Does the flow of `exact` follow this model?
[[nodiscard]] bool exact_takes(const Model& model, const RunSpec& run);

/// Seconds that exact would take instead of ida; nothing for other engines, where exact does not take the
/// scene, or where nobody knows.
[[nodiscard]] std::optional<double> exact_instead(const Model& model, const RunSpec& run);

/// "about 3", "less than 0.1"
[[nodiscard]] std::string about_seconds(double seconds);

}  // namespace signorini
