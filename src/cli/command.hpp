// command.hpp: registration of the subcommands, and options that several subcommands share.
//
// add_NAME() declares the options of a subcommand. If the command line names the subcommand, Program::action is set to
// the function that executes it. Actions run after parsing, so their exceptions never pass through CLI11. A new
// subcommand needs one file with an add_ function, and one line in main.cpp.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/terminal.hpp"
#include "signorini/error.hpp"
#include "signorini/scene.hpp"
#include "study/sweep/parameter_range.hpp"

namespace signorini::cli {

struct Program {
  CLI::App& app;
  std::vector<std::string> command_line;
  std::function<ExitCode()> action;
};

// Each function adds one subcommand to the program.
void add_run(Program& program);
void add_check(Program& program);
void add_compare(Program& program);
void add_witness(Program& program);
void add_plot(Program& program);
void add_report(Program& program);
void add_paraview(Program& program);
void add_study(Program& program);
void add_sweep(Program& program);
void add_verify(Program& program);
void add_orbit(Program& program);
void add_sensitivity(Program& program);
void add_fit(Program& program);
void add_keys(Program& program);
void add_schema(Program& program);
void add_new(Program& program);
void add_quake(Program& program);
void add_completion(Program& program);
void add_man(Program& program);

// Options shared by several subcommands: --set, and those for the output of results.

/// Options for the output of results.
struct OutputOptions {
  bool force = false, quiet = false, json = false, no_plots = false;
  [[nodiscard]] bool tables() const { return !quiet && !json; }
};
/// Prints warnings to stderr, each prefixed with `of`; prints nothing with --quiet.
void print_warnings(const OutputOptions& options, const std::vector<std::string>& warnings,
                    const std::string& of = "");

/// Prints a note to stderr if the files of a run cannot be checked because the run has no manifest (base/run_files.hpp).
void print_unchecked(const std::filesystem::path& directory);

/// Adds --force, --quiet, --json and --no-plots to a subcommand; `options` must outlive parsing. force: description of
/// --force; json: name of the printed JSON file.
void add_output_options(CLI::App& command, OutputOptions& options, const std::string& force,
                        const std::string& json);

/// Adds --table markdown|latex, the output for papers. `style` must outlive parsing.
void add_table_option(CLI::App& command, std::string& style);
/// The requested table style. Errors: UsageError for an unknown style, or if --table and --json are given together.
[[nodiscard]] TableStyle table_style_of(const std::string& style, const OutputOptions& options);

/// Adds --set PATH=VALUE to a subcommand; `settings` must outlive parsing.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

/// Prints notes to stderr: how many tables of the scene each path with a * matches. option, given: the paths are those of
/// this option, as PATH or PATH=VALUE; without `option` the paths are those of the settings, each reported after the
/// previous settings are applied. Errors: as for reading the scene with these settings.
void print_patterns(const std::string& scene, const std::vector<std::string>& settings,
                    const std::string& option = "", const std::vector<std::string>& given = {});

/// The settings as overrides. Errors: UsageError for a setting without "=".
[[nodiscard]] std::vector<Override> overrides_of(const std::vector<std::string>& settings);

/// The settings that apply to `engine`: those for all engines, and those for this engine only. "exact:run.rtol=1e-12" is a
/// setting for one engine of `engines`; keys of scenes have no colon before their first dot. Errors: UsageError for an
/// engine that is not in `engines`, or for a setting of run.engine.
[[nodiscard]] std::vector<Override> overrides_for(const std::vector<std::string>& settings,
                                                  const std::vector<std::string>& engines,
                                                  const std::string& engine);

/// Override that selects an engine. option: the option of the command line, for messages.
[[nodiscard]] Override engine_override(const std::string& engine, const std::string& option = "--engines");

// A directory of results that a command may replace, because the command created it.
//
//   DIR/MARKER        written first, so that --force can replace the remains of a killed command
//   DIR/FILES...      removed by --force; other files stay

struct ResultFolder {
  std::string what;                ///< kind of results, for messages: "comparison"
  std::string marker;              ///< file that identifies the directory: "compare.json"
  std::vector<std::string> files;  ///< other files that the command writes
};

/// Checks that a command may write into the folder. Errors: FileError unless the folder is absent, empty or, with `force`,
/// created by this command; FileError also if a folder that would be replaced contains the file `scene`, which could be
/// lost. scene: may be empty.
void check_folder(const std::filesystem::path& path, const ResultFolder& folder, bool force,
                  const std::string& scene);
/// Creates the folder, removes the files listed in `folder` and writes the marker. Errors: FileError.
void begin_folder(const std::filesystem::path& path, const ResultFolder& folder);
/// Removes DIR/plots if it is empty, then the marker and the folder; if other files remain, marker and folder stay.
void undo_folder(const std::filesystem::path& path, const ResultFolder& folder);

}  // namespace signorini::cli
