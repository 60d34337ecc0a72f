// signorini man [COMMAND]: pages for man(1), from the program's options.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "base/suggest.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"

namespace signorini::cli {

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
  throw UsageError(fmt::format("no command \"{}\"{}", name, suggestion(name, names)));
}

/// Writes all pages, and prints their names.
void write_pages(const CLI::App& app, const fs::path& folder) {
  std::vector<const CLI::App*> pages = commands_of(app);
  pages.insert(pages.begin(), nullptr);
  for (const CLI::App* command : pages) {
    const fs::path path = folder / (page_name(command) + ".1");
    write_file(path, man_page(app, command));
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

}  // namespace signorini::cli
