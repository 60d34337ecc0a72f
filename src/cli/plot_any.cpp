#include "cli/plot_any.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "base/json.hpp"
#include "base/run_files.hpp"
#include "cli/interrupt.hpp"
#include "cli/settings.hpp"
#include "cli/terminal.hpp"
#include "report/page.hpp"
#include "signorini/error.hpp"
#include "study/compare/comparison_plots.hpp"
#include "study/picture_rows.hpp"
#include "study/sensitivity/sensitivity_files.hpp"
#include "study/sensitivity/sensitivity_plots.hpp"
#include "study/sweep/sweep_directory.hpp"
#include "study/sweep/sweep_plots.hpp"

namespace signorini::cli {

namespace fs = std::filesystem;

namespace {

PictureFiles pictures_of_sweep(const fs::path& directory, const PictureLook& look) {
  const SweepDirectory swept(directory, read_sweep_spec(directory), false);
  return sweep_pictures(swept.spec(), swept.rows(), look);
}

PictureFiles pictures_of_sensitivities(const fs::path& directory, const PictureLook& look) {
  Sigmas sigmas;
  const Sensitivities s = read_sensitivities(directory, sigmas);
  return sensitivity_pictures(s, sigmas, look);
}

/// Scripts for the runs of a comparison: in a folder with the engine's name, else in their own directories.
std::vector<fs::path> comparison_scripts(const fs::path& directory, const PictureLook& look) {
  const fs::path file = directory / "compare.json";
  std::ifstream stream(file, std::ios::binary);
  ComparisonReport report;
  try {
    const Json json = parse_json(stream);
    for (const Json& run : json.at("runs")) {
      const std::string name = run.at("name");
      if (run.at("outcome") == "refused") continue;
      std::error_code error;
      const bool here = fs::is_directory(directory / name, error);
      const fs::path place = here ? directory / name : fs::path(run.at("directory"));
      report.runs.push_back(read_compared_run(place, name));
      print_unchecked(place);
    }
  } catch (const Json::exception& error) {
    throw FileError(file.string(), std::string("is no comparison: ") + error.what());
  }
  if (report.runs.empty()) throw FileError(file.string(), "has no runs");
  begin_comparison_plots(directory);
  for (std::size_t i = 1; i < report.runs.size(); ++i) {
    ComparisonSettings settings;
    settings.folder = directory / "plots";
    settings.slug = run_slug(report.runs[i].figures.name, i);
    report.comparisons.push_back(compare_runs(report.runs.front(), report.runs[i], settings));
  }
  return write_comparison_plots(directory, report, look);
}

}  // namespace

bool ready_to_draw(const fs::path& directory) {
  if (kind_of_results(directory) != "run") return true;
  print_unchecked(directory);
  if (!lacks_picture_rows(directory)) {
    check_run_files(directory);
    return true;
  }
  std::vector<std::string_view> others(result_files.begin(), result_files.end());
  std::erase_if(others, [](std::string_view file) {
    return std::find(picture_rows.begin(), picture_rows.end(), file) != picture_rows.end();
  });
  check_run_files(directory, others);
  print_note(directory.string() + ": pictures need a new computation, because the run used --no-plots");
  return add_picture_rows(directory, [] { return !Interrupt::asked(); });
}

std::vector<fs::path> write_any_plots(const fs::path& directory, const PlotWindow& window,
                                      const PictureLook& look) {
  const std::string kind = kind_of_results(directory);
  if (kind == "run") return run_pictures(directory, window, look).write(directory);
  if (window.from || window.to)
    throw UsageError(fmt::format("{}: {} is a {}, whose pictures have no part of a time to show",
                                 window.from ? "--from" : "--to", directory.string(), kind));
  if (kind == "sweep") return pictures_of_sweep(directory, look).write(directory);
  if (kind == "sensitivity") return pictures_of_sensitivities(directory, look).write(directory);
  if (kind == "comparison") return comparison_scripts(directory, look);
  throw FileError(
      directory.string(),
      fmt::format("is a {}; runs, comparisons, sweeps and sensitivities can be drawn again", kind));
}

}  // namespace signorini::cli
