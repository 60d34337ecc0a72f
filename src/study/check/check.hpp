// check.hpp: facts about a scene, computed by all steps of a run before its time loop.
//
//   read_scene -> build_model -> simulate, stopped after the first step        the same code as a run
//
// If check() succeeds, a run can start. Otherwise check() and the run have the same error message.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/modes/frequencies.hpp"
#include "run/cost_estimate.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::check {

/// Mass of the scene, including parts on fixed degrees of freedom. Only for scenes with nodes.
struct MassFacts {
  double total = 0.0;
  double x = 0.0, y = 0.0;  ///< centre of mass
  /// r^T M r; r: unit translation of all free degrees of freedom in x or in y
  double moving_x = 0.0, moving_y = 0.0;
};

/// Stiffness of a contact's spring, and stiffness `rest` of the remaining structure at the contact: 1 / (a .
/// K_rest^-1 a), a: direction of the contact. K_rest includes the springs of all other contacts. If rest is
/// 0, only the spring resists the motion.
struct StiffnessRatio {
  int contact = 0;
  bool normal = true;
  double stiffness = 0.0, rest = 0.0;
};

/// A time in [0, t_end] at which a load, a compression or a surface velocity is not smooth.
struct Discontinuity {
  double t = 0.0;
  bool jump = false;        ///< true: the value jumps; false: only the slope jumps
  std::string description;  ///< "load 1", "normal_force of contact 'pad'"
};

/// Estimated cost of the time loop, as an order of magnitude.
struct Cost {
  long unknowns = 0;
  /// Greatest circular frequency of the structure with sticking contacts, and of harmonic loads.
  double omega_max = 0.0;
  run::CostEstimate estimate;
  std::optional<double> exact;     ///< seconds that exact would take instead of ida, by the same estimate
  std::vector<run::Trial> trials;  ///< measurements by measure_cost(); empty if it is not called
};

/// Facts about a scene. Frequencies, free motions and stiffnesses are those of the full structure, even if
/// the run uses a reduced model.
struct CheckReport {
  long degrees_of_freedom = 0, massless = 0;
  std::optional<MassFacts> mass;
  double least_mass = 0.0, greatest_mass = 0.0;  ///< least and greatest nonzero entry on the diagonal of M
  std::vector<ContactSample> contacts;           ///< contacts just after t = 0
  std::vector<std::string> warnings;             ///< warnings of the run, and model warnings
  /// Motions of the structure that its closed contacts do not restrain, or restrain only by friction; one text each.
  std::vector<std::string> free_motions;
  modes::Frequencies open, closed, stuck;           ///< with all contacts open, closed, or sticking
  std::optional<std::vector<double>> load_factors;  ///< only with run.geometric: Geometric::load_factors
  std::vector<StiffnessRatio> stiffness;
  std::vector<Discontinuity> discontinuities;  ///< in ascending time
  Method method;
  Cost cost;
  std::size_t rows = 0;  ///< number of rows of history.csv
};

/// Checks a scene. Errors: SceneError with the reason if the run could not start.
[[nodiscard]] CheckReport check(const Scene& scene, const Model& model);

/// Measures the first steps of each engine that accepts the scene, for half a second each, and of reduced
/// models with these `cutoffs` of [reduction], in cycles per unit of time. If `cutoffs` is empty and the run
/// is long, run::cutoff_to_try chooses a cutoff.
void measure_cost(const Scene& scene, const Model& model, std::vector<double> cutoffs, CheckReport& report);

/// The report as JSON, with numbers in the scene's units.
[[nodiscard]] std::string check_json(const Scene& scene, const Model& model, const CheckReport& report);

}  // namespace signorini::check

// Functions that check() calls.

namespace signorini::checks {

/// Result of the first decision of contact states and of the first step, computed by simulate().
struct Start {
  std::vector<ContactSample> contacts;
  Method method;
  std::vector<std::string> warnings;  ///< warnings of the run itself
};
/// Decides the first states and makes the first step. Errors: SceneError with the reason why the run cannot
/// start.
[[nodiscard]] Start start(const Scene& scene, const Model& model);

/// Reason why the forces of sticking contacts without tangential stiffness are not unique.
struct Ambiguity {
  std::size_t contact = 0;
  std::string reason;  ///< one sentence
};
/// A contact whose forces are not unique; nullopt if there is none.
[[nodiscard]] std::optional<Ambiguity> ambiguous_contacts(const Model& model);

/// Nodes without any attachment, and sections that no member uses; one sentence each.
[[nodiscard]] std::vector<std::string> loose_parts(const Scene& scene);
/// Sentence about an unstable motion with the contact states of t = 0; empty if there is none.
[[nodiscard]] std::string unstable_motion(const Scene& scene, const Model& model,
                                          const std::vector<ContactSample>& contacts);
// Each of the following functions computes one member of CheckReport.
[[nodiscard]] check::MassFacts mass_of(const Scene& scene, const Model& model);
[[nodiscard]] std::vector<std::string> free_motions(const Scene& scene, const Model& model,
                                                    const std::vector<ContactSample>& contacts);
[[nodiscard]] std::vector<check::StiffnessRatio> stiffness_ratios(const Model& model);
[[nodiscard]] std::vector<check::Discontinuity> discontinuities(const Model& model, double t_end);
[[nodiscard]] check::Cost cost_of(const Model& model, const RunSpec& run, const Method& method);

}  // namespace signorini::checks
