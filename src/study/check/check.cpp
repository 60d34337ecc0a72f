#include "study/check/check.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/json.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "mesh/mesh_quality.hpp"
#include "result/summary_parts.hpp"
#include "run/cost_estimate.hpp"

namespace signorini::check {
namespace {

constexpr int shown_modes = 5;

/// Damping matrix C of the structure, with the dashpots of contacts.
SparseMatrix with_dashpots(const Model& model) {
  std::vector<assembly::LineSpring> dashpots;
  for (const Contact& c : model.contacts) {
    if (c.normal_damping > 0.0) dashpots.push_back({c.normal, c.normal_damping});
  }
  return assembly::with_springs(model.damping, dashpots);
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
  // Smaller losses, relative to the scene's scales, are not reported.
  constexpr double min_reported_loss = 1e-9;
  const Reduction& reduction = *model.reduction;
  const auto warn = [&](double lost, double scale, const char* what, const std::string& unit) {
    if (lost > min_reported_loss * scale)
      warnings.push_back(
          fmt::format("the reduced model leaves out up to {:.3g} {} of the initial {}", lost, unit, what));
  };
  warn(reduction.initial_displacement_lost, model.scales.displacement, "displacements", model.units.length);
  warn(reduction.initial_velocity_lost, model.scales.velocity, "velocities",
       model.units.length + "/" + model.units.time);
}

/// Warns of contacts at which the cutoff leaves out most of the structure's compliance. Their nodes follow their forces at once:
/// slips then begin and end without the inertia of the modes left out, and add up over a run.
void warn_of_cut_compliance(const Model& model, std::vector<std::string>& warnings) {
  constexpr double most = 0.5;  // share of the compliance that may be left out; chosen value
  std::vector<std::string> names;
  double greatest = 0.0;
  for (const ComplianceShare& share : model.reduction->shares) {
    if (share.contact < 0 || !(share.residual > most * share.compliance)) continue;
    greatest = std::max(greatest, share.residual / share.compliance);
    const std::string& name = model.contacts[static_cast<std::size_t>(share.contact)].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return;
  warnings.push_back(
      fmt::format("[reduction] leaves out up to {:.0f} % of the structure's compliance at {} {}: these nodes "
                  "follow their "
                  "forces at once, without inertia, so that slips and gaps may differ from those of the full "
                  "model; raise "
                  "the cutoff until they no longer change",
                  100.0 * greatest, names.size() == 1 ? "contact" : "contacts", base::join_quoted(names, 5)));
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
    report.warnings.push_back(found->reason + "; the run stops if this state of the contacts occurs");
  if (std::string found = checks::unstable_motion(scene, structure, report.contacts); !found.empty())
    report.warnings.push_back(std::move(found));
  for (std::string& loose : checks::loose_parts(scene)) report.warnings.push_back(std::move(loose));
  report.rows = scene.run.grid().size();
  if (model.reduction) {
    warn_of_lost_state(model, report.warnings);
    warn_of_cut_compliance(model, report.warnings);
  }
  measure_mass(scene, structure, report);
  report.free_motions = checks::free_motions(scene, structure, report.contacts);
  const auto frequencies = [&](const SparseMatrix& damping, const modes::ContactConstraints& holding) {
    return modes::lowest_frequencies(structure.mass, damping, structure.stiffness, holding, shown_modes);
  };
  const std::vector<bool> all(structure.contacts.size(), true);
  report.open = frequencies(structure.damping, {});
  report.closed = frequencies(with_dashpots(structure), modes::constrain_normals(structure.contacts));
  report.stuck = frequencies(with_dashpots(structure), modes::constrain_contacts(structure.contacts, all));
  if (structure.geometric) report.load_factors = structure.geometric->load_factors;
  report.stiffness = checks::stiffness_ratios(structure);
  report.discontinuities = checks::discontinuities(model, scene.run.t_end);
  report.cost = checks::cost_of(model, scene.run, report.method);
  return report;
}

namespace {

base::Json frequency_json(const modes::Frequencies& frequencies) {
  base::Json modes = base::Json::array();
  for (const modes::NaturalMode& mode : frequencies.modes)
    modes.push_back({{"omega", mode.omega}, {"damping_ratio", mode.damping_ratio}});
  return {{"free_motions", frequencies.free_motions},
          {"unstable_motions", frequencies.unstable},
          {"modes", std::move(modes)}};
}

base::Json contact_json(const Contact& contact, const ContactSample& sample) {
  base::Json json = {
      {"name", contact.name}, {"law", contact.law->name()}, {"state", to_string(sample.state)}};
  if (const auto gap = contact.optional_gap(sample.gap)) json["gap"] = *gap;
  json["ut"] = sample.ut;
  json["N"] = sample.N;
  json["T"] = sample.T;
  json["limit"] = contact::sticking_limit(contact, sample.N);
  return json;
}

base::Json body_json(const Scene& scene, const BodySpec& body) {
  const mesh::MeshQuality q = mesh::measure_quality(body.mesh.elements, [&](int n) {
    const Node& node = scene.nodes[static_cast<std::size_t>(n)];
    return mesh::PlanePoint{node.x, node.y};
  });
  const auto worst = [](const mesh::MeshQuality::Worst& w) {
    return base::Json{{"value", w.value}, {"element", w.element}};
  };
  return {{"name", body.name},
          {"nodes", body.node_count},
          {"elements", body.mesh.elements.size()},
          {"least_angle", worst(q.min_angle)},
          {"greatest_angle", worst(q.max_angle)},
          {"aspect", worst(q.aspect)}};
}

base::Json run_json(const Scene& scene, const CheckReport& report) {
  base::Json json = {{"t_end", scene.run.t_end},
                     {"rtol", scene.run.rtol},
                     {"engine", to_string(report.method.engine)},
                     {"engine_reason", report.method.engine_reason()},
                     {"max_order", report.method.max_order},
                     {"max_order_reason", report.method.max_order_reason},
                     {"rows", report.rows},
                     {"unknowns", report.cost.unknowns},
                     {"omega_max", report.cost.omega_max}};
  if (report.cost.estimate.steps > 0.0) {
    json["steps_about"] = report.cost.estimate.steps;
    json["seconds_about"] = report.cost.estimate.seconds;
    const run::CostEstimate& effort = report.cost.estimate;
    if (effort.by_series > 0.0) json["seconds_by_series_about"] = effort.by_series;
    if (effort.by_modes > 0.0) json["seconds_in_modes_about"] = effort.by_modes;
    if (report.cost.exact) json["seconds_with_exact_about"] = *report.cost.exact;
  }
  for (const run::Trial& trial : report.cost.trials) {
    base::Json row = {{"engine", to_string(trial.engine)}, {"seconds", trial.seconds}};
    if (trial.cutoff > 0.0) row["cutoff_frequency"] = trial.cutoff;
    json["expected"].push_back(std::move(row));
  }
  return json;
}

}  // namespace

std::string check_json(const Scene& scene, const Model& model, const CheckReport& report) {
  const Units& u = model.units;
  base::Json json = {{"scene", scene.file},
                     {"title", model.title},
                     {"units", result::units_json(u)},
                     {"degrees_of_freedom", report.degrees_of_freedom},
                     {"massless", report.massless},
                     {"static_start", model.static_start}};
  if (report.mass) {
    const MassFacts& m = *report.mass;
    json["mass"] = {{"total", m.total},
                    {"centre", {m.x, m.y}},
                    {"weight", {m.total * scene.gravity[0], m.total * scene.gravity[1]}},
                    {"moving", {m.moving_x, m.moving_y}}};
  }
  for (const BodySpec& body : scene.bodies) json["bodies"].push_back(body_json(scene, body));
  json["contacts"] = base::Json::array();
  for (std::size_t k = 0; k < report.contacts.size(); ++k)
    json["contacts"].push_back(contact_json(model.contacts[k], report.contacts[k]));
  if (!model.hangers.empty()) json["hangers"] = result::hangers_json(model);
  json["warnings"] = report.warnings;
  json["free_motions"] = report.free_motions;
  json["frequencies"] = {{"open", frequency_json(report.open)},
                         {"closed", frequency_json(report.closed)},
                         {"stuck", frequency_json(report.stuck)}};
  if (report.load_factors) json["load_factors"] = *report.load_factors;
  json["damping"] = {{"alpha", model.alpha}, {"beta", model.beta}, {"omega1", model.omega1}};
  json["stiffness"] = base::Json::array();
  for (const StiffnessRatio& s : report.stiffness)
    json["stiffness"].push_back({{"contact", model.contacts[static_cast<std::size_t>(s.contact)].name},
                                 {"direction", s.normal ? "normal" : "tangential"},
                                 {"contact_stiffness", s.stiffness},
                                 {"rest", s.rest}});
  json["discontinuities"] = base::Json::array();
  for (const Discontinuity& d : report.discontinuities)
    json["discontinuities"].push_back(
        {{"t", d.t}, {"kind", d.jump ? "jump" : "kink"}, {"what", d.description}});
  if (model.reduction) json["reduction"] = result::reduction_json(*model.reduction, nullptr);
  json["run"] = run_json(scene, report);
  base::Json columns = {"t"};
  for (const Column& column : model.columns) columns.push_back(column.name);
  json["columns"] = std::move(columns);
  // Names come from files in any encoding; a byte that is not UTF-8 must not prevent the output.
  return base::json_text(json);
}

}  // namespace signorini::check
