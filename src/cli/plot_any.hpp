// plot_any.hpp: redraws the pictures of any directory of results from its tables.
#pragma once

#include <filesystem>
#include <vector>

#include "result/plots.hpp"

namespace signorini::cli {

/// Checks the files of a run (base/run_files.hpp). One that was made with --no-plots is computed once more, as far as
/// pictures ask; a note says so. Results of another kind are left alone. False: interrupted. Errors: FileError where there are
/// no results; those of add_picture_rows.
[[nodiscard]] bool ready_to_draw(const std::filesystem::path& directory);

/// Writes the scripts and returns them. Errors: FileError; UsageError for a time window on results without time.
std::vector<std::filesystem::path> write_any_plots(const std::filesystem::path& directory,
                                                   const PlotWindow& window, const PictureLook& look);

}  // namespace signorini::cli
