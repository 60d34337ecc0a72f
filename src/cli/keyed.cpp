#include "cli/keyed.hpp"

#include "signorini/error.hpp"

namespace signorini::cli {

std::filesystem::path directory_of(const KeyedOptions& options, const std::string& ending) {
  if (!options.directory) return std::filesystem::path(options.scene).stem().string() + ending;
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

void add_scene(CLI::App& command, KeyedOptions& options) {
  command.add_option("SCENE", options.scene, "the scene file (TOML)")->required();
}

void add_keyed_options(CLI::App& command, KeyedOptions& options, const std::string& what,
                       const std::string& results, const std::string& ending, const std::string& json) {
  command.add_option("--parameter", options.parameters, what + " (may be repeated)")
      ->option_text("PATH")
      ->allow_extra_args(false);
  command
      .add_option("-o,--output", options.directory,
                  "directory of the results (default: SCENE's name with " + ending + ")")
      ->option_text("DIR");
  add_settings(command, options.settings);
  command.add_flag("--force", options.force, "replace " + results + " in the directory");
  command.add_flag("--quiet", options.quiet, "print errors only");
  command.add_flag("--json", options.json, "print " + json + " instead of tables");
}

}  // namespace signorini::cli
