// page.hpp: a directory of results as one self-contained HTML page.
//
//   write_file(dir / "report.html", run_page(dir, scene, check))
//
// Everything is read from the directory: for a run all tables, with an animation; for a comparison, study, sweep or
// verification its tables, facts and pictures. The texts, style and script of the page are in src/report/page. The page
// uses no library: the animation is one SVG of a few dozen shapes, charts are lines on a canvas, and motion, charts and
// events share one cursor. The charts take 300 lines of script; a chart library would add 50 KB and a second cursor.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/load_cases.hpp"
#include "signorini/scene.hpp"

namespace signorini::report {

/// Kind of results in a directory: "run", "comparison", "study", "sweep", "verification", "sensitivity", "fit",
/// "branch". Errors: FileError if the directory contains none of these.
[[nodiscard]] std::string kind_of_results(const std::filesystem::path& directory);

/// The page of a run. scene: read from run.toml of the run; check: output of `signorini check` for this scene. Errors:
/// FileError.
[[nodiscard]] std::string run_page(const std::filesystem::path& directory, const Scene& scene,
                                   const std::string& check);

/// The page of several runs side by side (load_cases.hpp).
[[nodiscard]] std::string load_cases_page(const std::vector<LoadCase>& cases);

/// The page of results that are not a single run. Errors: FileError.
[[nodiscard]] std::string results_page(const std::filesystem::path& directory);

}  // namespace signorini::report
