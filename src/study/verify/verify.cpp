#include "study/verify/verify.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "certify/companion.hpp"
#include "engine/tolerance.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"
#include "study/verify/richardson.hpp"
#include "study/verify/verification_runs.hpp"

namespace signorini::verify {
namespace {

constexpr double least_seconds_of_step = 1e-6;  // assumed least time per step, s
constexpr double steps_at_first = 64.0;         // number of steps of the first run, if no dt is given

class Study {
 public:
  Study(const Model& model, const Model& own, const VerifyRequest& request)
      : model_(model), own_(own), request_(request), run_(request.run) {
    run_.engine = run::engine_for(run::EngineRole::integrator);
    run_.certify = Certify::yes;
    run_.frames.clear();
    run_.output_dt.reset();
    run_.output_times.emplace();
    for (int k = 1; k <= request.rows; ++k) run_.output_times->push_back(run_.t_end * k / request.rows);
    const double capture = engine::tolerance_of(own, run_).capture_velocity();
    for (Model* m : {&model_, &own_}) certify::set_capture_velocities(*m, capture);
  }

  Verification verification() {
    check_newmark();
    VerificationRuns witnesses(model_, run_.t_end);
    run_ida(witnesses);
    if (!result_.interrupted) run_closed_form(witnesses);
    refine(witnesses);
    if (result_.interrupted) {
      result_.sentence = "interrupted";
    } else {
      witnesses.evaluate(result_);
    }
    find_paper_dt();
    return std::move(result_);
  }

 private:
  [[nodiscard]] RunSpec newmark(double dt) const {
    RunSpec run = run_;
    run.engine = run::engine_for(run::EngineRole::fixed_steps);
    run.dt = dt;
    run.step = StepControl::fixed;
    run.output_times->insert(run.output_times->end(), peaks_.begin(), peaks_.end());
    std::sort(run.output_times->begin(), run.output_times->end());
    return run;
  }

  /// Newmark has values only at the ends of its steps, and peaks lie between these ends. Halved steps share their
  /// ends, so all step sizes miss the same part of a peak, up to |r''| h^2 / 8. Therefore newmark also reports
  /// its values at the times of ida's peaks; the shift of a peak by O(h^2) changes its value by O(h^4) only.
  void find_peaks() {
    std::vector<double> rows = *run_.output_times;
    for (const OutputExtremes& extremes : result_.ida.report.response)
      for (const double t : {extremes.t_maximum, extremes.t_minimum})
        if (t > 0.0 && t < run_.t_end && std::find(rows.begin(), rows.end(), t) == rows.end()) {
          rows.push_back(t);
          peaks_.push_back(t);
        }
    std::sort(peaks_.begin(), peaks_.end());
  }

  /// Runs newmark with the step dt. Rows at peaks_ are removed, so that the result has the same rows as the other runs.
  [[nodiscard]] ObservedRun run_newmark(double dt) const {
    ObservedRun run = observe(model_, newmark(dt), request_.go_on);
    const auto width = static_cast<std::ptrdiff_t>(run.rows.width);
    for (std::size_t row = run.rows.t.size(); row-- > 0;) {
      if (!std::binary_search(peaks_.begin(), peaks_.end(), run.rows.t[row])) continue;
      const auto place = static_cast<std::ptrdiff_t>(row);
      const auto first = run.rows.values.begin() + place * width;
      run.rows.values.erase(first, first + width);
      run.rows.t.erase(run.rows.t.begin() + place);
    }
    return run;
  }

  /// Refuses scenes that newmark cannot compute, before any run begins. Errors: SceneError.
  void check_newmark() const {
    try {
      run::engine_row(run::engine_for(run::EngineRole::fixed_steps)).refuse(model_, newmark(run_.t_end));
    } catch (const run::UnsupportedSceneError& unfit) {
      throw SceneError(run_.place, "verify",
                       fmt::format("verify checks ida with newmark, but newmark {}; signorini run --certify "
                                   "compares ida with a more accurate run of ida instead",
                                   unfit.reason));
    }
  }

  void run_ida(VerificationRuns& witnesses) {
    ObservingRecorder patient(request_.go_on);
    certify::CompanionTracker tracker(own_, true, &patient);
    CertifyOptions options;
    options.forces = true;
    options.go_on = request_.go_on;
    result_.ida = simulate_certified(own_, run_, tracker, options);
    note(result_.ida.report);
    find_peaks();
    witnesses.ida = observed_run(std::move(tracker), result_.ida.report);
    witnesses.certificate = &*result_.ida.certificate;
  }

  void run_closed_form(VerificationRuns& witnesses) {
    if (!run::exact_accepts(model_, run_)) return;
    RunSpec run = run_;
    run.engine = run::engine_for(run::EngineRole::closed_form);
    witnesses.exact = observe(model_, run, request_.go_on);
    note(witnesses.exact->report);
  }

  /// Runs newmark with successively halved steps, until the results have settled or the next run would cost too much.
  void refine(VerificationRuns& witnesses) {
    double dt = request_.dt.value_or(run_.t_end / steps_at_first);
    while (!result_.interrupted) {
      witnesses.add(dt, run_newmark(dt));
      note(witnesses.newmark.back().report);
      test_step(witnesses);
      result_.dt = witnesses.dt;
      const bool three = witnesses.newmark.size() == VerificationRuns::runs;
      if (three && (request_.dt || (changes_little() && witnesses.settled()))) return;
      if (three && expected_seconds(0.5 * dt) > request_.max_seconds) return;
      dt *= 0.5;
    }
  }

  [[nodiscard]] double expected_seconds(double dt) const {
    return std::max(run::expected_cost(model_, newmark(dt)).estimate.seconds,
                    least_seconds_of_step * run_.t_end / dt);
  }

  /// Stores the change of the displacements between the last two runs, whose steps differ by a factor of two.
  void test_step(const VerificationRuns& witnesses) {
    if (witnesses.newmark.size() < 2) return;
    const ObservedRun& fine = witnesses.newmark.back();
    const ObservedRun& coarse = witnesses.newmark[witnesses.newmark.size() - 2];
    double change = 0.0, greatest = 0.0;
    const std::vector<ObservedColumn> columns = observed_columns(model_);
    for (std::size_t row = 0; row < std::min(fine.rows.t.size(), coarse.rows.t.size()); ++row)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        if (columns[j].kind != "displacement") continue;
        change = std::max(change, std::abs(fine.at(row, j) - coarse.at(row, j)));
        greatest = std::max(greatest, std::abs(fine.at(row, j)));
      }
    const bool whole = fine.rows.t.size() == coarse.rows.t.size();
    const double relative = greatest > 0.0 ? change / greatest : 0.0;
    result_.step_tests.push_back(
        {witnesses.dt.back(), whole ? relative : std::numeric_limits<double>::infinity()});
  }

  /// True if the finest step satisfies the paper's criterion: doubling it changes displacements little.
  [[nodiscard]] bool changes_little() const { return result_.step_tests.back().change < paper_change; }

  void find_paper_dt() {
    for (auto test = result_.step_tests.rbegin(); test != result_.step_tests.rend(); ++test) {
      if (!(test->change < paper_change)) return;
      result_.paper_dt = test->dt;
    }
  }

  void note(const Report& report) {
    result_.interrupted = result_.interrupted || report.outcome.kind == Outcome::Kind::interrupted;
  }

  Model model_, own_;
  const VerifyRequest& request_;
  RunSpec run_;
  std::vector<double> peaks_;  // times of ida's extremes of outputs, which are not output times
  Verification result_;
};

}  // namespace

double Observation::difference() const { return std::abs(ida - richardson); }

bool Observation::exact_agrees() const {
  return exact && !agrees() && std::abs(ida - *exact) <= ida_error && std::abs(richardson - *exact) > bar;
}

const char* to_string(Agreement verdict) {
  switch (verdict) {
    case Agreement::agree:
      return "agree";
    case Agreement::differ:
      return "differ";
    case Agreement::undecided:
      return "undecided";
  }
  return "?";
}

Verification verify(const Model& model, const Model& own, const VerifyRequest& request) {
  return Study(model, own, request).verification();
}

}  // namespace signorini::verify
