// command.hpp: registration of a subcommand.
//
// add_NAME() declares its options; if the command line names the subcommand, `action` is set to its function. Actions
// run after parsing, so their exceptions never pass through CLI11. A new subcommand is one file with one add_ function,
// and one line in main.cpp.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "signorini/error.hpp"

namespace signorini::cli {

struct Program {
  CLI::App& app;
  std::vector<std::string> command_line;
  std::function<ExitCode()> action;
};

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

}  // namespace signorini::cli
