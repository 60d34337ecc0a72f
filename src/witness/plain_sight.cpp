#include "witness/plain_sight.hpp"

#include <cmath>

#include "base/rounding.hpp"
#include "witness/sight.hpp"

namespace signorini {
namespace {

double N_of(const WitnessedSide& side, std::size_t k) {
  return (*side.forces)[static_cast<Eigen::Index>(side.layout.normal(k))];
}
double T_of(const WitnessedSide& side, std::size_t k) {
  return (*side.forces)[static_cast<Eigen::Index>(side.layout.tangent(k))];
}

/// True if s p' >= 0; with a spring between body and sliding point, N' contributes to p'.
bool slides_on(const Contact& c, std::size_t k, int s, const WitnessedSide& side) {
  if (c.normal_damping > 0.0 && side.a == nullptr) return false;
  const Driven& d = side.driven[k];
  double rate = s * (c.tangent.dot(*side.v) - d.ds);
  if (const double kt = c.tangential_stiffness.value_or(0.0); kt > 0.0) {
    double dN = -d.dq;
    if (!c.normal_force_given()) {
      dN = c.normal_stiffness * c.normal.dot(*side.v);
      if (c.normal_damping > 0.0) dN += c.normal_damping * c.normal.dot(*side.a);
    }
    rate += c.friction.kinetic / kt * dN;
  }
  return rate >= 0.0;
}

bool tangent_row_stands(const Contact& c, std::size_t k, const ContactState& state, const WitnessedSide& side,
                        double rest) {
  const double N = N_of(side, k), T = T_of(side, k);
  if (const int s = sign_of_slip(state.state); s != 0)
    return !is_held(state.state) &&
           std::abs(T + s * c.friction.kinetic * N) <= rounding::of_elimination * std::abs(T);
  if (kind_of(state.state) != State::stick) return T == 0.0;
  if (!c.tangential_stiffness) return std::abs(c.tangent.dot(*side.v) - side.driven[k].ds) <= rest;
  const double kt = *c.tangential_stiffness, ut = c.tangent.dot(*side.u) - side.driven[k].s;
  return std::abs(T - kt * (ut - state.anchor)) <=
         rounding::of_elimination * (std::abs(T) + kt * std::abs(state.anchor));
}

}  // namespace

bool guards_stand(const Contact& c, std::size_t k, const ContactState& state, const WitnessedSide& side) {
  if (is_open(state.state))
    return c.normal_force_given() || (state.state != State::inside && c.gap_at(*side.u) >= 0.0);
  const double N = N_of(side, k);
  if (!c.normal_force_given() && N > 0.0) return false;
  if (!c.has_friction() || kind_of(state.state) == State::closed) return true;
  if (c.friction.force || c.friction.varies() || is_held(state.state)) return false;
  if (const int s = sign_of_slip(state.state); s != 0) return slides_on(c, k, s, side);
  return std::abs(T_of(side, k)) <= -c.friction.static_ * N;
}

bool rows_stand(const Contact& c, std::size_t k, const ContactState& state, const WitnessedSide& side,
                double rest) {
  if (c.friction.force || !c.forces_follow_motion()) return false;
  const double N = N_of(side, k);
  double off = 0.0;
  if (c.normal_force_given())
    off = N + side.driven[k].q;
  else if (is_open(state.state))
    off = N;
  else if (c.normal_spring())
    off = N - c.normal_stiffness * c.gap_at(*side.u) -
          (c.normal_damping > 0.0 ? c.normal_damping * c.normal.dot(*side.v) : 0.0);
  return std::abs(off) <= rounding::of_elimination * std::abs(N) &&
         tangent_row_stands(c, k, state, side, rest);
}

}  // namespace signorini
