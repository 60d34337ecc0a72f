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

/// Runs each script in its own folder.
[[nodiscard]] Drawing draw(const std::vector<std::filesystem::path>& scripts);

}  // namespace signorini::cli
