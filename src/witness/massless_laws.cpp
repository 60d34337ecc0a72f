// Massless parts: their forces are balanced, and so are the rates of these forces.
//
//   r   = P - C v - K u - sum ( n N + t T )          = 0    in rows of M that are empty
//   r'  = P' - C a - K v - sum ( n N' + t T' )       = 0    if N', T' follow from u, v, a
//   r'' = P'' - K a - sum ( n N'' + t T'' )          = 0    if the row also has no damping
//
// N' and T' are known for springs and for open contacts: kn g' + cn g'', kt ut', -s fk N'; constraint forces are
// unknowns, and rows that contain one are skipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {
namespace {

// Relative accuracy of the terms of rates, which come from solves and their derivatives. Chosen value: a rate that is
// zero or missing by mistake is off by its whole size (tests/unit/witness/massless.cpp).
constexpr double of_rates = 1e-9;
constexpr const char* names[] = {"massless equilibrium", "massless velocity", "massless acceleration"};

/// N and T of a contact, or their first or second derivative, and the size of their terms. known: they follow from the
/// motion.
struct Push {
  double N = 0.0, T = 0.0, size = 0.0;
  bool known = true;
};

/// Derivatives of order 1 or 2.
Push push_of(const Contact& c, const ContactState& state, const Sight& m, int order) {
  Push push;
  if (is_open(state.state) && !c.normal_force_given()) return push;
  const bool first = order == 1;
  const double g = first ? m.dg : m.ddg, ut = first ? m.dut : m.ddut, size = first ? m.speed : m.push;
  push.known = c.forces_follow_motion() && !c.takes_impulses() && (first || c.normal_damping == 0.0);
  if (!push.known) return push;
  if (c.normal_force_given()) {
    push.N = first ? -m.dq : -m.ddq;
    push.size = std::abs(push.N);
  } else {
    push.N = c.normal_stiffness * g + (first ? c.normal_damping * m.ddg : 0.0);
    push.size = c.normal_stiffness * size + (first ? c.normal_damping * m.push : 0.0);
  }
  if (const int s = sign_of_slip(state.state); s != 0) {
    push.T = -s * c.friction.kinetic * push.N;
  } else if (kind_of(state.state) == State::stick) {
    push.known = c.tangential_stiffness.has_value();
    push.T = c.tangential_stiffness.value_or(0.0) * ut;
    push.size += c.tangential_stiffness.value_or(0.0) * size;
  }
  return push;
}

/// Sizes that the rounding of x is relative to, one per degree of freedom.
Vector reach_of(const Model& model, const Vector& x, const std::array<double, 2>& reached) {
  Vector reach = x.cwiseAbs();
  for (int i = 0; i < model.size(); ++i)
    reach[i] = std::max(reach[i], reached[model.dofs[static_cast<std::size_t>(i)].rotation]);
  return reach;
}

/// Balance of one order, row by row.
class Balance {
 public:
  Balance(const Bench& bench, const WitnessedSide& side, int order)
      : bench_(bench),
        side_(side),
        order_(order),
        sum_(Vector::Zero(bench.model.size())),
        size_(sum_),
        off_(sum_),
        known_(static_cast<std::size_t>(bench.model.size()), true) {}

  [[nodiscard]] std::optional<Unbalanced> worst() {
    const Vector rounded = noise();
    for (const int i : bench_.massless()) {
      const double limit = rounded[i] + of_tolerance * off_[i];
      // A decayed motion has terms below the smallest normal number, which have no digits.
      if (limit < std::numeric_limits<double>::min()) continue;
      if (known_[static_cast<std::size_t>(i)] && std::abs(sum_[i]) > limit)
        return Unbalanced{i, names[order_], std::abs(sum_[i]), limit, order_};
    }
    return std::nullopt;
  }

  /// Sums all rows; returns the rounding of each.
  [[nodiscard]] Vector noise() {
    structure();
    for (const std::size_t k : bench_.on_massless()) contact(k);
    return (order_ == 0 ? rounding::of_elimination : of_rates) * size_;
  }

 private:
  void structure() {
    const Model& model = bench_.model;
    const Vector none = Vector::Zero(model.size()), &a = side_.a != nullptr ? *side_.a : none;
    const Vector &x = order_ == 0 ? *side_.u : order_ == 1 ? *side_.v : a, &dx = order_ == 0 ? *side_.v : a;
    const Vector of_x = reach_of(model, x, reached(order_)), of_dx = reach_of(model, dx, reached(order_ + 1));
    for (const int i : bench_.massless()) {
      sum_[i] = side_.loads[static_cast<std::size_t>(order_)][i];
      size_[i] = std::abs(sum_[i]);
      for (SparseMatrix::InnerIterator it(bench_.stiffness_by_rows(), i); it; ++it) {
        take(i, it.value(), x[it.row()], of_x[it.row()]);
        off_[i] += std::abs(it.value()) * tolerance(static_cast<int>(it.row()), of_x[it.row()]);
      }
      SparseMatrix::InnerIterator damper(bench_.damping_by_rows(), i);
      if (!damper) continue;
      known_[static_cast<std::size_t>(i)] = order_ == 0 || (order_ == 1 && side_.a != nullptr);
      for (; damper; ++damper) take(i, damper.value(), dx[damper.row()], of_dx[damper.row()]);
    }
  }
  /// Sizes reached by displacements (order 0), velocities and accelerations. Rounding of displacements produces
  /// velocities w times, and accelerations w^2 times as large, w: the highest frequency. At rest there is nothing else.
  [[nodiscard]] std::array<double, 2> reached(int order) const {
    if (order == 0) return side_.u_reach;
    std::array<double, 2> reach = side_.u_reach;
    for (std::size_t i = 0; i < reach.size(); ++i) {
      reach[i] *= rounding::eps * std::pow(bench_.model.omega_max, order);
      if (order == 1) reach[i] = std::max(reach[i], side_.v_reach[i]);
    }
    return reach;
  }
  void take(int i, double factor, double x, double reach) {
    sum_[i] -= factor * x;
    size_[i] += std::abs(factor) * reach;
  }
  /// Tolerance of a displacement or a velocity.
  [[nodiscard]] double tolerance(int dof, double reach) const {
    const WitnessLimits& tol = bench_.limits;
    const bool turns = bench_.model.dofs[static_cast<std::size_t>(dof)].rotation;
    return tol.rtol * reach + (order_ == 0 ? turns ? tol.rotation : tol.displacement
                               : turns     ? tol.angular_velocity
                                           : tol.velocity);
  }
  void contact(std::size_t k) {
    const Contact& c = bench_.model.contacts[k];
    const Sight m = see(c, k, side_);
    Push push{m.N, m.T, std::abs(m.N) + std::abs(m.T)};
    if (order_ > 0) push = push_of(c, (*side_.mode)[k], m, order_);
    if (order_ == 1 && c.normal_damping > 0.0 && side_.a == nullptr) push.known = false;
    if (order_ == 0) push.size += size_of_normal(c, m) + c.tangential_stiffness.value_or(0.0) * m.place;
    add(c.normal, push.N, push);
    add(c.tangent, push.T, push);
  }
  void add(const Combination& form, double force, const Push& push) {
    for (const auto& [dof, factor] : form.terms) {
      sum_[dof] -= factor * force;
      size_[dof] += std::abs(factor) * push.size;
      if (!push.known) known_[static_cast<std::size_t>(dof)] = false;
    }
  }

  const Bench& bench_;
  const WitnessedSide& side_;
  int order_;
  Vector sum_, size_, off_;  // off_: tolerances
  std::vector<bool> known_;
};

}  // namespace

Vector massless_noise(const Bench& bench, const WitnessedSide& side, int order) {
  return Balance(bench, side, order).noise();
}

std::vector<Unbalanced> massless_balance(const Bench& bench, const WitnessedSide& side, int orders) {
  std::vector<Unbalanced> found;
  if (side.loads.empty()) return found;
  for (int order = 0; order < orders; ++order)
    if (const auto worst = Balance(bench, side, order).worst()) found.push_back(*worst);
  return found;
}

}  // namespace signorini
