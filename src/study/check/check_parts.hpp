// check_parts.hpp: the parts of check().
#pragma once

#include "study/check/check.hpp"

namespace signorini::checks {

/// Result of the first state decision and the first step, by simulate() itself.
struct Start {
  std::vector<ContactSample> contacts;
  Method method;
  std::vector<std::string> warnings;  ///< warnings of the run itself
};
/// Errors: SceneError with the reason why the run cannot start.
[[nodiscard]] Start start(const Scene& scene, const Model& model);

/// Reason why the forces of sticking contacts without tangential stiffness are not unique.
struct Ambiguity {
  std::size_t contact = 0;
  std::string reason;  ///< one sentence
};
[[nodiscard]] std::optional<Ambiguity> ambiguous_contacts(const Model& model);

/// Nodes without any attachment, and sections that no member uses; one sentence each.
[[nodiscard]] std::vector<std::string> loose_parts(const Scene& scene);
/// An unstable motion with the contacts as they are at t = 0; empty if there is none.
[[nodiscard]] std::string unstable_motion(const Scene& scene, const Model& model,
                                          const std::vector<ContactSample>& contacts);
[[nodiscard]] MassFacts mass_of(const Scene& scene, const Model& model);
[[nodiscard]] std::vector<std::string> free_motions(const Scene& scene, const Model& model,
                                                    const std::vector<ContactSample>& contacts);
[[nodiscard]] std::vector<StiffnessRatio> stiffness_ratios(const Model& model);
[[nodiscard]] std::vector<Discontinuity> discontinuities(const Model& model, double t_end);
[[nodiscard]] Cost cost_of(const Model& model, const RunSpec& run, const Method& method);

}  // namespace signorini::checks
