// man_completion.hpp: lists of the program's commands and options, read from CLI11, for man pages and completion.
//
//   commands_of(app)   run, check, ...
//   options_of(run)    SCENE (positional), -h --help, -o --output DIR, ...
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace signorini::cli {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for a positional argument
  /// Name of the value, "DIR", or of the positional argument; empty for a flag.
  std::string value;
  std::string description;
  bool required = false;
  [[nodiscard]] bool positional() const { return names.empty(); }
};

/// Subcommands of the program.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& app);
/// Options of a command, positional arguments first.
[[nodiscard]] std::vector<OptionText> options_of(const CLI::App& command);

/// How a shell completes a value.
struct Completion {
  enum class Kind { nothing, words, settings, scenes, files, directories };
  Kind kind = Kind::nothing;
  std::vector<std::string> words;  ///< allowed words; for Kind::settings beginnings such as "run.rtol="
};
/// Completion of an option's value, or of a positional argument.
[[nodiscard]] Completion completion_of(const std::string& command, const OptionText& option);

/// The completion scripts for bash and zsh.
[[nodiscard]] std::string bash_completion(const CLI::App& app);
[[nodiscard]] std::string zsh_completion(const CLI::App& app);

/// Page for man(1), section 1, of one command, or of the program if `command` is null.
[[nodiscard]] std::string man_page(const CLI::App& app, const CLI::App* command);

}  // namespace signorini::cli
