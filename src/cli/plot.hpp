// plot.hpp: draws pictures by running gnuplot on scripts, if it is on PATH.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/plots.hpp"

namespace signorini::cli {

struct Drawing {
  enum class Kind { drawn, no_gnuplot, failed } kind = Kind::drawn;
  std::string message;  ///< gnuplot's output if it failed
};

/// The scripts without those of contacts after the first 24, whose pictures would take minutes.
[[nodiscard]] std::vector<std::filesystem::path> first_ones(
    const std::vector<std::filesystem::path>& scripts);

/// Runs each script in its own folder. A failed script does not stop the others; the message is that of the
/// first failure.
[[nodiscard]] Drawing draw(const std::vector<std::filesystem::path>& scripts);

/// Draws the scripts in DIR/plots and returns the line that names the pictures; without gnuplot the line
/// names the scripts and ends with `later`. Empty if no line is needed. Error messages of gnuplot go to
/// stderr.
[[nodiscard]] std::string draw_pictures(const std::filesystem::path& directory,
                                        const std::vector<std::filesystem::path>& scripts,
                                        const std::string& later = "");

// Redraws the pictures of any directory of results from its tables.

/// Checks the files of a run (base/run_files.hpp). A run with --no-plots is computed once more for its
/// pictures, with a note. Results of another kind are not checked. Returns false if interrupted. Errors:
/// FileError if there are no results; those of add_picture_rows.
[[nodiscard]] bool ready_to_draw(const std::filesystem::path& directory);

/// Writes the scripts and returns them. Errors: FileError; UsageError for a time window on results without time.
std::vector<std::filesystem::path> write_any_plots(const std::filesystem::path& directory,
                                                   const result::PlotWindow& window,
                                                   const result::PictureStyle& look);

}  // namespace signorini::cli
