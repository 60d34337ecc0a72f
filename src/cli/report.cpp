// signorini report DIR [DIR...]: writes one self-contained HTML page.

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/files.hpp"
#include "cli/check.hpp"
#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/terminal.hpp"
#include "report/page.hpp"
#include "report/paraview.hpp"
#include "report/run_data.hpp"
#include "result/csv.hpp"
#include "study/check/check.hpp"

namespace signorini::cli {
namespace {

namespace fs = std::filesystem;

/// Output of `check` for the scene of a run, or the error message if `check` fails.
std::string check_of(const Scene& scene) {
  try {
    const Model model = build_model(scene);
    return check_text(scene, model, check::check(scene, model));
  } catch (const Error& error) {
    return error.what();
  }
}

/// Errors: FileError if the path is a pipe, a device or a folder, which the finished file would replace.
void check_regular(const fs::path& file) {
  if (const std::string why = base::input_file_error(file); !why.empty())
    throw FileError(file.string(), why + ", expected a file or a new name");
}

/// Checks that the page may be written. Errors: FileError if a file with this name exists that this command did not write.
void check_page(const fs::path& page) {
  check_regular(page);
  base::check_output_file(page, "page of Signorini", "<meta name=\"generator\" content=\"Signorini");
}

ExitCode report(const fs::path& directory, const fs::path& given) {
  const bool run = report::kind_of_results(directory) == "run";
  const fs::path page = given.empty() ? directory / "report.html" : given;
  check_page(page);
  if (run) {
    if (!ready_to_draw(directory)) return ExitCode::interrupted;
    const Scene scene = read_scene((directory / "run.toml").string());
    result::write_file(page, report::run_page(directory, scene, check_of(scene)));
  } else {
    result::write_file(page, report::results_page(directory));
  }
  print(page.string() + "\n");
  return ExitCode::done;
}

/// Writes a page for several runs, and a CSV file with the same data and the same name, but with the ending .csv.
ExitCode report_cases(const std::vector<std::string>& directories, const fs::path& given) {
  const std::vector<report::LoadCase> cases =
      report::read_load_cases(std::vector<fs::path>(directories.begin(), directories.end()));
  const fs::path page = given.empty() ? "cases.html" : given;
  for (const std::string& directory : directories) print_unchecked(directory);
  for (const std::string& doubt : report::load_case_warnings(cases)) print_warning(doubt);
  fs::path table = page;
  table.replace_extension(".csv");
  if (table == page)
    throw UsageError(page.string() + ": is also the name of the CSV table; expected FILE.html");
  check_page(page);
  check_regular(table);
  base::check_output_file(table, "table of load cases", "item,quantity,unit");
  result::write_file(page, report::load_cases_page(cases));
  result::write_file(table, report::load_cases_csv(cases));
  print(page.string() + "\n" + table.string() + "\n");
  return ExitCode::done;
}

}  // namespace

void add_report(Program& program) {
  auto directories = std::make_shared<std::vector<std::string>>();
  auto output = std::make_shared<std::string>();
  CLI::App* command = program.app.add_subcommand(
      "report",
      "write one page of HTML about a run, comparison, study, sweep or verification, or load cases");
  command
      ->add_option(
          "DIR", *directories,
          "directory of results. Several runs are compared as load cases, in one page and one CSV file")
      ->required();
  command
      ->add_option("-o,--output", *output,
                   "the page (default: DIR/report.html; for several runs: cases.html, with cases.csv)")
      ->option_text("FILE");
  command->callback([&program, directories, output] {
    program.action = [directories, output] {
      return directories->size() == 1 ? report(directories->front(), *output)
                                      : report_cases(*directories, *output);
    };
  });
}

// signorini paraview DIR: writes the deformed shapes of a run as frames for ParaView.

namespace {

namespace fs = std::filesystem;

struct FrameOptions {
  std::string directory;
  int count = 200;
  bool events = false;
};

ExitCode write_frames(const FrameOptions& options) {
  constexpr int most = 5000;
  if (options.count < 1 || options.count > most)
    throw UsageError(
        fmt::format("--frames: found {}, expected an integer from 1 to {}", options.count, most));
  const fs::path directory = options.directory;
  if (report::kind_of_results(directory) != "run")
    throw FileError(directory.string(), "is not a directory that `signorini run` wrote");
  if (!ready_to_draw(directory)) return ExitCode::interrupted;
  const Scene scene = read_scene((directory / "run.toml").string());
  const base::Json data = report::run_data(scene, directory);
  const auto count = static_cast<std::size_t>(options.count);
  const std::vector<double> times = report::frame_times(data, count, options.events);
  std::string written = report::write_paraview(directory, data, times).string() + "\n";
  if (const auto bodies = report::write_paraview_bodies(directory, scene)) written += bodies->string() + "\n";
  print(written);
  return ExitCode::done;
}

}  // namespace

void add_paraview(Program& program) {
  auto options = std::make_shared<FrameOptions>();
  CLI::App* command =
      program.app.add_subcommand("paraview", "write a run as frames for ParaView: DIR/paraview/run.pvd");
  command->add_option("DIR", options->directory, "a directory that `signorini run` wrote")->required();
  command->add_option("--frames", options->count, "number of frames at equal time intervals (default: 200)")
      ->option_text("N");
  command->add_flag("--events", options->events, "also write a frame at the time of each event");
  command->callback([&program, options] { program.action = [options] { return write_frames(*options); }; });
}

}  // namespace signorini::cli
