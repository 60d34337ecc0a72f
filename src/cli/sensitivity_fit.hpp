// sensitivity_fit.hpp: options that `sensitivity` and `fit` share: scene, keys of the scene, and output of results.
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

/// Directory of the results: the directory of -o, or SCENE's name with the suffix `ending`. Errors: UsageError.
[[nodiscard]] std::filesystem::path directory_of(const KeyedOptions& options, const std::string& ending);

/// Adds the argument SCENE.
void add_scene(CLI::App& command, KeyedOptions& options);
/// Adds --parameter, -o, --set, --force, --quiet and --json to a command. what: description of --parameter; results: name
/// of the results in the description of --force, such as "earlier sensitivities"; ending: suffix of the directory; json:
/// name of the printed JSON file.
void add_keyed_options(CLI::App& command, KeyedOptions& options, const std::string& what,
                       const std::string& results, const std::string& ending, const std::string& json);

}  // namespace signorini::cli
