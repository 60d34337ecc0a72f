// signorini check SCENE: all steps of `run` except the time loop, and their results.
#include <fmt/core.h>

#include <memory>
#include <sstream>

#include "base/number.hpp"
#include "cli/check_text.hpp"
#include "cli/command.hpp"
#include "cli/settings.hpp"
#include "cli/terminal.hpp"
#include "study/check/check.hpp"

namespace signorini::cli {

namespace {

struct CheckOptions {
  std::string scene, engine, reduction;
  std::vector<std::string> settings;
  bool json = false, columns = false;
};

/// Parses "50,100", in cycles per time.
std::vector<double> cutoffs_of(const std::string& text) {
  std::vector<double> list;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<double> value = parse_number(word);
    if (!value || !(*value > 0.0))
      throw UsageError(
          fmt::format("--reduction: found \"{}\", expected frequencies > 0, such as 50,100", word));
    list.push_back(*value);
  }
  return list;
}

ExitCode check_scene(const CheckOptions& options) {
  std::vector<Override> changes = overrides_of(options.settings);
  if (!options.engine.empty()) changes.push_back(engine_override(options.engine, "--engine"));
  const Scene scene = read_scene(options.scene, changes);
  const Model model = build_model(scene);
  print_patterns(options.scene, options.settings);
  CheckReport report = check(scene, model);
  measure_cost(scene, model, cutoffs_of(options.reduction), report);
  if (options.json) {
    print(check_json(scene, model, report));
    return ExitCode::done;
  }
  print(check_text(scene, model, report));
  if (options.columns) print(column_text(model));
  return ExitCode::done;
}

}  // namespace

void add_check(Program& program) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = program.app.add_subcommand(
      "check", "read a scene and compute its initial state: mass, reactions, frequencies, expected cost");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command->add_option("--engine", options->engine, "time integration, instead of the scene's run.engine")
      ->option_text("NAME");
  command
      ->add_option("--reduction", options->reduction,
                   "also try these cutoff frequencies of [reduction], in cycles per time")
      ->option_text("F,...");
  add_settings(*command, options->settings);
  command->add_flag("--columns", options->columns, "list the columns of history.csv too");
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback([&program, options] { program.action = [options] { return check_scene(*options); }; });
}

}  // namespace signorini::cli
