#include "orbit/shooting.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/eigen_dense.hpp"

namespace signorini::orbit {
namespace {

constexpr int max_steps = 30, max_halvings = 6;
// Newton's method stagnates if this number of successive steps does not halve the residual. Chosen value.
constexpr std::size_t patience = 8;
constexpr double reached = 1e-2;  // residual / tolerance at which Newton's method stops
// Residual / amplitude at which an orbit is accepted although the residual no longer decreases: the rounding
// of a long or stiff period. With a larger residual the search has failed. Chosen value.
constexpr double stagnated_residual = 1e-9;
// Singular values of Phi - I up to this limit are regarded as zero, relative to the largest one and to Phi. The limit
// is the rounding of Phi. A disturbance that decays within 1e7 periods has a far larger singular value. Chosen value.
constexpr double least_singular = 1e-9;
// Smaller limits, tried if no step reduces the residual: with fast mode shapes Phi may be 1e5 times larger
// than its part for slow mode shapes.
constexpr std::array finer_steps{1e-11, 1e-13};

// Amplitude, in scales, below which the structure is at rest and its state consists of rounding errors.
// Chosen value: fifty times the rounding of doubles.
constexpr double at_rest = 1e-14;

double over(double value, double amplitude) { return amplitude > at_rest ? value / amplitude : value; }

/// Residual of the state; if an energy is given, the larger one of this residual and the energy's relative residual.
double residual_with_energy(const Model& model, const ShootingStart& start, const OrbitPass& pass) {
  const double gap = orbit_residual(model, pass);
  return start.energy ? std::max(gap, std::abs(pass.energy - *start.energy) / *start.energy) : gap;
}

/// Solution (x, dT) of the equations in shooting.hpp. least: limit below which singular values are zero.
Vector newton_step(const Model& model, const OrbitPass& pass, const ShootingStart& start, double least) {
  const bool free_period = start.free_period;
  const OrbitSection section(model, pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Vector gap = B.transpose() * (section.coordinates(pass.end) - section.coordinates(pass.begin));
  const Eigen::Index n = section.size(), all = n + (free_period ? 1 : 0);
  if (all == 0) return {};
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(all, all);
  const Eigen::MatrixXd phi = B.transpose() * pass.end_derivatives;
  A.topLeftCorner(n, n) = phi - Eigen::MatrixXd::Identity(n, n);
  Vector b = Vector::Zero(all);
  b.head(n) = -gap;
  if (free_period) {
    A.block(0, n, n, 1) = B.transpose() * section.rates(pass.end);
    A.block(n, 0, 1, n) = (B.transpose() * section.rates(pass.begin)).transpose();
  }
  if (start.energy) {
    A.conservativeResize(all + 1, all);
    b.conservativeResize(all + 1);
    A.row(all).setZero();
    A.row(all).head(n) = energy_slope(model, pass, section).transpose() / *start.energy;
    b[all] = (*start.energy - pass.energy) / *start.energy;
  }
  return base::min_norm_solution(A, b, least, phi.norm());
}

/// One step, halved until the residual decreases. Trial passes omit tangents, which cost far more than the
/// run. Returns false if the residual does not decrease or is at rounding level.
bool damped_step(const PeriodMap& map, const ShootingStart& start, ShootingResult& shot, double least) {
  const Model& model = map.model();
  const OrbitSection section(model, shot.pass.begin);
  const Vector x = newton_step(model, shot.pass, start, least);
  const OrbitState from = orbit_state(shot.pass.begin);
  double part = 1.0;
  for (int h = 0; h <= max_halvings; ++h, part *= 0.5) {
    OrbitState state = section.moved(from, part * x.head(section.size()));
    const double duration = shot.duration + (start.free_period ? part * x[section.size()] : 0.0);
    if (!(duration > 0.1 * start.duration && duration < 10.0 * start.duration)) continue;
    const OrbitPass pass = map.pass({state, duration, false});
    if (pass.interrupted) {
      shot.interrupted = true;
      shot.reason = "interrupted";
      return false;
    }
    const double residual = pass.done() ? residual_with_energy(model, start, pass) : shot.residual;
    if (residual < shot.residual) {
      shot.steps.push_back({shot.residual, part});
      shot.state = std::move(state);
      shot.duration = duration;
      shot.residual = residual;
      return true;
    }
    if (shot.residual <= stagnated_residual) return false;  // at rounding level a shorter step is no better
  }
  return false;
}

}  // namespace

Vector energy_slope(const Model& model, const OrbitPass& pass, const OrbitSection& section) {
  const Vector Ma = model.mass * pass.begin.a, Mv = model.mass * pass.begin.v;
  const double unit = model.unit.force * model.unit.length;
  Vector slope(section.size());
  for (Eigen::Index k = 0; k < slope.size(); ++k) {
    const OrbitState d = section.unscaled(section.basis().col(k));
    slope[k] = Mv.dot(d.v) - Ma.dot(d.u);
    for (std::size_t c = 0; c < d.shears.size(); ++c)
      if (const auto& kt = model.contacts[c].tangential_stiffness)
        slope[k] += pass.begin.forces[static_cast<Eigen::Index>(model.layout.tangent(c))] * d.shears[c] / *kt;
  }
  return unit * slope;
}

double gap_residual(const OrbitSection& section, const OrbitPass& pass, const Vector& gap) {
  double worst = 0.0;
  const std::size_t nu = section.displacements(), nv = section.velocities();
  for (Eigen::Index i = 0; i < gap.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double amplitude = k < nu ? pass.u_amplitude : k < nu + nv ? pass.v_amplitude : pass.T_amplitude;
    worst = std::max(worst, over(std::abs(gap[i]), amplitude));
  }
  return worst;
}

namespace {

/// Largest change of the shear of a contact that sticks at the end of the period, relative to the amplitude
/// of T. The section's coordinates omit this shear if the contact slips at the beginning of the period.
double sticking_shear_change(const Model& model, const OrbitPass& pass) {
  double worst = 0.0;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (!model.contacts[c].tangential_stiffness || pass.end.states[c].state != State::stick) continue;
    const auto T = static_cast<Eigen::Index>(model.layout.tangent(c));
    worst = std::max(worst, std::abs(pass.end.forces[T] - pass.begin.forces[T]));
  }
  return over(worst / model.scales.force, pass.T_amplitude);
}

}  // namespace

double orbit_residual(const Model& model, const OrbitPass& pass) {
  const OrbitSection section(model, pass.begin);
  return std::max(
      gap_residual(section, pass, section.coordinates(pass.end) - section.coordinates(pass.begin)),
      sticking_shear_change(model, pass));
}

namespace {

/// True if both passes have the same sequence of events. Otherwise their difference is not noise, because Phi
/// differs, too.
bool same_sequence(const OrbitPass& a, const OrbitPass& b) {
  return std::equal(
      a.events.begin(), a.events.end(), b.events.begin(), b.events.end(),
      [](const Event& x, const Event& y) { return x.contact == y.contact && x.type == y.type; });
}

}  // namespace

std::optional<double> map_noise(const Model& model, const OrbitPass& first, const OrbitPass& second) {
  if (first.end_derivatives.size() == 0 || !second.done() || !same_sequence(first, second))
    return std::nullopt;
  const OrbitSection section(model, first.begin);
  if (OrbitSection(model, second.begin).size() != section.size()) return std::nullopt;
  const Vector gap = section.coordinates(first.end) - section.coordinates(first.begin);
  const Vector next = section.coordinates(second.end) - section.coordinates(first.end);
  return gap_residual(section, first, next - first.end_derivatives * (section.basis().transpose() * gap));
}

Eigen::MatrixXd monodromy(const Model& model, const OrbitPass& pass) {
  const OrbitSection section(model, pass.begin);
  return section.basis().transpose() * pass.end_derivatives;
}

namespace {

/// True if the remaining residual is at most accepted_noise_factor times the noise of the map.
bool is_noise(const PeriodMap& map, const ShootingResult& shot) {
  if (shot.residual > accepted_noise_factor * max_noise || shot.pass.end_derivatives.size() == 0)
    return false;
  const OrbitPass next = map.pass({orbit_state(shot.pass.end), shot.duration, false});
  const std::optional<double> noise = map_noise(map.model(), shot.pass, next);
  return noise && shot.residual <= accepted_noise_factor * std::min(*noise, max_noise);
}

}  // namespace

namespace {

/// Sets shot.pass to the pass that begins at shot.state, with tangents. Returns false if the pass stops or is interrupted.
bool run_period(const PeriodMap& map, ShootingResult& shot) {
  shot.pass = map.pass({shot.state, shot.duration});
  if (shot.pass.done()) return true;
  shot.interrupted = shot.pass.interrupted;
  shot.reason = "the run over one period stopped: " + shot.pass.outcome.reason;
  return false;
}

}  // namespace

ShootingResult shoot(const PeriodMap& map, const ShootingStart& start, double tolerance) {
  const Model& model = map.model();
  ShootingResult shot{false, "", false, start.state, start.duration, 0.0, {}, {}};
  if (!run_period(map, shot)) return shot;
  shot.residual = residual_with_energy(model, start, shot.pass);
  bool decreased = true;
  while (decreased && static_cast<int>(shot.steps.size()) < max_steps) {
    if (!shot.pass.reason.empty()) {
      shot.reason = "the state after one period has no derivative: " + shot.pass.reason;
      return shot;
    }
    if (shot.residual <= reached * tolerance) break;
    const double before = shot.residual;
    if (shot.steps.size() >= patience &&
        shot.residual > 0.5 * shot.steps[shot.steps.size() - patience].residual)
      break;
    decreased = damped_step(map, start, shot, least_singular);
    for (const double finer : finer_steps)
      if (!decreased && !shot.interrupted && shot.residual > stagnated_residual)
        decreased = damped_step(map, start, shot, finer);
    if (shot.interrupted) return shot;
    if (shot.residual > 0.5 * before && shot.residual <= stagnated_residual) {
      if (decreased && !run_period(map, shot)) return shot;
      break;
    }
    if (decreased && !run_period(map, shot)) return shot;
  }
  shot.steps.push_back({shot.residual, 0.0});
  shot.closed =
      shot.residual <= std::max({tolerance, stagnated_residual, start.closed}) || is_noise(map, shot);
  if (!shot.closed)
    shot.reason = fmt::format(
        "Newton's method ended with a residual of {:.2g} of the amplitude after {} steps: {}", shot.residual,
        shot.steps.size() - 1,
        decreased ? "the residual decreases too slowly; events may appear and vanish between steps"
                  : "no fraction of the next step reduces the residual");
  return shot;
}

}  // namespace signorini::orbit
