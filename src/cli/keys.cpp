// signorini keys [WORD...]: lists all keys of a scene file, or those whose description contains the words, from the
// reader's own table.
#include <memory>

#include "cli/command.hpp"
#include "cli/key_reference.hpp"
#include "cli/terminal.hpp"

namespace signorini::cli {

void add_keys(Program& program) {
  auto markdown = std::make_shared<bool>(false);
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = program.app.add_subcommand("keys", "list the keys of a scene file");
  command->add_option("WORD", *words,
                      "list only keys whose description contains all these words (upper or lower case)");
  command->add_flag("--markdown", *markdown, "print docs/scene.md, the reference with examples");
  command->callback([&program, markdown, words] {
    program.action = [markdown, words] {
      if (*markdown && !words->empty()) throw UsageError("--markdown: prints all keys, expected no WORD");
      print(*markdown ? scene_reference() : key_list(*words));
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
