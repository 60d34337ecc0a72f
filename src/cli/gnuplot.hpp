// gnuplot.hpp: draws pictures by running gnuplot on scripts, where there is one on PATH.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace signorini::cli {

struct Drawing {
  enum class Kind { drawn, no_gnuplot, failed } kind = Kind::drawn;
  std::string message;  ///< what gnuplot said when it failed
};

/// Without the pictures of single contacts after the first 24, which would take minutes; their scripts are
/// there.
[[nodiscard]] std::vector<std::filesystem::path> first_ones(
    const std::vector<std::filesystem::path>& scripts);

/// Runs each script in its own folder; one that fails stops no other, and the message is that of the first.
[[nodiscard]] Drawing draw(const std::vector<std::filesystem::path>& scripts);

/// Draws DIR/plots and returns the line that says where the pictures are, with `later` where there is no
/// gnuplot; empty where there is nothing to say. What gnuplot complains of goes to stderr.
[[nodiscard]] std::string draw_pictures(const std::filesystem::path& directory,
                                        const std::vector<std::filesystem::path>& scripts,
                                        const std::string& later = "");

}  // namespace signorini::cli
