// main.cpp: the program `signorini`. Parses the command line and converts every outcome to an exit code.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"

namespace signorini::cli {

namespace {

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

bool knows(const CLI::App& command, const std::string& option) {
  for (const CLI::Option* known : command.get_options())
    if (known->check_name(option)) return true;
  return false;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// Suggests an option for an unknown one: an option that begins with the given name, else a similar option.
std::string meant(const std::string& given, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (given.size() > 3 && name.starts_with(given)) return "; did you mean \"" + name + "\"?";
  return base::did_you_mean(given, names);
}

/// Message about the first unexpected argument of a command: an unknown option, else another argument; "" without any.
std::string unexpected(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  const auto option = std::find_if(rest.begin(), rest.end(), [&](const std::string& text) {
    return text.size() > 1 && text[0] == '-' && !knows(command, text.substr(0, text.find('=')));
  });
  if (option == rest.end())
    return rest.empty() ? ""
                        : fmt::format("{}: unexpected argument \"{}\"", command.get_name(), rest.front());
  const std::string name = option->substr(0, option->find('='));
  const std::vector<std::string> names = option_names(command);
  std::string text = fmt::format("{}: no option {}", command.get_name(), name);
  if (name == "--engine" && knows(command, "--set")) return text + "; use --set run.engine=NAME";
  return text + meant(name, names);
}

// Prints CLI11's message and returns the program's exit code (docs/command-line.md); CLI11's codes start at 100.
int parse_failure(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {  // --help, --version
    std::ostringstream text;
    app.exit(error, text, text);
    print(text.str());
    return code(ExitCode::done);
  }
  const std::vector<const CLI::App*> asked =
      app.get_subcommands([](const CLI::App* sub) { return sub->parsed(); });
  const CLI::App& command = asked.empty() ? app : *asked.front();
  const bool extras = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  std::string message = extras ? unexpected(command) : "";
  if (message.empty()) message = error.what();
  print_error(message + "\nsee " + app.get_name() + (asked.empty() ? "" : " " + command.get_name()) +
              " --help");
  return code(ExitCode::usage);
}

/// Arguments after the program's name; "help NAME" becomes "NAME --help".
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> list(argv + std::min(argc, 1), argv + argc);
  if (list.empty() || list[0] != "help") return list;
  list.erase(list.begin());
  list.push_back("--help");
  return list;
}

int main_program(int argc, char** argv) {
  CLI::App app{"Motion of structures on unilateral frictional contacts, event by event", "signorini"};
  app.set_version_flag("--version", std::string("signorini ") + version + ", SUNDIALS " + sundials_version);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a bug, 2 wrong command line, 3 wrong scene, 4 stopped early, or verify "
      "cannot\ndecide, 5 a limit of compare was exceeded, verify found a difference, or witness found a "
      "violation,\n6 a file could not be read or written, 130 interrupted.");
  Program program{app, std::vector<std::string>(argv, argv + argc), {}};
  add_run(program);
  add_check(program);
  add_verify(program);
  add_orbit(program);
  add_sensitivity(program);
  add_fit(program);
  add_compare(program);
  add_witness(program);
  add_sweep(program);
  add_study(program);
  add_plot(program);
  add_report(program);
  add_paraview(program);
  add_new(program);
  add_quake(program);
  add_keys(program);
  add_schema(program);
  add_completion(program);
  add_man(program);
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  std::vector<std::string> line = arguments(argc, argv);
  if (!line.empty() && !line[0].starts_with('-') &&
      std::find(names.begin(), names.end(), line[0]) == names.end()) {
    throw UsageError(fmt::format("no command \"{}\"{}\nsee {} --help", line[0],
                                 base::suggestion(line[0], names), app.get_name()));
  }
  std::reverse(line.begin(), line.end());  // CLI11 expects the arguments in reverse order
  try {
    app.parse(std::move(line));
  } catch (const CLI::ParseError& error) {
    return parse_failure(app, error);
  }
  return code(program.action());
}

}  // namespace

}  // namespace signorini::cli

int main(int argc, char** argv) {
  using namespace signorini;
  cli::open_closed_streams();
  cli::end_on_interrupt();
  std::signal(SIGXFSZ, SIG_IGN);  // so that a write beyond the file size limit fails with a message
  try {
    return cli::main_program(argc, argv);
  } catch (const Error& error) {
    cli::print_error(error.what());
    return static_cast<int>(error.code());
  } catch (
      const std::filesystem::filesystem_error& error) {  // the current directory was deleted, for example
    cli::print_error(error.path1().string() + (error.path1().empty() ? "the current directory: " : ": ") +
                     error.code().message());
    return static_cast<int>(ExitCode::file);
  } catch (const std::bad_alloc&) {
    cli::print_error("out of memory");
  } catch (const std::exception& error) {
    cli::print_error(std::string("a bug in Signorini: ") + error.what());
  }
  return static_cast<int>(ExitCode::bug);
}
