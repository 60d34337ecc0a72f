// signorini new NAME: a commented scene to start from.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "base/embedded.hpp"
#include "base/suggest.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : scene_templates()) names.push_back(fs::path(file.name).stem().string());
  return names;
}

ExitCode write_new_scene(const std::string& name, const std::string& from, bool force) {
  const std::vector<std::string> names = template_names();
  std::size_t k = 0;
  while (k < names.size() && names[k] != from) ++k;
  if (k == names.size())
    throw UsageError(fmt::format("--from: found \"{}\"{}", from, suggestion(from, names)));
  fs::path path = name;
  if (path.filename().empty())
    throw UsageError(fmt::format("NAME: found \"{}\", expected a file's name", name));
  if (path.extension() != ".toml") path += ".toml";
  if (!force && fs::exists(fs::symlink_status(path)))
    throw FileError(path.string(), "is there already; --force replaces it");
  write_file(path, std::string(scene_templates()[k].text));
  print(fmt::format("{}\n", path.string()));
  print_note(fmt::format("signorini check {0}, and then signorini run {0}", path.string()));
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
  command->add_option("--from", options->from, "which one: " + names + "; default: block")
      ->option_text("NAME");
  command->add_flag("--force", options->force, "replace a file that is there");
  command->callback([&program, options] {
    program.action = [options] { return write_new_scene(options->name, options->from, options->force); };
  });
}

}  // namespace signorini::cli
