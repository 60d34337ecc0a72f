// signorini study: measures run time against error, for several engines and settings.

#include <fmt/core.h>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "result/run_directory.hpp"
#include "study/speed/work_files.hpp"
#include "study/speed/work_plan.hpp"
#include "study/speed/work_study.hpp"

namespace signorini::cli {

// Output of `study`: a table of runs, the fastest run for each accuracy, and failures.

[[nodiscard]] std::string study_text(const speed::WorkReport& report);
/// The table of study_text() without other text, in a style for papers.
[[nodiscard]] std::string study_table(const speed::WorkReport& report, TableStyle style);

std::string study_table(const speed::WorkReport& report, TableStyle style) {
  speed::WorkTable content = speed::work_table(report);
  Table table(std::move(content.header), std::move(content.right));
  for (auto& row : content.rows) table.row(std::move(row));
  return table.str(style);
}

std::string study_text(const speed::WorkReport& report) {
  std::string text = report.title.empty() ? "" : report.title + "\n";
  text += speed::work_conditions(report) + "\n" + speed::work_reference(report) + "\n\n";
  text += study_table(report, TableStyle::plain) + "\n";
  for (const std::string& sentence : speed::work_conclusions(report)) text += sentence + "\n";
  for (const std::string& note : report.notes) text += "  note: " + note + "\n";
  for (const std::string& failure : speed::work_failures(report)) text += "  " + failure + "\n";
  return text;
}

namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of_engines() {
  std::vector<std::string> names;
  for (const EngineInfo& engine : all_engines) names.emplace_back(engine.name);
  return names;
}

/// Names of the engines with this kind of accuracy setting, such as "newmark, friction-iteration".
std::string engines_with(Accuracy accuracy) {
  std::string names;
  for (const EngineInfo& engine : all_engines)
    if (engine.accuracy == accuracy) names.append(names.empty() ? "" : ", ").append(engine.name);
  return names;
}

struct StudyOptions : OutputOptions {
  std::string scene;
  std::vector<std::string> engines = names_of_engines();
  std::optional<std::string> chosen;  // value of --engines: names separated by commas
  std::string rtol = "1e-4:1e-12";
  std::optional<std::string> dt, directory;
  std::vector<std::string> varied, settings;
  long repeats = 3;
  double time_limit = 60.0;
  std::string table;
};

const ResultFolder& study_folder() {
  static const ResultFolder folder = {"study", "study.json", {"study.csv", "study.md", "report.html"}};
  return folder;
}

/// Splits names at commas; an empty name results from a comma at an end or from two successive commas.
std::vector<std::string> names_between_commas(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text)
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  return names;
}

void check(const StudyOptions& options) {
  for (const std::string& engine : options.engines)
    if (engine.empty() || engine == to_string(Engine::automatic))
      throw UsageError("--engines: found \"" + (engine.empty() ? options.chosen.value_or("") : engine) +
                       "\", expected engines by name, such as exact,ida");
  for (const std::string& engine : options.engines)
    if (std::count(options.engines.begin(), options.engines.end(), engine) > 1)
      throw UsageError("--engines: " + engine + " is given twice");
  if (options.repeats < 1)
    throw UsageError(fmt::format("--repeats {}: expected at least 1", options.repeats));
  if (!(options.time_limit > 0.0))
    throw UsageError(fmt::format("--time-limit {}: expected a number of seconds > 0", options.time_limit));
  if (options.directory && options.directory->empty())
    throw UsageError("-o: expected the name of a directory");
}

bool sets_accuracy(const std::string& path) {
  return path == accuracy_key(Accuracy::tolerance) || path == accuracy_key(Accuracy::step);
}

/// Refuses a key that another option sets, or whose change makes runs incomparable. Errors: UsageError.
void refuse_key(const std::string& option, const std::string& path) {
  if (sets_accuracy(path))
    throw UsageError(option + ": is not allowed, because --rtol and --dt set the accuracy of the runs");
  for (const char* key : {"run.engine", "run.t_end", "run.output_dt", "run.output_times", "run.frames",
                          "title", "schema", "units"})
    if (path == key || path.starts_with(std::string(key) + "."))
      throw UsageError(option + ": is not allowed, because runs that differ in this key cannot be compared");
  if (path.ends_with(".name"))
    throw UsageError(option + ": is not allowed, because runs that differ in names cannot be compared");
}

/// Settings that apply to an engine, or to the reference run.
std::vector<Override> settings_for(const StudyOptions& options, const std::string& engine) {
  std::vector<std::string> engines = options.engines;
  for (const Engine reference : speed::WorkStudy::references) engines.emplace_back(to_string(reference));
  return overrides_for(options.settings, engines, engine);
}

void check_settings(const StudyOptions& options) {
  for (const Override& change : overrides_of(options.settings)) {
    const std::size_t colon = change.path.find(':');
    const std::string option = "--set " + change.path;
    if (colon != std::string::npos && colon < change.path.find('.'))
      refuse_key(option, change.path.substr(colon + 1));
    else if (sets_accuracy(change.path))
      refuse_key(option, change.path);
  }
}

/// Builds the scene with each engine and each varied key, so that invalid values are reported before any file is written.
void try_engines(const StudyOptions& options, const std::vector<sweep::ParameterRange>& varied) {
  for (const std::string& engine : options.engines) {
    std::vector<Override> changes = settings_for(options, engine);
    changes.insert(changes.begin(), engine_override(engine));
    if (const std::string key = speed::accuracy_key(engine); key == accuracy_key(Accuracy::step))
      changes.insert(changes.begin(), {key, "1e-3"});
    for (const sweep::ParameterRange& vary : varied)
      changes.push_back(sweep::override_of(vary, vary.values.front()));
    try {
      (void)read_scene(options.scene, changes);
    } catch (const SceneError&) {  // an error of a single engine or value is reported in its row
    }
  }
}

speed::WorkRequest request_of(const StudyOptions& options, const std::vector<std::string>& command_line) {
  speed::WorkRequest request;
  request.scene = options.scene;
  request.settings = [&options](const std::string& engine) { return settings_for(options, engine); };
  request.ranges.engines = options.engines;
  request.ranges.rtol = speed::parse_decades("--rtol", options.rtol);
  for (const double value : request.ranges.rtol)
    if (!(value >= 1e-14 && value < 1.0))
      throw UsageError(
          fmt::format("--rtol {}: found {:g}, expected numbers >= 1e-14 and < 1", options.rtol, value));
  check_settings(options);
  std::vector<sweep::ParameterRange> varied;
  for (const std::string& text : options.varied) varied.push_back(sweep::parse_vary(text));
  for (const sweep::ParameterRange& vary : varied) {
    refuse_key("--vary " + vary.path, vary.path);
    for (const std::string& value : vary.values)
      if (std::count(vary.values.begin(), vary.values.end(), value) > 1)
        throw UsageError("--vary " + vary.path + ": " + value + " is given twice");
  }
  request.ranges.varied = sweep::points(varied);
  if (!varied.empty()) request.ranges.varied.insert(request.ranges.varied.begin(), std::vector<Override>());
  request.repeats = static_cast<std::size_t>(options.repeats);
  request.directory = options.directory.value_or(fs::path(options.scene).stem().string() + "-study");
  request.limits = {options.time_limit, [] { return !Interrupt::requested(); }, command_line};
  try_engines(options, varied);
  sweep::check_overlaps(options.scene, varied, {});
  return request;
}

class ProgressLine {
 public:
  explicit ProgressLine(bool shown) : shown_(shown && stderr_is_terminal()) {}
  ~ProgressLine() { say(""); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void say(const std::string& text) const {
    if (shown_) progress_line(text);
  }

 private:
  bool shown_;
};

/// Removes the runs of an earlier study; other files remain. Errors: FileError.
void clear_runs(const fs::path& path) {
  std::error_code error;
  const fs::path runs = path / "runs";
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(runs, error)) folders.push_back(entry.path());
  for (const fs::path& folder : folders) {
    const std::string name = folder.filename().string();
    const bool numbered = name.size() > 4 && name[3] == '-' && name.find_first_not_of("0123456789") == 3;
    if ((!numbered && name != "again") || !fs::exists(folder / "summary.json", error)) continue;
    result::remove_run(folder);
    fs::remove(folder, error);  // succeeds only if no other files are in the folder
  }
  fs::remove(runs, error);
}

void run_all(speed::WorkStudy& study, const speed::WorkRequest& request, const ProgressLine& progress) {
  progress.say("reference");
  study.find_reference();
  if (study.report().interrupted) return;
  std::vector<speed::WorkPoint> plan = speed::work_points(request.ranges);
  const auto& series = study.series();
  if (series && std::any_of(plan.begin(), plan.end(),
                            [&](const speed::WorkPoint& point) { return point.engine == series->engine; }))
    plan.insert(plan.begin(), *series);
  for (std::size_t i = 0; i < plan.size() && !study.report().interrupted; ++i) {
    progress.say(fmt::format("{} ({} of {})", plan[i].name(), i + 1, plan.size()));
    study.add(plan[i]);
    speed::write_work(request.directory, study.report());
  }
  study.time_all([&](const speed::WorkRow& row, std::size_t round) {
    progress.say(fmt::format("timing {} (round {} of {})", row.point.name(), round, request.repeats));
  });
}

ExitCode study(const StudyOptions& options, const std::vector<std::string>& command_line) {
  check(options);
  const TableStyle style = table_style_of(options.table, options);
  speed::WorkRequest request = request_of(options, command_line);
  if (!options.quiet) {
    print_patterns(options.scene, options.settings);
    print_patterns(options.scene, options.settings, "--vary", options.varied);
  }
  const fs::path path = request.directory;
  check_folder(path, study_folder(), options.force, options.scene);
  if (options.dt) request.ranges.dt = speed::parse_decades("--dt", *options.dt);
  speed::WorkStudy work(request);
  if (!options.dt) request.ranges.dt = speed::usual_steps(work.report().t_end);
  begin_folder(path, study_folder());
  clear_runs(path);
  speed::remove_work_plots(path);
  {
    const Interrupt interrupt;
    const ProgressLine progress(!options.quiet);
    try {
      run_all(work, request, progress);
    } catch (const Error&) {
      if (work.report().rows.empty()) {
        clear_runs(path);
        undo_folder(path, study_folder());
      } else {
        speed::write_work(path, work.report());
      }
      throw;
    }
  }
  const speed::WorkReport& report = work.report();
  speed::write_work(path, report);
  const bool pictures = !options.no_plots && !report.interrupted;
  const std::string drawn = pictures ? draw_pictures(path, speed::write_work_plots(path, report)) : "";
  if (!drawn.empty()) speed::write_work(path, report);  // study.md then includes the picture
  if (options.json) print(speed::work_json(report));
  if (style != TableStyle::plain)
    print(study_table(report, style));
  else if (options.tables())
    print(study_text(report) + "\nresults: " + path.string() +
          "/ (study.csv, study.json, study.md, runs/)\n");
  if (report.interrupted) {
    print_error("interrupted; the measurements so far are kept in " + path.string());
    return ExitCode::interrupted;
  }
  if (options.tables() && style == TableStyle::plain) print(drawn);
  return ExitCode::done;
}

}  // namespace

void add_study(Program& program) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = program.app.add_subcommand(
      "study", "measure run time against error for each engine, and find the fastest for each accuracy");
  command->add_option("SCENE", options->scene, "the scene file (TOML)")->required();
  command->add_option("--engines", options->chosen, "engines to measure (default: all)")
      ->option_text("NAME,NAME...");
  command
      ->add_option("--rtol", options->rtol,
                   "tolerances of " + engines_with(Accuracy::tolerance) +
                       ": start:stop by decades, start:stop:factor, or a list (default: 1e-4:1e-12)")
      ->option_text("RANGE");
  command
      ->add_option("--dt", options->dt,
                   "steps of " + engines_with(Accuracy::step) +
                       " (default: five steps, each a tenth of the previous step, from about t_end/50)")
      ->option_text("RANGE");
  command
      ->add_option("--vary", options->varied,
                   "another key to vary; errors are relative to the run with the key unchanged. Example: "
                   "reduction.cutoff_omega=1e3,1e4")
      ->option_text("PATH=VALUES")
      ->allow_extra_args(false);
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the study (default: SCENE's name with -study)")
      ->option_text("DIR");
  add_settings(*command, options->settings);
  command
      ->add_option("--repeats", options->repeats,
                   "number of repetitions; the shortest time is reported (default: 3)")
      ->option_text("N");
  command->add_option("--time-limit", options->time_limit, "time limit of a run in s (default: 60)")
      ->option_text("S");
  add_table_option(*command, options->table);
  add_output_options(*command, *options, "replace an earlier study in the directory", "study.json");
  command->callback([&program, options] {
    if (options->chosen) options->engines = names_between_commas(*options->chosen);
    program.action = [options, line = program.command_line] { return study(*options, line); };
  });
}

}  // namespace signorini::cli
