// signorini compare: compares engines on one scene, or existing runs.

#include <fmt/core.h>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"
#include "study/compare/comparison_files.hpp"
#include "study/compare/comparison_plots.hpp"
#include "study/prepared_run.hpp"

namespace signorini::cli {

// Output of `compare`: a table of the runs, then the differences of each run from the reference.

[[nodiscard]] std::string compare_text(const compare::ComparisonReport& report);
/// The tables of compare_text() without other text, in a style for papers.
[[nodiscard]] std::string compare_tables(const compare::ComparisonReport& report, TableStyle style);

namespace {

std::string count(const std::optional<long>& value) { return value ? std::to_string(*value) : ""; }

std::string relative(const compare::RunFigures& run, const char* name) {
  const auto found = run.audit.find(name);
  return found == run.audit.end() ? "" : fmt::format("{:.1e}", found->second);
}

std::string run_table(const compare::ComparisonReport& report, TableStyle style = TableStyle::plain) {
  const result::RunFacts& facts = report.runs.front().figures.facts;
  const std::string energy = " [" + facts.units.force + " " + facts.units.length + "]";
  Table table({"run", "outcome", "events", "wall [s]", "steps", "factorisations", "friction loss" + energy,
               "balance", "|T| > T_U", "equilibrium"},
              {false, false, true, true, true, true, true, true, true, true});
  for (const compare::ComparedRun& compared : report.runs) {
    const compare::RunFigures& run = compared.figures;
    table.row({run.name, run.facts.outcome, std::to_string(count_state_changes(run.events_by_type)),
               run.wall_time ? fmt::format("{:.3f}", *run.wall_time) : "", count(run.steps),
               count(run.factorisations), run.friction ? fmt::format("{:.9g}", *run.friction) : "",
               relative(run, "energy"), relative(run, "friction"), relative(run, "equilibrium")});
  }
  for (const auto& [name, reason] : report.refused)
    table.row({name, "refused", "", "", "", "", "", "", "", ""});
  std::string text = table.str(style);
  if (style != TableStyle::plain) return text;
  for (const compare::ComparedRun& compared : report.runs)
    if (!compared.figures.reason.empty())
      text += fmt::format("  {}: {} at t = {:.9g}: {}\n", compared.figures.name,
                          compared.figures.facts.outcome, compared.figures.t, compared.figures.reason);
  for (const auto& [name, reason] : report.refused) text += fmt::format("  {}: refused: {}\n", name, reason);
  return text;
}

/// Note with the end of the compared time, if one of the two runs stopped early or the runs have different ends.
std::string up_to(const compare::ComparisonReport& report, std::size_t i) {
  const compare::RunFigures &a = report.runs.front().figures, &b = report.runs[i + 1].figures;
  if (a.done() && b.done() && a.t == b.t) return "";
  return fmt::format(" up to t = {:.9g}", report.comparisons[i].t_end);
}

std::string sequence(const compare::ComparisonReport& report, std::size_t i) {
  const compare::Alignment& alignment = report.comparisons[i].alignment;
  const std::size_t pairs = alignment.pairs.size();
  std::string text =
      alignment.split
          ? fmt::format(
                "{} in common, first difference at t = {:.9g}: {}; {} without counterpart from this time on",
                base::count_text(pairs, "event"), alignment.split->t,
                compare::split_text(report.runs.front(), report.runs[i + 1], *alignment.split),
                base::count_text(alignment.split->unaligned, "event"))
          : fmt::format("the same, {}", base::count_text(pairs, "event")) + up_to(report, i);
  if (alignment.swapped > 0)
    text += fmt::format("; {} swapped with events of other contacts, within the uncertainties of the times",
                        base::count_text(alignment.swapped, "event"));
  return text;
}

std::string place(const compare::MaxDifference& greatest, std::vector<std::string>& cells) {
  cells.push_back(fmt::format("{:.3g}", greatest.value));
  cells.push_back(greatest.value == 0.0 ? "" : fmt::format("{:.9g}", greatest.t));
  return greatest.where;
}

std::string difference_table(const compare::ComparisonReport& report, std::size_t i,
                             TableStyle style = TableStyle::plain) {
  const compare::Comparison& c = report.comparisons[i];
  const Units& units = report.runs.front().figures.facts.units;
  const bool split = c.alignment.split.has_value();
  const std::string at = "at t [" + units.time + "]";
  std::vector<std::string> header = {"greatest difference", "unit", "value", at, "where"};
  std::vector<bool> right = {false, false, true, true, false};
  if (split) {
    header.insert(header.end(), {"before the split", at});
    right.insert(right.end(), {true, true});
  }
  if (c.common_times == 0 && c.event_time.count == 0) return "";
  Table table(std::move(header), std::move(right));
  for (const compare::Quantity& q : compare::quantities(c, units)) {
    if (q.deviation->count == 0) continue;
    std::string name = q.name;
    if (!name.starts_with("response:")) std::replace(name.begin(), name.end(), '_', ' ');
    if (q.name == "force_away") name = "force away from events";
    std::vector<std::string> cells = {name, q.unit};
    const std::string where = place(q.deviation->whole, cells);
    cells.push_back(q.deviation->whole.value == 0.0 ? "" : where);
    if (split) place(q.deviation->until_split, cells);
    table.row(std::move(cells));
  }
  return table.str(style);
}

}  // namespace

std::string compare_tables(const compare::ComparisonReport& report, TableStyle style) {
  std::string text = run_table(report, style);
  for (std::size_t i = 0; i < report.comparisons.size(); ++i)
    text += "\n" + difference_table(report, i, style);
  return text;
}

std::string compare_text(const compare::ComparisonReport& report) {
  const compare::RunFigures& reference = report.runs.front().figures;
  std::string text = reference.facts.title.empty() ? "" : reference.facts.title + "\n\n";
  text += run_table(report);
  for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
    text += fmt::format("\n{} against {}\n", report.comparisons[i].name, reference.name);
    text += "  sequence: " + sequence(report, i) + "\n";
    if (const std::string rows = compare::rows_compared(report.comparisons[i]); !rows.empty())
      text += "  rows compared: " + rows + "\n";
    for (const std::string& note : report.comparisons[i].notes) text += "  note: " + note + "\n";
    text += difference_table(report, i);
  }
  return text;
}

namespace {

namespace fs = std::filesystem;

struct CompareOptions : OutputOptions {
  std::vector<std::string> sources, engines, settings, limits;
  std::optional<std::string> directory;
  double instant = 0.0;
  std::string table;
};

/// A run to compare, given as "newmark:dt=1e-4": an engine, and keys of [run] for this run.
struct Variant {
  std::string engine;
  std::vector<Override> keys;
};

Variant variant_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  Variant variant{parts.empty() ? text : parts.front(), {}};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t equals = parts[i].find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--engines " + text + ": expected NAME:KEY=VALUE, such as newmark:dt=1e-4");
    variant.keys.push_back(
        {"run." + parts[i].substr(0, equals), parts[i].substr(equals + 1), "--engines " + text});
  }
  return variant;
}

/// Names of the engines in --engines, without keys. A setting "NAME:PATH=VALUE" of --set applies to one of these names.
std::vector<std::string> engines_of(const CompareOptions& options) {
  std::vector<std::string> names;
  for (const std::string& text : options.engines) names.push_back(variant_of(text).engine);
  return names;
}

Scene scene_for(const CompareOptions& options, const std::string& text) {
  const Variant variant = variant_of(text);
  std::vector<Override> changes = overrides_for(options.settings, engines_of(options), variant.engine);
  changes.insert(changes.begin(), engine_override(variant.engine));
  changes.insert(changes.end(), variant.keys.begin(), variant.keys.end());
  return read_scene(options.sources.front(), changes);
}

const ResultFolder& compare_folder() {
  static const ResultFolder folder = {
      "comparison",
      "compare.json",
      {"runs.csv", "differences.csv", "columns.csv", "events.csv", "report.html"}};
  return folder;
}

void begin(const fs::path& path) {
  begin_folder(path, compare_folder());
  compare::begin_comparison_plots(path);
}

struct Outcomes {
  compare::ComparisonReport report;
  bool interrupted = false, stopped = false;
};

void run_engine(const CompareOptions& options, const fs::path& path, const study::PreparedRun& run,
                const std::vector<std::string>& command_line, Outcomes& outcomes) {
  const std::string& engine = options.engines[outcomes.report.runs.size() + outcomes.report.refused.size()];
  result::RunDirectory directory(path / engine, run.scene, run.model, {options.force, command_line});
  Report report;
  try {
    ProgressDisplay live(directory, run.model, run.scene.run.t_end, !options.quiet);
    report = run.run_to_disk(directory, live).certified.report;
  } catch (const SceneError& error) {
    // An earlier run in this directory could be mistaken for the refused run.
    if (options.force) result::remove_run(path / engine);
    outcomes.report.refused.emplace_back(engine, error.what());
    return;
  }
  print_warnings(options, report.warnings, engine + ": ");
  outcomes.interrupted = report.outcome.kind == Outcome::Kind::interrupted;
  outcomes.stopped = outcomes.stopped || report.outcome.kind == Outcome::Kind::stopped;
  outcomes.report.runs.push_back(compare::read_compared_run(path / engine, engine));
}

Outcomes run_engines(const CompareOptions& options, const fs::path& path,
                     const std::vector<std::string>& command_line) {
  std::vector<study::PreparedRun> runs;  // all scenes are built first: an invalid scene leaves no files
  for (const std::string& engine : options.engines)
    runs.push_back(study::prepare_run(scene_for(options, engine),
                                      runs.empty() ? std::nullopt : runs.front().scene.reduction));
  begin(path);
  Outcomes outcomes;
  for (const study::PreparedRun& run : runs) {
    run_engine(options, path, run, command_line, outcomes);
    if (outcomes.interrupted) return outcomes;
    if (outcomes.report.runs.empty()) {  // the reference was refused: there is nothing to compare with
      undo_folder(path, compare_folder());
      throw Error(ExitCode::scene, "the reference, " + options.engines.front() +
                                       ", refuses the scene: " + outcomes.report.refused.front().second);
    }
  }
  return outcomes;
}

std::vector<std::string> names_of(const std::vector<std::string>& directories) {
  std::vector<std::string> names;
  for (std::string name : directories) {
    while (name.size() > 1 && name.back() == '/') name.pop_back();
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw UsageError("compare: " + name + " is given twice");
    names.push_back(name);
  }
  return names;
}

void check_units(const compare::ComparisonReport& report) {
  const Units& first = report.runs.front().figures.facts.units;
  for (const compare::ComparedRun& run : report.runs) {
    const Units& units = run.figures.facts.units;
    if (units.force == first.force && units.length == first.length && units.time == first.time) continue;
    throw FileError(
        run.figures.directory.string(),
        fmt::format("has the units {}, {}, {}, expected those of the reference, {}, {}, {}", units.force,
                    units.length, units.time, first.force, first.length, first.time));
  }
}

Outcomes read_directories(const CompareOptions& options, const fs::path& path) {
  Outcomes outcomes;
  for (const std::string& name : names_of(options.sources))
    outcomes.report.runs.push_back(compare::read_compared_run(name, name));
  if (!options.quiet)
    for (const compare::ComparedRun& run : outcomes.report.runs) print_unchecked(run.figures.directory);
  check_units(outcomes.report);
  begin(path);
  return outcomes;
}

bool by_engine(const CompareOptions& options) { return !options.engines.empty(); }

void check_sources(const CompareOptions& options) {
  if (!(options.instant >= 0.0))
    throw UsageError(fmt::format("--instant: found {}, expected a time >= 0", options.instant));
  const auto& sources = options.sources;
  std::error_code error;
  if (by_engine(options)) {
    if (sources.size() != 1)
      throw UsageError(fmt::format("--engines: found {} scenes, expected one", sources.size()));
    for (std::size_t i = 0; i < options.engines.size(); ++i)
      if (std::count(options.engines.begin(), options.engines.end(), options.engines[i]) > 1)
        throw UsageError("--engines: " + options.engines[i] +
                         " is given twice; run this engine twice, and compare the two directories");
    if (options.engines.size() < 2)
      throw UsageError("--engines: found one engine, expected two or more, such as ida,exact");
    return;
  }
  if (!options.settings.empty()) throw UsageError("--set: existing runs cannot be changed");
  if (sources.size() >= 2) return;
  if (fs::is_directory(sources.front(), error))
    throw UsageError("compare: found one directory, expected two or more");
  throw UsageError("compare: found one scene, expected --engines with two or more, such as ida,exact");
}

fs::path output_directory(const CompareOptions& options) {
  if (options.directory) {
    if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
    return *options.directory;
  }
  fs::path first = options.sources.front();
  if (!first.has_filename()) first = first.parent_path();
  return (by_engine(options) ? first.stem() : first.filename()).string() + "-compare";
}

/// Refuses limits for outputs that the scene does not have, before any run starts.
void check_outputs(const std::vector<compare::Limit>& limits, const std::vector<OutputSpec>& outputs) {
  const std::string response = "response:";
  std::vector<std::string> names;
  for (const OutputSpec& output : outputs) names.push_back(output.name);
  for (const compare::Limit& limit : limits) {
    const std::string name = limit.name.starts_with(response) ? limit.name.substr(response.size()) : "";
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("--limit {}: no [[output]] is called \"{}\"{}", limit.name, name,
                                   base::suggestion(name, names)));
  }
}

ExitCode compare(const CompareOptions& options, const std::vector<std::string>& command_line) {
  const std::vector<compare::Limit> limits = compare::parse_limits(options.limits);
  const TableStyle style = table_style_of(options.table, options);
  check_sources(options);
  if (by_engine(options)) check_outputs(limits, read_scene(options.sources.front()).outputs);
  const fs::path path = output_directory(options);
  check_folder(path, compare_folder(), options.force, by_engine(options) ? options.sources.front() : "");
  if (by_engine(options) && !options.quiet) print_patterns(options.sources.front(), options.settings);
  Outcomes outcomes =
      by_engine(options) ? run_engines(options, path, command_line) : read_directories(options, path);
  if (outcomes.interrupted) {
    print_error("interrupted; the runs are kept in " + path.string());
    return ExitCode::interrupted;
  }
  compare::ComparisonReport& report = outcomes.report;
  report.limits = limits;
  for (std::size_t i = 1; i < report.runs.size(); ++i) {
    const compare::ComparedRun& run = report.runs[i];
    compare::ComparisonSettings settings;
    settings.instant = options.instant;
    settings.folder = path / "plots";
    settings.slug = compare::run_slug(run.figures.name, i);
    report.comparisons.push_back(compare::compare_runs(report.runs.front(), run, settings));
    for (std::string& sentence :
         compare::exceeded(limits, report.runs.front().figures, run.figures, report.comparisons.back()))
      report.exceeded.push_back(std::move(sentence));
  }
  if (!limits.empty())
    for (const auto& [name, reason] : report.refused)
      report.exceeded.push_back(name + ": refused the scene, so limits cannot be checked");
  compare::write_comparison(path, report);
  if (options.json) print(compare::comparison_json(report));
  if (style != TableStyle::plain) {
    print(compare_tables(report, style));
  } else if (options.tables()) {
    print(compare_text(report));
    print("\nresults: " + path.string() +
          "/ (compare.json, runs.csv, differences.csv, columns.csv, events.csv)\n");
  }
  const std::string drawn =
      options.no_plots ? "" : draw_pictures(path, compare::write_comparison_plots(path, report));
  if (options.tables() && style == TableStyle::plain) print(drawn);
  for (const std::string& sentence : report.exceeded) print_error("limit exceeded: " + sentence);
  if (!report.exceeded.empty()) return ExitCode::limit;
  if (!outcomes.stopped) return ExitCode::done;
  print_error("a computation stopped early; the results so far are kept in " + path.string());
  return ExitCode::stopped;
}

}  // namespace

void add_compare(Program& program) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      program.app.add_subcommand("compare", "compare engines, or existing runs, event by event");
  command
      ->add_option("SOURCE", options->sources, "a scene with --engines, or two or more directories of runs")
      ->required();
  command
      ->add_option("--engines", options->engines,
                   "engines to compare; the first is the reference. Example: ida,exact. Keys of [run] may "
                   "follow: newmark:dt=1e-4,newmark:dt=5e-5")
      ->option_text("NAME,NAME...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("-o,--output", options->directory, "directory of the comparison (default: SOURCE-compare)")
      ->option_text("DIR");
  add_settings(*command, options->settings);
  command
      ->add_option("--limit", options->limits,
                   "end with exit code 5 if a difference is above the given limit, for example "
                   "event_time=1e-4 (may be repeated)")
      ->option_text("NAME=NUMBER")
      ->allow_extra_args(false);
  command
      ->add_option("--instant", options->instant,
                   "treat events of different contacts as simultaneous if they are at most T apart")
      ->option_text("T");
  add_table_option(*command, options->table);
  add_output_options(*command, *options, "replace an earlier comparison in the directory", "compare.json");
  command->callback([&program, options] {
    program.action = [options, line = program.command_line] { return compare(*options, line); };
  });
}

}  // namespace signorini::cli
