// quake.hpp: options of `signorini quake`, and the function that writes its files; `signorini new` also uses them.
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

/// Adds the options of `quake` to a command; `options` must outlive parsing.
void add_quake_options(CLI::App& command, QuakeOptions& options);

/// Names of the files of write_quake(): NAME.AT2, NAME.csv.
[[nodiscard]] std::vector<std::string> quake_files(const QuakeOptions& options);

/// Writes NAME.AT2 and NAME.csv, and returns a description of the ground motion; empty with --quiet. Errors: UsageError,
/// FileError.
std::string write_quake(const QuakeOptions& options);

}  // namespace signorini::cli
