// signorini report DIR: one page of HTML that needs nothing else.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/check_text.hpp"
#include "cli/command.hpp"
#include "cli/plot_any.hpp"
#include "cli/terminal.hpp"
#include "report/page.hpp"
#include "result/csv.hpp"
#include "study/check/check.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

/// What `check` says about the scene of a run; why it cannot where it cannot.
std::string check_of(const Scene& scene) {
  try {
    const Model model = build_model(scene);
    return check_text(scene, model, check(scene, model));
  } catch (const Error& error) {
    return error.what();
  }
}

ExitCode report(const fs::path& directory, const fs::path& given) {
  const bool run = kind_of_results(directory) == "run";
  const fs::path page = given.empty() ? directory / "report.html" : given;
  if (run) {
    if (!complete_pictures(directory)) return ExitCode::interrupted;
    const Scene scene = read_scene((directory / "run.toml").string());
    write_file(page, run_page(directory, scene, check_of(scene)));
  } else {
    write_file(page, results_page(directory));
  }
  print(page.string() + "\n");
  return ExitCode::done;
}

}  // namespace

void add_report(Program& program) {
  auto directory = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  CLI::App* command = program.app.add_subcommand(
      "report", "write one page of HTML about a run, comparison, study, sweep or verification");
  command->add_option("DIR", *directory, "the directory of results")->required();
  command->add_option("-o,--output", *output, "the page (default: DIR/report.html)")->option_text("FILE");
  command->callback([&program, directory, output] {
    program.action = [directory, output] { return report(*directory, *output); };
  });
}

}  // namespace signorini::cli
