// warnings.hpp: what a run could not settle or had to change, one sentence each.
#pragma once

#include <optional>

#include "decide/decision.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// An initial_shear beyond the friction limit cannot stand; what is left of it. `start`: the first decision.
[[nodiscard]] std::vector<std::string> cut_shears(const Model& model, const Decision& start);

/// Loads that swing by more than a radian in a step of a given length, one sentence each. Short pulses are stepped through
/// as they need.
[[nodiscard]] std::vector<std::string> swings_within_steps(const Model& model, const RunSpec& run);

/// An impact that gains energy.
[[nodiscard]] std::string impact_gain(double t, double gain);

/// Parts without mass have left contact c at once. t: in the scene's unit.
[[nodiscard]] std::string left_at_once(const Model& model, std::size_t c, double t);

/// Rounding cannot tell whether a contact sticks. t: in the scene's unit.
[[nodiscard]] std::string rest_at_limit(const Model& model, const AtLimit& found, double t);

/// Contacts hold one motion together, if some do. t: in the scene's unit.
[[nodiscard]] std::optional<std::string> shared_motion(const Model& model, const Decision& decision,
                                                       double t);

/// The balance of a finished audit is off by more than 1e-3 of what was exchanged, and by more than `rounding`, what a
/// double leaves of the energy stored. other: `exact` takes the scene.
[[nodiscard]] std::optional<std::string> energy_lost(const Audit& audit, const Method& method,
                                                     double rounding, bool other);

}  // namespace signorini
