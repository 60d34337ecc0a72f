// work_plots.hpp: work-precision diagrams: time over error, both logarithmic, one line per engine.
//
//   DIR/plots/work-precision.gp, line-1.csv, line-2.csv, ...
//
// Filled points reached the end with the reference's events and are connected; hollow ones did not: their error covers
// the time up to the first difference of the sequences.
#pragma once

#include <filesystem>
#include <vector>

#include "study/speed/work_study.hpp"

namespace signorini {

/// The scripts; empty if no run has both an error and a time. Errors: FileError.
[[nodiscard]] std::vector<std::filesystem::path> write_work_plots(const std::filesystem::path& directory,
                                                                  const WorkReport& report);

/// Removes the files of write_work_plots() and of its scripts. Errors: FileError.
void remove_work_plots(const std::filesystem::path& directory);

}  // namespace signorini
