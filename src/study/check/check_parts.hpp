// check_parts.hpp: the pieces of check(), one question each.
#pragma once

#include "study/check/check.hpp"

namespace signorini::checks {

/// The first state decision and the first step, by simulate() itself.
struct Start {
  std::vector<ContactSample> contacts;
  Method method;
  std::vector<std::string> warnings;  ///< of the run itself
};
/// Errors: SceneError with the reason why the run cannot start.
[[nodiscard]] Start start(const Scene& scene, const Model& model);

/// Why the forces of contacts that stick without tangential stiffness are not unique.
struct Ambiguity {
  std::size_t contact = 0;
  std::string reason;  ///< in words
};
[[nodiscard]] std::optional<Ambiguity> ambiguous_contacts(const Model& model);

/// Nodes that nothing is attached to, and sections that no member has; one sentence each.
[[nodiscard]] std::vector<std::string> loose_parts(const Scene& scene);
/// A motion that grows by itself, with the contacts as they are at t = 0; empty when there is none.
[[nodiscard]] std::string unstable_motion(const Scene& scene, const Model& model,
                                          const std::vector<ContactSample>& contacts);
[[nodiscard]] MassFacts mass_of(const Scene& scene, const Model& model);
[[nodiscard]] std::vector<std::string> free_motions(const Scene& scene, const Model& model,
                                                    const std::vector<ContactSample>& contacts);
[[nodiscard]] std::vector<StiffnessRatio> stiffness_ratios(const Model& model);
[[nodiscard]] std::vector<Discontinuity> discontinuities(const Model& model, double t_end);
[[nodiscard]] Cost cost_of(const Model& model, const RunSpec& run, const Method& method);

}  // namespace signorini::checks
