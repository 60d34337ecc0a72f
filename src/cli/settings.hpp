// settings.hpp: options shared by several subcommands: --set, and the treatment of results.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/table.hpp"
#include "signorini/scene.hpp"
#include "study/sweep/vary.hpp"

namespace signorini::cli {

/// Treatment of results.
struct OutputOptions {
  bool force = false, quiet = false, json = false, no_plots = false;
  [[nodiscard]] bool tables() const { return !quiet && !json; }
};
/// Prints warnings to stderr, prefixed with `of`; none with --quiet.
void print_warnings(const OutputOptions& options, const std::vector<std::string>& warnings,
                    const std::string& of = "");

/// A note on stderr where the files of a run cannot be checked, since it has no manifest (base/run_files.hpp).
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

/// Prints notes to stderr: number of tables that each setting with a * matches. `given` are PATH or PATH=VALUE after
/// `option`. Without an option: the settings themselves, each applied after those before it. Errors: those of the file
/// and of settings.
void print_patterns(const std::string& scene, const std::vector<std::string>& settings,
                    const std::string& option = "", const std::vector<std::string>& given = {});

/// Errors: UsageError for a setting without "=".
[[nodiscard]] std::vector<Override> overrides_of(const std::vector<std::string>& settings);

/// The settings for `engine`. "exact:run.rtol=1e-12" is for one engine of `engines`: no key of a scene has a colon
/// before its first dot. Errors: UsageError, also for run.engine.
[[nodiscard]] std::vector<Override> overrides_for(const std::vector<std::string>& settings,
                                                  const std::vector<std::string>& engines,
                                                  const std::string& engine);

/// The engine selected by --engines.
[[nodiscard]] Override engine_override(const std::string& engine, const std::string& option = "--engines");

}  // namespace signorini::cli
