// signorini sensitivity: derivatives of event times, peaks and columns with respect to keys of a scene.

#include "cli/sensitivity_fit.hpp"

#include <fmt/core.h>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"
#include "result/run_tables.hpp"
#include "signorini/error.hpp"
#include "study/optional_values.hpp"
#include "study/sensitivity/sensitivity_files.hpp"
#include "study/sensitivity/sensitivity_plots.hpp"

namespace signorini::cli {

std::filesystem::path directory_of(const KeyedOptions& options, const std::string& ending) {
  if (!options.directory) return std::filesystem::path(options.scene).stem().string() + ending;
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

void add_scene(CLI::App& command, KeyedOptions& options) {
  command.add_option("SCENE", options.scene, "the scene file (TOML)")->required();
}

void add_keyed_options(CLI::App& command, KeyedOptions& options, const std::string& what,
                       const std::string& results, const std::string& ending, const std::string& json) {
  command.add_option("--parameter", options.parameters, what + " (may be repeated)")
      ->option_text("PATH")
      ->allow_extra_args(false);
  command
      .add_option("-o,--output", options.directory,
                  "directory of the results (default: SCENE's name with " + ending + ")")
      ->option_text("DIR");
  add_settings(command, options.settings);
  command.add_flag("--force", options.force, "replace " + results + " in the directory");
  command.add_flag("--quiet", options.quiet, "print errors only");
  command.add_flag("--json", options.json, "print " + json + " instead of tables");
}

namespace {

namespace fs = std::filesystem;

struct SensitivityOptions : KeyedOptions {
  std::vector<std::string> sigmas;
  bool losses = false, discrete = false;
};

/// The folder of sensitivities. The list of files includes "columns-1.csv" and so on for many parameters.
const ResultFolder& sensitivity_folder() {
  static const ResultFolder folder = [] {
    ResultFolder f{"sensitivities",
                   "sensitivity.json",
                   {"events.csv", "sensitivities.csv", "figures.csv", "landings.csv", "sequence.csv",
                    "spread.csv", "report.html"}};
    constexpr int most_parameters = 1000;
    for (int p = 1; p <= most_parameters; ++p) f.files.push_back(fmt::format("columns-{}.csv", p));
    return f;
  }();
  return folder;
}

/// Recorder that stops the computation on an interrupt.
class Stoppable : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return !Interrupt::requested(); }
};

/// Adds the parameters of --sigma to `paths`, and returns one sigma per parameter; 0: not given. Empty without --sigma.
sensitivity_study::Sigmas read_sigmas(const SensitivityOptions& options, std::vector<std::string>& paths) {
  sensitivity_study::Sigmas sigmas(paths.size(), 0.0);
  for (const std::string& text : options.sigmas) {
    const std::size_t equals = text.find('=');
    const auto value =
        equals == std::string::npos ? std::nullopt : base::parse_number(text.substr(equals + 1));
    if (equals == 0 || !value || !(*value >= 0.0) || !std::isfinite(*value))
      throw UsageError(
          fmt::format("--sigma {}: expected path=value, with a standard deviation >= 0 as value", text));
    const std::string path = text.substr(0, equals);
    auto place = std::find(paths.begin(), paths.end(), path);
    if (place == paths.end()) {
      paths.push_back(path);
      sigmas.push_back(0.0);
      place = paths.end() - 1;
    }
    sigmas[static_cast<std::size_t>(place - paths.begin())] = *value;
  }
  return options.sigmas.empty() ? sensitivity_study::Sigmas{} : sigmas;
}

std::string shown_rate(double x) { return std::isfinite(x) ? number(x) : "-"; }

/// Table of the derivatives of the first event times.
std::string first_events(const Sensitivities& s) {
  constexpr std::size_t most_events = 6, most_keys = 4;
  const std::size_t keys = std::min(s.parameters.size(), most_keys);
  std::vector<std::string> header{"event", "t [" + s.units.time + "]", "contact", "what"};
  for (std::size_t p = 0; p < keys; ++p) header.push_back("dt/d " + s.parameters[p].path);
  std::vector<bool> right(header.size(), true);
  right[2] = right[3] = false;
  Table table(std::move(header), std::move(right));
  std::size_t shown = 0;
  for (std::size_t i = 0; i < s.events.size() && shown < most_events; ++i) {
    if (s.events[i].contact < 0) continue;
    std::vector<std::string> cells{std::to_string(i + 1), fmt::format("{:.9g}", s.events[i].t),
                                   sensitivity_study::contact_of(s, s.events[i]),
                                   to_string(s.events[i].type)};
    for (std::size_t p = 0; p < keys; ++p) cells.push_back(shown_rate(s.event_rates[i][p].t));
    table.row(std::move(cells));
    ++shown;
  }
  if (shown == 0) return "";
  if (shown < s.events.size())
    table.line(fmt::format("all {} events are in sensitivities.csv", s.events.size()));
  return table.str() + "\n";
}

void add_parameter(const Sensitivities& s, std::size_t p, Table& table) {
  std::size_t most = s.events.size();
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    const double rate = std::abs(s.event_rates[i][p].t);
    if (std::isfinite(rate) && (most == s.events.size() || rate > std::abs(s.event_rates[most][p].t)))
      most = i;
  }
  const std::string path = study::key_with_unit(s.parameters[p].path, s.units);
  if (most < s.events.size()) {
    const Event& event = s.events[most];
    const double rate = s.event_rates[most][p].t;
    table.row({path, fmt::format("t of event {}", most + 1), sensitivity_study::contact_of(s, event),
               number(event.t), s.units.time, shown_rate(rate),
               shown_rate(sensitivity_study::elasticity(s.parameters[p].value, event.t, rate))});
  }
  for (const Response& r : s.responses)
    table.row({path, r.name, sensitivity_study::contact_of(s, r), number(r.value),
               sensitivity_study::unit_of(r, s.units), shown_rate(r.rates[p]),
               shown_rate(sensitivity_study::elasticity(s.parameters[p].value, r.value, r.rates[p]))});
}

std::string swap_text(const Sensitivities& s) {
  std::string text;
  for (const SequenceChange& swap : smallest_sequence_changes(s))
    text += fmt::format("{0}: events {1} and {2} coincide, to first order, if {0} = {3} (change {4}{5})\n",
                        s.parameters[swap.parameter].path, swap.first + 1, swap.second + 1,
                        number(s.parameters[swap.parameter].value + swap.change),
                        swap.change > 0.0 ? "+" : "", number(swap.change));
  return text;
}

std::string summary_of(const Sensitivities& s, const sensitivity_study::Sigmas& sigmas) {
  Table table({"parameter p", "x", "contact", "value", "unit", "dx/dp", "p/x dx/dp"},
              {false, false, false, true, false, true, true});
  for (std::size_t p = 0; p < s.parameters.size(); ++p) add_parameter(s, p, table);
  std::string text = first_events(s) + table.str() + "\n" + swap_text(s);
  for (const Parameter& parameter : s.parameters)
    if (!parameter.reason.empty())
      text += fmt::format("{}: derivatives end at t = {}: {}\n", parameter.path, number(parameter.until),
                          parameter.reason);
  if (sigmas.empty()) return text;
  const sensitivity_study::Spread spreads = sensitivity_study::spread(s, sigmas);
  Table figures({"x", "contact", "value", "sigma", "unit"}, {false, false, true, true, false});
  for (std::size_t i = 0; i < s.responses.size(); ++i)
    figures.row({s.responses[i].name, sensitivity_study::contact_of(s, s.responses[i]),
                 number(s.responses[i].value), shown_rate(spreads.responses[i]),
                 sensitivity_study::unit_of(s.responses[i], s.units)});
  text += "\n" + figures.str() + "\n";
  for (std::size_t p = 0; p < sigmas.size(); ++p)
    if (sigmas[p] > 0.0)
      text += fmt::format("{}: the sequence of events is the same, to first order, up to {:.2g} sigma\n",
                          s.parameters[p].path, spreads.reach[p]);
  return text;
}

/// One line about the engine and the method of the derivatives.
std::string method_of(const Sensitivities& s) {
  const Method& method = s.report.method;
  std::string text = fmt::format("engine {}", to_string(method.engine));
  if (!method.flow.empty()) text += fmt::format(", flow {}", method.flow);
  const Stretches& n = s.stretches;
  text += fmt::format("; derivatives over {} intervals by modes, {} by series", n.modes, n.series);
  if (n.followed > 0) text += fmt::format("; {} recomputed from event to event", n.followed);
  if (n.correction > 0.0)
    text += fmt::format(", event times differ from those of the engine by at most {:.2g}", n.correction);
  if (n.taken > 0) text += fmt::format(", {} times restarted from the engine's state", n.taken);
  return text + fmt::format(", {:.2f} s\n", s.report.wall_time);
}

ExitCode code_of(const Outcome& outcome) {
  switch (outcome.kind) {
    case Outcome::Kind::done:
      return ExitCode::done;
    case Outcome::Kind::stopped:
      return ExitCode::stopped;
    case Outcome::Kind::interrupted:
      return ExitCode::interrupted;
  }
  return ExitCode::bug;
}

void write_events(const fs::path& path, const Model& model, const Sensitivities& s) {
  result::write_file(path / "events.csv", result::event_table(model).text(s.events));
}

ExitCode run(const SensitivityOptions& options) {
  const std::vector<Override> changes = overrides_of(options.settings);
  std::vector<std::string> paths = options.parameters;
  const sensitivity_study::Sigmas sigmas = read_sigmas(options, paths);
  if (paths.empty()) throw UsageError("expected --parameter PATH or --sigma PATH=VALUE");
  const fs::path path = directory_of(options, "-sensitivity");
  check_folder(path, sensitivity_folder(), options.force, options.scene);
  const SceneReader read = reader_of(options.scene, changes);
  if (!options.quiet) {
    print_patterns(options.scene, options.settings);
    print_patterns(options.scene, options.settings, "--parameter", options.parameters);
    print_patterns(options.scene, options.settings, "--sigma", options.sigmas);
  }
  std::optional<Interrupt> interrupt(std::in_place);
  Stoppable recorder;
  const Sensitivities s = sensitivities(read, paths, &recorder, {options.losses, options.discrete});
  interrupt.reset();
  begin_folder(path, sensitivity_folder());
  sensitivity_study::remove_sensitivity_plots(path);
  write_events(path, build_model(read({})), s);
  sensitivity_study::write_sensitivities(path, s, sigmas);
  const std::string json = sensitivity_study::sensitivity_json(s, sigmas);
  result::write_file(path / "sensitivity.json", json);
  const std::string drawn =
      options.no_plots ? ""
                       : draw_pictures(path, sensitivity_study::sensitivity_pictures(s, sigmas).write(path));
  if (options.json) print(json);
  if (options.tables()) {
    if (!s.title.empty()) print(s.title + "\n\n");
    print(summary_of(s, sigmas) + method_of(s) + "results: " + path.string() +
          "/ (sensitivities.csv, figures.csv, columns-1.csv)\n" + drawn);
  }
  print_warnings(options, s.report.warnings);
  if (s.report.outcome.kind != Outcome::Kind::done) print_error("stopped: " + s.report.outcome.reason);
  return code_of(s.report.outcome);
}

}  // namespace

void add_sensitivity(Program& program) {
  auto options = std::make_shared<SensitivityOptions>();
  CLI::App* command = program.app.add_subcommand(
      "sensitivity", "compute derivatives of event times, peaks and columns with respect to keys of a scene");
  add_scene(*command, *options);
  add_keyed_options(
      *command, *options,
      "key of the scene for derivatives with respect to its value: contacts.*.friction, loads.1.amplitude",
      "earlier sensitivities", "-sensitivity", "sensitivity.json");
  command->add_flag("--no-plots", options->no_plots, "do not write pictures or gnuplot scripts");
  command->add_flag("--losses", options->losses,
                    "also compute derivatives of energies, works, losses and landings; costs as much as two "
                    "or three more runs with run.flow = taylor");
  command->add_flag(
      "--discrete", options->discrete,
      "with engine newmark: derivatives of the discrete solution instead of the continuous motion");
  command
      ->add_option("--sigma", options->sigmas,
                   "standard deviation of a key; the output then has standard deviations of times and "
                   "results (may be repeated)")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
  command->callback([&program, options] { program.action = [options] { return run(*options); }; });
}

// signorini fit: fits keys of a scene to measured event times or columns.

namespace {

namespace fs = std::filesystem;

struct FitOptions : KeyedOptions {
  std::string data;
};

const ResultFolder& fit_folder() {
  static const ResultFolder folder = {"fit", "fit.json", {"residuals.csv", "report.html"}};
  return folder;
}

std::string text_of(const Fit& fit, const Measurements& measured) {
  Table table({"key", "start", "fitted", "sigma"}, {false, true, true, true});
  for (const FittedKey& key : fit.keys)
    table.row({key.path, number(key.start), std::isfinite(key.value) ? fmt::format("{:.9g}", key.value) : "-",
               std::isfinite(key.sigma) ? number(key.sigma) : "-"});
  return table.str() +
         fmt::format("\n{} measured numbers, {} steps, {} runs: {}; {} {}\n", measured.rows.size(),
                     fit.iterations, fit.runs, fit.reason,
                     measured.has_sigma ? "chi squared" : "sum of squares", number(fit.chi_squared)) +
         (std::isfinite(fit.probability)
              ? fmt::format(
                    "{} degrees of freedom; the probability of such a large value by chance is {:.2g}\n",
                    fit.freedom, fit.probability)
              : "");
}

/// Runs the fit; the error about an unknown column names the file of measurements.
Fit fitted(const FitOptions& options, const Measurements& measured) {
  try {
    return fit(reader_of(options.scene, overrides_of(options.settings)), options.parameters, measured,
               [] { return !Interrupt::requested(); });
  } catch (const UsageError& error) {
    const std::string message = error.what();
    if (!message.starts_with("the run has no column")) throw;
    throw Error(ExitCode::scene, options.data + ":1: " + message);
  }
}

ExitCode run_fit(const FitOptions& options) {
  if (options.parameters.empty()) throw UsageError("expected --parameter PATH");
  const fs::path path = directory_of(options, "-fit");
  check_folder(path, fit_folder(), options.force, options.scene);
  const Measurements measured = read_measurements(options.data);
  if (!options.quiet) {
    print_patterns(options.scene, options.settings);
    print_patterns(options.scene, options.settings, "--parameter", options.parameters);
  }
  std::optional<Interrupt> interrupt(std::in_place);
  const Fit result = fitted(options, measured);
  const bool interrupted = Interrupt::requested();
  interrupt.reset();
  begin_folder(path, fit_folder());
  sensitivity_study::write_fit(path, result, measured);
  if (options.json) print(sensitivity_study::fit_json(result, measured));
  if (options.tables())
    print(text_of(result, measured) + "results: " + path.string() + "/ (fit.json, residuals.csv)\n");
  if (interrupted) {
    print_error("interrupted; the values so far are kept in " + path.string());
    return ExitCode::interrupted;
  }
  for (const std::string& doubt : result.issues) print_error("the fit has not converged: " + doubt);
  return result.converged ? ExitCode::done : ExitCode::stopped;
}

}  // namespace

void add_fit(Program& program) {
  auto options = std::make_shared<FitOptions>();
  CLI::App* command =
      program.app.add_subcommand("fit", "fit values of keys to measured event times or columns");
  add_scene(*command, *options);
  command
      ->add_option("DATA", options->data,
                   "CSV with t and event_index (optionally also contact and event), or with t and columns of "
                   "history.csv, or with both; optional: sigma")
      ->required();
  add_keyed_options(*command, *options, "a key of the scene to find", "an earlier fit", "-fit", "fit.json");
  command->callback([&program, options] { program.action = [options] { return run_fit(*options); }; });
}

}  // namespace signorini::cli
