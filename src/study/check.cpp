#include "study/check.hpp"

#include "study/check_parts.hpp"

namespace signorini {
namespace {

constexpr int shown_modes = 5;

/// C with the dashpots of contacts.
SparseMatrix with_dashpots(const Model& model) {
  std::vector<LineSpring> dashpots;
  for (const Contact& c : model.contacts) {
    if (c.normal_damping > 0.0) dashpots.push_back({c.normal, c.normal_damping});
  }
  return with_springs(model.damping, dashpots);
}

}  // namespace

CheckReport check(const Scene& scene, const Model& model) {
  CheckReport report;
  checks::Start start = checks::start(scene, model);
  report.contacts = std::move(start.contacts);
  report.settings = std::move(start.settings);
  report.warnings = std::move(start.warnings);
  if (const auto found = checks::ambiguous_contacts(model))
    report.warnings.push_back(found->reason + "; the run will stop when that happens");
  if (std::string found = checks::unstable_motion(scene, model, report.contacts); !found.empty())
    report.warnings.push_back(std::move(found));
  for (std::string& loose : checks::loose_parts(scene)) report.warnings.push_back(std::move(loose));
  report.rows = scene.run.grid().size();
  for (const Dof& dof : model.dofs) report.massless += dof.massless ? 1 : 0;
  if (!scene.matrices) report.mass = checks::mass_of(scene, model);
  report.free_motions = checks::free_motions(scene, model, report.contacts);
  const auto frequencies = [&](const SparseMatrix& damping, const Holding& holding) {
    return lowest_frequencies(model.mass, damping, model.stiffness, holding, shown_modes);
  };
  const std::vector<bool> all(model.contacts.size(), true);
  report.open = frequencies(model.damping, {});
  report.closed = frequencies(with_dashpots(model), close_contacts(model.contacts));
  report.stuck = frequencies(with_dashpots(model), hold_contacts(model.contacts, all));
  report.stiffness = checks::stiffness_ratios(model);
  report.discontinuities = checks::discontinuities(model, scene.run.t_end);
  report.cost = checks::cost_of(model, report.settings, scene.run.t_end);
  return report;
}

}  // namespace signorini
