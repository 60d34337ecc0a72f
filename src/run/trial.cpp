#include "run/trial.hpp"
#include "run/engines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "run/expected.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"

namespace signorini {
namespace {

constexpr double longest_first = 2.0;  // s, limit for the time before a trial can be stopped; chosen
constexpr double times_as_long = 4.0,
                 long_run = 5.0;  // ratio, and s; chosen: below, another engine is no advantage

constexpr double least_steps = 10.0;  // in steps of the rule: least progress of a trial; chosen

/// Ends the run after a given time. It stores no motion: memory of a trial is needed in addition to that of the run.
class Stopwatch : public Recorder {
 public:
  explicit Stopwatch(double patience) : patience_(patience) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double t) override {
    s = now();
    if (s < 0.25 * patience_ || t_1 == 0.0) {
      t_1 = t;
      s_1 = s;
    }
    t_reached = t;
    return s < patience_;
  }
  [[nodiscard]] double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  double s = 0.0, s_1 = 0.0, t_1 = 0.0, t_reached = 0.0;

 private:
  double patience_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string about(double seconds) {
  if (seconds < 0.1) return "less than 0.1 s";
  return seconds < 9.5 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

}  // namespace

double seconds_of_all(double t_end, const TrialTime& early, const TrialTime& late) {
  const double moved = late.t - early.t;
  if (moved > 0.0) return late.seconds + (t_end - late.t) * (late.seconds - early.seconds) / moved;
  return late.t > 0.0 ? late.seconds * t_end / late.t : 0.0;
}

double seconds_by_trial(const Model& model, RunSpec run, Engine engine, double patience) {
  run.engine = engine;
  run.certify = Certify::no;
  try {
    // A trial that cannot be stopped for a long time is not started.
    const Effort effort = expected(model, run).effort;
    if (effort.first > longest_first) return effort.seconds;
    Stopwatch watch(patience);
    const Report report = simulate(model, run, watch);
    if (report.outcome.kind == Outcome::Kind::done) return watch.now();
    if (report.outcome.kind != Outcome::Kind::interrupted) return 0.0;
    const double moved = watch.t_reached - watch.t_1;
    // Small steps at the start alone give no estimate: use the rule.
    if (effort.steps > 0.0 && moved < least_steps * run.t_end / effort.steps) return effort.seconds;
    return seconds_of_all(run.t_end, {watch.t_1, watch.s_1}, {watch.t_reached, watch.s});
  } catch (const SceneError&) {
    return 0.0;
  }
}

std::vector<Trial> trials(const Scene& scene, const Model& model, Engine own,
                          const std::vector<double>& cutoffs, double patience) {
  std::vector<Engine> engines{engine_for(EngineRole::closed_form), engine_for(EngineRole::integrator)};
  if (std::find(engines.begin(), engines.end(), own) == engines.end()) engines.push_back(own);
  std::vector<Trial> list;
  const auto add = [&](const Model& tried, double cutoff) {
    for (const Engine engine : engines)
      if (const double seconds = seconds_by_trial(tried, scene.run, engine, patience); seconds > 0.0)
        list.push_back({engine, cutoff, seconds});
  };
  add(model, 0.0);
  if (scene.reduction) return list;
  for (const double cutoff : cutoffs) {
    Scene reduced = scene;
    reduced.reduction.emplace().cutoff_omega = 2.0 * std::numbers::pi * cutoff;
    try {
      add(build_model(reduced), cutoff);
    } catch (const SceneError&) {
      continue;  // no modes can be computed for its parts
    }
  }
  return list;
}

double cutoff_to_try(double lowest_omega, double highest_omega) {
  constexpr double above = 50.0, below = 4.0;
  const double cutoff = above * lowest_omega / (2.0 * std::numbers::pi);
  if (!(cutoff > 0.0) || below * above * lowest_omega > highest_omega) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(cutoff)));
  return std::round(cutoff / unit) * unit;
}

std::string trial_text(const std::vector<Trial>& trials) {
  std::string text;
  double cutoff = 0.0;
  for (const Trial& trial : trials) {
    const bool other = trial.cutoff != cutoff;
    if (other)
      text +=
          fmt::format("{}with [reduction] cutoff_frequency = {:g}: ", text.empty() ? "" : "; ", trial.cutoff);
    else if (!text.empty())
      text += ", ";
    text += fmt::format("{} {}", to_string(trial.engine), about(trial.seconds));
    cutoff = trial.cutoff;
  }
  return text;
}

std::string quicker(const std::vector<Trial>& trials, Engine own, double seconds) {
  const auto best = std::min_element(trials.begin(), trials.end(),
                                     [](const Trial& a, const Trial& b) { return a.seconds < b.seconds; });
  if (best == trials.end() || seconds < long_run || best->seconds * times_as_long > seconds) return "";
  return fmt::format("{} is expected to take {}; by their first steps: {}", to_string(own), about(seconds),
                     trial_text(trials));
}

}  // namespace signorini
