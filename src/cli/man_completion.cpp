// signorini man [COMMAND]: prints pages for man(1), generated from the options of the program.

#include "cli/man_completion.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "base/files.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"
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

/// Settings "TABLE.KEY=" for keys whose path does not depend on the scene.
std::vector<std::string> plain_settings() {
  std::vector<std::string> paths;
  for (const scene::Key& key : scene::all_keys()) {
    const bool table = key.type == scene::KeyType::table || key.type == scene::KeyType::tables;
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
    return {Kind::words, scene::choices_of(*scene::find_key("run", "engine"))};
  if (has(option, "--set") || has(option, "--vary")) return {Kind::settings, plain_settings()};
  if (command == "new" && has(option, "--from")) {
    Completion completion{Kind::words, {}};
    for (const base::EmbeddedFile& file : base::scene_templates())
      completion.words.push_back(std::filesystem::path(file.name).stem().string());
    return completion;
  }
  if (option.value == "SHELL") return {Kind::words, {"bash", "zsh"}};
  if (option.value.starts_with("SCENE")) return {Kind::scenes, {}};
  if (option.value.starts_with("DIR")) return {Kind::directories, {}};
  if (option.value == "FILE" || option.value.starts_with("SOURCE")) return {Kind::files, {}};
  return {};
}

namespace {

namespace fs = std::filesystem;

/// Escapes text for troff.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      const bool first = result.empty() || result.back() == '\n';
      if (first && (c == '.' || c == '\'')) result += "\\&";
      result += c;
    }
  }
  return result;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string page_name(const CLI::App* command) {
  return command ? "signorini-" + command->get_name() : "signorini";
}

std::string term(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += (text.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
  if (!option.value.empty()) text += (text.empty() ? "" : " ") + ("\\fI" + roff(option.value) + "\\fR");
  return text;
}

std::string options_text(const CLI::App& app) {
  std::string text;
  for (const OptionText& option : options_of(app))
    text += fmt::format(".TP\n{}\n{}\n", term(option), roff(option.description));
  return text;
}

std::string synopsis(const CLI::App* command) {
  if (!command) return ".B signorini\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  std::string text = fmt::format(".B signorini {}\n[\\fIOPTIONS\\fR]", roff(command->get_name()));
  for (const OptionText& option : options_of(*command))
    if (option.positional())
      text += fmt::format(" {}\\fI{}\\fR{}", option.required ? "" : "[", roff(option.value),
                          option.required ? "" : "]");
  return text + "\n";
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) {
    if (command->get_name() == name) return command;
    names.push_back(command->get_name());
  }
  throw UsageError(fmt::format("no command \"{}\"{}", name, base::suggestion(name, names)));
}

/// Writes the pages of all commands to the folder, and prints their file names.
void write_pages(const CLI::App& app, const fs::path& folder) {
  std::vector<const CLI::App*> pages = commands_of(app);
  pages.insert(pages.begin(), nullptr);
  for (const CLI::App* command : pages) {
    const fs::path path = folder / (page_name(command) + ".1");
    result::write_file(path, man_page(app, command));
    print(path.string() + "\n");
  }
}

struct ManOptions {
  std::string command, folder;
};

}  // namespace

std::string man_page(const CLI::App& app, const CLI::App* command) {
  const CLI::App& shown = command ? *command : app;
  const std::string name = page_name(command);
  std::string text =
      fmt::format(".TH {} 1 \"\" \"signorini {}\" \"Signorini\"\n", upper(roff(name)), version);
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(shown.get_description()));
  text += ".SH SYNOPSIS\n" + synopsis(command);
  if (!command) {
    text += ".SH COMMANDS\n";
    for (const CLI::App* each : commands_of(app))
      text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(each->get_name()), roff(each->get_description()));
  }
  text += ".SH OPTIONS\n" + options_text(shown);
  std::string codes = app.get_footer();
  std::replace(codes.begin(), codes.end(), '\n', ' ');
  constexpr std::string_view heading = "Exit codes: ";
  if (codes.starts_with(heading)) codes.erase(0, heading.size());
  text += ".SH EXIT STATUS\n" + roff(codes) + "\n.SH SEE ALSO\n";
  std::string others;
  if (command) others = ".BR signorini (1)";
  for (const CLI::App* each : commands_of(app)) {
    if (command) break;
    others += fmt::format("{}.BR {} (1)", others.empty() ? "" : ",\n", roff(page_name(each)));
  }
  return text + others + "\n";
}

void add_man(Program& program) {
  auto options = std::make_shared<ManOptions>();
  CLI::App* command =
      program.app.add_subcommand("man", "print a page for man(1): signorini man run | man -l -");
  command->add_option("COMMAND", options->command, "command to describe (default: the program itself)");
  command->add_option("--write", options->folder, "write the manual pages of all commands to a directory")
      ->option_text("DIR");
  command->callback([&program, options] {
    program.action = [&program, options] {
      const CLI::App& app = program.app;
      if (!options->folder.empty()) {
        write_pages(app, options->folder);
      } else {
        print(man_page(app, options->command.empty() ? nullptr : command_named(app, options->command)));
      }
      return ExitCode::done;
    };
  });
}

// signorini completion bash|zsh: prints a script that completes commands, options, scenes and settings.

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + word;
  return text;
}

std::string bash_action(const Completion& completion) {
  switch (completion.kind) {
    case Completion::Kind::words:
      return fmt::format("_signorini_words '{}'", joined(completion.words));
    case Completion::Kind::settings:
      return fmt::format("compopt -o nospace 2>/dev/null; _signorini_words '{}'", joined(completion.words));
    case Completion::Kind::scenes:
      return "_signorini_files -X '!*.toml'";
    case Completion::Kind::files:
      return "_signorini_files";
    case Completion::Kind::directories:
      return "_signorini_files -X '*'";
    case Completion::Kind::nothing:
      break;
  }
  return ":";
}

/// Completions after one command, for bash: values of its options, its options, its first argument.
std::string bash_command(const CLI::App& command) {
  std::string values, flags, argument = ":";
  for (const OptionText& option : options_of(command)) {
    const std::string action = bash_action(completion_of(command.get_name(), option));
    if (option.positional() && argument == ":") argument = action;
    if (option.positional()) continue;
    flags += (flags.empty() ? "" : " ") + joined(option.names);
    if (!option.value.empty())
      values += fmt::format("        {}) {}; return ;;\n", joined(option.names, "|"), action);
  }
  std::string text = fmt::format("    {})\n", command.get_name());
  if (!values.empty()) text += fmt::format("      case $before in\n{}      esac\n", values);
  return text + fmt::format("      if [[ $word == -* ]]; then _signorini_words '{}'; else {}; fi ;;\n", flags,
                            argument);
}

/// Escapes text for single quotes and for zsh's _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

std::string zsh_action(const Completion& completion) {
  switch (completion.kind) {
    case Completion::Kind::words:
      return fmt::format("({})", joined(completion.words));
    case Completion::Kind::settings:
      return fmt::format("compadd -S \"\" {}", joined(completion.words));
    case Completion::Kind::scenes:
      return "_files -g \"*.toml\"";
    case Completion::Kind::files:
      return "_files";
    case Completion::Kind::directories:
      return "_files -/";
    case Completion::Kind::nothing:
      break;
  }
  return " ";
}

std::string zsh_command(const CLI::App& command) {
  std::string text = fmt::format("    {})\n      _arguments -s", command.get_name());
  for (const OptionText& option : options_of(command)) {
    const std::string action = zsh_action(completion_of(command.get_name(), option));
    if (option.positional()) {
      const bool many = option.value.ends_with("...");
      text += fmt::format(" \\\n        '{}:{}:{}'", many ? "*" : "", zsh_text(option.value), action);
      continue;
    }
    const std::string value =
        option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), action);
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n        '{}{}[{}]{}'", value.empty() ? "" : "*", name,
                          zsh_text(option.description), value);
  }
  return text + " ;;\n";
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> names = {"help"};
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    names.push_back(command->get_name());
    cases += bash_command(*command);
  }
  return fmt::format(R"(# bash completion of signorini; made by: signorini completion bash
_signorini_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}}
_signorini_files() {{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f "$@" -- "$word"; compgen -d -- "$word")
}}
_signorini() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _signorini_words '{} --help --version'
    return
  fi
  case ${{COMP_WORDS[1]}} in
    help) _signorini_words '{}' ;;
{}  esac
}}
complete -F _signorini signorini
)",
                     joined(names), joined(names), cases);
}

std::string zsh_completion(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    cases += zsh_command(*command);
  }
  return fmt::format(R"(#compdef signorini
# zsh completion of signorini; made by: signorini completion zsh
_signorini() {{
  local -a commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{}  esac
}}
_signorini "$@"
)",
                     names, cases);
}

void add_completion(Program& program) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      program.app.add_subcommand("completion", "print a script with which a shell completes command lines");
  command->add_option("SHELL", *shell, "bash or zsh")->required();
  command->callback([&program, shell] {
    program.action = [&program, shell] {
      if (*shell != "bash" && *shell != "zsh")
        throw UsageError(fmt::format("found the shell \"{}\", expected bash or zsh", *shell));
      print(*shell == "bash" ? bash_completion(program.app) : zsh_completion(program.app));
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
