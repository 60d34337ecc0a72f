// signorini new NAME: writes a scene file with comments as a starting point.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <sstream>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/quake.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const base::EmbeddedFile& file : base::scene_templates())
    names.push_back(fs::path(file.name).stem().string());
  return names;
}

/// The text with the scene's name in place of @NAME@.
std::string named(std::string_view text, const std::string& name) {
  constexpr std::string_view mark = "@NAME@";
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = text.find(mark, at);
    result += text.substr(at, next - at);
    if (next == std::string_view::npos) break;
    result += name;
    at = next + mark.size();
  }
  return result;
}

/// Accelerograms of a template, from its lines "#     signorini quake NAME OPTIONS". `folder`: folder of the scene.
std::vector<QuakeOptions> quakes_of(const std::string& text, const fs::path& folder) {
  constexpr std::string_view mark = "#     signorini quake ";
  std::vector<QuakeOptions> list;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(mark)) continue;
    CLI::App app;
    QuakeOptions& options = list.emplace_back();
    add_quake_options(app, options);
    app.parse(line.substr(mark.size()));
    options.name = (folder / options.name).string();
    options.quiet = true;
  }
  return list;
}

ExitCode write_new_scene(const std::string& name, const std::string& from, bool force) {
  const std::vector<std::string> names = template_names();
  std::size_t k = 0;
  while (k < names.size() && names[k] != from) ++k;
  if (k == names.size())
    throw UsageError(fmt::format("--from: found \"{}\"{}", from, base::suggestion(from, names)));
  fs::path path = name;
  if (path.filename().empty())
    throw UsageError(fmt::format("NAME: found \"{}\", expected a file's name", name));
  if (path.extension() != ".toml") path += ".toml";
  const std::string stem = path.stem().string();
  const bool makes_files = base::scene_templates()[k].text.find("@NAME@") != std::string_view::npos;
  if (makes_files && stem.find_first_of("\"\\ ") != std::string::npos)
    throw UsageError(
        fmt::format("NAME: found \"{}\", expected a name without blanks, quotes and backslashes", name));
  const std::string text = named(base::scene_templates()[k].text, stem);
  std::vector<QuakeOptions> quakes = quakes_of(text, path.parent_path());
  std::vector<std::string> files{path.string()};
  for (QuakeOptions& options : quakes) {
    options.force = force;
    for (const std::string& file : quake_files(options)) files.push_back(file);
  }
  for (const std::string& file : files)
    if (!force && fs::exists(fs::symlink_status(file)))
      throw FileError(file, "file exists; use --force to replace it");
  result::write_file(path, text);
  for (const QuakeOptions& options : quakes) write_quake(options);
  for (const std::string& file : files) print(fmt::format("{}\n", file));
  print_note(fmt::format("next commands: signorini check {0}, then signorini run {0}", path.string()));
  return ExitCode::done;
}

struct NewOptions {
  std::string name, from = "block";
  bool force = false;
};

}  // namespace

void add_new(Program& program) {
  auto options = std::make_shared<NewOptions>();
  CLI::App* command = program.app.add_subcommand("new", "write a commented scene to start from");
  command->add_option("NAME", options->name, "the file to write; .toml is added")->required();
  std::string names;
  for (const std::string& name : template_names()) names += (names.empty() ? "" : ", ") + name;
  command->add_option("--from", options->from, "template of the scene: " + names + " (default: block)")
      ->option_text("NAME");
  command->add_flag("--force", options->force, "replace an existing file");
  command->callback([&program, options] {
    program.action = [options] { return write_new_scene(options->name, options->from, options->force); };
  });
}

}  // namespace signorini::cli
