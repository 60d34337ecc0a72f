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

/// Warnings about the decisions of a run, some of each kind: impacts that gain energy, contacts that parts without mass leave
/// at once, contacts that hold one motion together, rest at a limit of friction that rounding hides.
class DecisionWarnings {
 public:
  /// The model must outlive this.
  explicit DecisionWarnings(const Model& model) : model_(model) {}
  /// t: in the units of the model.
  void add(double t, const Decision& decision, std::vector<std::string>& warnings);

 private:
  const Model& model_;
  bool shares_ = false;  // it has warned of it
  int gains_ = 0, releases_ = 0, at_limit_ = 0;
};

/// The balance of a finished audit is off by more than 1e-3 of what was exchanged, and by more than `rounding`, what a
/// double leaves of the energy stored. other: `exact` takes the scene.
[[nodiscard]] std::optional<std::string> energy_lost(const Audit& audit, const Method& method,
                                                     double rounding, bool other);

}  // namespace signorini
