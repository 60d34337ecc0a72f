// sensitivity_fit.hpp: options that `sensitivity` and `fit` share: the scene, keys of it, and where and how results are
// written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace signorini::cli {

struct KeyedOptions : OutputOptions {
  std::string scene;
  std::optional<std::string> directory;
  std::vector<std::string> parameters, settings;
};

/// Directory of the results: that of -o, or SCENE's name with this suffix. Errors: UsageError.
[[nodiscard]] std::filesystem::path directory_of(const KeyedOptions& options, const std::string& ending);

/// Adds the argument SCENE.
void add_scene(CLI::App& command, KeyedOptions& options);
/// Adds --parameter, -o, --set, --force, --quiet and --json, after other arguments. what: description of
/// --parameter; results: as in "replace earlier sensitivities in the directory"; ending: suffix of the
/// directory; json: description of --json.
void add_keyed_options(CLI::App& command, KeyedOptions& options, const std::string& what,
                       const std::string& results, const std::string& ending, const std::string& json);

}  // namespace signorini::cli
