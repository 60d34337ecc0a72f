// signorini check SCENE: reads the scene, builds the model and computes its initial state, but runs no time loop.

#include "cli/check.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "mesh/mesh_quality.hpp"
#include "model/outputs/reactions.hpp"
#include "run/cost_estimate.hpp"
#include "study/check/check.hpp"

namespace signorini::cli {
namespace {

constexpr std::size_t max_table_rows = 24;

/// The number with two significant digits, below 1e9 without an exponent: 140000.
std::string rough(double value) {
  const double unit = value > 0.0 ? std::pow(10.0, std::floor(std::log10(value)) - 1.0) : 1.0;
  const double rounded = std::round(value / unit) * unit;
  return rounded < 1e9 ? fmt::format("{:.{}f}", rounded, rounded < 10.0 ? 1 : 0)
                       : fmt::format("{:.1e}", rounded);
}

std::string count(long n, const char* one, const char* many) {
  return n == 0 ? fmt::format("no {}", many) : fmt::format("{} {}", n, n == 1 ? one : many);
}

// Number as text; a value below 1e-9 of the scale is rounding and shown as 0.
std::string above(double value, double scale) { return number(std::abs(value) < 1e-9 * scale ? 0.0 : value); }

std::string unit(const std::string& text) { return " [" + text + "]"; }

std::string frequency_unit(const Units& units) { return units.time == "s" ? "Hz" : "1/" + units.time; }

std::string more(std::size_t all) {
  return all > max_table_rows ? fmt::format("  ... {} more; all are in --json\n", all - max_table_rows) : "";
}

std::string head(const Scene& scene, const Model& model, const check::CheckReport& report) {
  const Units& u = model.units;
  std::string text = model.title.empty() ? "" : model.title + "\n";
  text += fmt::format("units: {}, {}, {}, {}\n\n", u.force, u.mass, u.length, u.time);
  text += fmt::format("structure: {}, {}; {}\n",
                      count(report.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
                      report.massless == 0 ? "none massless" : fmt::format("{} massless", report.massless),
                      count(static_cast<long>(model.contacts.size()), "contact", "contacts"));
  if (!report.mass) {
    text += fmt::format("mass: diagonal of the matrix from {} to {}\n", number(report.least_mass),
                        number(report.greatest_mass));
    return text;
  }
  const check::MassFacts& m = *report.mass;
  text += fmt::format("mass: {} {}, centre at ({}, {}) {}", number(m.total), u.mass, number(m.x), number(m.y),
                      u.length);
  const double weight = m.total * std::hypot(scene.gravity[0], scene.gravity[1]);
  text += weight > 0.0 ? fmt::format(", weight {} {}\n", number(weight), u.force) : ", no gravity\n";
  text += fmt::format("      movable mass: {} {} along x, {} {} along y\n", number(m.moving_x), u.mass,
                      number(m.moving_y), u.mass);
  return text;
}

/// One line per rigid body, with the mass and inertia at its centre.
std::string body_lines(const Scene& scene) {
  std::string text;
  for (const RigidBody& body : scene.rigid) {
    const auto at = [&](const auto& x) { return x.name == body.centre; };
    const Node& centre = *std::find_if(scene.nodes.begin(), scene.nodes.end(), at);
    const auto mass = std::find_if(scene.masses.begin(), scene.masses.end(),
                                   [&](const PointMass& m) { return m.key == "rigid." + body.name; });
    text += fmt::format("rigid body '{}': {} with its centre {} at ({}, {}) {}", body.name,
                        count(static_cast<long>(body.nodes.size()), "node moves", "nodes move"), body.centre,
                        number(centre.x), number(centre.y), scene.units.length);
    if (mass != scene.masses.end())
      text += fmt::format(", mass {} {}, inertia {} {} {}^2", number(mass->mass), scene.units.mass,
                          number(mass->inertia), scene.units.mass, scene.units.length);
    text += "\n";
  }
  return text;
}

/// Two lines per mesh.
std::string mesh_lines(const Scene& scene) {
  std::string text;
  const mesh::NodePosition place = [&](int n) {
    const Node& node = scene.nodes[static_cast<std::size_t>(n)];
    return mesh::PlanePoint{node.x, node.y};
  };
  for (const BodySpec& body : scene.bodies) {
    const mesh::MeshQuality q = mesh::measure_quality(body.mesh.elements, place);
    text += fmt::format("body '{}': {}, {}, plane {}\n", body.name,
                        count(static_cast<long>(body.node_count), "node", "nodes"),
                        count(static_cast<long>(body.mesh.elements.size()), "element", "elements"),
                        body.plane_strain ? "strain" : "stress");
    text += fmt::format(
        "      element angles from {:.3g} degrees (element {}) to {:.3g} degrees (element {}); largest edge "
        "ratio 1 : {:.3g} (element {})\n",
        q.min_angle.value, q.min_angle.element, q.max_angle.value, q.max_angle.element, q.aspect.value,
        q.aspect.element);
  }
  return text;
}

std::string contact_rows(const Model& model, const check::CheckReport& report) {
  if (report.contacts.empty()) return "";
  const std::string force = unit(model.units.force), length = unit(model.units.length);
  Table table({"contact", "law", "state", "gap" + length, "ut" + length, "reaction -N" + force, "T" + force,
               "limit f |N|" + force},
              {false, false, false, true, true, true, true, true});
  for (std::size_t k = 0; k < report.contacts.size() && k < max_table_rows; ++k) {
    const Contact& c = model.contacts[k];
    const ContactSample& s = report.contacts[k];
    const std::optional<double> gap = c.optional_gap(s.gap);
    table.row({c.name, c.law->name(), to_string(s.state), gap ? number(*gap) : "",
               above(s.ut, model.scales.displacement), above(-s.N, model.scales.force),
               above(s.T, model.scales.force),
               c.has_friction() ? number(contact::sticking_limit(c, s.N)) : ""});
  }
  return fmt::format("contacts at t = 0, {}:\n", model.statics.frictional ? "after a start with friction"
                                                 : model.static_start     ? "in static equilibrium"
                                                                          : "in the given initial state") +
         table.str() + more(report.contacts.size()) + "\n";
}

/// One line per spring with a preload.
std::string hanger_rows(const Model& model) {
  if (model.hangers.empty()) return "";
  const std::string force = unit(model.units.force);
  Table table({"spring", "preload" + force, "at t = 0" + force, "hot design" + force, "variability"},
              {false, true, true, true, true});
  for (const HangerLoad& h : model.hangers)
    table.row({fmt::format("{}", h.spring), number(h.cold), number(h.at_start), h.hot ? number(*h.hot) : "",
               h.at_start == 0.0 ? "-" : fmt::format("{:.3g} %", 100.0 * outputs::variability(h))});
  return "springs with a preload:\n" + table.str() + "\n";
}

std::string warning_lines(const check::CheckReport& report) {
  std::string text;
  for (const std::string& warning : report.warnings) text += "warning: " + warning + "\n\n";
  return text;
}

std::string free_motion_lines(const check::CheckReport& report) {
  if (report.free_motions.empty()) return "rigid-body motions that the closed contacts allow: none\n\n";
  std::string text = "rigid-body motions that the closed contacts allow without friction:\n";
  for (std::size_t i = 0; i < report.free_motions.size() && i < max_table_rows; ++i)
    text += "  " + report.free_motions[i] + "\n";
  return text + more(report.free_motions.size()) + "\n";
}

bool same(const modes::Frequencies& a, const modes::Frequencies& b) {
  if (a.free_motions != b.free_motions || a.unstable != b.unstable || a.modes.size() != b.modes.size())
    return false;
  for (std::size_t i = 0; i < a.modes.size(); ++i)
    if (std::abs(a.modes[i].omega - b.modes[i].omega) > 1e-9 * a.modes[i].omega) return false;
  return true;
}

void add_frequencies(Table& table, std::string label, const modes::Frequencies& f) {
  if (f.unstable > 0) {
    table.row({label, count(f.unstable, "unstable motion", "unstable motions"), "-", "-", ""});
    label.clear();
  }
  if (const int free = f.free_motions - f.unstable; free > 0) {
    table.row({label, count(free, "free motion", "free motions"), "0", "0", ""});
    label.clear();
  }
  for (std::size_t i = 0; i < f.modes.size(); ++i) {
    const modes::NaturalMode& mode = f.modes[i];
    table.row({label, fmt::format("{}", i + 1), number(mode.omega / (2.0 * std::numbers::pi)),
               number(mode.omega),
               mode.damping_ratio > 0.0 ? fmt::format("{:.3g}", mode.damping_ratio) : "0"});
    label.clear();
  }
  if (!label.empty()) table.row({label, "nothing can move", "", "", ""});
}

std::string frequency_rows(const Model& model, const check::CheckReport& report) {
  const Units& u = model.units;
  Table table(
      {"contacts", "mode", "f" + unit(frequency_unit(u)), "omega" + unit("rad/" + u.time), "damping ratio"},
      {false, true, true, true, true});
  if (model.contacts.empty()) {
    add_frequencies(table, "none", report.open);
  } else {
    const bool closing = !same(report.open, report.closed), sticking = !same(report.closed, report.stuck);
    add_frequencies(table,
                    closing    ? "all open"
                    : sticking ? "all open or sliding"
                               : "open or closed",
                    report.open);
    if (closing) add_frequencies(table, sticking ? "all closed, sliding" : "all closed", report.closed);
    if (sticking) add_frequencies(table, "all stuck", report.stuck);
  }
  std::string text = "lowest frequencies:\n" + table.str();
  text += model.omega1 > 0.0
              ? fmt::format(
                    "omega1 = {} rad/{}: the lowest circular frequency if all contacts that are closed at t "
                    "= 0 stick\n",
                    number(model.omega1), u.time)
              : std::string(
                    "no omega1: if all contacts that are closed at t = 0 stick, a motion is free, or nothing "
                    "can move\n");
  if (model.alpha == 0.0 && model.beta == 0.0) return text + "no Rayleigh damping\n\n";
  return text + fmt::format("damping C = alpha M + beta K, alpha = {} 1/{}, beta = {} {}\n\n",
                            number(model.alpha), u.time, number(model.beta), u.time);
}

std::string load_factor_lines(const check::CheckReport& report) {
  if (!report.load_factors) return "";
  const std::vector<double>& factors = *report.load_factors;
  std::string text = "buckling load factors (factors of the static loads; contacts as at the start): ";
  if (factors.empty()) return text + "none: no multiple of the static loads causes buckling\n\n";
  for (std::size_t i = 0; i < factors.size(); ++i) text += (i == 0 ? "" : ", ") + number(factors[i]);
  if (factors.front() < 0.0)
    return text +
           "; all are negative: no multiple of the static loads causes buckling, only loads of the other "
           "sign do\n\n";
  return text + (factors.front() > 1.0
                     ? "\n\n"
                     : "; a factor up to 1: the structure is unstable under its static loads\n\n");
}

std::string stiffness_rows(const Model& model, const check::CheckReport& report) {
  if (report.stiffness.empty()) return "";
  const std::string stiffness = unit(model.units.force + "/" + model.units.length);
  Table table({"contact", "direction", "contact stiffness" + stiffness, "structure" + stiffness, "ratio"},
              {false, false, true, true, true});
  for (std::size_t i = 0; i < report.stiffness.size() && i < max_table_rows; ++i) {
    const check::StiffnessRatio& s = report.stiffness[i];
    table.row({model.contacts[static_cast<std::size_t>(s.contact)].name, s.normal ? "normal" : "tangential",
               number(s.stiffness), s.rest > 0.0 ? fmt::format("{:.4g}", s.rest) : "0",
               s.rest > 0.0 ? fmt::format("{:.3g}", s.stiffness / s.rest) : "only this contact resists"});
  }
  return "stiffness of each contact, and of the structure at the contact if all other contacts stick\n"
         "(ratio far above 1: the contact is nearly rigid; far below 1: it is soft):\n" +
         table.str() + more(report.stiffness.size()) + "\n";
}

/// Adds rows for the breakpoints of one load, normal force or surface motion: one row per breakpoint; if there are more
/// than 12, a single row with the numbers of jumps and kinks.
void add_breakpoints(Table& table, const std::vector<check::Discontinuity>& all, const std::string& what) {
  constexpr std::size_t most_listed = 12;
  std::vector<const check::Discontinuity*> own;
  for (const check::Discontinuity& d : all)
    if (d.description == what) own.push_back(&d);
  if (own.size() <= most_listed) {
    for (const check::Discontinuity* d : own) table.row({number(d->t), d->jump ? "jump" : "kink", what});
    return;
  }
  const long jumps =
      std::count_if(own.begin(), own.end(), [](const check::Discontinuity* d) { return d->jump; });
  const long kinks = static_cast<long>(own.size()) - jumps;
  std::string kinds = jumps > 0 ? count(jumps, "jump", "jumps") : "";
  if (kinks > 0) kinds += (kinds.empty() ? "" : ", ") + count(kinks, "kink", "kinks");
  table.row({number(own.front()->t) + " to " + number(own.back()->t), kinds, what});
}

std::string load_rows(const Model& model, const check::CheckReport& report) {
  if (report.discontinuities.empty()) return "loads: smooth, no breakpoints\n\n";
  Table table({"t" + unit(model.units.time), "", "of"}, {true, false, false});
  std::vector<std::string> shown;
  for (const check::Discontinuity& d : report.discontinuities) {
    if (std::find(shown.begin(), shown.end(), d.description) != shown.end()) continue;
    shown.push_back(d.description);
    if (shown.size() <= max_table_rows) add_breakpoints(table, report.discontinuities, d.description);
  }
  return "breakpoints, where the integration stops and restarts:\n" + table.str() + more(shown.size()) + "\n";
}

std::string reduction_lines(const Model& model) {
  if (!model.reduction) return "";
  const Reduction& r = *model.reduction;
  const std::string per_time = "rad/" + model.units.time;
  std::string text = fmt::format("reduced: {} of {} modes kept, up to {} {}", r.modes,
                                 r.modes + r.truncated_modes, number(r.cutoff), per_time);
  if (r.free_modes > 0) text += fmt::format(", {} of them free motions", r.free_modes);
  text += r.highest_kept > 0.0
              ? fmt::format("; highest kept frequency {} {}", number(r.highest_kept), per_time)
              : std::string("; all kept modes are free motions");
  text += r.truncated_modes > 0
              ? fmt::format(", lowest omitted frequency {} {}\n", number(r.first_truncated), per_time)
              : std::string(", no modes omitted\n");
  text += fmt::format("         {} without mass", count(r.massless_shapes, "static shape", "static shapes"));
  if (r.massive_shapes > 0)
    text += fmt::format(", {} with mass and frequencies up to {} {}", r.massive_shapes,
                        number(r.highest_massive), per_time);
  text += fmt::format("; after jumps of loads the omitted modes would oscillate with an amplitude of {} {}\n",
                      number(r.ringing), model.units.length);
  const std::string give = unit(model.units.length + "/" + model.units.force);
  Table table({"static compliance", "all modes" + give, "omitted" + give, "share"},
              {false, true, true, true});
  for (std::size_t i = 0; i < r.shares.size() && i < max_table_rows; ++i) {
    const ComplianceShare& s = r.shares[i];
    table.row({s.label, number(s.compliance), number(s.residual),
               number(s.compliance > 0.0 ? s.residual / s.compliance : 0.0)});
  }
  return text + table.str() + more(r.shares.size()) + "\n";
}

std::string cost_lines(const Scene& scene, const Model& model, const check::CheckReport& report) {
  const Units& u = model.units;
  const Method& method = report.method;
  const bool steps = engine_info(method.engine).accuracy == Accuracy::step;
  std::string text =
      fmt::format("run: to t = {} {}, {}\n", number(scene.run.t_end), u.time,
                  count(static_cast<long>(report.rows), "row of history.csv", "rows of history.csv"));
  if (steps)
    text += fmt::format("     engine {}, dt {:g} {}\n", to_string(method.engine), method.accuracy, u.time);
  else
    text += fmt::format("     engine {}, rtol {:g}, order at most {} ({})\n", to_string(method.engine),
                        scene.run.rtol, method.max_order, method.max_order_reason);
  if (method.automatic) text += "     engine " + method.engine_reason() + "\n";
  const check::Cost& cost = report.cost;
  text += fmt::format("cost: {} variables in the time integration, highest frequency {:.4g} rad/{}\n",
                      cost.unknowns, cost.omega_max, u.time);
  const run::CostEstimate& effort = cost.estimate;
  const std::string measured =
      cost.trials.empty() ? ""
                          : fmt::format("expected run time, from the first steps of each engine: {}\n",
                                        run::trial_text(cost.trials));
  std::string exact =
      cost.exact && cost.trials.empty()
          ? fmt::format("      exact would take {} s (--engine exact)\n", run::seconds_text(*cost.exact))
          : "";
  if (!method.flow.empty()) {
    exact += fmt::format("      flow {} ({}): estimated {} s by series", method.flow, method.flow_reason,
                         run::seconds_text(effort.by_series));
    exact += effort.by_modes > 0.0 ? fmt::format(", in modes {} s", run::seconds_text(effort.by_modes)) : "";
    exact += " (rule of thumb)\n";
  }
  if (!(effort.steps > 0.0))
    return text + "      the number of steps cannot be estimated\n" + exact + measured;
  const std::string time = effort.seconds < 0.1 ? "less than 0.1 s" : "about " + rough(effort.seconds) + " s";
  if (steps)
    return text +
           fmt::format("      {:.3g} steps per period of the highest frequency; {} steps, {}\n",
                       effort.steps_per_period, rough(effort.steps), time) +
           measured;
  return text +
         fmt::format(
             "      estimate: {:.0f} steps per period of the highest frequency, thus {} steps, {},\n      "
             "and about 30 steps more for each event; this estimate is too high if the highest modes are not "
             "excited\n",
             effort.steps_per_period, rough(effort.steps), time) +
         exact + measured;
}

}  // namespace

std::string check_text(const Scene& scene, const Model& model, const check::CheckReport& report) {
  return head(scene, model, report) + body_lines(scene) + mesh_lines(scene) + "\n" +
         contact_rows(model, report) + hanger_rows(model) + warning_lines(report) +
         free_motion_lines(report) + frequency_rows(model, report) + load_factor_lines(report) +
         stiffness_rows(model, report) + load_rows(model, report) + reduction_lines(model) +
         cost_lines(scene, model, report);
}

std::string column_text(const Model& model) {
  Table table({"", ""}, {false, false});
  table.row({"t", model.units.time});
  for (const Column& column : model.columns) table.row({column.name, model.unit_of(column)});
  return "\ncolumns of history.csv:" + table.str();
}

namespace {

struct CheckOptions {
  std::string scene, engine, reduction;
  std::vector<std::string> settings;
  bool json = false, columns = false;
};

/// Parses cutoff frequencies such as "50,100", in cycles per time.
std::vector<double> cutoffs_of(const std::string& text) {
  std::vector<double> list;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<double> value = base::parse_number(word);
    if (!value || !(*value > 0.0))
      throw UsageError(
          fmt::format("--reduction: found \"{}\", expected frequencies > 0, such as 50,100", word));
    list.push_back(*value);
  }
  return list;
}

ExitCode check_scene(const CheckOptions& options) {
  std::vector<Override> changes = overrides_of(options.settings);
  if (!options.engine.empty()) changes.push_back(engine_override(options.engine, "--engine"));
  const Scene scene = read_scene(options.scene, changes);
  const Model model = build_model(scene);
  print_patterns(options.scene, options.settings);
  check::CheckReport report = check::check(scene, model);
  check::measure_cost(scene, model, cutoffs_of(options.reduction), report);
  if (options.json) {
    print(check::check_json(scene, model, report));
    return ExitCode::done;
  }
  print(check_text(scene, model, report));
  if (options.columns) print(column_text(model));
  return ExitCode::done;
}

}  // namespace

void add_check(Program& program) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = program.app.add_subcommand(
      "check", "read a scene and compute its initial state: mass, reactions, frequencies, expected cost");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command->add_option("--engine", options->engine, "time integration, instead of the scene's run.engine")
      ->option_text("NAME");
  command
      ->add_option("--reduction", options->reduction,
                   "also try these cutoff frequencies of [reduction], in cycles per time")
      ->option_text("F,...");
  add_settings(*command, options->settings);
  command->add_flag("--columns", options->columns, "also list the columns of history.csv");
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback([&program, options] { program.action = [options] { return check_scene(*options); }; });
}

}  // namespace signorini::cli
