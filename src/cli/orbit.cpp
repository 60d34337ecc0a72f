// signorini orbit SCENE: finds a periodic motion of a scene, and its stability.

#include <fmt/core.h>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "orbit/orbit_engine.hpp"
#include "result/picture_files.hpp"
#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "scene/units.hpp"
#include "signorini/certify.hpp"
#include "signorini/orbit.hpp"
#include "signorini/output.hpp"
#include "study/orbit/branch_files.hpp"
#include "study/orbit/orbit_files.hpp"

namespace signorini::cli {

// signorini orbit SCENE --over PATH=FROM:TO: follows a branch of orbits while a key varies from FROM to TO.

/// Parses PATH=FROM:TO. Errors: UsageError.
void read_over(const std::string& text, BranchOptions& options);

/// Follows a branch and writes its results to `path`. scene: the scene file; resume: continues the branch in `path`.
/// Errors: those of continue_branch(), FileError.
[[nodiscard]] ExitCode run_over(const std::string& scene, const SceneReader& read, BranchOptions over,
                                const std::filesystem::path& path, const OutputOptions& options, bool resume);

namespace {

namespace fs = std::filesystem;

const ResultFolder& branch_folder() {
  static const ResultFolder folder{"branch", "branch.json", {"branch.csv"}};
  return folder;
}

class BranchWatch final : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return !Interrupt::requested(); }
};

/// Writes the checkpoints DIR/last while the branch is followed; writing takes a limited fraction of the time.
class CheckpointWriter {
 public:
  /// before: number of points of the resumed branch.
  CheckpointWriter(const fs::path& path, const SceneReader& read, const BranchOptions& over,
                   std::size_t before)
      : path_(path), read_(read), over_(over), before_(before) {}

  void write_if_due(const std::function<BranchCheckpoint()>& make) {
    const auto begin = Clock::now();
    if (written_ && begin - *written_ < checkpoint_interval_factor * took_) return;
    write(make());
    written_ = Clock::now();
    took_ = *written_ - begin;
  }
  void write(BranchCheckpoint checkpoint) const {
    checkpoint.point_count += before_;
    orbit_study::write_checkpoint(path_, read_, over_, checkpoint);
  }

 private:
  using Clock = std::chrono::steady_clock;
  // Least time between two checkpoints, divided by the time to write a checkpoint. Chosen value.
  static constexpr int checkpoint_interval_factor = 20;

  const fs::path& path_;
  const SceneReader& read_;
  const BranchOptions& over_;
  std::size_t before_;
  std::optional<Clock::time_point> written_;
  Clock::duration took_{};
};

/// Table of the branch: its first point, its special points and its last point; then its side branches.
std::string branch_table(const BranchOptions& over, const Branch& branch) {
  Table table({over.path, "period", "amplitude", "multiplier", "stable", "events", "special"},
              {true, true, true, true, false, true, false});
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const BranchPoint& p = branch.points[i];
    if (p.special.empty() && i > 0 && i + 1 < branch.points.size()) continue;
    table.row({fmt::format("{:.9g}", p.parameter), fmt::format("{:.9g}", p.period), number(p.amplitude),
               number(p.max_multiplier),
               !p.stable   ? "?"
               : *p.stable ? "yes"
                           : std::string("no, ") + to_string(p.loss),
               std::to_string(p.events), p.special});
  }
  std::string text = table.str();
  for (const SideBranch& side : branch.sides)
    text += fmt::format("branch {} leaves branch {} at a {}, {} = {:.9g}: {}\n", side.number, side.from,
                        side.kind, over.path, side.parameter, side.end);
  return text;
}

}  // namespace

void read_over(const std::string& text, BranchOptions& options) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = equals == std::string::npos ? equals : text.find(':', equals);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](std::size_t begin, std::size_t end) {
    return colon == std::string::npos ? none
                                      : base::parse_number(text.substr(begin, end - begin)).value_or(none);
  };
  const double from = value(equals + 1, colon), to = value(colon + 1, text.size());
  if (equals == 0 || !(from < to || to < from))
    throw UsageError(fmt::format("--over {}: expected PATH=FROM:TO, two different numbers", text));
  options.path = text.substr(0, equals);
  options.from = from;
  options.to = to;
}

ExitCode run_over(const std::string& scene, const SceneReader& read, BranchOptions over, const fs::path& path,
                  const OutputOptions& options, bool resume) {
  if (!resume) check_folder(path, branch_folder(), options.force, scene);
  const Scene first = orbit::branch_reader(read, over.path, over.from)({});
  std::vector<std::string> outputs;
  for (const OutputSpec& output : first.outputs) outputs.push_back(output.name);
  std::vector<BranchPoint> before;
  if (resume) {
    over.resume_from = orbit_study::read_checkpoint(path, read, over);
    before = orbit_study::read_branch(path, outputs.size(), over.resume_from->point_count);
  } else {
    begin_folder(path, branch_folder());
    orbit_study::remove_checkpoint(path);
  }
  orbit_study::BranchWriter writer(path, outputs);
  std::optional<Interrupt> interrupt(std::in_place);
  BranchWatch watch;
  for (const BranchPoint& point : before) writer.add(point);
  CheckpointWriter checkpoints(path, read, over, before.size());
  over.on_checkpoint = [&checkpoints](const std::function<BranchCheckpoint()>& make) {
    checkpoints.write_if_due(make);
  };
  Branch branch = continue_branch(read, over, &watch, [&](const BranchPoint& point) { writer.add(point); });
  branch.points.insert(branch.points.begin(), before.begin(), before.end());
  if (branch.last && !branch.complete) checkpoints.write(*branch.last);
  const std::string json = orbit_study::branch_json(over, first.units, branch);
  result::write_file(path / "branch.json", json);
  std::vector<std::string> labels;
  for (const OutputSpec& output : first.outputs) {
    const std::string unit = unit_text(scene::unit_of_output(output, first.outputs), first.units);
    labels.push_back(output.name + (unit.empty() ? "" : " [" + unit + "]"));
  }
  result::clear_plot_folder(path / "plots", orbit_study::is_picture_of_branch);
  const std::vector<fs::path> scripts =
      options.no_plots
          ? std::vector<fs::path>()
          : orbit_study::branch_pictures(first.title, first.units, over, labels, branch).write(path);
  if (options.json) print(json);
  if (options.tables())
    print(branch_table(over, branch) +
          fmt::format("\n{} points: {}\nresults: {}/ (branch.csv, branch.json)\n", branch.points.size(),
                      branch.end, path.string()));
  interrupt.reset();  // everything is kept: from here on, while pictures are drawn, a signal ends the program
  if (Interrupt::requested()) {
    print_error("interrupted; the points up to here are kept in " + path.string());
    return ExitCode::interrupted;
  }
  const std::string drawn =
      scripts.empty() ? "" : draw_pictures(path, scripts, " (gnuplot, once installed, draws them)");
  if (options.tables()) print(drawn);
  if (!branch.complete) print_error("the branch ends early: " + branch.end);
  return branch.complete ? ExitCode::done : ExitCode::stopped;
}

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

/// Recorder that stops the search on an interrupt.
class SearchWatch final : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return !Interrupt::requested(); }
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
  if (orbit.multipliers.empty()) return "stability: unknown: " + orbit.reason + "\n";
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
  for (const std::string& family : orbit.families) text += "this orbit is one of a family: " + family + "\n";
  text += cycle_line(model, orbit);
  return text + "results: " + path.string() + "/ (orbit.json, and a run of one period)\n";
}

ExitCode not_found(const OrbitCommand& options, const Orbit& orbit) {
  if (Interrupt::requested()) {
    print_error("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  print_error(fmt::format("no orbit found in {}: {}", options.scene, orbit.reason));
  return ExitCode::stopped;
}

void set_steps(const OrbitCommand& options, BranchOptions& over) {
  if (options.step && !(*options.step > 0.0 && *options.step <= 1.0))
    throw UsageError(
        fmt::format("--step: found {:g}, expected a fraction of the range, > 0 and <= 1", *options.step));
  if (options.most_points && *options.most_points < 1)
    throw UsageError(fmt::format("--most-points: found {}, expected an integer >= 1", *options.most_points));
  if (options.switches && *options.switches < 0)
    throw UsageError(fmt::format("--switch: found {}, expected an integer >= 0", *options.switches));
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
    throw UsageError("--step, --most-points, --switch: apply only to branches; add --over PATH=FROM:TO");
  if (options.resume) throw UsageError("--resume: applies only to branches; add --over PATH=FROM:TO");
  result::check_run_directory(path, options.force);
  const SceneReader read = reader_of(options.scene, changes);
  if (!options.quiet) print_patterns(options.scene, options.settings);
  std::optional<Interrupt> interrupt(std::in_place);
  SearchWatch watch;
  const Orbit orbit = find_orbit(read, options.search, &watch);
  if (!orbit.found) return not_found(options, orbit);
  const Scene scene = orbit_study::scene_starting_from(orbit_scene(read, orbit), path);
  const Model model = build_model(scene);
  result::RunDirectory directory(path, scene, model, {options.force, command_line, false, !options.no_plots});
  const CertifiedReport certified =
      simulate_certified(model, scene.run, directory, {{}, [] { return !Interrupt::requested(); }});
  orbit_study::write_orbit(path, scene, model, orbit);
  directory.finish(certified);
  print_warnings(options, certified.report.warnings);
  if (options.json) print(orbit_study::orbit_json(model, orbit));
  if (options.tables()) print(text_of(scene, model, orbit, path));
  interrupt.reset();  // everything is kept: from here on, while pictures are drawn, a signal ends the program
  if (Interrupt::requested()) {
    print_error("interrupted; the orbit and its run are kept in " + path.string());
    return ExitCode::interrupted;
  }
  const bool done = certified.report.outcome.kind == Outcome::Kind::done;
  std::vector<fs::path> scripts;
  if (!options.no_plots && done) {
    scripts = result::write_plots(path);
    for (fs::path& more : orbit_study::orbit_pictures(path, scene.title, scene.units, orbit).write(path))
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
      ->add_option(
          "--step", options->step,
          "with --over: greatest step from point to point, as a fraction of the range (default: 0.02)")
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
