#include "differential/pair_commands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "differential/relation_judge.hpp"
#include "differential/transform.hpp"
#include "signorini/orbit.hpp"
#include "study/reduction/find_cutoff.hpp"
#include "study/sweep/sweep_row.hpp"
#include "study/verify/verify.hpp"

namespace signorini::differential {

using Kind = Checked::Kind;

namespace {

bool is_linear(const Scene& scene) {
  return std::none_of(scene.contacts.begin(), scene.contacts.end(), [](const ContactSpec& c) {
    return c.friction.is_rate_dependent() || c.pendulum_surface || c.user_law;
  });
}

/// Something of a run at one place of it.
using Quantity = std::function<double(const Result&)>;

class Differences {
 public:
  Differences(const SceneReader& read, const std::string& path, double p, bool linear)
      : read_(read), path_(path), p_(p), linear_(linear) {}

  /// Runs at p + k h, k = -2, -1, 1, 2, for h and h/4.
  void run(double h) {
    h_ = h;
    for (const double part : {1.0, 0.25})
      for (const int k : {-2, -1, 1, 2}) runs_.push_back(at(p_ + k * part * h));
  }
  [[nodiscard]] const std::vector<Result>& runs() const { return runs_; }
  [[nodiscard]] double coarse(const Quantity& of) const { return difference(of, 0, h_); }
  [[nodiscard]] double fine(const Quantity& of) const { return difference(of, 4, 0.25 * h_); }
  [[nodiscard]] double fine_step() const { return 0.25 * h_; }

 private:
  [[nodiscard]] Result at(double value) const {
    Scene scene = read_({{path_, fmt::format("{:.17g}", value)}});
    scene.run.certify = Certify::no;
    if (linear_) {
      scene.run.engine = Engine::exact;
      scene.run.flow = Flow::taylor;
    } else {
      scene.run.engine = Engine::ida;
      scene.run.rtol = 1e-12;
      scene.run.atol = {};
    }
    return simulate(build_model(scene), scene.run);
  }
  [[nodiscard]] double difference(const Quantity& of, std::size_t first, double h) const {
    return (8.0 * (of(runs_[first + 2]) - of(runs_[first + 1])) - (of(runs_[first + 3]) - of(runs_[first]))) /
           (12.0 * h);
  }

  const SceneReader& read_;
  const std::string& path_;
  double p_, h_ = 0.0;
  bool linear_;
  std::vector<Result> runs_;
};

/// How many events the runs have in common, in the same order.
std::size_t common_events(const Sensitivities& s, const std::vector<Result>& runs) {
  std::size_t count = s.events.size();
  for (const Result& run : runs) {
    std::size_t i = 0;
    while (i < std::min(count, run.events.size()) && run.events[i].contact == s.events[i].contact &&
           run.events[i].type == s.events[i].type)
      ++i;
    count = i;
  }
  return count;
}

/// What a derivative may be off by.
struct Allowed {
  double relative = 1e-5;  ///< of the greatest of its kind
  double noise = 0.0;      ///< of a value, over the step
  double of_differences = 20.0;
};

}  // namespace

Checked by_derivatives(const SceneReader& read, const std::string& path) {
  const std::string how = "derivatives by " + path;
  const Scene scene = read({});
  const Sensitivities s = sensitivities(read, {path});
  const Parameter& p = s.parameters[0];
  const bool linear = is_linear(scene), in_steps = engine_info(scene.run.engine).accuracy == Accuracy::step;
  Differences differences(read, path, p.value, linear);
  const double size = p.value != 0.0 ? std::abs(p.value) : 1.0;
  differences.run((linear ? 2e-4 : 1e-3) * size);
  const std::size_t count = common_events(s, differences.runs());
  const double until = std::min({p.until, count < s.events.size() ? s.events[count].t : scene.run.t_end});
  Allowed allowed;
  if (in_steps) allowed.relative = 2e-2;
  if (!linear) allowed.relative = 1e-3;
  long compared = 0;
  double greatest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(s.event_rates[i][0].t)) greatest = std::max(greatest, std::abs(s.event_rates[i][0].t));
  const double time_noise = (linear ? 1e-13 : 1e-9) * scene.run.t_end / differences.fine_step();
  for (std::size_t i = 0; i < count; ++i) {
    const double rate = s.event_rates[i][0].t;
    if (s.events[i].contact < 0 || s.events[i].t >= until || !std::isfinite(rate)) continue;
    const Quantity t = [i](const Result& run) { return run.events[i].t; };
    const double fine = differences.fine(t), coarse = differences.coarse(t);
    const double bound =
        allowed.of_differences * std::abs(fine - coarse) + allowed.relative * greatest + time_noise;
    ++compared;
    if (!(std::abs(rate - fine) <= bound))
      return {Kind::broken, how,
              fmt::format("dt/dp of the event at {:.9g}: {:.9g}, differences {:.9g}, {:.2g} allowed",
                          s.events[i].t, rate, fine, bound)};
  }
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    for (const char* of : {".ut", ".N"}) {
      const auto place = std::find(s.columns.begin(), s.columns.end(), s.contacts[c] + of);
      if (place == s.columns.end()) continue;
      const auto column = static_cast<std::size_t>(place - s.columns.begin());
      const bool force = of[1] == 'N';
      double most = 0.0, value = 0.0;
      for (std::size_t i = 0; i < s.times.size(); ++i) {
        if (std::isfinite(s.value_rates[0][i][column]))
          most = std::max(most, std::abs(s.value_rates[0][i][column]));
        if (std::isfinite(s.values[i][column])) value = std::max(value, std::abs(s.values[i][column]));
      }
      const double noise = (linear ? 1e-11 : 1e-7) * value / differences.fine_step();
      for (std::size_t i = 0; i < s.times.size() && s.times[i] < until; ++i) {
        const double rate = s.value_rates[0][i][column];
        const bool there =
            std::all_of(differences.runs().begin(), differences.runs().end(), [&](const Result& run) {
              return run.rows.size() > i && std::abs(run.rows[i].t - s.times[i]) <= 1e-9 * scene.run.t_end;
            });
        if (!there || !std::isfinite(rate)) continue;
        const Quantity x = [i, c, force](const Result& run) {
          return force ? run.rows[i].contacts[c].N : run.rows[i].contacts[c].ut;
        };
        const double fine = differences.fine(x), coarse = differences.coarse(x);
        const double bound =
            allowed.of_differences * std::abs(fine - coarse) + allowed.relative * most + noise;
        ++compared;
        if (!(std::abs(rate - fine) <= bound))
          return {Kind::broken, how,
                  fmt::format("d({}{})/dp at {:.9g}: {:.9g}, differences {:.9g}, {:.2g} allowed",
                              s.contacts[c], of, s.times[i], rate, fine, bound)};
      }
    }
  }
  if (compared == 0) return {Kind::idle, how, "no derivative is known: " + p.reason};
  return {Kind::held, how, ""};
}

namespace {

/// Greatest |x(T) - x(0)| of displacements, over the amplitude.
double gap_after_period(Scene scene, const Orbit& orbit, bool linear) {
  scene.run.t_end = orbit.period;
  scene.run.certify = Certify::no;
  scene.run.output_times.reset();
  scene.run.output_dt = orbit.period;
  // Another engine than the one that found it, where there is one.
  if (linear && scene.run.engine != Engine::exact) {
    scene.run.engine = Engine::exact;
  } else {
    scene.run.engine = Engine::ida;
    scene.run.rtol = 1e-11;
    scene.run.atol = {};
  }
  const Model model = build_model(scene);
  const Result run = simulate(model, scene.run);
  if (run.report.outcome.kind != Outcome::Kind::done) return std::nan("");
  const Vector off = run.rows.back().u - run.rows.front().u;
  return off.cwiseAbs().maxCoeff() / orbit.amplitude;
}

}  // namespace

Checked by_orbit(const SceneReader& read, std::uint64_t seed) {
  const Scene scene = read({});
  OrbitOptions options;
  options.transient = 30;
  const Orbit orbit = find_orbit(read, options);
  if (!orbit.found) return {Kind::idle, "orbit", "no orbit: " + orbit.reason};
  if (!(orbit.amplitude > 0.0)) return {Kind::idle, "orbit", "nothing moves"};
  constexpr double closes = 1e-5;
  const double gap = gap_after_period(orbit_scene(read, orbit), orbit, is_linear(scene));
  // An unstable orbit grows what is left of it within the period.
  const double grown = closes * std::max(1.0, orbit.max_multiplier);
  if (gap > grown)
    return {Kind::broken, "orbit",
            fmt::format("another engine is {:.3g} of the amplitude off after a period", gap)};
  const SceneReader other = [&](const std::vector<Override>& changes) {
    return permuted(read(changes), seed).scene;
  };
  const Orbit twin = find_orbit(other, options);
  if (!twin.found) return {Kind::broken, "orbit", "in another order of tables there is none: " + twin.reason};
  // Families of orbits, and orbits beside each other, are not the same one.
  const bool same = std::abs(twin.amplitude - orbit.amplitude) <= 1e-7 * orbit.amplitude;
  if (orbit.families.empty() && same && std::abs(twin.period - orbit.period) <= 1e-9 * orbit.period) {
    const double off = std::abs(twin.max_multiplier - orbit.max_multiplier);
    if (off > 100.0 * (orbit.multiplier_error + twin.multiplier_error) + 1e-6)
      return {Kind::broken, "orbit",
              fmt::format("greatest multiplier {:.9g}, in another order of tables {:.9g}, errors {:.2g}",
                          orbit.max_multiplier, twin.max_multiplier, orbit.multiplier_error)};
    return {Kind::held, "orbit", ""};
  }
  return {std::isnan(gap) ? Kind::idle : Kind::held, "orbit", ""};
}

Checked by_sweep(const CheckRequest& request, const std::string& path) {
  const std::string how = "sweep of " + path;
  const auto asks = [&](Check check) {
    return std::find(request.checks.begin(), request.checks.end(), check) != request.checks.end();
  };
  const Scene scene = parse_scene(request.text, "pair.toml");
  double given = std::nan("");
  for (const LoadSpec& load : scene.loads)
    if (load.name == "push") given = load.amplitude;
  constexpr double part = 0.9;
  const std::string value = fmt::format("{:.17g}", part * given);
  Scene changed = reduction::find_cutoff(parse_scene(request.text, "pair.toml", {{path, value}}));
  std::optional<SavedState> carried;
  if (asks(Check::going_on)) {
    const std::optional<Related> later =
        related_going_on_at(reduction::find_cutoff(scene), 0.3 * scene.run.t_end);
    if (!later) return {Kind::idle, how, "the run does not come so far"};
    carried = later->scene.initial.saved;
    changed.initial = {};
    changed.initial.saved = carried;
  }
  const sweep::SweepRow row =
      sweep::compute_row({"pair.toml", request.text, {{path, value}}, 0, {value}, {}, {}}, carried);
  if (row.outcome == "refused") return {Kind::refused, how, row.reason};
  if (row.outcome != "done") return {Kind::idle, how, row.outcome + ": " + row.reason};
  Transformed other = permuted(changed, request.seed);
  if (asks(Check::in_units)) {
    std::optional<Transformed> units = in_units(other.scene, {1e-3, scene.matrices ? 1.0 : 1000.0, 1e3});
    if (units) other = std::move(*units);
  }
  const RelationJudge judge(changed, request.bounds);
  const Likeness own = judge.compare({other.name, other.scene, other.factors});
  const SeenRun run = see_plainly(other.scene, request.bounds);
  const bool certain = is_explained(own.verdict) && own.verdict != Likeness::Class::undetermined &&
                       own.verdict != Likeness::Class::ended_before && run.end == Track::End::done;
  if (!certain) return {Kind::idle, how, "the related run is not certain to the end, or differs by itself"};
  if (row.changes() != static_cast<long>(run.events.size()))
    return {Kind::broken, how,
            fmt::format("{} events, of a related run {}", row.changes(), run.events.size())};
  double greatest = 0.0;
  for (const Peak& peak : run.peaks) greatest = std::max({greatest, std::abs(peak.N), std::abs(peak.T)});
  constexpr double same = 1e-5;
  for (const sweep::SweepRow::Contact& c : row.contacts)
    for (std::size_t k = 0; k < run.contacts.size(); ++k) {
      if (run.contacts[k] != c.name) continue;
      const double f = other.factors.force;
      const double off = std::max(std::abs(f * std::abs(c.N) - std::abs(run.peaks[k].N)),
                                  std::abs(f * std::abs(c.T) - std::abs(run.peaks[k].T)));
      if (off > same * greatest)
        return {Kind::broken, how, fmt::format("peak forces of {} differ by {:.3g}", c.name, off / f)};
    }
  return {Kind::held, how, ""};
}

Checked by_verify(const Scene& scene) {
  verify::VerifyRequest request;
  request.run = scene.run;
  request.run.engine = Engine::ida;
  request.dt = scene.run.dt ? *scene.run.dt : scene.run.t_end / 2000.0;
  request.max_seconds = 2.0;
  const Model model = build_model(scene);
  const verify::Verification found = verify::verify(model, model, request);
  if (found.verdict == verify::Agreement::agree) return {Kind::held, "verify", ""};
  return {found.verdict == verify::Agreement::differ ? Kind::broken : Kind::idle, "verify", found.sentence};
}

}  // namespace signorini::differential
