#include "orbit/shooting.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr int most_steps = 30, most_halvings = 6;
// Residual over amplitude at which an orbit is closed although the residual no longer falls: what rounding of a long
// or stiff period leaves. Chosen; above it a search has failed.
constexpr double closed_at_last = 1e-9;
// Singular values of Phi - I below this, relative to the greatest: the rounding of Phi, well below what a
// disturbance that dies out in 1e7 periods has. Chosen.
constexpr double least_singular = 1e-9;

double over(double value, double amplitude) { return amplitude > 0.0 ? value / amplitude : value; }

/// (x, dT)
Vector newton_step(const Model& model, const OrbitPass& pass, bool free_period) {
  const OrbitSection section(model, pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Vector gap = B.transpose() * (section.coordinates(pass.end) - section.coordinates(pass.begin));
  const Eigen::Index n = section.size(), all = n + (free_period ? 1 : 0);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(all, all);
  A.topLeftCorner(n, n) = B.transpose() * pass.end_rates - Eigen::MatrixXd::Identity(n, n);
  Vector b = Vector::Zero(all);
  b.head(n) = -gap;
  if (free_period) {
    A.block(0, n, n, 1) = B.transpose() * section.rates(pass.end);
    A.block(n, 0, 1, n) = (B.transpose() * section.rates(pass.begin)).transpose();
  }
  return shortest_solution(A, b, least_singular);
}

}  // namespace

double orbit_residual(const Model& model, const OrbitPass& pass) {
  const OrbitSection section(model, pass.begin);
  const Vector gap = section.coordinates(pass.end) - section.coordinates(pass.begin);
  double worst = 0.0;
  const std::size_t nu = section.displacements(), nv = section.velocities();
  for (Eigen::Index i = 0; i < gap.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double amplitude = k < nu ? pass.u_amplitude : k < nu + nv ? pass.v_amplitude : pass.T_amplitude;
    worst = std::max(worst, over(std::abs(gap[i]), amplitude));
  }
  return worst;
}

Eigen::MatrixXd monodromy(const Model& model, const OrbitPass& pass) {
  const OrbitSection section(model, pass.begin);
  return section.basis().transpose() * pass.end_rates;
}

Shot shoot(const PeriodMap& map, const ShootingStart& start, double tolerance) {
  const Model& model = map.model();
  Shot shot{false, "", false, start.state, start.duration, 0.0, {}, {}};
  shot.pass = map.pass({shot.state, shot.duration});
  if (!shot.pass.done()) {
    shot.interrupted = shot.pass.interrupted;
    shot.reason = "the run over one period stopped: " + shot.pass.outcome.reason;
    return shot;
  }
  shot.residual = orbit_residual(model, shot.pass);
  for (int i = 0; i < most_steps; ++i) {
    if (shot.pass.end_rates.size() == 0 && !shot.pass.reason.empty()) {
      shot.reason = "the state after one period has no derivative: " + shot.pass.reason;
      return shot;
    }
    if (shot.residual == 0.0) break;
    const Vector x = newton_step(model, shot.pass, start.free_period);
    const OrbitSection section(model, shot.pass.begin);
    const OrbitState from = orbit_state(shot.pass.begin);
    bool fell = false;
    double part = 1.0;
    for (int h = 0; h <= most_halvings && !fell; ++h, part *= 0.5) {
      OrbitState state = section.moved(from, part * x.head(section.size()));
      const double duration = shot.duration + (start.free_period ? part * x[section.size()] : 0.0);
      if (!(duration > 0.1 * start.duration && duration < 10.0 * start.duration)) continue;
      OrbitPass pass = map.pass({state, duration});
      if (pass.interrupted) {
        shot.interrupted = true;
        shot.reason = "interrupted";
        return shot;
      }
      if (!pass.done()) continue;
      const double residual = orbit_residual(model, pass);
      if (!(residual < shot.residual)) {
        if (shot.residual <= tolerance) break;  // rounding is reached
        continue;
      }
      shot.steps.push_back({shot.residual, part});
      shot.state = std::move(state);
      shot.duration = duration;
      shot.pass = std::move(pass);
      shot.residual = residual;
      fell = true;
    }
    if (!fell) break;
  }
  shot.steps.push_back({shot.residual, 0.0});
  shot.closed = shot.residual <= std::max({tolerance, closed_at_last, start.closed});
  if (!shot.closed)
    shot.reason = fmt::format(
        "Newton's method ended with a residual of {:.2g} of the amplitude after {} steps: no part of the "
        "next step "
        "reduces it",
        shot.residual, shot.steps.size() - 1);
  return shot;
}

}  // namespace signorini
