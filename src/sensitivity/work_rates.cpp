#include "sensitivity/work_rates.hpp"

#include <numeric>

#include "contact/law.hpp"

namespace signorini {
namespace {

/// Derivative of the form p' of a contact that slips in direction s; the guard of that state is s p'.
Form slip_form_rate(const Contact& contact, const ContactRates& rates, const ContactState& state, int s) {
  const auto forms = guards(contact, state);
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (forms[i].kind == Guard::sliding) {
      Form form = rates.guards[index_of(state.state)][i];
      if (s < 0)
        for (double* x : {&form.N, &form.T, &form.gap, &form.ut, &form.vn, &form.vt, &form.an, &form.at,
                          &form.pressing, &form.pressing_rate, &form.constant})
          *x = -*x;
      return form;
    }
  return {};
}

double sum_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

/// x^T A y + y^T A x
double both_ways(const SparseMatrix& a, const Vector& x, const Vector& y) {
  return x.dot(a * y) + y.dot(a * x);
}

}  // namespace

double WorkRates::friction() const { return sum_of(works.friction); }
double WorkRates::surface() const { return sum_of(works.surface); }

double stiffness_rate(const ContactRates& rates) { return -rates.rows[index_of(State::closed)].normal.gap; }
double damping_rate(const ContactRates& rates) { return -rates.rows[index_of(State::closed)].normal.vn; }

double slip_by(const Contact& contact, const ContactRates& rates, const ContactMotion& m,
               const ContactMotion& D) {
  const double kt = contact.anchor_spring().value_or(0.0);
  return kt > 0.0 ? D.ut - D.T / kt + m.T * rates.tangential_stiffness / (kt * kt) : D.ut;
}

void WorkTangent::add(const TangentPlace& at, double factor) {
  const Vector &v = at.motion.v, &w = at.tangent.v;
  now_.works.loads += factor * (at.load.dot(v) + at.forcing.power(at.t, w.data()));
  double damped = both_ways(model_.damping, v, w);
  if (derivative_.damping.nonZeros() > 0) damped += v.dot(derivative_.damping * v);
  for (std::size_t c = 0; c < at.mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    const ContactState& state = at.mode[c];
    const ContactMotion m = motion_of(contact, c, at.forcing, at.t, at.motion);
    const ContactMotion p =
        parameter_rate(contact, rates, model_.layout, c, at.motion, at.tangent, at.driven[c]);
    double friction = 0.0;
    if (!contact.obeys_coulomb()) {
      friction = p.N * m.vn + m.N * p.vn + p.T * m.vt + m.T * p.vt;
    } else if (const int s = slip_sign(state.state); s != 0) {
      const Form form = slip_rate(contact, s);
      friction =
          p.T * form.value(m) + m.T * (form.rate(p) + slip_form_rate(contact, rates, state, s).value(m));
    }
    now_.works.friction[c] += factor * friction;
    now_.works.surface[c] -= factor * (p.T * at.forcing.surface(c, at.t, 1) + m.T * at.driven[c].surface[1]);
    now_.works.pressing[c] -= factor * p.N;
    if (!contact.obeys_coulomb()) continue;
    if (!is_open(state.state))
      damped += damping_rate(rates) * m.vn * m.vn + 2.0 * contact.normal_damping * m.vn * p.vn;
    else if (state.state == State::inside)  // its dashpot dissipates the energy of its spring, kn g^2/2
      damped -=
          stiffness_rate(rates) * m.gap * m.vn + contact.normal_stiffness * (p.gap * m.vn + m.gap * p.vn);
  }
  now_.works.damping += factor * damped;
}

void WorkTangent::shift(const Forcing& forcing, double t, const Mode& mode, const SeriesPoint& motion,
                        const std::vector<ContactMotion>& m, double dt, const std::vector<double>& dt_of) {
  now_.works.loads += dt * forcing.power(t, motion.v.data());
  now_.works.damping += dt * motion.v.dot(model_.damping * motion.v);
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const double slip = working_slip_rate(contact, mode[c].state, m[c]);
    now_.works.add(c,
                   work_on(contact, mode[c].state, m[c].N, m[c].T,
                           {slip, forcing.surface(c, t, 1), m[c].vn, m[c].vn, 1.0}),
                   dt_of[c]);
    if (mode[c].state == State::inside)
      now_.works.damping -= dt_of[c] * contact.normal_stiffness * m[c].gap * m[c].vn;
  }
}

double WorkTangent::kinetic(const Vector& v, const Vector& Dv) const {
  double energy = 0.5 * both_ways(model_.mass, v, Dv);
  if (derivative_.mass.nonZeros() > 0) energy += 0.5 * v.dot(derivative_.mass * v);
  return energy;
}

/// shear: energy of its shear element, which belongs to the structure.
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
  const State state = at.mode[c].state;
  if (state == State::inside) return energy + kn * m.gap * D.gap + 0.5 * kn_p * m.gap * m.gap;
  if (is_open(state)) return energy;
  const double spring = m.N - contact.normal_damping * m.vn;
  const double moved = D.N - contact.normal_damping * D.vn - damping_rate(rates) * m.vn;
  return energy + spring * moved / kn - 0.5 * spring * spring * kn_p / (kn * kn);
}

Energy WorkTangent::stored(const StoredMotion& at) const {
  Energy e;
  e.kinetic = kinetic(at.v, at.Dv);
  e.elastic = 0.5 * both_ways(model_.stiffness, at.u, at.Du);
  if (derivative_.stiffness.nonZeros() > 0) e.elastic += 0.5 * at.u.dot(derivative_.stiffness * at.u);
  for (std::size_t c = 0; c < at.mode.size(); ++c) {
    double shear = 0.0;
    e.contact += contact_energy(c, at, shear) + shear;
    e.elastic -= shear;
  }
  return e;
}

}  // namespace signorini
