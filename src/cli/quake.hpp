// quake.hpp: options of `signorini quake` and writer of its files, which `new` also uses.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace signorini::cli {

struct QuakeOptions {
  std::string name;
  double pga = 0.3, duration = 20.0, dt = 0.01;
  double ground_frequency = 2.5, ground_damping = 0.6;
  long seed = 1;
  std::optional<std::string> spectrum;
  bool force = false, quiet = false;
};

/// `options` must outlive parsing.
void add_quake_options(CLI::App& command, QuakeOptions& options);

/// Names of the files of write_quake(): NAME.AT2, NAME.csv.
[[nodiscard]] std::vector<std::string> quake_files(const QuakeOptions& options);

/// Writes the files, and returns a description of the ground motion; empty with --quiet. Errors: UsageError, FileError.
std::string write_quake(const QuakeOptions& options);

}  // namespace signorini::cli
