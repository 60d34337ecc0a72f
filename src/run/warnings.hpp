// warnings.hpp: warnings about ambiguities and corrections in a run, one sentence each.
#pragma once

#include <optional>

#include "decide/decision.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

/// Warnings about an initial_shear beyond the friction limit, with the value that remains. `start`: the first decision.
[[nodiscard]] std::vector<std::string> shear_limit_warnings(const Model& model,
                                                            const decide::Decision& start);

/// Warnings about loads that oscillate by more than a radian in a step of given length. Short pulses cause
/// none: they have steps of their own.
[[nodiscard]] std::vector<std::string> fast_load_warnings(const Model& model, const RunSpec& run);

/// Warnings about the decisions of a run, a few of each kind: impacts that gain energy, contacts that
/// massless parts leave instantaneously, several contacts that hold one motion, rest at a friction limit
/// within rounding.
class DecisionWarnings {
 public:
  /// The model must outlive this.
  explicit DecisionWarnings(const Model& model) : model_(model) {}
  /// Adds warnings. t: in the units of the model.
  void add(double t, const decide::Decision& decision, std::vector<std::string>& warnings);

 private:
  const Model& model_;
  bool shared_motion_reported_ = false;
  int gains_ = 0, releases_ = 0, at_limit_ = 0;
};

/// Warning if the balance of a finished audit is off by more than 1e-3 of the exchanged energy, and by more than
/// `rounding`, the rounding of the stored energy. other: `exact` accepts the scene.
[[nodiscard]] std::optional<std::string> energy_warning(const Audit& audit, const Method& method,
                                                        double rounding, bool other);

}  // namespace signorini::run
