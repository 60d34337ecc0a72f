#include "cli/command.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <optional>
#include <system_error>

#include "base/files.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"
#include "scene/overrides.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {
namespace {

std::optional<std::string> engine_of(const Override& change, const std::vector<std::string>& engines) {
  const std::size_t colon = change.path.find(':');
  if (colon == std::string::npos || colon > change.path.find('.')) return std::nullopt;
  const std::string name = change.path.substr(0, colon);
  if (std::find(engines.begin(), engines.end(), name) == engines.end())
    throw UsageError(fmt::format("--set {}={}: \"{}\" is not among the selected engines{}", change.path,
                                 change.value, name, base::suggestion(name, engines)));
  return name;
}

}  // namespace

void add_output_options(CLI::App& command, OutputOptions& options, const std::string& force,
                        const std::string& json) {
  command.add_flag("--force", options.force, force);
  command.add_flag("--quiet", options.quiet, "print errors only");
  command.add_flag("--json", options.json, "print " + json + " instead of tables");
  command.add_flag("--no-plots", options.no_plots, "write neither pictures nor gnuplot scripts");
}

void print_warnings(const OutputOptions& options, const std::vector<std::string>& warnings,
                    const std::string& of) {
  if (options.quiet) return;
  for (const std::string& warning : warnings) print_warning(of + warning);
}

void print_unchecked(const std::filesystem::path& directory) {
  if (const std::string why = base::unchecked_reason(directory); !why.empty()) print_note(why);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "change a key of the scene: run.rtol=1e-10, contacts.first.friction=0.5 (may be repeated)")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
}

void add_table_option(CLI::App& command, std::string& style) {
  command.add_option("--table", style, "print only the tables, as markdown or latex")
      ->option_text("markdown|latex");
}

TableStyle table_style_of(const std::string& style, const OutputOptions& options) {
  const TableStyle result = table_style(style);
  if (result != TableStyle::plain && options.json)
    throw UsageError("--table: cannot be combined with --json; give only one of them");
  return result;
}

void print_patterns(const std::string& scene, const std::vector<std::string>& settings,
                    const std::string& option, const std::vector<std::string>& given) {
  const auto note = [&](const std::vector<Override>& before, const std::string& path,
                        const std::string& text) {
    if (const std::string met = scene::count_matching_tables_in(scene, before, path); !met.empty())
      print_note(text + ": " + met);
  };
  std::vector<Override> before;
  for (Override& change : overrides_of(settings)) {
    const std::string text = scene::override_text(change);
    if (const std::size_t colon = change.path.find(':'); colon < change.path.find('.'))
      change.path.erase(0, colon + 1);  // setting for one engine
    if (option.empty()) note(before, change.path, text);
    before.push_back(change);
  }
  for (const std::string& text : given) note(before, text.substr(0, text.find('=')), option + " " + text);
}

std::vector<Override> overrides_of(const std::vector<std::string>& settings) {
  std::vector<Override> list;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError("--set " + setting + ": expected path=value, such as run.rtol=1e-10");
    }
    list.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return list;
}

std::vector<Override> overrides_for(const std::vector<std::string>& settings,
                                    const std::vector<std::string>& engines, const std::string& engine) {
  std::vector<Override> changes;
  for (const Override& change : overrides_of(settings)) {
    const std::optional<std::string> only = engine_of(change, engines);
    const std::string path = only ? change.path.substr(only->size() + 1) : change.path;
    if (path == "run.engine")
      throw UsageError(scene::override_text(change) +
                       ": cannot be set here; choose the engines with --engines");
    if (!only || *only == engine) changes.push_back({path, change.value});
  }
  return changes;
}

Override engine_override(const std::string& engine, const std::string& option) {
  return {"run.engine", engine, option + " " + engine};
}

namespace fs = std::filesystem;

namespace {

bool is_inside_folder(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path outer = fs::weakly_canonical(folder, error), inner = fs::weakly_canonical(file, error);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace

void check_folder(const fs::path& path, const ResultFolder& folder, bool force, const std::string& scene) {
  base::check_output_directory(path, {folder.what, folder.marker}, force);
  std::error_code error;
  const bool is_result_folder = fs::exists(path / folder.marker, error);
  if (is_result_folder && !scene.empty() && is_inside_folder(path, scene))
    throw FileError(scene, fmt::format("lies in {}, where --force replaces files; move the scene file, or "
                                       "choose another directory with -o",
                                       path.string()));
}

void begin_folder(const fs::path& path, const ResultFolder& folder) {
  base::make_directory(path);
  std::error_code error;
  for (const std::string& name : folder.files) fs::remove(path / name, error);
  result::write_file(path / folder.marker, "{}\n");
}

void undo_folder(const fs::path& path, const ResultFolder& folder) {
  std::error_code error;
  fs::remove(path / "plots", error);
  for (const auto& entry : fs::directory_iterator(path, error))
    if (entry.path().filename() != folder.marker) return;
  fs::remove(path / folder.marker, error);
  fs::remove(path, error);
}

}  // namespace signorini::cli
