#include "sensitivity/loss_rates.hpp"

#include <algorithm>

#include "sensitivity/forcing_rates.hpp"

namespace signorini {

/// Values on both sides of an instant, along it.
struct LossRates::Sides {
  const InstantMotion& motion;
  const TangentBefore& before;
  const TangentAfter& after;
  Vector Du_before, Dv_before, Du_after, Dv_after;
  std::vector<ContactMotion> D_before, D_after;
};

void LossRates::add_impact(const Sides& s, WorkRates& works) const {
  const RunInstant& now = s.motion.instant;
  if (s.after.impulse_n.empty()) return;
  const WorkTangent energy(model_, derivative_);
  double driven = 0.0;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Impulse& impulse = now.after.impulses[c];
    const double dt = s.after.rates[c].t;
    const double moved =
        s.after.impulse_t[c] * now.forcing_before.surface(c, now.t, 1) +
        impulse.tangent * (s.before.driven[c].surface[1] + dt * now.forcing_before.surface(c, now.t, 2));
    works.works.surface[c] += moved;
    driven += moved;
  }
  works.impact +=
      energy.kinetic(s.motion.before.v, s.Dv_before) - energy.kinetic(s.motion.after.v, s.Dv_after) + driven;
}

/// Derivative of the energy that a contact's shear loses as its force drops, as in the audit; nullopt: no loss.
std::optional<double> LossRates::drop_by(const Sides& s, std::size_t c) const {
  const Contact& contact = model_.contacts[c];
  const ContactMotion &b = s.motion.motion_before[c], &a = s.motion.motion_after[c];
  const double kt = contact.anchor_spring().value_or(0.0);
  const Decision& now = s.motion.instant.after;
  if (!now.jumped[c] || !(std::abs(a.T) < std::abs(b.T))) return std::nullopt;
  if (slides_at_once(contact) && (now.mode[c].state != State::stick || now.visited[c])) return 0.0;
  if (!(kt > 0.0)) return std::nullopt;
  return (b.T * s.D_before[c].T - a.T * s.D_after[c].T) / kt -
         (b.T * b.T - a.T * a.T) * derivative_.contacts[c].tangential_stiffness / (2.0 * kt * kt);
}

/// Derivative of P . (u+ - u-) on parts without mass, which jump under continuous loads.
double LossRates::driven_by(const Sides& s) const {
  const RunInstant& now = s.motion.instant;
  ForcingRatesSeries rates;
  ForcingRates(model_, derivative_, now.t, Side::after).expand(now.t, 1.0, 1, rates);
  Vector load = Vector::Zero(model_.size()), rate = rates.load.col(0);
  now.forcing_after.add_load(now.t, 0, load.data());
  now.forcing_after.add_load(now.t, 1, rate.data(), s.after.dt);
  double work = 0.0;
  for (int i = 0; i < model_.size(); ++i)
    if (model_.dofs[static_cast<std::size_t>(i)].massless)
      work +=
          rate[i] * (s.motion.after.u[i] - s.motion.before.u[i]) + load[i] * (s.Du_after[i] - s.Du_before[i]);
  return work;
}

void LossRates::add_drops(const Sides& s, WorkTangent& works) const {
  const RunInstant& now = s.motion.instant;
  const InstantMotion& m = s.motion;
  double released = 0.0, lost = 0.0, dropped = 0.0;
  if (massless_) {
    const Energy from = works.stored(
        {now.mode_before, m.before.u, m.before.v, s.Du_before, s.Dv_before, m.motion_before, s.D_before});
    const Energy to = works.stored(
        {now.after.mode, m.after.u, m.after.v, s.Du_after, s.Dv_after, m.motion_after, s.D_after});
    WorkRates impact{Works(model_.contacts.size()), 0.0};
    add_impact(s, impact);
    released = from.stored() - to.stored() - (impact.impact - impact.surface());
  }
  const std::vector<bool>& jumped = now.after.jumped;
  if (massless_ && !now.load_jumps && std::find(jumped.begin(), jumped.end(), true) != jumped.end()) {
    const double driven = driven_by(s);
    released += driven;
    works.now().works.loads += driven;
  }
  std::vector<std::optional<double>> drops;
  int count = 0;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    drops.push_back(drop_by(s, c));
    dropped += drops.back().value_or(0.0);
    count += drops.back() ? 1 : 0;
  }
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    if (!now.after.jumped[c] && !(massless_ && now.load_jumps)) continue;
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    const ContactMotion &b = m.motion_before[c], &a = m.motion_after[c];
    const ContactMotion &Db = s.D_before[c], &Da = s.D_after[c];
    double loss = 0.0;
    if (!massless_) {
      loss = drops[c].value_or(0.0);
    } else if (now.load_jumps) {
      loss = Da.T * (slip_of(contact, a) - slip_of(contact, b)) +
             a.T * (slip_by(contact, rates, a, Da) - slip_by(contact, rates, b, Db));
    } else if (drops[c]) {
      loss = *drops[c] + (released - dropped) / count;
    } else if (count == 0 && contact.tangential_stiffness) {
      loss = released - lost;
    }
    works.now().works.friction[c] += loss;
    lost += loss;
  }
  if (massless_ && now.load_jumps) works.now().works.loads += lost - released;
}

WorkRates LossRates::pass(const InstantMotion& m, const TangentBefore& before, const TangentAfter& after,
                          WorkTangent& works) const {
  const RunInstant& now = m.instant;
  std::vector<double> dt_of;
  Sides s{m, before, after, {}, {}, {}, {}, {}, {}};
  s.Du_before = before.point.u + after.dt * m.before.v;
  s.Dv_before = before.point.v + after.dt * m.before.a;
  s.Du_after = after.point.u + after.dt * m.after.v;  // includes parts without mass, which have moved
  s.Dv_after = after.point.v + after.dt * m.after.a;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    dt_of.push_back(after.rates[c].t);
    s.D_before.push_back(
        sum(parameter_rate(contact, rates, model_.layout, c, m.before, before.point, before.driven[c]),
            m.rate_before[c], dt_of[c]));
    s.D_after.push_back(
        sum(parameter_rate(contact, rates, model_.layout, c, m.after, after.point, after.driven[c]),
            m.rate_after[c], dt_of[c]));
  }
  works.shift(now.forcing_before, now.t, now.mode_before, m.before, m.motion_before, after.dt, dt_of);
  add_impact(s, works.now());
  add_drops(s, works);
  WorkRates along = works.now();
  for (double& dt : dt_of) dt = -dt;
  works.shift(now.forcing_after, now.t, now.after.mode, m.after, m.motion_after, -after.dt, dt_of);
  return along;
}

}  // namespace signorini
