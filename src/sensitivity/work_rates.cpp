#include "sensitivity/work_rates.hpp"

#include <algorithm>
#include <numeric>

#include "contact/law.hpp"
#include "sensitivity/forcing_rates.hpp"

namespace signorini::sensitivity {
namespace {

/// Derivative of the coefficients of p' for a contact that slips in direction s. The guard of that state is s p'.
Form slip_form_rate(const Contact& contact, const ContactRates& rates, const ContactState& state, int s) {
  const auto forms = contact::guards(contact, state);
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (forms[i].kind == Guard::sliding) {
      Form form = rates.guards[index_of(state.state)][i];
      if (s < 0)
        for (double* x : {&form.N, &form.T, &form.gap, &form.ut, &form.vn, &form.vt, &form.an, &form.at,
                          &form.applied_normal_force, &form.applied_normal_force_rate, &form.constant})
          *x = -*x;
      return form;
    }
  return {};
}

double sum_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

/// x^T A y + y^T A x
double symmetric_product(const SparseMatrix& a, const Vector& x, const Vector& y) {
  return x.dot(a * y) + y.dot(a * x);
}

}  // namespace

double WorkRates::friction() const { return sum_of(works.friction); }
double WorkRates::surface() const { return sum_of(works.surface); }

double stiffness_rate(const ContactRates& rates) { return -rates.rows[index_of(State::closed)].normal.gap; }
double damping_rate(const ContactRates& rates) { return -rates.rows[index_of(State::closed)].normal.vn; }

double slip_derivative(const Contact& contact, const ContactRates& rates, const ContactMotion& m,
                       const ContactMotion& D) {
  const double kt = contact.anchor_spring().value_or(0.0);
  return kt > 0.0 ? D.ut - D.T / kt + m.T * rates.tangential_stiffness / (kt * kt) : D.ut;
}

void WorkTangent::add(const TangentPlace& at, double factor) {
  const Vector &v = at.motion.v, &w = at.tangent.v;
  now_.works.loads += factor * (at.load.dot(v) + at.forcing.power(at.t, w.data()));
  double damped = symmetric_product(model_.damping, v, w);
  if (derivative_.damping.nonZeros() > 0) damped += v.dot(derivative_.damping * v);
  for (std::size_t c = 0; c < at.states.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    const ContactState& state = at.states[c];
    const ContactMotion m = motion_of(contact, c, at.forcing, at.t, at.motion);
    const ContactMotion p =
        parameter_rate(contact, rates, model_.layout, c, at.motion, at.tangent, at.driven[c]);
    double friction = 0.0;
    if (!contact.obeys_coulomb()) {
      friction = p.N * m.vn + m.N * p.vn + p.T * m.vt + m.T * p.vt;
    } else if (const int s = slip_sign(state.state); s != 0) {
      const Form form = contact::slip_rate(contact, s);
      friction =
          p.T * form.value(m) + m.T * (form.rate(p) + slip_form_rate(contact, rates, state, s).value(m));
    }
    now_.works.friction[c] += factor * friction;
    now_.works.surface[c] -= factor * (p.T * at.forcing.surface(c, at.t, 1) + m.T * at.driven[c].surface[1]);
    now_.works.applied_normal_force[c] -= factor * p.N;
    if (!contact.obeys_coulomb()) continue;
    if (!is_open(state.state))
      damped += damping_rate(rates) * m.vn * m.vn + 2.0 * contact.normal_damping * m.vn * p.vn;
    else if (state.state == State::inside)  // the contact's dashpot dissipates the spring energy kn g^2/2
      damped -=
          stiffness_rate(rates) * m.gap * m.vn + contact.normal_stiffness * (p.gap * m.vn + m.gap * p.vn);
  }
  now_.works.damping += factor * damped;
}

void WorkTangent::shift(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
                        const SeriesPoint& motion, const std::vector<ContactMotion>& m, double dt,
                        const std::vector<double>& dt_of) {
  now_.works.loads += dt * forcing.power(t, motion.v.data());
  now_.works.damping += dt * motion.v.dot(model_.damping * motion.v);
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const double slip = contact::working_slip_rate(contact, states[c].state, m[c]);
    now_.works.add(c,
                   contact::work_on(contact, states[c].state, m[c].N, m[c].T,
                                    {slip, forcing.surface(c, t, 1), m[c].vn, m[c].vn, 1.0}),
                   dt_of[c]);
    if (states[c].state == State::inside)
      now_.works.damping -= dt_of[c] * contact.normal_stiffness * m[c].gap * m[c].vn;
  }
}

double WorkTangent::kinetic(const Vector& v, const Vector& Dv) const {
  double energy = 0.5 * symmetric_product(model_.mass, v, Dv);
  if (derivative_.mass.nonZeros() > 0) energy += 0.5 * v.dot(derivative_.mass * v);
  return energy;
}

/// Derivative of a contact's stored energy. shear: receives that of its shear element, whose energy is part of the structure.
double WorkTangent::contact_energy(std::size_t c, const StoredMotion& at, double& shear) const {
  const Contact& contact = model_.contacts[c];
  const ContactRates& rates = derivative_.contacts[c];
  const ContactMotion &m = at.m[c], &D = at.D[c];
  double energy = 0.0;
  shear = 0.0;
  if (const double kt = contact.anchor_spring().value_or(0.0); kt > 0.0)
    energy += m.T * D.T / kt - 0.5 * m.T * m.T * rates.tangential_stiffness / (kt * kt);
  if (const ShearElement* element = contact.sliding_point()) {
    const double strain = element->body.dot(at.u) - contact.tangent.dot(at.u);
    const double moved = element->body.dot(at.Du) - contact.tangent.dot(at.Du) +
                         rates.body_tangent.dot(at.u) - rates.tangent.dot(at.u);
    shear = element->stiffness * strain * moved + 0.5 * rates.shear_stiffness * strain * strain;
  }
  if (!contact.is_elastic_along_normal()) return energy;
  const double kn = contact.normal_stiffness, kn_p = stiffness_rate(rates);
  const State state = at.states[c].state;
  if (state == State::inside) return energy + kn * m.gap * D.gap + 0.5 * kn_p * m.gap * m.gap;
  if (is_open(state)) return energy;
  const double spring = m.N - contact.normal_damping * m.vn;
  const double moved = D.N - contact.normal_damping * D.vn - damping_rate(rates) * m.vn;
  return energy + spring * moved / kn - 0.5 * spring * spring * kn_p / (kn * kn);
}

Energy WorkTangent::stored(const StoredMotion& at) const {
  Energy e;
  e.kinetic = kinetic(at.v, at.Dv);
  e.elastic = 0.5 * symmetric_product(model_.stiffness, at.u, at.Du);
  if (derivative_.stiffness.nonZeros() > 0) e.elastic += 0.5 * at.u.dot(derivative_.stiffness * at.u);
  for (std::size_t c = 0; c < at.states.size(); ++c) {
    double shear = 0.0;
    e.contact += contact_energy(c, at, shear) + shear;
    e.elastic -= shear;
  }
  return e;
}

/// Values on both sides of an instant, and their derivatives along the instant.
struct LossRates::Sides {
  const InstantMotion& motion;
  const TangentBefore& before;
  const TangentAfter& after;
  Vector Du_before, Dv_before, Du_after, Dv_after;
  std::vector<ContactMotion> D_before, D_after;
};

void LossRates::add_impact(const Sides& s, WorkRates& works) const {
  const run::RunInstant& now = s.motion.instant;
  if (s.after.impulse_n.empty()) return;
  const WorkTangent energy(model_, derivative_);
  double driven = 0.0;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const decide::Impulse& impulse = now.after.impulses[c];
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

/// Derivative of the energy that a contact's shear spring loses if its force drops, as in the audit; nullopt: no loss.
std::optional<double> LossRates::friction_drop_loss(const Sides& s, std::size_t c) const {
  const Contact& contact = model_.contacts[c];
  const ContactMotion &b = s.motion.motion_before[c], &a = s.motion.motion_after[c];
  const double kt = contact.anchor_spring().value_or(0.0);
  const decide::Decision& now = s.motion.instant.after;
  if (!now.jumped[c] || !(std::abs(a.T) < std::abs(b.T))) return std::nullopt;
  if (contact::slides_instantaneously(contact) && (now.states[c].state != State::stick || now.visited[c]))
    return 0.0;
  if (!(kt > 0.0)) return std::nullopt;
  return (b.T * s.D_before[c].T - a.T * s.D_after[c].T) / kt -
         (b.T * b.T - a.T * a.T) * derivative_.contacts[c].tangential_stiffness / (2.0 * kt * kt);
}

/// Derivative of P . (u+ - u-) on massless parts, which jump under continuous loads.
double LossRates::load_work_rate(const Sides& s) const {
  const run::RunInstant& now = s.motion.instant;
  ForcingDerivatives rates;
  ForcingRates(model_, derivative_, now.t, motion::Side::after).expand(now.t, 1.0, 1, rates);
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
  const run::RunInstant& now = s.motion.instant;
  const InstantMotion& m = s.motion;
  double released = 0.0, lost = 0.0, dropped = 0.0;
  if (massless_) {
    const Energy from = works.stored(
        {now.states_before, m.before.u, m.before.v, s.Du_before, s.Dv_before, m.motion_before, s.D_before});
    const Energy to = works.stored(
        {now.after.states, m.after.u, m.after.v, s.Du_after, s.Dv_after, m.motion_after, s.D_after});
    WorkRates impact{motion::WorkIntegrals(model_.contacts.size()), 0.0};
    add_impact(s, impact);
    released = from.stored() - to.stored() - (impact.impact - impact.surface());
  }
  const std::vector<bool>& jumped = now.after.jumped;
  if (massless_ && !now.load_jumps && std::find(jumped.begin(), jumped.end(), true) != jumped.end()) {
    const double driven = load_work_rate(s);
    released += driven;
    works.now().works.loads += driven;
  }
  std::vector<std::optional<double>> drops;
  int count = 0;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    drops.push_back(friction_drop_loss(s, c));
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
      loss = Da.T * (contact::slip_of(contact, a) - contact::slip_of(contact, b)) +
             a.T * (slip_derivative(contact, rates, a, Da) - slip_derivative(contact, rates, b, Db));
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
  const run::RunInstant& now = m.instant;
  std::vector<double> dt_of;
  Sides s{m, before, after, {}, {}, {}, {}, {}, {}};
  s.Du_before = before.point.u + after.dt * m.before.v;
  s.Dv_before = before.point.v + after.dt * m.before.a;
  s.Du_after = after.point.u + after.dt * m.after.v;  // includes massless parts, which have moved
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
  works.shift(now.forcing_before, now.t, now.states_before, m.before, m.motion_before, after.dt, dt_of);
  add_impact(s, works.now());
  add_drops(s, works);
  WorkRates along = works.now();
  for (double& dt : dt_of) dt = -dt;
  works.shift(now.forcing_after, now.t, now.after.states, m.after, m.motion_after, -after.dt, dt_of);
  return along;
}

}  // namespace signorini::sensitivity
