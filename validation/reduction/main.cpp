// What a cutoff costs in accuracy and brings in time, on the pipeline scene. Prints Markdown.
//
//   build/release/signorini_reduction [repeats]
//
// 1. against the exact flow of the full model: displacements of all degrees of freedom at the output times,
//    events in order and their times, for a sweep of cutoffs;
// 2. time of each engine on the reduced model beside the full one;
// 3. ida beside newmark on one reduced model at a given error of event times.
// 4. the same cutoff on finer meshes.
// Times are medians of alternating repeats, processor time of one thread, without output but at the end.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

using Changes = std::vector<Override>;

const std::string file = SIGNORINI_MODELS "/pipeline.toml";

Changes with(Changes changes, const std::optional<double>& cutoff, const std::string& engine) {
  if (cutoff) changes.push_back({"reduction.cutoff_omega", fmt::format("{}", *cutoff)});
  changes.push_back({"run.engine", engine});
  return changes;
}

std::vector<Event> state_changes(const Result& result) {
  std::vector<Event> events;
  for (const Event& e : result.events)
    if (e.type != EventType::time) events.push_back(e);
  return events;
}

struct Difference {
  std::size_t agreeing = 0, found = 0, expected = 0;
  double time = 0.0;          ///< of agreeing events
  double displacement = 0.0;  ///< over the whole run
  double before = 0.0;        ///< the same up to the first difference of the sequences
};

Difference difference(const Result& reference, const Result& other) {
  const std::vector<Event> expected = state_changes(reference), found = state_changes(other);
  Difference d;
  d.expected = expected.size();
  d.found = found.size();
  double parted = reference.rows.back().t;
  for (; d.agreeing < std::min(d.expected, d.found); ++d.agreeing) {
    const Event &a = expected[d.agreeing], &b = found[d.agreeing];
    if (a.contact != b.contact || a.from != b.from || a.to != b.to) {
      parted = std::min(a.t, b.t);
      break;
    }
    d.time = std::max(d.time, std::abs(a.t - b.t));
  }
  for (std::size_t i = 0; i < std::min(reference.rows.size(), other.rows.size()); ++i) {
    const double u = (reference.rows[i].u - other.rows[i].u).cwiseAbs().maxCoeff();
    d.displacement = std::max(d.displacement, u);
    if (reference.rows[i].t < parted) d.before = std::max(d.before, u);
  }
  return d;
}

Result run(const Changes& changes) {
  const Scene scene = read_scene(file, changes);
  return simulate(build_model(scene), scene.run);
}

/// A run to be timed.
class Subject {
 public:
  explicit Subject(const Changes& changes) : scene_(read_scene(file, changes)), model_(build_model(scene_)) {
    scene_.run.output_dt.reset();
    scene_.run.output_times = std::vector<double>{scene_.run.t_end};
  }
  void run() {
    Result result;
    const std::clock_t start = std::clock();
    steps = simulate(model_, scene_.run, result).counters.steps;
    seconds_.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  [[nodiscard]] double median() {
    std::sort(seconds_.begin(), seconds_.end());
    return seconds_[seconds_.size() / 2];
  }
  [[nodiscard]] const Model& model() const { return model_; }
  long steps = 0;

 private:
  Scene scene_;
  Model model_;
  std::vector<double> seconds_;
};

void accuracy(const std::vector<double>& cutoffs) {
  const Result whole = run(with({}, std::nullopt, "exact"));
  fmt::print(
      "| cutoff, rad/s | modes, static shapes | highest kept | omega_max | displacement, m | until sequences "
      "part, m "
      "| events, in order of {} | their times, s | greatest `followed`, m "
      "|\n|---|---|---|---|---|---|---|---|---|\n",
      state_changes(whole).size());
  for (const double cutoff : cutoffs) {
    const Scene scene = read_scene(file, with({}, cutoff, "exact"));
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    const Difference d = difference(whole, result);
    const Reduction& r = *model.reduction;
    double followed = 0.0;
    for (const ComplianceShare& share : r.shares)
      if (share.contact >= 0) {
        const Peak& peak = result.report.peaks[static_cast<std::size_t>(share.contact)];
        followed = std::max(followed, share.residual * (share.normal ? peak.N : peak.T));
      }
    fmt::print("| {:g} | {}, {} | {:.4g} | {:.4g} | {:.2g} | {:.2g} | {}, {} | {:.2g} | {:.2g} |\n", cutoff,
               r.modes, r.massless_shapes, r.highest_kept, model.omega_max, d.displacement, d.before, d.found,
               d.agreeing, d.time, followed);
    std::fflush(stdout);
  }
}

void cost(const std::vector<double>& cutoffs, int repeats) {
  fmt::print(
      "\n| cutoff, rad/s | ida, s | steps | full / reduced | exact, s | full / reduced | newmark, dt = 1e-5, "
      "s | full / "
      "reduced | full ida / reduced exact |\n|---|---|---|---|---|---|---|---|---|\n");
  const std::vector<std::pair<std::string, Changes>> engines{
      {"ida", {}}, {"exact", {}}, {"newmark", {{"run.dt", "1e-5"}}}};
  std::vector<Subject> subjects;
  std::vector<std::optional<double>> rows{std::nullopt};
  rows.insert(rows.end(), cutoffs.begin(), cutoffs.end());
  for (const auto& cutoff : rows)
    for (const auto& [engine, changes] : engines) subjects.emplace_back(with(changes, cutoff, engine));
  for (int i = 0; i < repeats; ++i)
    for (Subject& subject : subjects) subject.run();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = [&](std::size_t row, std::size_t engine) -> Subject& {
      return subjects[3 * row + engine];
    };
    const auto ratio = [&](std::size_t engine) { return at(0, engine).median() / at(i, engine).median(); };
    fmt::print("| {} | {:.3g} | {} | {:.1f} | {:.3g} | {:.1f} | {:.3g} | {:.1f} | {:.0f} |\n",
               rows[i] ? fmt::format("{:g}", *rows[i]) : "none", at(i, 0).median(), at(i, 0).steps, ratio(0),
               at(i, 1).median(), ratio(1), at(i, 2).median(), ratio(2),
               at(0, 0).median() / at(i, 1).median());
  }
  std::fflush(stdout);
}

/// The loosest setting from `next` on whose events are those of the exact flow within the error; `next` moves
/// on.
std::optional<Changes> loosest(const Result& exact, double cutoff, const std::string& engine, const char* key,
                               const std::vector<double>& values, std::size_t& next, const Changes& more,
                               double error) {
  for (; next < values.size(); ++next) {
    Changes changes = with(more, cutoff, engine);
    changes.push_back({key, fmt::format("{}", values[next])});
    const Difference d = difference(exact, run(changes));
    if (d.agreeing == d.expected && d.found == d.expected && d.time <= error) return changes;
  }
  return std::nullopt;
}

void beside_newmark(double cutoff, const char* t_end, int repeats) {
  const Changes until{{"run.t_end", t_end}, {"run.output_dt", "0.01"}};
  const Result exact = run(with(until, cutoff, "exact"));
  std::vector<double> tolerances, steps;
  for (double rtol = 1e-5; rtol > 3e-13; rtol /= std::sqrt(10.0)) tolerances.push_back(rtol);
  for (double dt = 6.4e-5; dt > 4e-9; dt *= 0.5) steps.push_back(dt);
  fmt::print(
      "\n| cutoff {:g}, to {} s: error of event times, s | ida: rtol | steps | s | newmark: dt | steps | s | "
      "newmark / "
      "ida |\n|---|---|---|---|---|---|---|---|\n",
      cutoff, t_end);
  std::size_t next_rtol = 0, next_dt = 0;
  for (const double error : {1e-6, 1e-7, 1e-8}) {
    const auto ida = loosest(exact, cutoff, "ida", "run.rtol", tolerances, next_rtol, until, error);
    const auto newmark = loosest(exact, cutoff, "newmark", "run.dt", steps, next_dt, until, error);
    if (!ida || !newmark) {
      fmt::print("| {:g} | {} | {} |\n", error, ida ? "reached" : "not reached",
                 newmark ? "reached" : "not reached");
      continue;
    }
    Subject a(*ida), b(*newmark);
    for (int i = 0; i < repeats; ++i) {
      a.run();
      b.run();
    }
    fmt::print("| {:g} | {:.1e} | {} | {:.3g} | {:.1e} | {} | {:.3g} | {:.1f} |\n", error,
               std::atof(ida->back().value.c_str()), a.steps, a.median(),
               std::atof(newmark->back().value.c_str()), b.steps, b.median(), b.median() / a.median());
    std::fflush(stdout);
  }
}

/// One cutoff, a finer mesh.
void finer(const char* elements, const char* t_end, double cutoff) {
  const Changes mesh{{"members.1.elements", elements}, {"run.t_end", t_end}};
  Subject ida(with(mesh, std::nullopt, "ida")), reduced_ida(with(mesh, cutoff, "ida")),
      exact(with(mesh, std::nullopt, "exact")), reduced_exact(with(mesh, cutoff, "exact"));
  for (Subject* subject : {&ida, &reduced_ida, &exact, &reduced_exact}) subject->run();
  const Difference d = difference(run(with(mesh, std::nullopt, "exact")), run(with(mesh, cutoff, "exact")));
  fmt::print("| {}, {} s | {}, {} | {:.2g} | {:.3g}, {:.3g} | {:.1f} | {:.3g}, {:.3g} | {:.1f} |\n", elements,
             t_end, ida.model().size(), reduced_ida.model().size(), d.displacement, ida.median(),
             reduced_ida.median(), ida.median() / reduced_ida.median(), exact.median(),
             reduced_exact.median(), exact.median() / reduced_exact.median());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  accuracy({500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0, 22000.0, 32000.0, 1e6});
  cost({2000.0, 4000.0, 8000.0, 16000.0, 22000.0}, repeats);
  beside_newmark(4000.0, "0.2", repeats);
  beside_newmark(22000.0, "0.16", repeats);
  fmt::print(
      "\n| elements a piece, to t | degrees of freedom, full and reduced | displacement, m | ida, full and "
      "reduced, s | "
      "ratio | exact, full and reduced, s | ratio |\n|---|---|---|---|---|---|---|\n");
  finer("8", "0.2", 22000.0);
  finer("16", "0.2", 22000.0);
  finer("33", "0.05", 22000.0);
}
