#include "study/check/check.hpp"

#include <fmt/core.h>

#include "run/expected.hpp"
#include "study/check/check_parts.hpp"

namespace signorini {
namespace {

constexpr int shown_modes = 5;

/// C including the dashpots of contacts.
SparseMatrix with_dashpots(const Model& model) {
  std::vector<LineSpring> dashpots;
  for (const Contact& c : model.contacts) {
    if (c.normal_damping > 0.0) dashpots.push_back({c.normal, c.normal_damping});
  }
  return with_springs(model.damping, dashpots);
}

/// The model before its reduction.
Model unreduced(Scene scene) {
  scene.reduction.reset();
  return build_model(scene);
}

void measure_mass(const Scene& scene, const Model& structure, CheckReport& report) {
  report.degrees_of_freedom = structure.size();
  for (const Dof& dof : structure.dofs) report.massless += dof.massless ? 1 : 0;
  const Vector diagonal = structure.mass.diagonal();
  report.greatest_mass = diagonal.maxCoeff();
  for (double m : diagonal)
    if (m > 0.0 && (report.least_mass == 0.0 || m < report.least_mass)) report.least_mass = m;
  if (!scene.matrices) report.mass = checks::mass_of(scene, structure);
}

/// Warns of the part of the initial state that the reduced model cannot represent.
void warn_of_lost_state(const Model& model, std::vector<std::string>& warnings) {
  constexpr double worth_a_word = 1e-9;  // relative to the scene's scales
  const Reduction& reduction = *model.reduction;
  const auto warn = [&](double lost, double scale, const char* what, const std::string& unit) {
    if (lost > worth_a_word * scale)
      warnings.push_back(
          fmt::format("the reduced model leaves out up to {:.3g} {} of the initial {}", lost, unit, what));
  };
  warn(reduction.initial_displacement_lost, model.scales.displacement, "displacements", model.units.length);
  warn(reduction.initial_velocity_lost, model.scales.velocity, "velocities",
       model.units.length + "/" + model.units.time);
}

}  // namespace

CheckReport check(const Scene& scene, const Model& model) {
  CheckReport report;
  std::optional<Model> whole;
  if (model.reduction) whole = unreduced(scene);
  const Model& structure = whole ? *whole : model;
  checks::Start start = checks::start(scene, model);
  report.contacts = std::move(start.contacts);
  report.method = std::move(start.method);
  report.warnings = std::move(start.warnings);
  if (const auto found = checks::ambiguous_contacts(model))
    report.warnings.push_back(found->reason + "; the run will stop when that happens");
  if (std::string found = checks::unstable_motion(scene, structure, report.contacts); !found.empty())
    report.warnings.push_back(std::move(found));
  for (std::string& loose : checks::loose_parts(scene)) report.warnings.push_back(std::move(loose));
  report.rows = scene.run.grid().size();
  if (model.reduction) warn_of_lost_state(model, report.warnings);
  measure_mass(scene, structure, report);
  report.free_motions = checks::free_motions(scene, structure, report.contacts);
  const auto frequencies = [&](const SparseMatrix& damping, const Holding& holding) {
    return lowest_frequencies(structure.mass, damping, structure.stiffness, holding, shown_modes);
  };
  const std::vector<bool> all(structure.contacts.size(), true);
  report.open = frequencies(structure.damping, {});
  report.closed = frequencies(with_dashpots(structure), close_contacts(structure.contacts));
  report.stuck = frequencies(with_dashpots(structure), hold_contacts(structure.contacts, all));
  if (structure.geometric) report.load_factors = structure.geometric->load_factors;
  report.stiffness = checks::stiffness_ratios(structure);
  report.discontinuities = checks::discontinuities(model, scene.run.t_end);
  report.cost = checks::cost_of(model, scene.run, report.method);
  return report;
}

}  // namespace signorini
