#include "orbit/branch_newton.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "orbit/shooting.hpp"

namespace signorini {
namespace {

constexpr int most_corrections = 10;
constexpr double longest_correction = 0.1;  // in the norm; steps are shorter. Chosen.
constexpr double slow = 0.02;  // of the residual: more is left where dG/ds is that of another point
constexpr double corrected_at_last = 1e-9;  // residual over amplitude, as in shooting.cpp
constexpr double singular = 1e-9;           // as in shooting.cpp
constexpr double amplitudes_a_range =
    5.0;  // in which the state may change as far as the parameter in its range
// Of dz/ds, beside the motion: above the noise of dG/ds. Chosen; who asks tries it.
constexpr double shifts_by = 1e-3;

}  // namespace

BranchState BranchNewton::moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const {
  const OrbitSection section(map_.model(), pass.begin);
  BranchState to = from;
  to.state = section.moved(orbit_state(pass.begin), amplitude_ * dy.head(section.size()));
  to.s = std::clamp(from.s + dy[dy.size() - 1], 0.0, 1.0);  // outside, the key may mean nothing
  to.state = map_.fitted(std::move(to.state), pass.begin.mode, to.s);
  to.duration = map_.autonomous() ? from.duration * (1.0 + dy[section.size()]) : map_.period(to.s);
  return to;
}

/// dG/dy, columns in the norm: x by the amplitude, T by itself. With the phase condition where T is unknown.
Eigen::MatrixXd BranchNewton::jacobian(const BranchState& state, const OrbitPass& pass,
                                       const Vector& by_s) const {
  const OrbitSection section(map_.model(), pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Eigen::Index n = section.size(), extra = map_.autonomous() ? 1 : 0;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n + extra, n + extra + 1);
  J.topLeftCorner(n, n) = B.transpose() * pass.end_rates - Eigen::MatrixXd::Identity(n, n);
  J.block(0, n + extra, n, 1) = by_s / amplitude_;
  if (extra == 1) {
    J.block(0, n, n, 1) = B.transpose() * section.rates(pass.end) * state.duration / amplitude_;
    Vector along = B.transpose() * section.rates(pass.begin);
    J.block(n, 0, 1, n) = (along / along.norm()).transpose();
  }
  return J;
}

/// Why a pass is no step of the branch; empty: it is one.
std::string BranchNewton::refusal(const OrbitPass& pass, Eigen::Index unknowns) const {
  if (!pass.done()) return "the run over one period stopped: " + pass.outcome.reason;
  if (pass.end_rates.size() == 0) return "the state after one period has no derivative: " + pass.reason;
  return size(pass) != unknowns ? "the contact state at the section changes" : "";
}

Corrected BranchNewton::correct(BranchState guess, const Vector& t, const Vector& by_s) const {
  Corrected c;
  c.state = std::move(guess);
  Vector slope = by_s;
  double before = 0.0;
  for (c.iterations = 0; c.iterations <= most_corrections; ++c.iterations) {
    c.pass = map_.pass(c.state);
    c.reason = refusal(c.pass, t.size());
    if (!c.reason.empty()) return c;
    c.residual = orbit_residual(map_.model(), c.pass);
    const bool stands = c.iterations > 0 && c.residual > 0.5 * before && c.residual <= corrected_at_last;
    if (c.residual <= corrected_to || stands) {
      c.done = true;
      return c;
    }
    const bool stale = c.iterations > 0 && c.residual > slow * before;
    before = c.residual;
    const OrbitSection section(map_.model(), c.pass.begin);
    if (slope.size() != section.size() || stale) slope = by_parameter(c.state, c.pass);
    Eigen::MatrixXd A(t.size(), t.size());
    A << jacobian(c.state, c.pass, slope), t.transpose();
    Vector b = Vector::Zero(t.size());
    b.head(section.size()) = -section.basis().transpose() *
                             (section.coordinates(c.pass.end) - section.coordinates(c.pass.begin)) /
                             amplitude_;
    const Vector dy = shortest_solution(A, b, singular);
    if (!(dy.norm() < longest_correction)) {
      c.reason = "Newton's method leaves the branch";
      return c;
    }
    c.state = moved(c.state, c.pass, dy);
  }
  c.reason = fmt::format("Newton's method does not converge: a residual of {:.2g} of the amplitude is left",
                         c.residual);
  return c;
}

Vector BranchNewton::examine(Corrected& at, const Vector& before, std::optional<std::size_t> ones) const {
  if (at.by_s.size() == 0) at.by_s = by_parameter(at.state, at.pass);
  Eigen::MatrixXd A(before.size(), before.size());
  A << jacobian(at.state, at.pass, at.by_s), before.transpose();
  Vector b = Vector::Zero(before.size());
  b[b.size() - 1] = 1.0;
  Vector t = shortest_solution(A, b, singular);
  t = t.norm() > 0.0 ? Vector(t / t.norm()) : before;
  at.monodromy = monodromy(map_.model(), at.pass);
  at.multipliers = multipliers_of(at.monodromy);
  at.ones = ones.value_or(std::max<std::size_t>(count_ones(at.multipliers), map_.autonomous() ? 1 : 0));
  at.tests = test_values(at.multipliers, at.ones, t[t.size() - 1]);
  return t;
}

void BranchNewton::measure(const OrbitPass& pass, Vector* t) {
  const OrbitSection section(map_.model(), pass.begin);
  const auto u = static_cast<double>(section.displacements()), v = static_cast<double>(section.velocities());
  const double T = static_cast<double>(section.basis().rows()) - u - v;
  const double square = u * pass.u_amplitude * pass.u_amplitude + v * pass.v_amplitude * pass.v_amplitude +
                        T * pass.T_amplitude * pass.T_amplitude;
  const double amplitude = amplitudes_a_range * (square > 0.0 ? std::sqrt(square) : 1.0);
  if (t != nullptr) t->head(t->size() - (map_.autonomous() ? 2 : 1)) *= amplitude_ / amplitude;
  amplitude_ = amplitude;
}

std::optional<double> BranchNewton::shift(const Corrected& at, const Vector& t) const {
  if (map_.autonomous()) return std::nullopt;
  const OrbitSection section(map_.model(), at.pass.begin);
  const Vector x = amplitude_ * t.head(section.size());
  const Vector along = section.basis().transpose() * section.rates(at.pass.begin);
  if (!(along.norm() > 0.0) || !(t.head(section.size()).norm() > shifts_by)) return std::nullopt;
  const double time = along.dot(x) / along.squaredNorm();
  if ((x - time * along).norm() > shifts_by * x.norm()) return std::nullopt;
  return time / t[t.size() - 1];
}

}  // namespace signorini
