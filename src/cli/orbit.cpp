// signorini orbit SCENE: finds a periodic motion of a scene, and its stability.
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/gnuplot.hpp"
#include "cli/interrupt.hpp"
#include "cli/orbit_over.hpp"
#include "cli/settings.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "signorini/certify.hpp"
#include "study/orbit/orbit_files.hpp"
#include "study/orbit/orbit_pictures.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct OrbitCommand : OutputOptions {
  std::string scene;
  std::optional<std::string> directory;
  std::vector<std::string> settings;
  OrbitOptions search;
  std::string over;
  std::optional<double> step;
  std::optional<int> most_points, switches;
  bool resume = false;
};

fs::path directory_of(const OrbitCommand& options) {
  if (!options.directory) return fs::path(options.scene).stem().string() + "-orbit";
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

/// Stops the search on an interrupt.
class SearchWatch final : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return !Interrupt::asked(); }
};

std::string multiplier_text(std::complex<double> mu) {
  return mu.imag() == 0.0
             ? fmt::format("{:.9g}", mu.real())
             : fmt::format("{:.9g} {} {:.9g} i", mu.real(), mu.imag() < 0.0 ? "-" : "+", std::abs(mu.imag()));
}

std::string multiplier_table(const Orbit& orbit) {
  constexpr std::size_t most = 12;
  Table table({"multiplier", "magnitude"}, {false, true});
  for (std::size_t i = 0; i < std::min(most, orbit.multipliers.size()); ++i)
    table.row({multiplier_text(orbit.multipliers[i]), fmt::format("{:.9g}", std::abs(orbit.multipliers[i]))});
  if (orbit.multipliers.size() > most)
    table.line(fmt::format("all {} are in orbit.json", orbit.multipliers.size()));
  return orbit.multipliers.empty() ? "" : table.str() + "\n";
}

std::string sequence_table(const Model& model, const Orbit& orbit) {
  constexpr std::size_t most = 20;
  Table table({"t [" + model.units.time + "]", "contact", "event", "from -> to"},
              {true, false, false, false});
  for (std::size_t i = 0; i < std::min(most, orbit.sequence.size()); ++i) {
    const Event& e = orbit.sequence[i];
    table.row({fmt::format("{:.9g}", e.t), model.contacts[static_cast<std::size_t>(e.contact)].name,
               to_string(e.type), fmt::format("{} -> {}", to_string(e.from), to_string(e.to))});
  }
  if (orbit.sequence.size() > most)
    table.line(fmt::format("all {} are in events.csv", orbit.sequence.size()));
  return orbit.sequence.empty() ? "no events\n\n" : table.str() + "\n";
}

std::string stability_line(const Orbit& orbit) {
  const std::string size =
      fmt::format("greatest multiplier {:.9g}, error {:.1g}", orbit.max_multiplier, orbit.multiplier_error);
  if (orbit.multipliers.empty()) return "stability: not known: " + orbit.reason + "\n";
  if (!orbit.stable)
    return "stability: undecided: a multiplier lies on the unit circle within its error (" + size + ")\n";
  return *orbit.stable ? "stable (" + size + ")\n"
                       : fmt::format("unstable, {} ({})\n", to_string(orbit.loss), size);
}

std::string cycle_line(const Model& model, const Orbit& orbit) {
  const Energy& e = orbit.cycle;
  return fmt::format(
      "per period: friction {:.9g}, damping {:.9g}, impacts {:.9g}; loads {:.9g}, surfaces {:.9g} {} {}\n",
      e.friction, e.damping, e.impact, e.loads, e.surface, model.units.force, model.units.length);
}

std::string text_of(const Scene& scene, const Model& model, const Orbit& orbit, const fs::path& path) {
  std::string text = scene.title.empty() ? "" : scene.title + "\n\n";
  text += sequence_table(model, orbit) + multiplier_table(orbit);
  text += fmt::format(
      "period {:.15g} {}{}, residual {:.2g} of the amplitude {:.6g} {} ({} steps of Newton's method)\n",
      orbit.period, model.units.time, orbit.autonomous ? " (of the motion itself)" : "", orbit.residual,
      orbit.amplitude, model.units.length, orbit.steps.size() - 1);
  text += stability_line(orbit);
  if (!orbit.multipliers.empty() && !orbit.reason.empty()) text += orbit.reason + "\n";
  for (const std::string& family : orbit.families) text += "one of a family of orbits: " + family + "\n";
  text += cycle_line(model, orbit);
  return text + "results: " + path.string() + "/ (orbit.json, and a run of one period)\n";
}

ExitCode not_found(const OrbitCommand& options, const Orbit& orbit) {
  if (Interrupt::asked()) {
    print_error("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  print_error(fmt::format("no orbit found in {}: {}", options.scene, orbit.reason));
  return ExitCode::stopped;
}

void set_steps(const OrbitCommand& options, BranchOptions& over) {
  if (options.step && !(*options.step > 0.0 && *options.step <= 1.0))
    throw UsageError("--step: expected a part of the range, above 0 and at most 1");
  if (options.most_points && *options.most_points < 1)
    throw UsageError("--most-points: expected an integer of at least 1");
  if (options.switches && *options.switches < 0)
    throw UsageError("--switch: expected an integer of at least 0");
  over.switches = options.switches.value_or(over.switches);
  over.step = options.step.value_or(over.step);
  over.most_points = options.most_points.value_or(over.most_points);
}

ExitCode run(const OrbitCommand& options, const std::vector<std::string>& command_line) {
  const std::vector<Override> changes = overrides_of(options.settings);
  const fs::path path = directory_of(options);
  if (!options.over.empty()) {
    BranchOptions over;
    read_over(options.over, over);
    over.orbit = options.search;
    set_steps(options, over);
    return run_over(options.scene, reader_of(options.scene, changes), over, path, options, options.resume);
  }
  if (options.step || options.most_points || options.switches)
    throw UsageError("--step, --most-points, --switch: expected --over, whose branch they are of");
  if (options.resume) throw UsageError("--resume: expected --over, whose branch it continues");
  check_run_directory(path, options.force);
  const SceneReader read = reader_of(options.scene, changes);
  if (!options.quiet) print_patterns(options.scene, options.settings);
  Interrupt interrupt;
  SearchWatch watch;
  const Orbit orbit = find_orbit(read, options.search, &watch);
  if (!orbit.found) return not_found(options, orbit);
  const Scene scene = scene_beginning_in(orbit_scene(read, orbit), path);
  const Model model = build_model(scene);
  RunDirectory directory(path, scene, model, {options.force, command_line, false, !options.no_plots});
  const CertifiedReport certified =
      simulate_certified(model, scene.run, directory, {{}, [] { return !Interrupt::asked(); }});
  write_orbit(path, scene, model, orbit);
  directory.finish(certified);
  print_warnings(options, certified.report.warnings);
  if (options.json) print(orbit_json(model, orbit));
  if (options.tables()) print(text_of(scene, model, orbit, path));
  const bool done = certified.report.outcome.kind == Outcome::Kind::done;
  std::vector<fs::path> scripts;
  if (!options.no_plots && done) {
    scripts = write_plots(path);
    for (fs::path& more : orbit_pictures(path, scene.title, scene.units, orbit).write(path))
      scripts.push_back(std::move(more));
  }
  const std::string drawn =
      scripts.empty() ? "" : draw_pictures(path, scripts, " (signorini plot draws them later)");
  if (options.tables()) print(drawn);
  if (!done) print_error("the run of one period stopped: " + certified.report.outcome.reason);
  return done ? ExitCode::done : ExitCode::stopped;
}

}  // namespace

void add_orbit(Program& program) {
  auto options = std::make_shared<OrbitCommand>();
  CLI::App* command =
      program.app.add_subcommand("orbit", "find the periodic motion of a scene, and whether it is stable");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the results (default: SCENE's name with -orbit)")
      ->option_text("DIR");
  command
      ->add_option("--period", options->search.period,
                   "period of the loads, in the scene's unit of time (default: from the loads). Without "
                   "periodic loads: first guess of the period")
      ->option_text("T");
  command
      ->add_option("--energy", options->search.energy,
                   "energy of a conservative motion, in the scene's units; --period is then a first guess")
      ->option_text("E");
  command->add_option("--times", options->search.times, "number of load periods in one period of the orbit")
      ->option_text("N");
  command
      ->add_option("--transient", options->search.transient,
                   "number of periods computed before Newton's method (default: 20)")
      ->option_text("N");
  command
      ->add_option("--over", options->over,
                   "follow the orbit while a key changes from FROM to TO; results in branch.csv")
      ->option_text("PATH=FROM:TO");
  command
      ->add_option("--switch", options->switches,
                   "with --over: number of consecutive changes to a branch that begins at a flip or at a "
                   "branch point (default: 0)")
      ->option_text("N");
  command
      ->add_option("--step", options->step,
                   "with --over: greatest step from point to point, as a part of the range (default: 0.02)")
      ->option_text("PART");
  command
      ->add_option("--most-points", options->most_points,
                   "with --over: number of points after which a branch ends (default: 1000)")
      ->option_text("N");
  command->add_flag("--resume", options->resume,
                    "with --over: continue the branch that ended early in the directory");
  add_settings(*command, options->settings);
  add_output_options(*command, *options, "replace an earlier orbit, or run, in the directory", "orbit.json");
  command->callback([&program, options] {
    program.action = [options, line = program.command_line] { return run(*options, line); };
  });
}

}  // namespace signorini::cli
