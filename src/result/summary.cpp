#include "result/summary.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>
#include "base/json.hpp"

#include "base/files.hpp"
#include "base/version.hpp"
#include "contact/law.hpp"
#include "engine/tolerance.hpp"
#include "model/modes/modes.hpp"
#include "model/statics/static_system.hpp"
#include "result/certificate_files.hpp"
#include "result/summary_parts.hpp"
#include "signorini/error.hpp"

namespace signorini::result {

const char* to_string(Outcome::Kind kind) {
  switch (kind) {
    case Outcome::Kind::done:
      return "done";
    case Outcome::Kind::stopped:
      return "stopped";
    case Outcome::Kind::interrupted:
      return "interrupted";
  }
  return "?";
}

namespace {

int exit_code(Outcome::Kind kind) {
  switch (kind) {
    case Outcome::Kind::done:
      return static_cast<int>(ExitCode::done);
    case Outcome::Kind::stopped:
      return static_cast<int>(ExitCode::stopped);
    case Outcome::Kind::interrupted:
      return static_cast<int>(ExitCode::interrupted);
  }
  return static_cast<int>(ExitCode::bug);
}

base::Json unit_json(const Units& units) {
  base::Json json = units_json(units);
  json["energy"] = units.force + " " + units.length;
  json["power"] = units.force + " " + units.length + "/" + units.time;
  json["angle"] = "rad";
  return json;
}

base::Json version_json() {
  return {{"signorini", version}, {"sundials", sundials_version}, {"compiler", "g++ " __VERSION__}};
}

/// History of a frictional start: changes of contact states, and all contacts at the end of each load step of a stage.
base::Json frictional_json(const Model& model) {
  base::Json events = base::Json::array(), stages = base::Json::array();
  const auto name = [&](int k) { return model.contacts[static_cast<std::size_t>(k)].name; };
  for (const StageEvent& e : model.statics.events)
    events.push_back({{"stage", e.stage},
                      {"part", e.fraction},
                      {"contact", name(e.contact)},
                      {"from", signorini::to_string(e.from)},
                      {"to", signorini::to_string(e.to)}});
  for (const StageEnd& end : model.statics.stages) {
    base::Json contacts = base::Json::array();
    for (std::size_t k = 0; k < end.states.size(); ++k)
      contacts.push_back({{"name", model.contacts[k].name},
                          {"state", signorini::to_string(end.states[k])},
                          {"N", end.N[k]},
                          {"T", end.T[k]}});
    stages.push_back({{"stage", end.stage}, {"part", end.fraction}, {"contacts", contacts}});
  }
  return {{"events", events}, {"stages", stages}};
}

base::Json model_json(const Model& model) {
  long massless = 0;
  for (const Dof& dof : model.dofs) massless += dof.massless ? 1 : 0;
  base::Json json = {{"degrees_of_freedom", model.size()},
                     {"massless", massless},
                     {"alpha", model.alpha},
                     {"beta", model.beta},
                     {"omega1", model.omega1},
                     {"omega_max", model.omega_max},
                     {"static_start", model.static_start}};
  if (model.static_start) json["free_motions"] = model.statics.free_motions;
  if (!model.hangers.empty()) json["hangers"] = hangers_json(model);
  for (const Contact& contact : model.contacts)
    if (const CurvedSurface* surface = contact.curved_surface())
      json["pendulums"][contact.name] = surface->nominal_force;
  if (model.geometric) json["load_factors"] = model.geometric->load_factors;
  if (model.statics.frictional) json["frictional_start"] = frictional_json(model);
  json["scales"] = {{"displacement", model.scales.displacement},
                    {"rotation", model.scales.rotation},
                    {"velocity", model.scales.velocity},
                    {"angular_velocity", model.scales.angular_velocity},
                    {"force", model.scales.force}};
  return json;
}

base::Json turn_json(const TimedExtreme& turn) { return {{"value", turn.value}, {"t", turn.t}}; }

base::Json support_json(const SupportLoad& load) {
  return {{"N", {{"least", turn_json(load.min_N)}, {"greatest", turn_json(load.max_N)}}},
          {"T", {{"least", turn_json(load.min_T)}, {"greatest", turn_json(load.max_T)}}},
          {"residual_slip", load.residual_slip()}};
}

/// Object of contact k in summary.json. run: null if the run has not ended; results are then omitted.
base::Json contact_json(const Model& model, std::size_t k, double capture_velocity,
                        const CertifiedReport* run) {
  const Report* report = run != nullptr ? &run->report : nullptr;
  const Contact& contact = model.contacts[k];
  base::Json json = {{"name", contact.name},
                     {"law", contact.law->name()},
                     {"static_friction", contact.friction.static_},
                     {"kinetic_friction", contact.friction.kinetic}};
  if (const auto gap = contact.optional_gap(contact.gap)) {
    json["gap"] = *gap;
    if (contact.takes_impulses())
      json["restitution"] = contact.restitution;
    else if (!contact.compliance_split())
      json["normal_stiffness"] = contact.normal_stiffness;
  }
  for (const FrictionConstant& constant : friction_constants)
    if (const auto& value = contact.friction.*constant.value) json[std::string(constant.key)] = *value;
  if (contact.takes_impulses() && report != nullptr)
    json["capture_velocity"] = contact.capture_velocity.value_or(capture_velocity);
  if (const ShearElement* element = contact.sliding_point()) {
    json["tangential_stiffness"] = element->stiffness;
    json["tangential_damping"] = element->damping;
  }
  if (contact.tangential_stiffness && !contact.compliance_split())
    json["tangential_stiffness"] = *contact.tangential_stiffness;
  if (const auto reaction = statics::static_reaction(model, k)) json["static_reaction"] = *reaction;
  if (report == nullptr) return json;
  if (k < report->supports.size()) json["load"] = support_json(report->supports[k]);
  if (k < report->audit.friction_work.size()) json["friction_work"] = report->audit.friction_work[k];
  if (k < report->peaks.size()) {
    const Peak& peak = report->peaks[k];
    json["peaks"] = {{"tangential", peak.tangential}, {"normal", peak.normal}, {"N", peak.N}, {"T", peak.T}};
    if (run->certificate) json["peaks"]["errors"] = peak_errors_json(*run, k);
  }
  if (k < report->landings.size() && !contact.normal_force_given()) {
    json["landings"] = base::Json::array();
    for (std::size_t i = 0; i < report->landings[k].size(); ++i) {
      const Landing& l = report->landings[k][i];
      json["landings"].push_back({{"start", l.start},
                                  {"duration", l.end - l.start},
                                  {"peak_force", l.peak_force},
                                  {"impulse", l.impulse}});
      if (run->certificate) json["landings"].back()["errors"] = landing_errors_json(*run, k, i);
    }
  }
  return json;
}

base::Json settings_json(const RunSpec& run, const engine::Tolerance& tolerance, const Method& method) {
  base::Json json = {{"t_end", run.t_end},
                     {"rtol", tolerance.rtol},
                     {"atol",
                      {{"displacement", tolerance.displacement},
                       {"rotation", tolerance.rotation},
                       {"velocity", tolerance.velocity},
                       {"angular_velocity", tolerance.angular_velocity},
                       {"force", tolerance.force}}},
                     {"engine_reason", method.engine_reason()},
                     {"max_order", method.max_order},
                     {"max_order_reason", method.max_order_reason},
                     {"max_events_at_once", run.max_events_at_once}};
  const EngineInfo& engine = signorini::engine_info(method.engine);
  if (engine.accuracy == Accuracy::step) json["dt"] = method.accuracy;
  const std::pair<const char*, base::Json> own[] = {
      {"refine", run.refine == Refine::linear ? "linear" : "root"},
      {"step", run.step == StepControl::doubling ? "doubling" : "fixed"},
      {"relaxation", run.relaxation},
      {"max_iterations", run.max_iterations}};
  for (const auto& [key, value] : own)
    if (has_key(engine, key)) json[key] = value;
  if (!method.flow.empty()) {
    json["flow"] = method.flow;
    json["flow_reason"] = method.flow_reason;
  }
  return json;
}

base::Json counter_json(const Counters& c) {
  base::Json orders = base::Json::object();
  for (const auto& [order, steps] : c.steps_by_order) orders[std::to_string(order)] = steps;
  return {{"steps", c.steps},
          {"steps_by_order", orders},
          {"residuals", c.residuals},
          {"jacobians", c.jacobians},
          {"factorisations", c.factorisations},
          {"refactorisations", c.refactorisations},
          {"solves", c.solves},
          {"error_test_failures", c.error_test_failures},
          {"convergence_failures", c.convergence_failures},
          {"guard_evaluations", c.guard_evaluations},
          {"restarts", c.restarts},
          {"rolled_back", c.rolled_back},
          {"time_events", c.time_events},
          {"contact_states", c.contact_states},
          {"proof_steps", c.proof_steps},
          {"fallbacks", c.fallbacks}};
}

base::Json extreme_json(const Model& model, const Extreme& extreme, double scale) {
  base::Json json = {{"value", extreme.value},
                     {"scale", scale},
                     {"relative", scale > 0.0 ? extreme.value / scale : 0.0},
                     {"t", extreme.t}};
  if (extreme.contact >= 0) json["contact"] = model.contacts[static_cast<std::size_t>(extreme.contact)].name;
  return json;
}

base::Json output_extreme_json(const Output& output, double value, double t, const OutputPlace& place) {
  base::Json json = {{"value", value}, {"t", t}};
  if (place.segment < 0) return json;
  const Output::Segment& stretch = output.segments[static_cast<std::size_t>(place.segment)];
  json["at"] = {stretch.from, stretch.to};
  json["station"] = place.station;
  if (stretch.fibre != Fibre::both) json["fibre"] = stretch.fibre == Fibre::left ? "left" : "right";
  return json;
}

base::Json response_json(const Model& model, const Report& report) {
  base::Json list = base::Json::array();
  for (std::size_t i = 0; i < report.response.size() && i < model.outputs.size(); ++i) {
    const Output& output = model.outputs[i];
    const OutputExtremes& e = report.response[i];
    list.push_back({{"name", output.name},
                    {"kind", all_output_kinds[static_cast<std::size_t>(output.kind)].name},
                    {"unit", unit_text(output.unit, model.units)},
                    {"maximum", output_extreme_json(output, e.maximum, e.t_maximum, e.at_maximum)},
                    {"minimum", output_extreme_json(output, e.minimum, e.t_minimum, e.at_minimum)},
                    {"last", e.last}});
    if (!output.contains.empty()) list.back()["contains"] = output.contains;
  }
  return list;
}

base::Json audit_json(const Model& model, const Audit& a) {
  base::Json json = {{"gap", extreme_json(model, a.gap, a.length_scale)},
                     {"tension", extreme_json(model, a.tension, a.force_scale)},
                     {"product", extreme_json(model, a.product, a.energy_reference())},
                     {"friction", extreme_json(model, a.friction, a.force_scale)},
                     {"direction", extreme_json(model, a.direction, a.power_scale)},
                     {"equilibrium", extreme_json(model, a.equilibrium, a.force_scale)},
                     {"penetration", extreme_json(model, a.penetration, a.length_scale)},
                     {"impulses_on_closed", a.impulses_on_closed},
                     {"energy", extreme_json(model, a.energy, a.energy_reference())}};
  if (a.contacts_at_limit > 0) {
    json["at_limit"] = extreme_json(model, a.at_limit, a.force_scale);
    json["at_limit"]["contacts"] = a.contacts_at_limit;
  }
  if (a.reactions) json["reactions"] = extreme_json(model, *a.reactions, a.force_scale);
  return json;
}

base::Json energy_json(const Energy& e) {
  base::Json json;
  for (const EnergyColumn& column : energy_columns) json[column.name] = e.*column.value;
  json[balance_column] = e.balance();
  return json;
}

base::Json head_json(const Scene& scene, const Model& model, const std::vector<std::string>& command_line) {
  return {{"title", scene.title},
          {"scene", scene.file},
          {"command_line", command_line},
          {"versions", version_json()},
          {"units", unit_json(scene.units)},
          {"model", model_json(model)}};
}

/// Reason why the contact states could not be determined. Unknown or infinite values are written as null.
base::Json refusal_json(const Model& model, const Refusal& refusal) {
  base::Json contacts = base::Json::array();
  for (const std::size_t c : refusal.contacts) contacts.push_back(model.contacts[c].name);
  return {{"kind", signorini::to_string(refusal.kind)},
          {"contacts", contacts},
          {"cond", refusal.condition},
          {"residual", refusal.residual},
          {"reason", refusal.reason}};
}

}  // namespace

std::string summary_json(const Scene& scene, const Model& model, const CertifiedReport& run,
                         const std::vector<std::string>& command_line) {
  const Report& report = run.report;
  const engine::Tolerance tolerance = engine::tolerance_of(model, scene.run);
  base::Json json;
  json["outcome"] = {{"kind", to_string(report.outcome.kind)},
                     {"t", report.outcome.t},
                     {"t_end", scene.run.t_end},
                     {"reason", report.outcome.reason},
                     {"exit_code", exit_code(report.outcome.kind)}};
  if (report.outcome.refusal) json["refusal"] = refusal_json(model, report.outcome.refusal);
  json["undecided"] = report.undecided;
  json.update(head_json(scene, model, command_line));
  json["engine"] = signorini::to_string(report.method.engine);
  json["warnings"] = report.warnings;
  json["settings"] = settings_json(scene.run, tolerance, report.method);
  json["settings"]["rounding_floor"] = modes::rounding_floor(model);
  json["wall_time"] = report.wall_time;
  long total = 0;
  for (const auto& [type, count] : report.events_by_type) total += count;
  json["events"] = {{"total", total}, {"by_type", report.events_by_type}};
  json["certified"] = certificate_json(run);
  if (!run.certificate && !run.reason.empty()) json["not_certified"] = run.reason;
  json["counters"] = counter_json(report.counters);
  if (model.reduction) json["reduction"] = reduction_json(*model.reduction, &run);
  json["witness"] = law_check_json(model, report.law_checks);
  json["audit"] = audit_json(model, report.audit);
  json["energy"] = {{"initial", energy_json(report.audit.initial)},
                    {"final", energy_json(report.audit.final)},
                    {"greatest_work_of_loads", report.audit.work_of_loads}};
  if (!model.outputs.empty()) json["response"] = response_json(model, report);
  json["contacts"] = base::Json::array();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    json["contacts"].push_back(contact_json(model, k, tolerance.capture_velocity(), &run));
  }
  return base::json_text(json);
}

namespace {

/// Text of summary.json without results, for a run that has no Report.
std::string brief_json(const Scene& scene, const Model& model, const std::vector<std::string>& command_line,
                       const base::Json& outcome) {
  base::Json json;
  json["outcome"] = outcome;
  json.update(head_json(scene, model, command_line));
  json["contacts"] = base::Json::array();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    json["contacts"].push_back(contact_json(model, k, 0.0, nullptr));
  }
  return base::json_text(json);
}

}  // namespace

std::string running_json(const Scene& scene, const Model& model,
                         const std::vector<std::string>& command_line) {
  return brief_json(scene, model, command_line, {{"kind", "running"}, {"t_end", scene.run.t_end}});
}

std::string abandoned_json(const Scene& scene, const Model& model,
                           const std::vector<std::string>& command_line, double t,
                           const std::string& reason) {
  return brief_json(scene, model, command_line,
                    {{"kind", to_string(Outcome::Kind::stopped)},
                     {"t", t},
                     {"t_end", scene.run.t_end},
                     {"reason", reason},
                     {"exit_code", static_cast<int>(ExitCode::file)}});
}

RunFacts read_run_facts(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "summary.json";
  if (const std::string why = base::input_file_error(path); !why.empty())
    throw FileError(path.string(), why + ", expected the summary of a run");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw FileError(path.string(),
                    "cannot be read" + base::system_error_text(errno) + "; expected the directory of a run");
  try {
    const base::Json json = base::parse_json(file);
    RunFacts facts;
    facts.title = json.at("title");
    facts.outcome = json.at("outcome").at("kind");
    facts.t_end = json.at("outcome").at("t_end");
    if (const auto found = json.find("certified"); found != json.end() && found->is_object())
      if (!found->at("complete").get<bool>()) facts.certain_until = found->at("until").get<double>();
    facts.units = units_from(json.at("units"));
    if (const auto found = json.find("response"); found != json.end())
      for (const base::Json& output : *found)
        facts.response.push_back({output.at("name"), output.at("unit")});
    std::set<std::string> names;
    for (const base::Json& contact : json.at("contacts")) {
      facts.contacts.push_back({contact.at("name"), contact.at("law") == "slider",
                                contact.at("static_friction"), contact.at("kinetic_friction")});
      if (const std::string& name = facts.contacts.back().name; !names.insert(name).second)
        throw FileError(path.string(), "names the contact '" + name + "' twice");
    }
    return facts;
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not the summary of a run: ") + error.what());
  }
}

}  // namespace signorini::result
