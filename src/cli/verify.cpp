// signorini verify: compares engine ida with engine newmark at three time steps, and reports whether they agree.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "signorini/error.hpp"
#include "study/prepared_run.hpp"
#include "study/verify/verify_files.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct VerifyOptions : OutputOptions {
  std::string scene;
  std::optional<std::string> directory;
  std::vector<std::string> settings;
};

const ResultFolder& verify_folder() {
  static const ResultFolder folder = {"verification", "verify.json", {"events.csv", "report.html"}};
  return folder;
}

fs::path directory_of(const VerifyOptions& options) {
  if (!options.directory) return fs::path(options.scene).stem().string() + "-verify";
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

std::string two_digits(double value) { return fmt::format("{:.2g}", value); }

std::string text_of(const verify::Verification& result) {
  Table table(
      {"quantity", "number", "order", "largest error bar", "largest difference", "allowed", "unit", "at t"},
      {false, true, true, true, true, true, false, true});
  for (const verify::VerifiedKind& kind : result.kinds) {
    if (kind.compared == 0) continue;
    table.row({kind.name, std::to_string(kind.compared),
               kind.order ? fmt::format("{:.2f}", *kind.order) : "-", two_digits(kind.greatest_bar),
               two_digits(kind.worst.difference()), two_digits(kind.worst.allowed()), kind.unit,
               fmt::format("{:.6g}", kind.worst.t)});
  }
  std::string text = table.str();
  if (result.dt.size() == 3)
    text += fmt::format("\nnewmark: dt {:g}, {:g}, {:g}\n", result.dt[0], result.dt[1], result.dt[2]);
  if (result.paper_dt)
    text += fmt::format(
        "convergence test of the paper: with the step doubled to {:g} displacements change by less than {:g} "
        "of the greatest\n",
        *result.paper_dt, verify::paper_change);
  text += result.exact_result + "\n";
  return text + fmt::format("{}: {}\n", verify::to_string(result.verdict), result.sentence);
}

ExitCode code_of(const verify::Verification& result) {
  if (result.interrupted) return ExitCode::interrupted;
  switch (result.verdict) {
    case verify::Agreement::agree:
      return ExitCode::done;
    case verify::Agreement::differ:
      return ExitCode::limit;
    case verify::Agreement::undecided:
      return ExitCode::stopped;
  }
  return ExitCode::bug;
}

ExitCode run(const VerifyOptions& options) {
  std::vector<Override> changes = overrides_of(options.settings);
  changes.push_back({"run.engine", "ida"});
  const fs::path path = directory_of(options);
  check_folder(path, verify_folder(), options.force, options.scene);
  const auto [scene, model] = study::prepare_run(options.scene, changes);
  if (!options.quiet) print_patterns(options.scene, options.settings);
  verify::VerifyRequest request;
  request.run = scene.run;
  request.dt = scene.run.dt;
  request.go_on = [] { return !Interrupt::requested(); };
  std::optional<Interrupt> interrupt(std::in_place);
  const verify::Verification result = verify::verify(model, model, request);
  interrupt.reset();
  begin_folder(path, verify_folder());
  verify::begin_verify_plot(path);
  verify::write_verification(path, model, result);
  const bool pictures = !options.no_plots && !result.interrupted;
  const std::string drawn =
      pictures ? draw_pictures(path, verify::write_verify_plot(path, model, result)) : "";
  if (options.json) print(verify::verify_json(model, result));
  if (options.tables()) {
    if (!scene.title.empty()) print(scene.title + "\n\n");
    print(text_of(result) + "results: " + path.string() + "/ (verify.json, events.csv)\n" + drawn);
  }
  if (result.interrupted) {
    print_error("interrupted; the results so far are kept in " + path.string());
  } else if (result.verdict != verify::Agreement::agree) {
    print_error(fmt::format("{}: {}", verify::to_string(result.verdict), result.sentence));
  }
  return code_of(result);
}

}  // namespace

void add_verify(Program& program) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = program.app.add_subcommand(
      "verify", "check ida against newmark at three steps, and report whether they agree");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the results (default: SCENE's name with -verify)")
      ->option_text("DIR");
  add_settings(*command, options->settings);
  add_output_options(*command, *options, "replace an earlier verification in the directory", "verify.json");
  command->callback([&program, options] { program.action = [options] { return run(*options); }; });
}

}  // namespace signorini::cli
