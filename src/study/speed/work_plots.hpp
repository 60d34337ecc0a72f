// work_plots.hpp: work-precision pictures: time over error, both logarithmic, one line an engine.
//
//   DIR/plots/work-precision.gp, line-1.csv, line-2.csv, ...
//
// Filled points reached the end with the reference's events and are joined; hollow ones did not: their error
// is that up to where the sequences part.
#pragma once

#include <filesystem>
#include <vector>

#include "study/speed/work_study.hpp"

namespace signorini {

/// The scripts to be drawn; none where no run has both an error and a time. Errors: FileError.
[[nodiscard]] std::vector<std::filesystem::path> write_work_plots(const std::filesystem::path& directory,
                                                                  const WorkReport& report);

/// Removes what write_work_plots() and its scripts have made. Errors: FileError.
void remove_work_plots(const std::filesystem::path& directory);

}  // namespace signorini
