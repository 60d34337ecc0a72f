#include "decide/impact.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

// Of the velocities before: slower than this an impulse leaves rest, or, where it is clearly inside its cone,
// what the rounding of an elimination makes of rest.
constexpr double at_rest = 1e-12, rounded_rest = 1e-9;
constexpr double inside_cone = 1.0 - 1e-6;

/// All that could sticks rigidly let go: only then does the system's matrix say what an impulse does.
Mode released(const Model& model, Mode mode) {
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (const Contact& contact = model.contacts[c]; contact.takes_impulses() || contact.sticks_rigidly())
      mode[c] = {State::open, 0.0};
  return mode;
}

}  // namespace

Vector Impacts::closed(const std::vector<std::size_t>& touching, const Delassus& d, Vector u) const {
  const auto m = static_cast<Eigen::Index>(touching.size());
  const auto normals = Eigen::seqN(0, m, 2);
  Eigen::VectorXd gap(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& contact = model_.contacts[touching[static_cast<std::size_t>(i)]];
    gap[i] = contact.gap_at(u);
  }
  const Eigen::MatrixXd W = d.W(normals, normals);
  const Eigen::MatrixXd effect = d.effect(Eigen::all, normals);
  u -= effect * least_squares(W, gap);
  for (const std::size_t c : touching) set_exactly(model_.contacts[c].normal, -model_.contacts[c].gap, u);
  return u;
}

Vector Impacts::close(const Mode& mode, const std::vector<std::size_t>& touching, const Vector& u) {
  const ModeSystemPtr system = systems_.of(released(model_, mode));
  return system ? closed(touching, delassus(model_, *system, touching), u) : u;
}

Impact Impacts::solve(const Forcing& forcing, double t, const Mode& mode,
                      const std::vector<std::size_t>& touching, const Vector& u, const Vector& v) {
  Impact impact;
  impact.v = v;
  impact.impulses.resize(model_.contacts.size());
  const ModeSystemPtr system = systems_.of(released(model_, mode));
  if (!system) {
    impact.reason = "the mass matrix is singular";
    return impact;
  }
  const Delassus d = delassus(model_, *system, touching);
  const auto m = static_cast<Eigen::Index>(touching.size());
  Eigen::VectorXd before(2 * m), restitution(m);
  JointProblem problem{d.W, {}, {}};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& contact = model_.contacts[touching[static_cast<std::size_t>(i)]];
    before[2 * i] = contact.normal.dot(v);
    before[2 * i + 1] = contact.tangent.dot(v) - forcing.surface(touching[static_cast<std::size_t>(i)], t, 1);
    restitution[i] = contact.restitution;
    JointItem item;
    item.kind = contact.has_friction() ? JointItem::Kind::frictional : JointItem::Kind::normal;
    item.static_friction = contact.static_friction;
    item.kinetic_friction = contact.kinetic_friction;
    problem.items.push_back(item);
  }
  std::optional<JointSolution> solution;
  Eigen::VectorXd after;
  for (bool captured = true; captured;) {  // ends: each round captures one more contact
    captured = false;
    problem.b = before;
    for (Eigen::Index i = 0; i < m; ++i) problem.b[2 * i] += restitution[i] * std::min(before[2 * i], 0.0);
    solution = signorini::solve(problem);
    if (!solution) {
      impact.reason = "the impact has no solution: its complementarity problem ends in a ray";
      for (Eigen::Index i = 0; i < m; ++i)
        impact.reason += fmt::format("; '{}': vn = {:.6g}, vt = {:.6g}",
                                     model_.contacts[touching[static_cast<std::size_t>(i)]].name,
                                     before[2 * i], before[2 * i + 1]);
      return impact;
    }
    after = before + d.W * solution->force;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Contact& contact = model_.contacts[touching[static_cast<std::size_t>(i)]];
      const double slowest = contact.capture_velocity.value_or(capture_velocity_);
      if (restitution[i] == 0.0 || !(before[2 * i] < 0.0) || after[2 * i] >= slowest) continue;
      restitution[i] = 0.0;
      captured = true;
    }
  }
  impact.solved = true;
  impact.u = closed(touching, d, u);
  impact.v += d.effect * solution->force;
  const double size = before.cwiseAbs().maxCoeff();
  std::vector<Fixed> fixed;
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t c = touching[static_cast<std::size_t>(i)];
    const double n = solution->force[2 * i], k = solution->force[2 * i + 1];
    if (!(n > 0.0)) continue;
    after[2 * i] = -restitution[i] * std::min(before[2 * i], 0.0);
    fixed.push_back({2 * i, &model_.contacts[c].normal, after[2 * i]});
    impact.impulses[c].rests = after[2 * i] == 0.0;
    if (!model_.contacts[c].has_friction()) continue;
    const JointItem& item = problem.items[static_cast<std::size_t>(i)];
    const double f =
        solution->kinetic[static_cast<std::size_t>(i)] ? item.kinetic_friction : item.static_friction;
    const double slip = std::abs(after[2 * i + 1]);
    if (slip > at_rest * size && (slip > rounded_rest * size || std::abs(k) > inside_cone * f * n)) continue;
    after[2 * i + 1] = 0.0;
    fixed.push_back({2 * i + 1, &model_.contacts[c].tangent, forcing.surface(c, t, 1)});
    impact.impulses[c].sticks = true;
  }
  settle(d, fixed, impact.v);
  double greatest = 0.0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t c = touching[static_cast<std::size_t>(i)];
    const double n = solution->force[2 * i], k = solution->force[2 * i + 1];
    Impulse& impulse = impact.impulses[c];
    impulse.hit = n > 0.0 && mode[c].is_open();
    impulse.normal = n;
    impulse.tangent = k;
    const double normal = 0.5 * n * (before[2 * i] + after[2 * i]);
    const double tangent = 0.5 * k * (before[2 * i + 1] + after[2 * i + 1]);
    impact.loss -= normal + tangent;
    impact.surface_work += k * forcing.surface(c, t, 1);
    greatest = std::max({greatest, std::abs(n * before[2 * i]), std::abs(k * before[2 * i + 1])});
  }
  impact.gains = impact.loss < -1e-9 * greatest;
  return impact;
}

}  // namespace signorini
