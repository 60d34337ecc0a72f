// signorini completion bash|zsh: a script that completes commands, options, scenes and settings.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"

namespace signorini::cli {

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

/// Completions after one command: values of its options, its options, its first argument.
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

/// Text in single quotes, without characters that _arguments interprets.
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
