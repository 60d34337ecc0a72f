// plot.hpp: draws pictures by running gnuplot on scripts, if gnuplot is on PATH.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/plots.hpp"

namespace signorini::cli {

struct Drawing {
  enum class Kind { drawn, no_gnuplot, failed } kind = Kind::drawn;
  std::string message;  ///< output of gnuplot, if gnuplot failed
};

/// The scripts without those of contacts after the first 24, because pictures of many contacts would take minutes.
[[nodiscard]] std::vector<std::filesystem::path> scripts_to_draw(
    const std::vector<std::filesystem::path>& scripts);

/// Runs gnuplot on each script, in the folder of the script. The other scripts also run if one fails; the result has the
/// message of the first failure.
[[nodiscard]] Drawing draw(const std::vector<std::filesystem::path>& scripts);

/// Draws the scripts in DIR/plots and returns a line for the terminal that names the pictures. Without gnuplot the line
/// names the scripts and ends with `later`. Empty if there are no scripts, or if the only script failed. Messages of gnuplot go
/// to stderr.
[[nodiscard]] std::string draw_pictures(const std::filesystem::path& directory,
                                        const std::vector<std::filesystem::path>& scripts,
                                        const std::string& later = "");

// Functions that redraw the pictures of any directory of results from its tables.

/// Checks the files of a run (base/run_files.hpp). A run made with --no-plots is computed again for its pictures, and a
/// note is printed. Results of another kind are not checked. Returns false if interrupted. Errors: FileError if there are
/// no results; errors of add_picture_rows.
[[nodiscard]] bool ready_to_draw(const std::filesystem::path& directory);

/// Writes the gnuplot scripts and returns their paths. Errors: FileError; UsageError if the window has times, but the
/// pictures of these results do not show time.
std::vector<std::filesystem::path> write_plot_scripts(const std::filesystem::path& directory,
                                                      const result::PlotWindow& window,
                                                      const result::PictureStyle& look);

}  // namespace signorini::cli
