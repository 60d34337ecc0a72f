#include "differential/judge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "contact/friction.hpp"
#include "differential/neighbour.hpp"

namespace signorini::differential {
namespace {

constexpr double steps_per_tolerance = 5.0;  // a step of ida spends a fifth of it (docs/theory.md)
constexpr long newmark_steps_for_one = 4;
constexpr double steps_a_period = 20.0, fewest_steps = 500.0, most_steps = 20000.0;
// Order p leaves 1/(2^p - 1) of the last halving's difference: a third at order 2, and this much at order
// 0.4. Events make the factor of dt^2 vary from step to step, so single halvings are not always in order.
constexpr double of_own_difference = 3.0;

// Of t_end, for times of events. The second one is chosen, not derived: an event in newmark's first step is
// as far off at every dt, since the step is cut to it, so its own difference says nothing (README.md, seed
// 312).
constexpr double roundoff = 1e-14, first_step = 1e-10;

class Judge {
 public:
  Judge(const Scene& scene, const JudgeSettings& settings) : scene_(scene), settings_(settings) {}

  Judgement operator()() {
    try {
      model_ = build_model(scene_);
    } catch (const SceneError& error) {
      result_.verdict = Verdict::refused;
      result_.what = error.what();
      return result_;
    }
    fix_capture();
    if (!find_reference()) return result_;
    weights_ = weights_of(model_, reference_);
    check_audit(reference_, "reference", linear_ ? 1e-10 : delta_of(reference_, reference_spec_.rtol), 1e-6);
    compare_ida(fmt::format("ida {:g}", settings_.tight), settings_.tight);
    compare_ida(fmt::format("ida {:g}", settings_.loose), settings_.loose);
    if (linear_) compare_newmark();
    for (const Comparison& c : result_.comparisons)
      if (c.verdict > result_.verdict) {
        result_.verdict = c.verdict;
        result_.what = c.engine + ": " + c.what;
      }
    if (result_.verdict == Verdict::agree && reference_.end == Track::End::stopped) {
      result_.verdict = Verdict::stopped;
      result_.what = reference_.reason;
    }
    return result_;
  }

 private:
  /// Its default follows rtol, which is not the same for all: that of the loosest is taken by all.
  void fix_capture() {
    for (Contact& contact : model_.contacts)
      if (contact.takes_impulses() && !contact.capture_velocity)
        contact.capture_velocity = settings_.loose * model_.scales.velocity;
  }

  [[nodiscard]] RunSpec spec(Engine engine, double rtol) const {
    RunSpec run = scene_.run;
    run.engine = engine;
    run.rtol = rtol;
    run.atol = {};
    return run;
  }

  [[nodiscard]] Track run_of(const Model& model, const RunSpec& run) {
    Bounds bounds;
    bounds.steps =
        std::min(run.engine == Engine::newmark ? newmark_steps_for_one * settings_.steps : settings_.steps,
                 steps_left_);
    bounds.seconds = std::min(settings_.seconds, time_left());
    Track track = differential::run(model, run, bounds);
    steps_left_ -= track.steps;
    return track;
  }

  [[nodiscard]] double time_left() const {
    return settings_.scene_seconds -
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] bool spent() const { return steps_left_ <= 0 || time_left() <= 0.0; }

  bool find_reference() {
    reference_spec_ = spec(Engine::exact, settings_.tight);
    linear_ = std::none_of(model_.contacts.begin(), model_.contacts.end(),
                           [](const Contact& c) { return contact::friction_varies(c); });
    if (!linear_) reference_spec_ = spec(Engine::ida, 0.1 * settings_.tight);
    reference_ = run_of(model_, reference_spec_);
    if (reference_.end == Track::End::refused) {
      result_.verdict = Verdict::refused;
      result_.what = reference_.said;
      return false;
    }
    result_.events = reference_.events.size();
    if (reference_.end == Track::End::too_long && reference_.rows.size() < 2) {
      result_.verdict = Verdict::too_long;
      result_.what = fmt::format("the reference reached {:.3g}", reference_.t);
      return false;
    }
    return true;
  }

  /// Conditions and energy, whatever the other engines say; a gap is as sharp as its tolerance.
  void check_audit(const Track& track, const std::string& name, double penetration, double energy) {
    const Audit& a = track.report.audit;
    const auto claim = [&](const char* what, double value, double limit) {
      if (value <= limit) return;
      Comparison c;
      c.engine = "audit of " + name;
      c.to_end = true;
      c.verdict = Verdict::disagree;
      c.until = track.t;
      c.what = fmt::format("{}: {:.2e}, allowed {:.2e}", what, value, limit);
      result_.comparisons.push_back(c);
    };
    double length = a.length_scale;
    for (const double u : weights_.u) length = std::max(length, u);
    claim("penetration", a.penetration.value, penetration * length);
    claim("tension", a.tension.value, 1e-7 * a.force_scale);
    claim("friction", a.friction.value, 1e-7 * a.force_scale);
    claim("energy", a.energy.value, energy * a.energy_scale + 1e-9 * a.force_scale * a.length_scale);
  }

  /// Exact runs of `count` scenes at distance delta; those of a smaller count are among them.
  [[nodiscard]] Deviation spread_of(double delta, int from, int to) {
    Deviation spread;
    for (int j = from; j < to; ++j) {
      const Track near =
          run_of(neighbour(model_, weights_, delta, scene_.run.t_end, static_cast<std::uint64_t>(j)),
                 reference_spec_);
      spread.include(deviation(reference_, near, weights_, scene_.run.t_end));
    }
    return spread;
  }

  /// Adds neighbours until the promise is kept, or there are enough of them to say that it is not.
  [[nodiscard]] Finding settle(const Deviation& found, Promise& promise, double delta) {
    Finding finding;
    const auto wanting = [&] { return !finding.kept && !spent(); };
    for (int count = 0; count < settings_.more && (count == 0 || wanting()); count += settings_.directions) {
      promise.spread.include(spread_of(delta, count, count + settings_.directions));
      finding = check(found, promise);
    }
    return finding;
  }

  void add(const std::string& engine, const Track& track, const Deviation& found, const Promise& promise,
           const Finding& finding, bool decided) {
    Comparison c;
    c.engine = engine;
    c.worst = finding.worst;
    c.aligned = found.aligned;
    c.sharp_times = finding.sharp_times;
    c.times = finding.times;
    c.until = finding.until;
    c.to_end = finding.to_end;
    c.what = finding.what;
    if (!finding.kept) {
      c.verdict = decided ? Verdict::disagree : Verdict::undecided;
    } else if (found.splits()) {
      c.verdict = finding.unresolved ? Verdict::unresolved : Verdict::ill_conditioned;
      c.what = fmt::format("from {:.6g} on: {}", found.until, found.split);
    } else if (track.end == Track::End::too_long || reference_.end == Track::End::too_long) {
      c.verdict = Verdict::too_long;
      c.what = fmt::format("compared to {:.3g}", c.until);
    } else if (!finding.to_end) {
      c.verdict = promise.spread.splits() ? Verdict::ill_conditioned : Verdict::too_long;
      c.what = fmt::format("compared to {:.6g}, where neighbours {}", c.until,
                           promise.spread.splits() ? "part: " + promise.spread.split : "were given up");
    }
    result_.comparisons.push_back(c);
  }

  /// What all steps of ida may have been off together, relative.
  [[nodiscard]] double delta_of(const Track& track, double rtol) const {
    const double errors = static_cast<double>(track.report.counters.steps) / steps_per_tolerance;
    return settings_.margin * rtol * std::max(1.0, errors);
  }

  void compare_ida(const std::string& name, double rtol) {
    steps_left_ = settings_.engine_steps;
    const Track track = run_of(model_, spec(Engine::ida, rtol));
    if (refused(name, track)) return;
    Promise promise;
    promise.delta = delta_of(track, rtol);
    promise.blur = promise.delta / rtol;
    promise.resolution = settings_.margin;
    promise.least_time = roundoff * scene_.run.t_end;
    const Deviation found = deviation(reference_, track, weights_, scene_.run.t_end);
    const Finding finding = settle(found, promise, promise.delta);
    add(name, track, found, promise, finding, !spent());
    if (rtol == settings_.tight) check_audit(track, name, promise.delta, std::max(1e-6, promise.delta));
  }

  bool refused(const std::string& name, const Track& track) {
    if (track.end != Track::End::refused) return false;
    Comparison c;
    c.engine = name;
    c.verdict = Verdict::disagree;
    c.what = "refuses what the reference takes: " + track.said;
    result_.comparisons.push_back(c);
    return true;
  }

  void compare_newmark() {
    steps_left_ = newmark_steps_for_one * settings_.engine_steps;
    const double t_end = scene_.run.t_end;
    const double steps = std::clamp(steps_a_period * t_end * model_.omega_max / (2.0 * std::numbers::pi),
                                    fewest_steps, most_steps);
    RunSpec run = spec(Engine::newmark, settings_.tight);
    run.dt = t_end / std::ceil(steps);
    Track coarse = run_of(model_, run);
    if (refused("newmark", coarse)) return;
    for (int halving = 1;; ++halving) {
      run.dt = 0.5 * *run.dt;
      Track fine = run_of(model_, run);
      const Deviation found = deviation(reference_, fine, weights_, t_end);
      Promise promise;
      promise.spread = deviation(fine, coarse, weights_, t_end);
      promise.factor = of_own_difference;
      promise.resolution = of_own_difference;
      promise.delta = settings_.margin * settings_.tight;
      promise.least_time = first_step * t_end;
      Finding finding = check(found, promise);
      // Flights lower than the rounding of their gaps are known to series, and rest in newmark.
      if (!finding.kept && found.splits() && finding.worst <= 1.0 &&
          rests_by_rounding(reference_, fine, t_end)) {
        finding.kept = finding.unresolved = true;
        finding.to_end = false;
      }
      const bool last = halving == settings_.halvings || fine.end == Track::End::too_long || spent();
      if (!finding.kept && last && found.splits() && !promise.spread.u.empty())
        finding = settle(found, promise, settings_.margin * promise.spread.u.back());
      if (finding.kept || last) {
        add("newmark", fine, found, promise, finding, !spent() && fine.end != Track::End::too_long);
        return;
      }
      coarse = std::move(fine);
    }
  }

  const Scene& scene_;
  const JudgeSettings settings_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  long steps_left_ = settings_.engine_steps;
  Model model_;
  RunSpec reference_spec_;
  Track reference_;
  Weights weights_;
  bool linear_ = true;
  Judgement result_;
};

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agree:
      return "agree";
    case Verdict::stopped:
      return "stopped";
    case Verdict::unresolved:
      return "unresolved";
    case Verdict::ill_conditioned:
      return "ill-conditioned";
    case Verdict::refused:
      return "refused";
    case Verdict::too_long:
      return "too long";
    case Verdict::undecided:
      return "undecided";
    case Verdict::disagree:
      return "DISAGREE";
  }
  return "?";
}

Judgement judge(const Scene& scene, const JudgeSettings& settings) { return Judge(scene, settings)(); }

}  // namespace signorini::differential
