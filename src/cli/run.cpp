// signorini run SCENE: computes a scene and writes a directory of results.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/run_text.hpp"
#include "cli/terminal.hpp"
#include "model/modes/frequencies.hpp"
#include "result/instants.hpp"
#include "result/plots.hpp"
#include "run/choose_engine.hpp"
#include "run/cost_estimate.hpp"
#include "signorini/certify.hpp"
#include "study/prepared_run.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct RunOptions : OutputOptions {
  std::string scene, engine;
  std::optional<std::string> directory, trace;
  std::vector<std::string> settings;
  bool certify = false, instants = false;
  std::string table;
};

fs::path directory_of(const RunOptions& options) {
  if (!options.directory) return fs::path(options.scene).stem().string() + "-run";
  if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
  return *options.directory;
}

ExitCode conclude(const Outcome& outcome, const Units& units, const fs::path& directory) {
  const std::string kept = "the results so far are kept in " + directory.string();
  switch (outcome.kind) {
    case Outcome::Kind::done:
      return ExitCode::done;
    case Outcome::Kind::stopped:
      print_error(fmt::format("the computation stopped early, at t = {:.9g} {}: {}; {}", outcome.t,
                              units.time, outcome.reason, kept));
      return ExitCode::stopped;
    case Outcome::Kind::interrupted:
      print_error(fmt::format("interrupted at t = {:.9g} {}; {}", outcome.t, units.time, kept));
      return ExitCode::interrupted;
  }
  return ExitCode::bug;
}

/// Joins tables with an empty line between them.
std::string stacked(const std::vector<std::string>& tables) {
  std::string text;
  for (const std::string& table : tables)
    if (!table.empty()) text += (text.empty() ? "" : "\n") + table;
  return text;
}

/// Text that a run prints at its end. events: table of events; pictures: the run has written data for pictures.
std::string certificate_text(const Scene& scene, const Model& model, const CertifiedReport& certified,
                             const std::string& events, const fs::path& path, bool pictures) {
  const Report& report = certified.report;
  const std::string tables =
      stacked({support_table(model, report), response_table(model, report), start_table(model), events,
               contact_table(model, report), run_summary(scene.run, model, report)});
  std::string frames = scene.run.frames.empty() ? "" : "frames.csv, frame_contacts.csv, ";
  if (!frames.empty() && !scene.bodies.empty()) frames += "frame_bodies.csv, ";
  if (!frames.empty() && !scene.seams.empty()) frames += "frame_seams.csv, ";
  const std::string response = model.outputs.empty() ? "" : "response.csv, ";
  return (scene.title.empty() ? "" : scene.title + "\n\n") + tables + certification_text(model, certified) +
         reduction_text(model, certified) + "results: " + path.string() + "/ (events.csv, history.csv, " +
         response +
         (pictures ? "contacts.csv, motion.csv, energy.csv, curves.csv, " : "contacts.csv, energy.csv, ") +
         (pictures && !scene.bodies.empty() ? "body_motion.csv, " : "") + frames +
         "summary.json, run.toml)\n";
}

/// Suggestion of another engine or a reduction for a run that is expected to take `seconds`; empty if none is much
/// faster.
std::string faster_settings_advice(const Scene& scene, const Model& model, double seconds) {
  constexpr double time_of_trial = 0.2;  // s, for each engine and cutoff
  const Engine own = run::choose_engine(model, scene.run).engine;
  std::vector<double> cutoffs;
  if (!scene.reduction) {
    const auto modes =
        modes::lowest_frequencies(
            model.mass, model.damping, model.stiffness,
            modes::constrain_contacts(model.contacts, std::vector<bool>(model.contacts.size(), true)), 1)
            .modes;
    const double cutoff = modes.empty() ? 0.0 : run::cutoff_to_try(modes.front().omega, model.omega_max);
    if (cutoff > 0.0) cutoffs.push_back(cutoff);
  }
  return run::faster_engine_advice(run::trials(scene, model, own, cutoffs, time_of_trial), own, seconds);
}

ExitCode run(const RunOptions& options, const std::vector<std::string>& command_line) {
  std::vector<Override> changes = overrides_of(options.settings);
  if (!options.engine.empty()) changes.push_back(engine_override(options.engine, "--engine"));
  if (options.certify) changes.push_back({"run.certify", "true", "--certify"});
  const TableStyle style = table_style_of(options.table, options);
  const bool plain = style == TableStyle::plain;
  const fs::path path = directory_of(options);
  const study::PreparedRun prepared =
      study::prepare_run(options.scene, changes, [] { return !Interrupt::requested(); });
  const Scene& scene = prepared.scene;
  const Model& model = prepared.model;
  if (!options.quiet) print_patterns(options.scene, options.settings);
  const auto trace = options.trace ? std::make_unique<result::TraceWriter>(*options.trace, model) : nullptr;
  RoundListener listener;
  if (trace) listener = [&](const DecisionRound& round) { trace->write(round); };
  result::RunDirectory directory(path, scene, model,
                                 {options.force, command_line, options.instants, !options.no_plots});

  study::StoredRun kept;
  const CertifiedReport& certified = kept.certified;
  const Report& report = certified.report;
  std::string events;
  {
    ProgressDisplay live(directory, model, scene.run.t_end, !options.quiet, !plain);
    if (!options.quiet && stderr_is_terminal())
      live.set_long_run_advice([&](double seconds) { return faster_settings_advice(scene, model, seconds); });
    kept = prepared.run_to_disk(directory, live,
                                CertifyOptions{listener, [] { return !Interrupt::requested(); }});
    if (options.tables() || !plain)
      events = event_table(live, model, certified.certificate ? &*certified.certificate : nullptr, style);
  }
  print_warnings(options, report.warnings);

  if (options.json) print(kept.summary);
  if (!plain) {
    print(stacked({support_table(model, report, style), response_table(model, report, style),
                   start_table(model, style), events, contact_table(model, report, style),
                   audit_table(model, report.audit, style)}));
  } else if (options.tables()) {
    print(certificate_text(scene, model, certified, events, path, !options.no_plots));
  }
  const bool pictures = !options.no_plots && report.outcome.kind != Outcome::Kind::interrupted;
  const std::string drawn =
      pictures ? draw_pictures(path, result::write_plots(path), " (signorini plot draws them later)") : "";
  if (options.tables() && plain) print(drawn);
  return conclude(report.outcome, scene.units, path);
}

}  // namespace

void add_run(Program& program) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.app.add_subcommand("run", "compute a scene and write a directory of results");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the results (default: SCENE's name with -run)")
      ->option_text("DIR");
  command->add_option("--engine", options->engine, "time integration, instead of the scene's run.engine")
      ->option_text("NAME");
  add_settings(*command, options->settings);
  command->add_flag("--certify", options->certify,
                    "also compute a companion run: error bounds of event times and the certified part of the "
                    "sequence (same as --set run.certify=true)");
  command
      ->add_option("--trace", options->trace,
                   "write the steps of each decision on contact states: one JSON object per round")
      ->option_text("FILE");
  command->add_flag(
      "--instants", options->instants,
      "write the state just before and just after every instant to instants.csv, for `signorini witness`");
  add_table_option(*command, options->table);
  add_output_options(*command, *options,
                     "replace an earlier run in the directory; refused if the scene file is in it",
                     "summary.json");
  command->callback([&program, options] {
    program.action = [options, line = program.command_line] { return run(*options, line); };
  });
}

}  // namespace signorini::cli
