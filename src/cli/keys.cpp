// signorini keys: every key of a scene file, from the table that the reader itself uses.
#include <memory>

#include "cli/command.hpp"
#include "cli/key_reference.hpp"
#include "cli/terminal.hpp"

namespace signorini::cli {

void add_keys(Program& program) {
  auto markdown = std::make_shared<bool>(false);
  CLI::App* command = program.app.add_subcommand("keys", "list every key of a scene file");
  command->add_flag("--markdown", *markdown, "print docs/scene.md, the reference with examples");
  command->callback([&program, markdown] {
    program.action = [markdown] {
      print(*markdown ? scene_reference() : key_list());
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
