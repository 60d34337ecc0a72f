// signorini fit: keys of a scene from measured event times or columns.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/owned_folder.hpp"
#include "cli/settings.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "signorini/error.hpp"
#include "study/sensitivity/fit_files.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct FitOptions : OutputOptions {
  std::string scene, data;
  std::optional<std::string> directory;
  std::vector<std::string> parameters, settings;
};

const OwnedFolder& fit_folder() {
  static const OwnedFolder folder = {"fit", "fit.json", {"residuals.csv", "report.html"}};
  return folder;
}

fs::path folder_of(const FitOptions& options) {
  if (!options.directory) return fs::path(options.scene).stem().string() + "-fit";
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

std::string text_of(const Fit& fit, const Measurements& measured) {
  Table table({"key", "start", "fitted", "sigma"}, {false, true, true, true});
  for (const FittedKey& key : fit.keys)
    table.row({key.path, number(key.start), fmt::format("{:.9g}", key.value), number(key.sigma)});
  return table.str() + fmt::format("\n{} numbers, {} steps, {} runs: {}; {} {}\n", measured.rows.size(),
                                   fit.iterations, fit.runs, fit.reason,
                                   measured.has_sigma ? "chi squared" : "sum of squares",
                                   number(fit.chi_squared));
}

ExitCode run_fit(const FitOptions& options) {
  if (options.parameters.empty()) throw UsageError("expected --parameter PATH");
  const fs::path path = folder_of(options);
  check_folder(path, fit_folder(), options.force, options.scene);
  const Measurements measured = read_measurements(options.data);
  std::optional<Interrupt> interrupt(std::in_place);
  const Fit result = fit(reader_of(options.scene, overrides_of(options.settings)), options.parameters,
                         measured, [] { return !Interrupt::asked(); });
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
  if (!result.converged) print_error("the fit has not settled: " + result.reason);
  return result.converged ? ExitCode::done : ExitCode::stopped;
}

}  // namespace

void add_fit(Program& program) {
  auto options = std::make_shared<FitOptions>();
  CLI::App* command =
      program.app.add_subcommand("fit", "find keys of a scene from measured event times or columns");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command->add_option("DATA", options->data, "event_index,t[,sigma] or t,COLUMN,...[,sigma] (CSV)")
      ->required();
  command->add_option("--parameter", options->parameters, "a key of the scene to find (may be repeated)")
      ->option_text("PATH")
      ->allow_extra_args(false);
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the results (default: SCENE's name with -fit)")
      ->option_text("DIR");
  add_settings(*command, options->settings);
  command->add_flag("--force", options->force, "replace an earlier fit in the directory");
  command->add_flag("--quiet", options->quiet, "print errors only");
  command->add_flag("--json", options->json, "print fit.json instead of tables");
  command->callback([&program, options] { program.action = [options] { return run_fit(*options); }; });
}

}  // namespace signorini::cli
