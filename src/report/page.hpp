// page.hpp: a directory of results as one page of HTML that needs nothing else: no network, no other file.
//
//   write_file(dir / "report.html", page_of(dir, check))
//
// What is shown is read from the directory: of a run everything, with an animation; of a comparison, study, sweep or verification
// its tables, facts and pictures. The texts, style and script of the page stand in src/report/page. There is no library in it: what
// moves is one SVG of a few dozen shapes, and charts are lines on a canvas with one cursor that motion, charts and events share. That is
// 300 lines of script; a library of charts has its own cursor and legend, which would have to be tied to the player, and 50 KB.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/load_cases.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// What a directory holds: "run", "comparison", "study", "sweep", "verification", "sensitivity", "fit",
/// "branch". Errors: FileError for any other.
[[nodiscard]] std::string kind_of_results(const std::filesystem::path& directory);

/// The page of a run; `scene`: its run.toml, `check`: what `check` says about it. Errors: FileError.
[[nodiscard]] std::string run_page(const std::filesystem::path& directory, const Scene& scene,
                                   const std::string& check);

/// The page of several runs side by side (load_cases.hpp).
[[nodiscard]] std::string load_cases_page(const std::vector<LoadCase>& cases);

/// The page of anything else. Errors: FileError.
[[nodiscard]] std::string results_page(const std::filesystem::path& directory);

}  // namespace signorini
