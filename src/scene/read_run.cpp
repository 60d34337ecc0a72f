// [run]: duration, accuracy and output times.

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/text.hpp"
#include "scene/readers.hpp"
#include "signorini/engine.hpp"

namespace signorini::scene {
namespace {

constexpr double most_output_rows = 1e8;

void check_times(const Table& table, std::string_view key, const std::vector<double>& times, double t_end) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < 0.0 || times[i] > t_end) {
      table.fail(key, fmt::format("found {}, expected times from 0 to t_end = {}",
                                  base::format_number(times[i]), base::format_number(t_end)));
    }
    if (i > 0 && times[i] <= times[i - 1]) {
      table.fail(key, fmt::format("found {} after {}, expected strictly ascending times",
                                  base::format_number(times[i]), base::format_number(times[i - 1])));
    }
  }
}

void read_output(Table& table, RunSpec& run) {
  if (table.has("output_dt") && table.has("output_times")) {
    table.fail("output_times", "cannot be combined with output_dt; give only one of them");
  }
  run.output_times = table.numbers("output_times");
  run.output_dt = table.optional_number("output_dt");
  if (!run.output_times && !run.output_dt) {
    run.output_dt = run.t_end / 1000.0;
    table.record("output_dt", toml_number(*run.output_dt));
  }
  if (run.output_dt && !(run.t_end / *run.output_dt <= most_output_rows)) {
    table.fail("output_dt", fmt::format("found the number {}, which gives more than 1e8 rows up to t_end = "
                                        "{}; expected a longer interval",
                                        base::format_number(*run.output_dt), base::format_number(run.t_end)));
  }
  if (run.output_times) check_times(table, "output_times", *run.output_times, run.t_end);
}

void read_frames(Table& table, RunSpec& run, bool matrices) {
  if (matrices && table.has("frames")) {
    table.fail("frames", "has no meaning with [matrices], because matrices define no shape");
  }
  run.frames = table.numbers("frames").value_or(std::vector<double>{});
  check_times(table, "frames", run.frames, run.t_end);
}

void read_tolerances(Table& table, RunSpec& run) {
  run.rtol = table.number("rtol");
  Table atol = table.child("atol");
  run.atol.displacement = atol.optional_number("displacement");
  run.atol.velocity = atol.optional_number("velocity");
  run.atol.force = atol.optional_number("force");
  atol.finish();
  // Default tolerances depend on the scales of the assembled structure, so they are not recorded here.
  if (table.has("atol")) table.record("atol", atol.record().inline_table());
}

void read_max_order(Table& table, RunSpec& run) {
  const toml::node* node = table.raw("max_order");
  const std::string expected = "\"auto\" or an integer from 1 to 5";
  if (!node || node->value<std::string>() == "auto") {
    table.record("max_order", "\"auto\"");
    return;
  }
  if (!node->is_integer()) table.wrong("max_order", expected);
  const int order = table.integer("max_order");
  if (order < 1 || order > 5) table.wrong("max_order", expected);
  run.max_order = order;
}

void read_certification(Table& table, RunSpec& run) {
  const toml::node* node = table.raw("certify");
  if (!node || node->value<std::string>() == "auto") {
    table.record("certify", "\"auto\"");
  } else {
    if (!node->is_boolean()) table.wrong("certify", "\"auto\", true or false");
    const bool wanted = node->value_or(false);
    run.certify = wanted ? Certify::yes : Certify::no;
    table.record("certify", wanted ? "true" : "false");
  }
  const std::string companion = table.choice("companion");
  run.companion = companion == "exact"   ? Companion::exact
                  : companion == "finer" ? Companion::finer
                                         : Companion::automatic;
}

/// Reads the keys of engines that have a time step.
void read_steps(Table& table, RunSpec& run) {
  const EngineInfo* engine = run.engine == Engine::automatic ? nullptr : &engine_info(run.engine);
  const bool steps = engine != nullptr && engine->accuracy == Accuracy::step;
  if (steps) table.require("dt", fmt::format(" (required for engine \"{}\")", engine->name));
  run.dt = table.optional_number("dt");
  run.refine = table.choice("refine") == "linear" ? Refine::linear : Refine::root;
  run.step = table.choice("step") == "doubling" ? StepControl::doubling : StepControl::fixed;
  if (run.step == StepControl::doubling && steps && !has_key(*engine, "step"))
    table.fail("step",
               fmt::format("found \"doubling\", which engine \"{}\" does not support; expected \"fixed\"",
                           engine->name));
  run.relaxation = table.number("relaxation");
  if (run.relaxation > 1.0)
    table.fail("relaxation",
               fmt::format("found the number {}, expected at most 1", base::format_number(run.relaxation)));
  run.max_iterations = table.integer("max_iterations");
}

}  // namespace

void read_run(Table& top, Scene& scene, ResolvedScene& record) {
  top.require("run", "");
  Table table = top.child("run");
  RunSpec& run = scene.run;
  run.place = table.place();
  run.t_end = table.number("t_end");
  read_initial(table, scene);
  run.engine = find_engine(table.choice("engine")).value_or(Engine::automatic);
  const std::string flow = table.choice("flow");
  run.flow = flow == "modal" ? Flow::modal : flow == "taylor" ? Flow::taylor : Flow::automatic;
  run.geometric = table.flag("geometric");
  run.geometric_place = table.place("geometric");
  if (run.geometric && scene.matrices)
    table.fail("geometric",
               "has no effect with [matrices]: remove it, and add the geometric stiffness of the static "
               "forces to matrices.stiffness");
  read_tolerances(table, run);
  read_output(table, run);
  read_frames(table, run, scene.matrices.has_value());
  read_max_order(table, run);
  run.max_events_at_once = table.integer("max_events_at_once");
  read_certification(table, run);
  read_steps(table, run);
  table.finish();
  record.add("run", "[run]", table.record());
}

}  // namespace signorini::scene

namespace signorini {

std::vector<double> RunSpec::grid() const {
  std::vector<double> times;
  if (output_times) {
    times = *output_times;
    if (times.empty() || times.back() < t_end) times.push_back(t_end);
    return times;
  }
  const double dt_out = output_dt.value_or(t_end / 1000.0);
  if (!(t_end / dt_out <= scene::most_output_rows))
    throw SceneError(place, "run.output_dt",
                     "gives more than 1e8 rows up to t_end; expected a longer interval");
  // Row k has the time k dt, a product and not a sum, so that rounding errors do not accumulate. If the last product equals
  // t_end up to rounding, the last time is t_end.
  times.reserve(static_cast<std::size_t>(t_end / dt_out) + 2);
  for (long k = 0; static_cast<double>(k) * dt_out < t_end - 1e-6 * dt_out; ++k) {
    times.push_back(static_cast<double>(k) * dt_out);
  }
  times.push_back(t_end);
  return times;
}

}  // namespace signorini

namespace signorini::scene {

// [reduction]: the cutoff in cycles or in radians per time, or the tolerance from which the program finds the cutoff.

void read_reduction(Table& top, Scene& scene, ResolvedScene& record) {
  if (!top.has("reduction")) return;
  Table table = top.child("reduction");
  if (table.has("cutoff_frequency") && table.has("cutoff_omega"))
    table.fail("cutoff_frequency", "cannot be combined with cutoff_omega; give only one of them");
  ReductionSpec spec;
  spec.place = table.place();
  for (const char* cutoff : {"cutoff_frequency", "cutoff_omega"})
    if (table.has("tolerance") && table.has(cutoff))
      table.fail("tolerance", std::string("cannot be combined with ") + cutoff + "; give only one of them");
  if (const auto tolerance = table.optional_number("tolerance")) {
    spec.tolerance = *tolerance;
  } else if (const auto frequency = table.optional_number("cutoff_frequency")) {
    spec.cutoff_omega = 2.0 * std::numbers::pi * *frequency;
  } else {
    table.require("cutoff_omega", " (give one of cutoff_omega, cutoff_frequency and tolerance)");
    spec.cutoff_omega = *table.optional_number("cutoff_omega");
  }
  table.finish();
  scene.reduction = spec;
  record.add("reduction", "[reduction]", table.record());
}

// Units are given by name. The reader checks that unit of force = unit of mass * unit of length / (unit of time)^2.

namespace {

double si_factor(const std::string& unit) {
  static const std::map<std::string, double> factors = {{"N", 1.0},   {"kN", 1e3}, {"MN", 1e6},
                                                        {"kg", 1.0},  {"t", 1e3},  {"m", 1.0},
                                                        {"mm", 1e-3}, {"s", 1.0},  {"ms", 1e-3}};
  return factors.at(unit);
}

bool same(double a, double b) { return std::abs(a - b) < 1e-9 * std::abs(b); }

}  // namespace

void read_units(Table& top, Scene& scene, ResolvedScene& record) {
  top.require("units", "");
  Table table = top.child("units");
  Units& units = scene.units;
  units.force = table.choice("force");
  units.mass = table.choice("mass");
  units.length = table.choice("length");
  units.time = table.choice("time");

  const double time = si_factor(units.time);
  const double fitting = si_factor(units.mass) * si_factor(units.length) / (time * time);
  if (!same(si_factor(units.force), fitting)) {
    const std::string product = fmt::format("{} {}/{}^2", units.mass, units.length, units.time);
    std::string answer = "none of the units of force (N, kN, MN)";
    for (const std::string name : {"N", "kN", "MN"}) {
      if (same(si_factor(name), fitting)) answer = "\"" + name + "\"";
    }
    table.fail("force", fmt::format("found \"{}\", expected mass * length / time^2: {} is {}", units.force,
                                    product, answer));
  }
  table.finish();
  record.top.set("units", table.record().inline_table());
}

}  // namespace signorini::scene

namespace signorini {

std::string_view to_string(Engine engine) {
  return engine == Engine::automatic ? "auto" : engine_info(engine).name;
}

const EngineInfo& engine_info(Engine engine) {
  return *std::find_if(all_engines.begin(), all_engines.end(),
                       [&](const EngineInfo& e) { return e.engine == engine; });
}

std::optional<Engine> find_engine(std::string_view name) {
  for (const EngineInfo& e : all_engines)
    if (e.name == name) return e.engine;
  return std::nullopt;
}

bool has_key(const EngineInfo& engine, std::string_view key) {
  std::string_view rest = engine.specific_keys;
  while (!rest.empty()) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, blank) == key) return true;
    rest.remove_prefix(std::min(blank + 1, rest.size()));
  }
  return false;
}

std::string_view accuracy_key(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::tolerance:
      return "run.rtol";
    case Accuracy::step:
      return "run.dt";
    case Accuracy::rounding:
      break;
  }
  return "";
}

}  // namespace signorini
