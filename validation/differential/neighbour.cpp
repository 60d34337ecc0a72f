#include "differential/neighbour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "differential/random.hpp"

namespace signorini::differential {
namespace {

// The exact flow's step follows the frequencies of its loads; far above the run's own they change nothing.
constexpr double most_periods = 100.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

Load disturbance(int dof, double amplitude, double omega, double phase) {
  Piece wave;
  wave.amplitude = amplitude;
  wave.omega = omega;
  wave.phase = phase;
  Load load;
  load.name = "disturbance";
  load.direction.terms = {{dof, 1.0}};
  load.history = History(wave);
  return load;
}

}  // namespace

Model neighbour(const Model& model, const Weights& weights, double delta, double t_end, std::uint64_t seed) {
  Random draw(seed);
  Model near = model;
  const double slowest = two_pi / t_end;
  const double fastest = std::clamp(model.omega_max, slowest, most_periods * slowest);
  for (int i = 0; i < model.size(); ++i) {
    const double omega = slowest * std::pow(fastest / slowest, draw.real(0.0, 1.0));
    const double phase = draw.real(0.0, two_pi);
    const double mass = model.mass.coeff(i, i);
    if (!(mass > 0.0)) continue;
    const auto k = static_cast<std::size_t>(i);
    near.loads.push_back(disturbance(i, delta * mass * weights.v[k] * omega, omega, phase));
    const double slow_phase = draw.real(0.0, two_pi);
    near.loads.push_back(
        disturbance(i, delta * mass * weights.u[k] * slowest * slowest, slowest, slow_phase));
    const double part = std::pow(most_periods, -draw.real(0.0, 1.0)), part_phase = draw.real(0.0, two_pi);
    near.loads.push_back(
        disturbance(i, delta * mass * weights.u[k] * slowest * slowest / part, slowest / part, part_phase));
  }
  for (Contact& contact : near.contacts) {
    const double share = draw.real(-1.0, 1.0);
    const double of_rebound = draw.real(-1.0, 1.0);
    if (contact.takes_impulses()) {
      const double change = contact.restitution < 1.0 ? of_rebound : -std::abs(of_rebound);
      contact.restitution = std::min(1.0, contact.restitution * (1.0 + delta * change));
    }
    if (contact.normal_force_given() || contact.gap_at(model.u0) <= 0.0) continue;
    double reach = 0.0;
    for (const auto& [dof, factor] : contact.normal.terms)
      reach += std::abs(factor) * weights.u[static_cast<std::size_t>(dof)];
    const double open = contact.gap_at(model.u0);
    // It stays open: whether it starts closed is the scene's, not the engines'.
    contact.gap += std::max(share * delta * reach, -0.5 * open);
  }
  return near;
}

}  // namespace signorini::differential
