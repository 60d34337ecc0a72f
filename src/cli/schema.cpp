// signorini schema: prints a JSON Schema of scenes, for editors.
#include "scene/schema.hpp"

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/terminal.hpp"

namespace signorini::cli {

void add_schema(Program& program) {
  CLI::App* command = program.app.add_subcommand(
      "schema", "print a JSON Schema for scene files; editors use it for completion and checks");
  command->callback([&program] {
    program.action = [] {
      print(scene_schema());
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
