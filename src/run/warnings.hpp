// warnings.hpp: warnings about ambiguities and corrections in a run, one sentence each.
#pragma once

#include <optional>

#include "decide/decision.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

/// Warnings about an initial_shear above the friction limit, with the reduced force T. start: the first decision.
[[nodiscard]] std::vector<std::string> shear_limit_warnings(const Model& model,
                                                            const decide::Decision& start);

/// Warnings about loads whose phase advances by more than a radian in a fixed step run.dt. Short pulses cause no warning,
/// because the engine divides its steps during a pulse.
[[nodiscard]] std::vector<std::string> fast_load_warnings(const Model& model, const RunSpec& run);

/// Warnings about the decisions of a run, a few of each kind: impacts that gain energy, contacts that massless parts leave
/// instantaneously, several contacts that prevent the same motion, sticking at the friction limit within rounding.
class DecisionWarnings {
 public:
  /// The model must outlive the object.
  explicit DecisionWarnings(const Model& model) : model_(model) {}
  /// Appends warnings about a decision at t, in the unit of the model, to `warnings`.
  void add(double t, const decide::Decision& decision, std::vector<std::string>& warnings);

 private:
  const Model& model_;
  bool shared_motion_reported_ = false;
  int gains_ = 0, releases_ = 0, at_limit_ = 0;
};

/// Warning if the error of a run's energy balance exceeds 1e-3 of the exchanged energy, and also `rounding`, the rounding
/// error of the stored energy. other: engine exact accepts the scene, and is recommended.
[[nodiscard]] std::optional<std::string> energy_warning(const Audit& audit, const Method& method,
                                                        double rounding, bool other);

}  // namespace signorini::run
