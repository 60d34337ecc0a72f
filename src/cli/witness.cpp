// signorini witness DIR: checks, using only the files of a run, whether the laws are satisfied at every instant.
#include <fmt/core.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "result/summary_parts.hpp"
#include "study/law_check/directory_law_checker.hpp"

namespace signorini::cli {

namespace {

struct WitnessOptions {
  std::string directory;
  bool json = false;
};

std::string text_of(const directory_check::DirectoryLawCheck& found, const std::string& directory) {
  std::string text;
  for (const Violation& v : found.law_checks.violations)
    text += fmt::format("t = {:<14.9g} {:<14} {:<12} {:<22} {:.4g}, limit {:.2g}\n", v.t,
                        v.event.empty() ? "-" : v.event,
                        v.contact < 0 ? "-" : found.model.contacts[static_cast<std::size_t>(v.contact)].name,
                        v.law, v.value, v.limit);
  if (const auto more = found.law_checks.violated - static_cast<long>(found.law_checks.violations.size());
      more > 0)
    text += fmt::format("and {} more\n", more);
  text += fmt::format("{}: {} instants, {} events, {} rows of contacts.csv: ", directory, found.instants,
                      found.events, found.rows);
  text += found.law_checks.violated == 0 ? "all laws hold\n"
                                         : fmt::format("{} violation{}\n", found.law_checks.violated,
                                                       found.law_checks.violated == 1 ? "" : "s");
  return text;
}

ExitCode check_laws_of_run(const WitnessOptions& options) {
  const directory_check::DirectoryLawCheck found = directory_check::check_directory_laws(options.directory);
  print_unchecked(options.directory);
  if (!found.complete)
    print_note(options.directory + ": the run is not complete; its files are checked up to their last rows");
  if (options.json) {
    base::Json json = {{"instants", found.instants},
                       {"events", found.events},
                       {"rows", found.rows},
                       {"ended", found.complete}};
    json.update(result::law_check_json(found.model, found.law_checks));
    print(base::json_text(json));
  } else {
    print(text_of(found, options.directory));
  }
  return found.law_checks.violated == 0 ? ExitCode::done : ExitCode::limit;
}

}  // namespace

void add_witness(Program& program) {
  auto options = std::make_shared<WitnessOptions>();
  CLI::App* command = program.app.add_subcommand(
      "witness",
      "check the contact laws at every instant of a run, using only its files (needs run --instants)");
  command->add_option("DIR", options->directory, "a directory that `signorini run --instants` wrote")
      ->required();
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback(
      [&program, options] { program.action = [options] { return check_laws_of_run(*options); }; });
}

}  // namespace signorini::cli
