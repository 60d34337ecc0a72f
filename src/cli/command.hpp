// command.hpp: registration of the subcommands, and options that several of them share.
//
// add_NAME() declares the options of a subcommand; if the command line names the subcommand, `action` is set
// to its function. Actions run after parsing, so their exceptions never pass through CLI11. A new subcommand
// is one file with one add_ function, and one line in main.cpp.
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

// Each adds one subcommand to the program.
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
/// Prints warnings to stderr, prefixed with `of`; none with --quiet.
void print_warnings(const OutputOptions& options, const std::vector<std::string>& warnings,
                    const std::string& of = "");

/// Prints a note to stderr if the files of a run cannot be checked because it has no manifest
/// (base/run_files.hpp).
void print_unchecked(const std::filesystem::path& directory);

/// Adds --force, --quiet, --json and --no-plots to a subcommand; `options` must outlive parsing.
void add_output_options(CLI::App& command, OutputOptions& options, const std::string& force,
                        const std::string& json);

/// Adds --table markdown|latex: output for papers. `style` must outlive parsing.
void add_table_option(CLI::App& command, std::string& style);
/// The requested table style. Errors: UsageError, also if combined with --json.
[[nodiscard]] TableStyle table_style_of(const std::string& style, const OutputOptions& options);

/// Adds --set PATH=VALUE to a subcommand; `settings` must outlive parsing.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

/// Prints notes to stderr: the number of tables that each setting with a * matches. given: PATH or PATH=VALUE
/// after `option`; without an option the settings themselves are reported, each applied after those before
/// it. Errors: those of the file and of settings.
void print_patterns(const std::string& scene, const std::vector<std::string>& settings,
                    const std::string& option = "", const std::vector<std::string>& given = {});

/// The settings as overrides. Errors: UsageError for a setting without "=".
[[nodiscard]] std::vector<Override> overrides_of(const std::vector<std::string>& settings);

/// The settings for `engine`: general ones, and those for this engine alone. "exact:run.rtol=1e-12" is a
/// setting for one engine of `engines`; it cannot be a key of a scene, which has no colon before its first
/// dot. Errors: UsageError, also for run.engine.
[[nodiscard]] std::vector<Override> overrides_for(const std::vector<std::string>& settings,
                                                  const std::vector<std::string>& engines,
                                                  const std::string& engine);

/// The engine selected by --engines.
[[nodiscard]] Override engine_override(const std::string& engine, const std::string& option = "--engines");

// A directory of results that a command may replace, because the command created it.
//
//   DIR/MARKER        written first, so that --force can replace the remains of a killed command
//   DIR/FILES...      removed by --force; other files stay

struct ResultFolder {
  std::string what;    ///< "comparison"
  std::string marker;  ///< "compare.json"
  std::vector<std::string> files;
};

/// Checks that a command may write into the folder. Errors: FileError unless it is absent, empty or, with
/// `force`, created by this command; with `force` also if the folder contains the scene, which could be lost.
/// scene: may be empty.
void check_folder(const std::filesystem::path& path, const ResultFolder& folder, bool force,
                  const std::string& scene);
/// Creates the folder, removes our files and writes the marker. Errors: FileError.
void begin_folder(const std::filesystem::path& path, const ResultFolder& folder);
/// Reverses begin_folder(), and removes DIR/plots if it is empty. If other files remain, the marker stays.
void undo_folder(const std::filesystem::path& path, const ResultFolder& folder);

}  // namespace signorini::cli
