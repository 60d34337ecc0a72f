#include "cli/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/embedded.hpp"
#include "scene/keys.hpp"

namespace signorini::cli {

namespace {

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  text.description = option.get_description();
  text.required = option.get_required();
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.positional()) {
    text.value = option.get_name(true);
    if (option.get_items_expected_max() > 1) text.value += "...";
  } else if (option.get_items_expected_max() > 0) {
    text.value = option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  }
  return text;
}

bool has(const OptionText& option, std::string_view name) {
  return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
}

/// Settings with paths that do not depend on the scene.
std::vector<std::string> plain_settings() {
  std::vector<std::string> paths;
  for (const Key& key : all_keys()) {
    const bool table = key.type == KeyType::table || key.type == KeyType::tables;
    if (table || key.name == "*" || key.table.empty() || key.table == "history" ||
        key.table.find_first_of("[*") != std::string_view::npos || key.table == "base_motion")
      continue;
    paths.push_back(std::string(key.table) + "." + std::string(key.name) + "=");
  }
  return paths;
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<OptionText> options_of(const CLI::App& command) {
  std::vector<OptionText> list;
  for (const CLI::Option* option : command.get_options()) list.push_back(option_text(*option));
  std::stable_partition(list.begin(), list.end(), [](const OptionText& o) { return o.positional(); });
  return list;
}

Completion completion_of(const std::string& command, const OptionText& option) {
  using Kind = Completion::Kind;
  if (has(option, "--engine") || has(option, "--engines"))
    return {Kind::words, choices_of(*find_key("run", "engine"))};
  if (has(option, "--set") || has(option, "--vary")) return {Kind::settings, plain_settings()};
  if (command == "new" && has(option, "--from")) {
    Completion completion{Kind::words, {}};
    for (const EmbeddedFile& file : scene_templates())
      completion.words.push_back(std::filesystem::path(file.name).stem().string());
    return completion;
  }
  if (option.value == "SHELL") return {Kind::words, {"bash", "zsh"}};
  if (option.value.starts_with("SCENE")) return {Kind::scenes, {}};
  if (option.value.starts_with("DIR")) return {Kind::directories, {}};
  if (option.value == "FILE" || option.value.starts_with("SOURCE")) return {Kind::files, {}};
  return {};
}

}  // namespace signorini::cli
