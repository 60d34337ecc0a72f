// signorini fit: fits keys of a scene to measured event times or columns.
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/keyed.hpp"
#include "cli/owned_folder.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "signorini/error.hpp"
#include "study/sensitivity/fit_files.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct FitOptions : KeyedOptions {
  std::string data;
};

const OwnedFolder& fit_folder() {
  static const OwnedFolder folder = {"fit", "fit.json", {"residuals.csv", "report.html"}};
  return folder;
}

std::string text_of(const Fit& fit, const Measurements& measured) {
  Table table({"key", "start", "fitted", "sigma"}, {false, true, true, true});
  for (const FittedKey& key : fit.keys)
    table.row({key.path, number(key.start), std::isfinite(key.value) ? fmt::format("{:.9g}", key.value) : "-",
               std::isfinite(key.sigma) ? number(key.sigma) : "-"});
  return table.str() +
         fmt::format("\n{} numbers, {} steps, {} runs: {}; {} {}\n", measured.rows.size(), fit.iterations,
                     fit.runs, fit.reason, measured.has_sigma ? "chi squared" : "sum of squares",
                     number(fit.chi_squared)) +
         (std::isfinite(fit.probability)
              ? fmt::format("{} degrees of freedom, as great by chance with a probability of {:.2g}\n",
                            fit.freedom, fit.probability)
              : "");
}

/// An error for an unknown column names the file that contains it.
Fit fitted(const FitOptions& options, const Measurements& measured) {
  try {
    return fit(reader_of(options.scene, overrides_of(options.settings)), options.parameters, measured,
               [] { return !Interrupt::asked(); });
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
  const bool interrupted = Interrupt::asked();
  interrupt.reset();
  begin_folder(path, fit_folder());
  write_fit(path, result, measured);
  if (options.json) print(fit_json(result, measured));
  if (options.tables())
    print(text_of(result, measured) + "results: " + path.string() + "/ (fit.json, residuals.csv)\n");
  if (interrupted) {
    print_error("interrupted; what was found is kept in " + path.string());
    return ExitCode::interrupted;
  }
  for (const std::string& doubt : result.doubts) print_error("the fit has not converged: " + doubt);
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
                   "CSV with t and event_index (optional with it: contact, event) or columns of history.csv, "
                   "or both; optional: sigma")
      ->required();
  add_keyed_options(*command, *options, "a key of the scene to find", "an earlier fit", "-fit", "fit.json");
  command->callback([&program, options] { program.action = [options] { return run_fit(*options); }; });
}

}  // namespace signorini::cli
