#include "law_check/contact_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/rounding.hpp"

namespace signorini::law_check {
namespace {

/// Bound of |form . x| by Schwarz, |form| sqrt(|x|^2 + reach^2), x on the degrees of freedom of the form. reach: largest
/// |x| of the run so far.
double size_on(const Combination& form, const Vector& x, double reach) {
  double of_form = 0.0, of_x = reach * reach;
  for (const auto& [dof, factor] : form.terms) {
    of_form += factor * factor;
    of_x += x[dof] * x[dof];
  }
  return std::sqrt(of_form * of_x);
}

/// Slope dF/d|N| of the friction limit F, for friction that depends on N.
double slope_of_friction_limit(const Contact& c, double N) {
  const double x = std::max(0.0, -N) / *c.friction.force;
  return friction_at(c, 0.0, N) - (c.friction.static_ - c.friction.kinetic) * x * std::exp(-x);
}

/// Stiffness kt of the spring between body and sliding point; 0: no such spring.
double shear_stiffness(const Contact& c) { return c.tangential_stiffness.value_or(0.0); }

}  // namespace

const Unit& GuardValue::unit() const {
  const std::string_view name = law;
  return name == "penetration" || name == "lasting gap" ? seen::length
         : name == "slip direction" || name == "rest"   ? seen::velocity
                                                        : seen::force;
}

int slip_direction(State state) {
  return kind_of(state) == State::slip_plus ? 1 : kind_of(state) == State::slip_minus ? -1 : 0;
}

double friction_at(const Contact& c, double slip_rate, double N) {
  const Friction& f = c.friction;
  if (f.force) {
    const double light = std::exp(-std::max(0.0, -N) / *f.force);
    return f.static_ * light + f.kinetic * (1.0 - light);
  }
  if (!f.is_rate_dependent()) return f.kinetic;
  const double part = std::exp(-std::abs(slip_rate) / f.decay_velocity());
  return f.static_ * part + f.kinetic * (1.0 - part);
}

double friction_in(const Contact& c, State state, double slip_rate, double N) {
  return is_at_static_limit(state) ? c.friction.static_ : friction_at(c, slip_rate, N);
}

double normal_force_size(const Contact& c, const ContactKinematics& m) {
  return c.normal_stiffness * m.displacement_size + c.normal_damping * m.velocity_size;
}

bool may_be_held_by_neighbour(const Model& model, std::size_t k) {
  const Contact& foot = model.contacts[k];
  const auto shares = [&](const Contact& other) {
    return std::any_of(other.tangent.terms.begin(), other.tangent.terms.end(), [&](const auto& a) {
      return std::any_of(foot.tangent.terms.begin(), foot.tangent.terms.end(),
                         [&](const auto& b) { return a.first == b.first; });
    });
  };
  if (!foot.sticks_rigidly()) return false;
  for (std::size_t j = 0; j < model.contacts.size(); ++j)
    if (j != k && model.contacts[j].sticks_rigidly() &&
        model.contacts[j].takes_impulses() == foot.takes_impulses() && shares(model.contacts[j]))
      return true;
  return false;
}

ContactKinematics kinematics(const Contact& c, std::size_t k, const CheckedSide& side) {
  const Driven& d = side.driven[k];
  ContactKinematics m;
  m.N = side.forces->data()[side.layout.normal(k)];
  m.T = side.forces->data()[side.layout.tangent(k)];
  m.g = c.gap + c.normal.dot(*side.u);
  m.ut = c.tangent.dot(*side.u) - d.s;
  m.dg = c.normal.dot(*side.v);
  m.dut = c.tangent.dot(*side.v) - d.ds;
  if (side.a != nullptr) {
    m.ddg = c.normal.dot(*side.a);
    m.ddut = c.tangent.dot(*side.a) - d.dds;
  }
  m.q = d.q;
  m.dq = d.dq;
  m.ddq = d.ddq;
  m.displacement_size = size_on(c.normal, *side.u, side.max_u[0]) +
                        size_on(c.tangent, *side.u, side.max_u[0]) + std::abs(c.gap) + std::abs(d.s);
  m.velocity_size =
      size_on(c.normal, *side.v, side.max_v[0]) + size_on(c.tangent, *side.v, side.max_v[0]) + std::abs(d.ds);
  if (side.energy_speeds != nullptr) m.velocity_size = std::max(m.velocity_size, side.energy_speeds[k]);
  if (side.a != nullptr)
    m.acceleration_size = size_on(c.normal, *side.a, side.acceleration_terms[0]) +
                          size_on(c.tangent, *side.a, side.acceleration_terms[0]) + std::abs(d.dds);
  return m;
}

GuardValues guards_of(const Contact& c, const ContactState& state, const ContactKinematics& m,
                      const LawLimits& tol) {
  GuardValues guards;
  const double kn = c.normal_stiffness, cn = c.normal_damping, kt = shear_stiffness(c);
  const double of_u = tol.rtol * m.displacement_size + tol.displacement,
               of_v = tol.rtol * m.velocity_size + tol.velocity;
  const bool elastic = c.normal_spring().has_value(), given = c.normal_force_given();
  const double of_N = elastic ? kn * of_u + cn * of_v : tol.rtol * std::abs(m.N) + tol.force;
  const double size_N = elastic ? normal_force_size(c, m) : std::abs(m.N);
  const double dN = elastic ? kn * m.dg + cn * m.ddg : given ? -m.dq : 0.0;
  if (is_open(state.state)) {
    if (given) return guards;
    if (state.state == State::inside) {
      guards.add({"penetration", m.g + cn / kn * m.dg, m.displacement_size + cn / kn * m.velocity_size, m.dg,
                  of_u + cn / kn * of_v});
      guards.add({"lasting gap", -m.g, m.displacement_size, -m.dg, of_u});
      return guards;
    }
    guards.add({"penetration", m.g, m.displacement_size, m.dg, of_u});
    return guards;
  }
  if (!given) guards.add({"tension", -m.N, size_N, -dN, of_N});
  if (!c.has_friction() || kind_of(state.state) == State::closed) return guards;
  const bool by_force = c.friction.force.has_value();
  const double fs = by_force ? friction_at(c, 0.0, m.N) : c.friction.static_;
  const double growth = by_force ? slope_of_friction_limit(c, m.N) : fs;
  const double fk = by_force ? growth : c.friction.kinetic;
  if (const int s = slip_direction(state.state); s == 0) {
    const double size =
        fs * size_N + (kt > 0.0 ? kt * (m.displacement_size + std::abs(state.anchor)) : std::abs(m.T));
    const double off = fs * of_N + (kt > 0.0 ? kt * of_u : tol.rtol * std::abs(m.T) + tol.force);
    const double side = m.T >= 0.0 ? 1.0 : -1.0;
    guards.add({"friction", -fs * m.N - std::abs(m.T), size, -growth * dN - side * kt * m.dut, off});
  } else if (is_at_static_limit(state.state)) {
    guards.add({"rest", -std::abs(m.dut), m.velocity_size, 0.0, of_v});
  } else {
    double rate = s * m.dut, size = m.velocity_size, off = of_v;
    if (kt > 0.0) {
      const double f = fk / kt;
      rate += given ? -f * m.dq : f * (kn * m.dg + cn * m.ddg);
      size += f * (kn * m.velocity_size + cn * m.acceleration_size + std::abs(m.dq));
      off += f * (kn * of_v + cn * (tol.rtol * m.acceleration_size + tol.force));
    }
    guards.add({"slip direction", rate, size, s * m.ddut, off});
  }
  return guards;
}

namespace {

double N_of(const CheckedSide& side, std::size_t k) {
  return (*side.forces)[static_cast<Eigen::Index>(side.layout.normal(k))];
}
double T_of(const CheckedSide& side, std::size_t k) {
  return (*side.forces)[static_cast<Eigen::Index>(side.layout.tangent(k))];
}

/// True if the contact slides in the direction s: s p' >= 0. With a spring between body and sliding point, p' contains N'.
bool slides_on(const Contact& c, std::size_t k, int s, const CheckedSide& side) {
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

bool tangent_row_is_satisfied(const Contact& c, std::size_t k, const ContactState& state,
                              const CheckedSide& side, double rest) {
  const double N = N_of(side, k), T = T_of(side, k);
  if (const int s = slip_direction(state.state); s != 0)
    return !is_at_static_limit(state.state) &&
           std::abs(T + s * c.friction.kinetic * N) <= rounding::elimination * std::abs(T);
  if (kind_of(state.state) != State::stick) return T == 0.0;
  if (!c.tangential_stiffness) return std::abs(c.tangent.dot(*side.v) - side.driven[k].ds) <= rest;
  const double kt = *c.tangential_stiffness, ut = c.tangent.dot(*side.u) - side.driven[k].s;
  return std::abs(T - kt * (ut - state.anchor)) <=
         rounding::elimination * (std::abs(T) + kt * std::abs(state.anchor));
}

}  // namespace

bool guards_are_satisfied(const Contact& c, std::size_t k, const ContactState& state,
                          const CheckedSide& side) {
  if (is_open(state.state))
    return c.normal_force_given() || (state.state != State::inside && c.gap_at(*side.u) >= 0.0);
  const double N = N_of(side, k);
  if (!c.normal_force_given() && N > 0.0) return false;
  if (!c.has_friction() || kind_of(state.state) == State::closed) return true;
  if (c.friction.force || c.friction.is_rate_dependent() || is_at_static_limit(state.state)) return false;
  if (const int s = slip_direction(state.state); s != 0) return slides_on(c, k, s, side);
  return std::abs(T_of(side, k)) <= -c.friction.static_ * N;
}

bool rows_are_satisfied(const Contact& c, std::size_t k, const ContactState& state, const CheckedSide& side,
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
  return std::abs(off) <= rounding::elimination * std::abs(N) &&
         tangent_row_is_satisfied(c, k, state, side, rest);
}

}  // namespace signorini::law_check
