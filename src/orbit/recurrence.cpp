#include "orbit/recurrence.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr double near_enough = 0.02;  // relative to the range: the first return within this distance is used.
                                      // Chosen value.
constexpr double too_far = 0.5;
constexpr double least_distance = 0.02;  // relative to the period, from the section to an event. Chosen
                                         // value.

bool same_states(const OrbitPoint& a, const OrbitPoint& b) {
  return std::equal(a.mode.begin(), a.mode.end(), b.mode.begin(), b.mode.end(),
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

Recurrence recurrence(const Model& model, const std::vector<OrbitPoint>& instants) {
  Recurrence found;
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
    if (d <= near_enough) break;
  }
  if (best == count || found.distance > too_far) return found;
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

}  // namespace signorini
