// signorini sweep: runs a scene for ranges or samples of keys, and writes one table with one row per run.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/host_info.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/plot.hpp"
#include "cli/sweep_text.hpp"
#include "cli/terminal.hpp"
#include "cli/workers.hpp"
#include "result/csv.hpp"
#include "scene/toml_node.hpp"
#include "study/sweep/parameter_range.hpp"
#include "study/sweep/quantiles.hpp"
#include "study/sweep/response_query.hpp"
#include "study/sweep/sweep_plots.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct SweepOptions : OutputOptions {
  std::string scene, engine;
  std::vector<std::string> varied, settings, merge, responses, samples;
  bool together = false;
  std::optional<long> sample_count, seed;
  std::string sequence = "random", table;
  std::optional<std::string> directory;
  std::optional<std::string> share;
  std::optional<long> jobs;
  bool keep = false;
  std::string strobe;
  std::optional<double> settle;
  bool carry = false, back = false;
};

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

/// Sets the varied keys of the sweep: first those of --vary, then those of --sample, which vary fastest.
void vary_keys(const SweepOptions& options, sweep::SweepSpec& spec) {
  for (const std::string& text : options.varied) {
    spec.vary.push_back(sweep::parse_vary(text));
    spec.vary.back().group = options.together ? 1 : 0;
  }
  if (options.together && options.varied.size() < 2)
    throw UsageError("--together: expected two or more --vary, which then vary together");
  const auto needs_samples = [&](const char* option) {
    if (options.samples.empty())
      throw UsageError(std::string(option) + ": has no meaning without --sample PATH=DISTRIBUTION");
  };
  sweep::SampleSpec sample;
  if (options.sample_count) {
    needs_samples("--samples");
    if (*options.sample_count < 1)
      throw UsageError(
          fmt::format("--samples {}: expected an integer from 1 to 1000000", *options.sample_count));
    sample.count = static_cast<std::size_t>(*options.sample_count);
  }
  if (options.seed) {
    needs_samples("--seed");
    constexpr long greatest = 4294967295;  // limit of the random generator
    if (*options.seed < 0 || *options.seed > greatest)
      throw UsageError(fmt::format("--seed {}: expected an integer from 0 to {}", *options.seed, greatest));
    sample.seed = static_cast<unsigned long>(*options.seed);
  }
  if (options.sequence != "random" && options.sequence != "sobol")
    throw UsageError("--sequence " + options.sequence + ": expected random or sobol");
  if (options.sequence == "sobol") {
    needs_samples("--sequence");
    sample.sequence = sweep::Sequence::sobol;
  }
  if (options.samples.empty()) return;
  for (sweep::ParameterRange& vary : sweep::draw_samples(options.samples, sample))
    spec.vary.push_back(std::move(vary));
  spec.sampling =
      fmt::format("{} {}, seed {}", base::count_text(sample.count, "sample"), options.sequence, sample.seed);
}

/// Sets --carry and --back: whether each run starts from the final state of the previous run. Errors: UsageError.
void specify_carry(const SweepOptions& options, sweep::SweepSpec& spec) {
  if (options.back && !options.carry) throw UsageError("--back: has no effect without --carry; add --carry");
  if (!options.carry) return;
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw UsageError(fmt::format("--carry: cannot be combined with {}: {}", option, why));
  };
  refuse(!options.samples.empty(), "--sample", "drawn values have no order");
  refuse(options.share.has_value(), "--share",
         "each run starts from the final state of the run before, which may belong to another share");
  refuse(
      options.keep, "--keep",
      "each run starts from the final state of the run before, and no file of the kept run has this state");
  spec.carry = {true, options.back};
  if (!options.back) return;
  const int group = spec.vary.back().group;
  for (sweep::ParameterRange& vary : spec.vary) {
    if (&vary != &spec.vary.back() && (group == 0 || vary.group != group)) continue;
    const std::vector<std::string> there = vary.values;
    vary.values.insert(vary.values.end(), there.rbegin(), there.rend());
  }
}

/// Sets the points of a stroboscopic sweep.
void specify_strobe(const SweepOptions& options, const Scene& scene, const Model& model,
                    sweep::SweepSpec& spec) {
  const sweep::StroboscopicMap strobe = sweep::parse_strobe(options.strobe, scene, model);
  spec.strobe = {options.strobe, strobe.period, options.settle, sweep::strobe_columns(model)};
  const double t_end = scene.run.t_end;
  if (options.settle && !(*options.settle >= 0.0 && *options.settle < t_end))
    throw UsageError(
        fmt::format("--settle {:g}: expected a time >= 0 and below t_end = {:g}", *options.settle, t_end));
  if (strobe.period > t_end)
    throw UsageError(
        fmt::format("--strobe {}: found a period longer than the run, t_end = {:g}", options.strobe, t_end));
  const double periods = strobe.period > 0.0 ? t_end / strobe.period : 0.0;
  if (options.carry && !strobe.of_loads && std::abs(periods - std::round(periods)) > 1e-9 * periods)
    throw UsageError(
        fmt::format("--carry: t_end = {:g} is {:g} times the period of --strobe, expected a whole number: "
                    "the loads of the next run start at t = 0 again",
                    t_end, periods));
}

/// Text of the saved state from which the runs start. It is part of the fingerprint, so that a changed state is detected.
std::string text_of_state(const Scene& scene) {
  std::string text;
  if (!scene.initial.saved) return text;
  const SavedState& state = *scene.initial.saved;
  for (const auto& [name, value] : state.motions) text += fmt::format("{}={} ", name, value);
  for (const auto& [name, value] : state.shears) text += fmt::format("{}={} ", name, value);
  for (const auto& [name, value] : state.slips) text += fmt::format("{}={} ", name, value);
  for (const SavedState::UserLawMemory& own : state.user_law_states)
    text += fmt::format("{}={},{} ", own.contact, own.state, own.memory);
  if (state.prestress) {
    for (const Prestress::Element& e : state.prestress->elements)
      text += fmt::format("{}-{}={},{} ", e.from, e.to, e.at_from, e.at_to);
    for (const Prestress::Body& body : state.prestress->bodies)
      text += fmt::format("{}={} ", body.name, body.stiffness);
  }
  if (state.scales)
    for (const double scale : *state.scales) text += fmt::format("{} ", scale);
  return text;
}

struct Specified {
  sweep::SweepSpec spec;
  std::string text;  ///< text of the scene file
};

/// Builds the sweep, and reports all errors that can be found before its start. A key that is invalid in every row is an
/// error of the command line; a value that is invalid in some rows gives rows with the outcome "refused".
Specified specify(const SweepOptions& options) {
  Specified specified;
  sweep::SweepSpec& spec = specified.spec;
  spec.scene = options.scene;
  spec.settings = options.settings;
  vary_keys(options, spec);
  specify_carry(options, spec);
  if (options.settle && options.strobe.empty()) throw UsageError("--settle: has no meaning without --strobe");
  if (options.share) spec.share = sweep::parse_share(*options.share, environment);
  specified.text = scene::scene_text(options.scene);
  // Limit of the number of rows that are tried until a valid row is found.
  constexpr std::size_t most_tried = 200;
  std::optional<Error> first;
  std::size_t tried = 0;
  for (const auto& point : sweep::points(spec.vary)) {
    if (tried++ == most_tried) break;
    std::vector<Override> changes = overrides_of(options.settings);
    changes.insert(changes.end(), point.begin(), point.end());
    try {
      const Scene scene = parse_scene(specified.text, options.scene, changes);
      spec.fingerprint = base::fingerprint_of(scene.resolved + text_of_state(scene));
      spec.title = scene.title;
      spec.units = scene.units;
      if (options.responses.empty() && options.strobe.empty()) return specified;
      const Model model = build_model(scene);
      if (!options.strobe.empty()) specify_strobe(options, scene, model, spec);
      for (const std::string& response : options.responses) {
        const sweep::ResponseQuery query = sweep::parse_query(response, model);
        if (std::find(spec.responses.begin(), spec.responses.end(), response) != spec.responses.end())
          throw UsageError("--response " + response + ": given twice");
        spec.responses.push_back(response);
        spec.response_units.push_back(sweep::unit_of(query, model));
      }
      return specified;
    } catch (const Error& error) {
      if (!first) first = error;
    }
  }
  throw *first;
}

std::size_t jobs_of(const SweepOptions& options) {
  if (!options.jobs)
    // MPI or Slurm starts one process per processor.
    return sweep::ranks(environment) > 1 ? 1 : base::processor_count();
  if (*options.jobs < 1) throw UsageError(fmt::format("--jobs {}: expected at least 1", *options.jobs));
  return static_cast<std::size_t>(*options.jobs);
}

fs::path output_directory(const SweepOptions& options, const sweep::Share& share) {
  if (options.directory) {
    if (options.directory->empty()) throw UsageError("-o: expected the name of a directory");
    return *options.directory;
  }
  const std::string stem = fs::path(options.scene).stem().string() + "-sweep";
  return share.all() ? stem : fmt::format("{}-{}-of-{}", stem, share.number, share.count);
}

/// Writes the table on disk at most twice a second, so that writing costs less than the runs, and the progress line.
class Progress {
 public:
  Progress(const sweep::SweepDirectory& directory, std::size_t all, bool line)
      : directory_(directory),
        all_(all),
        rows_before_(directory.rows().size()),
        line_(line && stderr_is_terminal()) {}
  ~Progress() {
    if (line_) progress_line("");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void idle(std::size_t running) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(500);
    if (directory_.rows().size() != written_) {
      written_ = directory_.rows().size();
      directory_.write_table();
    }
    if (line_)
      progress_line(fmt::format("{} of {}, {} running{}", directory_.rows().size(),
                                base::count_text(all_, "run"), running, time_left(now)));
  }

 private:
  [[nodiscard]] std::string time_left(std::chrono::steady_clock::time_point now) const {
    const std::size_t done = directory_.rows().size() - rows_before_;
    if (done == 0) return "";
    const double s = std::chrono::duration<double>(now - start_).count();
    return ", about " +
           base::duration_text(s * static_cast<double>(all_ - rows_before_ - done) /
                               static_cast<double>(done)) +
           " left";
  }

  const sweep::SweepDirectory& directory_;
  std::size_t all_, rows_before_,
      written_ = 0;  // rows_before_: number of rows that an earlier process has computed
  bool line_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point next_;
};

/// Computes the rows of all tasks; returns false if interrupted.
bool run_rows(sweep::SweepDirectory& directory, SweepTasks& tasks, const SweepOptions& options) {
  int file_error = 0;
  const auto ended = [&](const TaskResult& end) {
    if (end.signal == 0 && end.code == static_cast<int>(ExitCode::file)) {
      ++file_error;  // the worker process has printed the message
      return false;
    }
    try {
      tasks.take(end);
    } catch (const FileError& error) {
      print_error(error.what());
      ++file_error;
    }
    return file_error == 0;
  };
  Progress progress(directory, directory.rows().size() + tasks.rows(), !options.quiet);
  const bool whole = run_workers(
      tasks.list(), jobs_of(options),
      [&](std::size_t first, const SendReport& tell) { return tasks.work(first, tell); }, ended,
      [&](std::size_t running) { progress.idle(running); });
  if (file_error > 0) {
    try {
      directory.write_table();
    } catch (const FileError&) {  // only the table cannot be written; the rows are on disk
    }
    throw Error(ExitCode::file,
                fmt::format("a file could not be written, so the sweep stopped; {} kept in {}",
                            base::count_text(directory.rows().size(), "row"), directory.path().string()));
  }
  return whole;
}

void conclude(const SweepOptions& options, const sweep::SweepDirectory& directory) {
  directory.write_results();
  const std::vector<sweep::SampledResults> answers =
      sweep::sampled_results(directory.spec(), directory.rows());
  if (!answers.empty()) {
    result::write_file(directory.path() / "quantiles.csv", sweep::quantile_table(directory.spec(), answers));
    result::write_file(directory.path() / "exceedance.csv",
                       sweep::exceedance_table(directory.spec(), answers));
  }
  if (options.json) print(sweep::sweep_json(directory.spec(), directory.rows()));
  const TableStyle style = table_style(options.table);
  if (style != TableStyle::plain) {
    print(sweep_text(directory.spec(), directory.rows(), style));
    if (!answers.empty()) print("\n" + quantile_text(directory.spec(), answers, style));
  } else if (options.tables()) {
    if (!directory.spec().title.empty()) print(directory.spec().title + "\n\n");
    print(sweep_text(directory.spec(), directory.rows()));
    if (!answers.empty()) print("\n" + quantile_text(directory.spec(), answers));
    print("\nresults: " + directory.path().string() + "/ (sweep.csv, results.json" +
          (answers.empty() ? "" : ", quantiles.csv, exceedance.csv") +
          (options.strobe.empty() ? "" : ", strobe.csv") + (options.keep ? ", runs/)\n" : ")\n"));
  }
  const std::string drawn =
      options.no_plots
          ? ""
          : draw_pictures(directory.path(),
                          sweep::sweep_pictures(directory.spec(), directory.rows()).write(directory.path()));
  if (options.tables() && style == TableStyle::plain) print(drawn);
  std::size_t failed = 0;
  for (const auto& [index, row] : directory.rows()) failed += row.outcome == "done" ? 0 : 1;
  if (failed > 0 && !options.quiet)
    print_note(fmt::format("{} of {} did not reach the end; see the column reason of {}", failed,
                           base::count_text(directory.rows().size(), "run"),
                           (directory.path() / "sweep.csv").string()));
}

/// Prints a note if --strobe does not fit the first or the last row: a varied key may change the period of the loads.
void print_strobe_note(const SweepOptions& options, const sweep::SweepSpec& spec, const std::string& text) {
  const auto all = sweep::points(spec.vary);
  for (const auto* point : {&all.front(), &all.back()}) {
    std::vector<Override> changes = overrides_of(options.settings);
    changes.insert(changes.end(), point->begin(), point->end());
    try {
      const Scene scene = parse_scene(text, options.scene, changes);
      const std::string doubt =
          sweep::strobe_warning(sweep::parse_strobe(options.strobe, scene, build_model(scene)), scene);
      if (!doubt.empty()) return print_note(doubt);
    } catch (const Error&) {  // the run of this row reports the error
    }
  }
}

ExitCode sweep(const SweepOptions& options, const std::vector<std::string>& command_line) {
  const auto [spec, text] = specify(options);
  sweep::check_overlaps(options.scene, spec.vary, overrides_of(options.settings));
  if (!options.quiet) {
    print_patterns(options.scene, options.settings);
    print_patterns(options.scene, options.settings, "--vary", options.varied);
    for (const sweep::ParameterRange& vary : spec.vary)
      if (vary.sampled) print_patterns(options.scene, options.settings, "--sample", {vary.path});
  }
  if (!options.quiet && !options.strobe.empty()) print_strobe_note(options, spec, text);
  (void)jobs_of(options);  // reports an invalid --jobs before anything is written
  sweep::SweepDirectory directory(output_directory(options, spec.share), spec, options.force);
  sweep::RowTask common{options.scene, text, overrides_of(options.settings), 0, {}, {}, command_line};
  common.responses = options.responses;
  common.strobe = options.strobe;
  common.settle = options.settle;
  SweepTasks tasks(directory, common, options.keep);
  const std::size_t kept = directory.rows().size();
  if (kept > 0 && options.keep && !options.quiet)
    print_note(
        "--keep: rows that were already computed get no directories; --force computes these rows again");
  if (kept > 0 && !options.quiet)
    print_note(fmt::format("{} of {} already computed, {} left", base::count_text(kept, "row"),
                           directory.spec().carry.on ? directory.points().size() : kept + tasks.rows(),
                           tasks.rows()));
  if (!run_rows(directory, tasks, options)) {
    directory.write_table();
    print_error(fmt::format("interrupted; {} of {} kept in {}; the same command continues the sweep",
                            directory.rows().size(), base::count_text(kept + tasks.rows(), "row"),
                            directory.path().string()));
    return ExitCode::interrupted;
  }
  conclude(options, directory);
  const auto& rows = directory.rows();
  const bool none = !rows.empty() && std::all_of(rows.begin(), rows.end(), [](const auto& row) {
    return row.second.outcome == "refused";
  });
  if (!none) return ExitCode::done;
  print_error("every run of the sweep was refused; reason of the first run: " + rows.begin()->second.reason);
  return ExitCode::scene;
}

ExitCode merge(const SweepOptions& options) {
  if (!options.directory || options.directory->empty())
    throw UsageError("--merge: expected -o DIR, the directory of the joined sweep");
  if (!options.scene.empty() || !options.varied.empty() || !options.settings.empty() || options.share ||
      !options.responses.empty() || !options.samples.empty() || !options.strobe.empty() || options.carry)
    throw UsageError(
        "--merge: joins existing sweeps; expected neither SCENE nor --vary, --sample, --response, --strobe, "
        "--carry, --set, --share");
  std::vector<fs::path> from(options.merge.begin(), options.merge.end());
  sweep::SweepSpec spec = sweep::read_sweep_spec(from.front());
  spec.share = {};
  for (const fs::path& path : from) {
    const std::string differs = sweep::difference(spec, sweep::read_sweep_spec(path));
    if (!differs.empty()) throw FileError(path.string(), "is not a share of the same sweep: " + differs);
    std::error_code error;
    if (fs::equivalent(path, *options.directory, error))
      throw UsageError("--merge: " + path.string() + " is also the output directory");
  }
  sweep::SweepDirectory directory(*options.directory, spec, options.force);
  const std::vector<std::size_t> missing = sweep::merge_sweeps(from, directory);
  conclude(options, directory);
  if (missing.empty()) return ExitCode::done;
  constexpr std::size_t most_named = 10;
  std::string list;
  for (std::size_t i = 0; i < std::min(missing.size(), most_named); ++i)
    list += (i > 0 ? ", " : "") + std::to_string(missing[i] + 1);
  if (missing.size() > most_named) list += ", ...";
  print_error(fmt::format("{} of {} missing ({}); run the sweep itself with -o {} to compute them",
                          missing.size(), base::count_text(directory.points().size(), "row"), list,
                          directory.path().string()));
  return ExitCode::stopped;
}

/// Converts --engine to a setting, which sweep.json stores, so that a sweep with another engine counts as another sweep.
SweepOptions with_engine(SweepOptions options) {
  if (options.engine.empty()) return options;
  for (const std::string& varied : options.varied)
    if (varied.starts_with("run.engine="))
      throw UsageError(
          fmt::format("--engine {}: has no effect, because --vary {} sets the engine of every run",
                      options.engine, varied));
  const Override engine = engine_override(options.engine, "--engine");
  options.settings.push_back(engine.path + "=" + engine.value);
  return options;
}

ExitCode sweep_or_merge(const SweepOptions& given, const std::vector<std::string>& command_line) {
  (void)table_style_of(given.table, given);
  const SweepOptions options = with_engine(given);
  if (!options.merge.empty()) return merge(options);
  if (options.scene.empty()) throw UsageError("sweep: expected SCENE, or --merge DIR...");
  if (options.varied.empty() && options.samples.empty())
    throw UsageError("sweep: expected --vary, such as --vary 'contacts.*.friction=0:1.3:0.1', or --sample");
  if (!options.samples.empty() && options.responses.empty())
    throw UsageError("--sample needs at least one --response: the quantity whose distribution is computed");
  return sweep(options, command_line);
}

void add_strobe(CLI::App& command, SweepOptions& options, const CLI::Validator& given) {
  command
      .add_option("--strobe", options.strobe,
                  "states at multiples of a period, of the period of the loads, or after every EVENT or "
                  "EVENT@CONTACT: strobe.csv, and a bifurcation diagram")
      ->option_text("PERIOD|loads|EVENT");
  command
      .add_option("--settle", options.settle,
                  "with --strobe: omit states before this time (default: half of t_end)")
      ->option_text("T")
      ->check(given);
  command.add_flag("--carry", options.carry,
                   "along the last --vary, each run starts from the final state of the previous run");
  command.add_flag("--back", options.back, "with --carry: then run the same values in reverse order");
}

void add_sampling(CLI::App& command, SweepOptions& options, const CLI::Validator& given) {
  command
      .add_option(
          "--sample", options.samples,
          "draw values: normal(mean,sd), lognormal(mean,sd), uniform(from,to), "
          "triangular(least,likely,greatest); keys separated by commas get the same sample (may be repeated)")
      ->option_text("PATH[,PATH...]=DISTRIBUTION")
      ->allow_extra_args(false);
  command.add_option("--samples", options.sample_count, "number of samples (default: 1000)")
      ->option_text("N")
      ->check(given);
  command.add_option("--seed", options.seed, "seed of the samples (default: 1)")
      ->option_text("S")
      ->check(given);
  command.add_option("--sequence", options.sequence, "kind of samples: random (default) or sobol")
      ->option_text("NAME");
}

}  // namespace

void add_sweep(Program& program) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command =
      program.app.add_subcommand("sweep", "run a scene over ranges of its keys, into one table");
  command->add_option("SCENE", options->scene, "the scene file (TOML)");
  command
      ->add_option("--vary", options->varied,
                   "start:stop:step (stop included) or value,value,...; several --vary give all combinations")
      ->option_text("PATH=VALUES")
      ->allow_extra_args(false);
  command->add_flag("--together", options->together,
                    "change all --vary keys together, row by row, instead of all combinations");
  command
      ->add_option(
          "--response", options->responses,
          "a column of the table: max:OUTPUT, also min:, abs:, tmax:, tmin: and end:; residual:CONTACT or "
          "impulse:CONTACT; count:EVENT or count:EVENT@CONTACT (may be repeated)")
      ->option_text("QUERY")
      ->allow_extra_args(false);
  const CLI::Validator given([](const std::string& text) { return text.empty() ? "expected a number" : ""; },
                             "");
  add_sampling(*command, *options, given);
  command
      ->add_option("-o,--output", options->directory,
                   "directory of the sweep (default: SCENE's name with -sweep); an unfinished sweep in DIR "
                   "is continued")
      ->option_text("DIR");
  add_settings(*command, options->settings);
  command->add_option("--engine", options->engine, "engine of all runs, instead of the scene's run.engine")
      ->option_text("NAME");
  command->add_option("--jobs", options->jobs, "number of parallel runs (default: one per processor)")
      ->option_text("N")
      ->check(given);
  command
      ->add_option(
          "--share", options->share,
          "compute only every Nth row from the Kth on; auto: K and N from MPI's or Slurm's environment")
      ->option_text("K/N|auto");
  command
      ->add_option("--merge", options->merge,
                   "join the shares in these directories into the directory given with -o")
      ->option_text("DIR...");
  add_strobe(*command, *options, given);
  add_table_option(*command, options->table);
  command->add_flag("--keep", options->keep, "keep the directory of every run, in DIR/runs");
  add_output_options(*command, *options, "replace an earlier sweep instead of continuing it", "results.json");
  command->callback([&program, options] {
    program.action = [options, line = program.command_line] { return sweep_or_merge(*options, line); };
  });
}

}  // namespace signorini::cli
