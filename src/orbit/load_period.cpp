#include "orbit/load_period.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/text.hpp"
#include "scene/history_from_spec.hpp"

namespace signorini::orbit {
namespace {

// Relative difference up to which two periods are equal, or have a ratio of integers. Scenes give periods
// with at least this accuracy. Chosen value.
constexpr double same_period = 1e-9;
constexpr int max_multiples = 100;
// Number of times at which a history is compared with itself one period later; chosen value.
constexpr int compared_places = 41;

/// A history of the scene, and its key.
struct Driver {
  const HistorySpec* spec;
  std::string key;
  bool surface = false;
  bool acceleration = false;  // true: acceleration of a support, which starts from rest
};

bool drives(const LoadSpec& load) { return load.amplitude != 0.0; }

std::vector<Driver> drivers(const Scene& scene, const CountedLoads& count = {}) {
  std::vector<Driver> all;
  const auto add = [&](const HistorySpec& spec, std::string key, bool surface = false,
                       bool acceleration = false) {
    if (spec.amplitude != 0.0 || spec.in_code) all.push_back({&spec, std::move(key), surface, acceleration});
  };
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    if (drives(scene.loads[i]) || (i < count.size() && count[i]))
      add(scene.loads[i].history, fmt::format("loads.{}.history", i + 1));
  for (std::size_t i = 0; i < scene.base_motion.size(); ++i)
    add(scene.base_motion[i].acceleration, fmt::format("base_motion.{}.acceleration", i + 1));
  for (const Support& s : scene.supports)
    if (s.motion)
      add(*s.motion, s.key + (s.motion_is_acceleration ? ".acceleration" : ".motion"), false,
          s.motion_is_acceleration);
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    add(scene.members[i].temperature, fmt::format("members.{}.temperature", i + 1));
    add(scene.members[i].initial_strain, fmt::format("members.{}.initial_strain", i + 1));
  }
  for (const BodySpec& b : scene.bodies) add(b.temperature, "bodies." + b.name + ".temperature");
  for (const ContactSpec& c : scene.contacts) {
    add(c.normal_force, c.key("normal_force"));
    add(c.surface_velocity, c.key("surface_velocity"), true);
  }
  return all;
}

bool repeats(const HistorySpec& spec) {
  return spec.period > 0.0 ||
         (spec.type == HistoryType::harmonic && std::isinf(spec.end) && spec.omega != 0.0 && !spec.in_code);
}

double history_period(const HistorySpec& spec) {
  return spec.period > 0.0 ? spec.period : 2.0 * std::numbers::pi / std::abs(spec.omega);
}

/// Time from which the history is periodic or constant.
double periodic_since(const HistorySpec& spec) {
  if (spec.in_code) return spec.in_code->starts().empty() ? 0.0 : spec.in_code->starts().back();
  if (spec.type == HistoryType::table)
    return (spec.period > 0.0 ? spec.times.front() : spec.times.back()) + spec.shift;
  if (spec.period > 0.0 || std::isinf(spec.end)) return spec.start_given ? spec.start + spec.shift : 0.0;
  return spec.end + spec.shift;
}

LoadPeriod settled(const std::vector<Driver>& all) {
  LoadPeriod found;
  for (const Driver& d : all) {
    found.periodic_from = std::max(found.periodic_from, periodic_since(*d.spec));
    if (d.surface) found.surfaces_move = true;
  }
  return found;
}

/// Smallest common multiple, up to max_multiples times the longer period; nullopt if there is none.
std::optional<double> common(double a, double b) {
  if (a < b) std::swap(a, b);
  for (int k = 1; k <= max_multiples; ++k) {
    const double ratio = k * a / b;
    if (std::abs(ratio - std::round(ratio)) <= same_period * ratio) return k * a;
  }
  return std::nullopt;
}

/// An accelerated support starts at rest at zero displacement. Its motion is periodic only if the
/// acceleration changes neither its velocity nor its displacement over one period.
void check_drift(const Driver& d, const History& acceleration, double settled, double period) {
  const History moved = acceleration.integrated().integrated();
  double size = 0.0, drift = 0.0;
  for (int i = 0; i < compared_places; ++i) {
    const double t = settled + period * i / compared_places;
    const double by = moved.value(t + period) - moved.value(t);
    size = std::max({size, std::abs(moved.value(t)), std::abs(moved.value(t + period))});
    if (std::abs(by) > std::abs(drift)) drift = by;
  }
  if (std::abs(drift) <= same_period * 2.0 * std::numbers::pi * size) return;
  throw SceneError(
      d.spec->place, d.key,
      fmt::format(
          "found an acceleration that displaces the support by {:.6g} in each period of {} (from rest at "
          "zero displacement), expected an acceleration without drift: with drift no motion is periodic",
          drift, base::format_number(period)));
}

}  // namespace

CountedLoads driving_loads(const Scene& scene) {
  CountedLoads count;
  for (const LoadSpec& load : scene.loads) count.push_back(drives(load));
  const bool none = std::find(count.begin(), count.end(), true) == count.end();
  return none ? CountedLoads(count.size(), true) : count;
}

LoadPeriod load_period(const Scene& scene, const CountedLoads& count) {
  const std::vector<Driver> all = drivers(scene, count);
  LoadPeriod found = settled(all);
  for (const Driver& d : all) {
    if (!repeats(*d.spec)) continue;
    const double own = history_period(*d.spec);
    const std::optional<double> both = found.period ? common(*found.period, own) : own;
    if (!both)
      throw SceneError(
          d.spec->place, d.key,
          fmt::format(
              "found the period {}, while earlier histories have the period {}; expected periods with "
              "a common multiple of at most {} times the longer period",
              base::format_number(own), base::format_number(*found.period), max_multiples));
    found.period = both;
  }
  return found.period ? check_period(scene, *found.period, count) : found;
}

LoadPeriod check_period(const Scene& scene, double period, const CountedLoads& count) {
  const std::vector<Driver> all = drivers(scene, count);
  LoadPeriod found = settled(all);
  found.period = period;
  for (const Driver& d : all) {
    HistorySpec spec = *d.spec;
    if (spec.period > 0.0)
      spec.rounds = static_cast<int>(std::ceil((found.periodic_from + 3.0 * period) / spec.period)) + 1;
    const History f = scene::make_history(spec, d.key);
    double size = 0.0, differ = 0.0;
    for (int i = 0; i < compared_places; ++i) {
      const double t = found.periodic_from + period * (i + 1.0 / std::numbers::sqrt2) / compared_places;
      const double now = f.value(t), then = f.value(t + period);
      size = std::max({size, std::abs(now), std::abs(then)});
      differ = std::max(differ, std::abs(now - then));
    }
    if (differ > same_period * 2.0 * std::numbers::pi * size)
      throw SceneError(
          d.spec->place, d.key,
          fmt::format("found a history that changes by {:.2g} of its largest value from one period of {} to "
                      "the next, expected a history with this period",
                      differ / size, base::format_number(period)));
    if (d.acceleration) check_drift(d, f, found.periodic_from, period);
  }
  return found;
}

std::vector<Override> shifted_excitation(const Scene& scene, double time) {
  std::vector<Override> changes;
  for (const Driver& d : drivers(scene)) {
    const bool always =
        d.spec->type == HistoryType::constant && !d.spec->start_given && std::isinf(d.spec->end);
    if (!always && !d.spec->in_code)
      changes.push_back({d.key + ".shift", base::format_number(d.spec->shift - time)});
  }
  return changes;
}

namespace {

// The search for a return to an earlier state ends at this distance or less. Distances are relative to the range of the
// motion. Chosen value.
constexpr double accepted_return_distance = 0.02;
// A return to a state at a larger distance is ignored.
constexpr double max_return_distance = 0.5;
// Smallest distance from the section to an event, relative to the period. Chosen value.
constexpr double least_distance = 0.02;

bool same_states(const OrbitPoint& a, const OrbitPoint& b) {
  return std::equal(a.states.begin(), a.states.end(), b.states.begin(), b.states.end(),
                    [](const ContactState& x, const ContactState& y) { return x.state == y.state; });
}

/// Largest difference of displacements and velocities, in scales.
double distance(const Model& model, const OrbitPoint& a, const OrbitPoint& b) {
  double greatest = 0.0;
  const Scales& s = model.scales;
  for (Eigen::Index i = 0; i < a.u.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    greatest = std::max({greatest, std::abs(a.u[i] - b.u[i]) / (turns ? s.rotation : s.displacement),
                         std::abs(a.v[i] - b.v[i]) / (turns ? s.angular_velocity : s.velocity)});
  }
  return greatest;
}

}  // namespace

ReturnMapStart return_map_start(const Model& model, const std::vector<OrbitPoint>& instants) {
  ReturnMapStart found;
  const std::size_t count = instants.size();
  if (count < 3) return found;
  const OrbitPoint& last = instants.back();
  double range = 0.0;
  for (std::size_t i = count / 2; i + 1 < count; ++i)
    range = std::max(range, distance(model, instants[i], last));
  std::size_t best = count;
  for (std::size_t i = count - 1; i-- > 0;) {
    if (!same_states(instants[i], last)) continue;
    const double d = range > 0.0 ? distance(model, instants[i], last) / range : 0.0;
    if (best != count && d >= found.distance) continue;
    best = i;
    found.distance = d;
    if (d <= accepted_return_distance) break;
  }
  if (best == count || found.distance > max_return_distance) return found;
  found.period = last.t - instants[best].t;
  double longest = 0.0;
  for (std::size_t i = best; i + 1 < count; ++i) {
    const double stretch = instants[i + 1].t - instants[i].t;
    if (stretch <= longest) continue;
    longest = stretch;
    found.section = instants[i].t + 0.5 * stretch;
  }
  return found;
}

double section_away_from(const std::vector<OrbitPoint>& instants, double T) {
  std::vector<double> times;
  for (const OrbitPoint& p : instants) times.push_back(std::fmod(p.t, T));
  if (times.empty()) return 0.0;
  std::sort(times.begin(), times.end());
  if (times.front() > least_distance * T && T - times.back() > least_distance * T) return 0.0;
  double longest = times.front() + T - times.back(), section = std::fmod(times.back() + 0.5 * longest, T);
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (times[i + 1] - times[i] > longest) {
      longest = times[i + 1] - times[i];
      section = times[i] + 0.5 * longest;
    }
  return section;
}

}  // namespace signorini::orbit
