#include "differential/metamorphic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "differential/neighbour.hpp"
#include "differential/random.hpp"
#include "motion/point.hpp"

namespace signorini::differential {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
// Forces are compared relative to the greatest one, after the events' times have had their say.
constexpr double force_off = 1e-9;
constexpr double steps_per_tolerance = 5.0;  // a step of ida spends a fifth of it (docs/theory.md)
constexpr double margin = 5.0;               // JudgeSettings::margin
constexpr int neighbours = 6;
constexpr double widest_scale = 20.0;  // decades, to both sides

/// What computes a run, at which tolerance.
struct Means {
  Engine engine = Engine::exact;
  double rtol = 1e-10;

  [[nodiscard]] RunSpec of(const Scene& scene) const {
    RunSpec run = scene.run;
    run.engine = engine;
    run.rtol = rtol;
    run.atol = {};
    return run;
  }
};

Track run_scene(const Scene& scene, const Means& means, const Bounds& bounds) {
  try {
    return differential::run(build_model(scene), means.of(scene), bounds);
  } catch (const SceneError& error) {
    Track track;
    track.end = Track::End::refused;
    track.said = error.what();
    return track;
  }
}

/// Units of force, length and time in N, m and s, the other way round.
constexpr Factors systems[] = {{1e-3, 1.0, 1.0},                            // kN, m
                               {1.0, 1e3, 1.0},                             // N, mm
                               {1e-6, 1.0, 1e3},                            // MN, m, ms
                               {1.0 / 4.4482216152605, 1.0 / 0.3048, 1.0},  // lbf, ft
                               {1e5, 1e2, 1.0}};                            // dyn, cm

}  // namespace

std::vector<Transformed> transformations(const Scene& scene, std::uint64_t seed) {
  std::vector<Transformed> all;
  Random draw(seed);
  const auto add = [&](std::optional<Transformed> other) {
    if (other) all.push_back(std::move(*other));
  };
  for (const double degrees : {7.0, 45.0, 90.0, draw.rounded(0.0, 360.0, 3), draw.rounded(0.0, 360.0, 3)})
    add(turned(scene, degrees));
  add(mirrored(scene));
  add(permuted(scene, seed));
  add(permuted(scene, seed + 1));
  add(reversed(scene));
  for (const Factors& system : systems) add(in_units(scene, system));
  for (const double exponent : {-20.0, -9.0, draw.rounded(-20.0, 20.0, 2), 12.0, 20.0}) {
    const double scale = std::pow(10.0, exponent);
    add(in_units(scene, {scale, 1.0, 1.0}));
    add(in_units(scene, {1.0, scale, 1.0}));
    add(in_units(scene, {1.0, 1.0, scale}));
  }
  for (const int exponent : {-50, -30, 30}) add(in_units(scene, {std::ldexp(1.0, exponent), 1.0, 1.0}));
  return all;
}

std::vector<Transformed> angles_and_scales(const Scene& scene, int angles, int scales) {
  std::vector<Transformed> all;
  for (int i = 0; i < angles; ++i)
    if (auto other = turned(scene, 360.0 * i / angles)) all.push_back(std::move(*other));
  for (int j = 0; j < scales; ++j) {
    const double scale = std::pow(10.0, widest_scale * (2.0 * j / std::max(1, scales - 1) - 1.0));
    const Factors factors[] = {{scale, 1.0, 1.0}, {1.0, scale, 1.0}, {1.0, 1.0, scale}};
    if (auto other = in_units(scene, factors[j % 3])) all.push_back(std::move(*other));
  }
  return all;
}

struct Metamorphic::Members {
  Scene scene;
  MetamorphicSettings settings;
  std::string hindrance;
  Model model;
  Means means;  ///< of the reference: exact, ida ten times sharper where friction is not linear, or newmark
  Track reference;
  Weights weights;
  Deviation spread;
  std::map<double, Deviation> spreads;  ///< ida: by delta

  /// Runs of the same scene, its data off by one rounding; and its motion, since a turn makes of a small
  /// displacement the sum of two great ones, each with its own rounding.
  void disturb() {
    spread.include(spread_of(eps));
    for (int j = 0; j < settings.disturbances; ++j) {
      const Scene other = disturbed(scene, static_cast<std::uint64_t>(j));
      const Track track = run_scene(other, means, settings.bounds);
      if (track.end != Track::End::refused)
        spread.include(deviation(reference, track, weights, scene.run.t_end));
    }
  }

  /// The same of a way in its own numbers: along the axes a beam's bending has the rounding of EI, turned it has
  /// that of EA, too. track: of the way, written back.
  [[nodiscard]] Deviation spread_as_written(const Transformed& other, const Track& track) const {
    Deviation result;
    for (int j = 0; j < settings.disturbances; ++j) {
      Track copy = run_scene(disturbed(other.scene, static_cast<std::uint64_t>(j)), means, settings.bounds);
      if (copy.end == Track::End::refused) continue;
      copy = mapped_back(std::move(copy), other, reference, scene);
      result.include(deviation(track, copy, weights, scene.run.t_end));
    }
    return result;
  }

  /// What steps of ida may have been off together, relative; steps rounded up to a power of two, so that
  /// runs share their neighbours.
  [[nodiscard]] double delta_of(const Track& track) const {
    const double errors = static_cast<double>(track.report.counters.steps) / steps_per_tolerance;
    return margin * settings.rtol * std::exp2(std::ceil(std::log2(std::max(1.0, errors))));
  }

  /// How far runs of neighbours lie apart.
  [[nodiscard]] const Deviation& spread_of(double delta) {
    const auto [it, first] = spreads.try_emplace(delta);
    if (!first) return it->second;
    const RunSpec run = means.of(scene);
    const Weights whole = weights_of(model, reference);
    for (int j = 0; j < neighbours; ++j) {
      const Model near = neighbour(model, whole, delta, scene.run.t_end, static_cast<std::uint64_t>(j));
      it->second.include(
          deviation(reference, differential::run(near, run, settings.bounds), weights, scene.run.t_end));
    }
    return it->second;
  }

  [[nodiscard]] Promise promise_of(const Track& track) {
    Promise promise;
    promise.least_time = motion::resolution_at(scene.run.t_end, 0.0);  // what is closer is one instant
    if (settings.engine != Engine::ida) {
      promise.spread = spread;
      promise.factor = settings.factor;
      promise.delta = force_off;
      promise.blur = 0.0;
      return promise;
    }
    promise.delta = delta_of(track);
    promise.blur = promise.delta / settings.rtol;
    promise.resolution = margin;
    promise.spread = spread_of(promise.delta);
    return promise;
  }
};

Metamorphic::Metamorphic(const Scene& scene, const MetamorphicSettings& settings)
    : m_(std::make_unique<Members>()) {
  m_->scene = scene;
  m_->settings = settings;
  for (const ContactSpec& contact : scene.contacts)
    if (contact.friction.stribeck_velocity) m_->means = {Engine::ida, 0.1 * settings.rtol};
  if (settings.engine == Engine::newmark && m_->means.engine == Engine::exact)
    m_->means.engine = Engine::newmark;
  if (settings.engine != Engine::ida && m_->means.engine == Engine::ida) {
    m_->hindrance = "its friction is not linear";
    return;
  }
  m_->reference = run_scene(scene, m_->means, settings.bounds);
  if (m_->reference.end == Track::End::refused) m_->hindrance = m_->reference.said;
  if (m_->reference.end == Track::End::too_long) m_->hindrance = "it takes too long";
  if (!m_->hindrance.empty()) return;
  m_->model = build_model(scene);
  m_->weights.force = weights_of(m_->model, m_->reference).force;
  if (settings.engine != Engine::ida) m_->disturb();
}

Metamorphic::~Metamorphic() = default;

const std::string& Metamorphic::hindrance() const { return m_->hindrance; }

Sameness Metamorphic::compare(const Transformed& other) const {
  Sameness result;
  Track track = run_scene(other.scene, {m_->settings.engine, m_->settings.rtol}, m_->settings.bounds);
  if (track.end == Track::End::refused) {
    result.verdict = Sameness::Verdict::refused;
    result.what = track.said;
    return result;
  }
  Promise promise = m_->promise_of(track);
  const std::string said = track.said;
  result.ended = track.end == m_->reference.end && track.reason == m_->reference.reason;
  track = mapped_back(std::move(track), other, m_->reference, m_->scene);
  const Deviation found = deviation(m_->reference, track, m_->weights, m_->scene.run.t_end);
  Finding finding = check(found, promise);
  if (!finding.kept && found.splits() && finding.worst <= 1.0 &&
      rests_by_rounding(m_->reference, track, m_->scene.run.t_end)) {
    finding.kept = true;
    finding.to_end = false;
  }
  if (!finding.kept && m_->settings.engine != Engine::ida) {
    promise.spread.include(m_->spread_as_written(other, track));
    finding = check(found, promise);
  }
  result.verdict = finding.kept ? Sameness::Verdict::same : Sameness::Verdict::unlike;
  result.worst = finding.worst;
  result.events = found.aligned;
  result.to_end = finding.to_end;
  result.what = finding.what;
  if (!finding.kept && !said.empty()) result.what += " (" + said + ")";
  if (finding.kept && found.splits()) result.what = "parts where rounding decides: " + found.split;
  return result;
}

}  // namespace signorini::differential
