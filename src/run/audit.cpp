#include "run/audit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/rounding.hpp"
#include "contact/law.hpp"
#include "contact/motion.hpp"
#include "contact/work.hpp"

namespace signorini::run {
namespace {

void raise(Extreme& extreme, double value, double t, int contact = -1) {
  if (value > extreme.value) extreme = {value, t, contact};
}

/// Energies released by shear springs whose force drops, one entry per contact. A shear element in series with a sliding
/// point keeps its energy during the slide, and dissipates a share of the energy that other springs release.
struct Drops {
  std::vector<double> own;
  std::vector<bool> any;
  double sum = 0.0;
  int count = 0;
};

Drops drops_of(const Model& model, const decide::Decision& decision) {
  const std::size_t contacts = model.contacts.size();
  Drops drops{std::vector<double>(contacts, 0.0), std::vector<bool>(contacts, false)};
  for (std::size_t k = 0; k < contacts; ++k) {
    const double from = decision.before[k].T, to = decision.after[k].T;
    if (!decision.jumped[k] || !(std::abs(to) < std::abs(from))) continue;
    const Contact& contact = model.contacts[k];
    drops.own[k] = contact::shear_energy(contact, from) - contact::shear_energy(contact, to);
    const bool holds = decision.states[k].state == State::stick && !decision.visited[k];
    drops.any[k] = drops.own[k] > 0.0 || (contact::slides_instantaneously(contact) && !holds);
    drops.sum += drops.own[k];
    drops.count += drops.any[k] ? 1 : 0;
  }
  return drops;
}

}  // namespace

bool has_instantaneous_parts(const Model& model) {
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless && model.damping.coeff(i, i) == 0.0) return true;
  return false;
}

Auditor::Auditor(const Model& model, const linear::SystemMatrices& structure)
    : model_(model),
      structure_(structure),
      friction_(model.contacts.size(), 0.0),
      peaks_(model.contacts.size()),
      supports_(model.contacts.size()),
      rested_at_limit_(model.contacts.size(), false),
      landings_(model),
      massless_(has_instantaneous_parts(model)) {}

void Auditor::add(const motion::WorkIntegrals& works) {
  landings_.add(works);
  work_.loads += works.loads;
  work_.damping += works.damping;
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    friction_[k] += works.friction[k];
    work_.friction += works.friction[k];
    work_.surface += works.surface[k];
  }
}

void Auditor::begin(const decide::Decision& decision, const contact::ContactStates& first,
                    const motion::Forcing& forcing, const motion::Point& point) {
  for (std::size_t k = 0; k < peaks_.size(); ++k)
    at_start_.push_back(place_of(k, forcing, decision.jet.t, decision.states[k].state, point));
  for (std::size_t k = 0; k < supports_.size(); ++k) {
    const ContactMotion m = motion(k, forcing, decision.jet.t, point);
    SupportLoad& load = supports_[k];
    load.min_N = load.max_N = {m.N, decision.jet.t};
    load.min_T = load.max_T = {m.T, decision.jet.t};
    load.slip_at_start = load.slip_at_end = slip(k, decision.states[k], m);
  }
  landings_.begin(decision.jet.t, first);
  landings_.instant(decision.jet.t, decision, first);
  update_limits(decision.jet.t, decision);
  work_.impact += decision.impact_loss;
  work_.surface += decision.impact_surface_work;
  correction_energy_at_start_ = model_.correction_energy(decision.jet.t);
  audit_.initial = energy(decision.jet.t, decision.states, point);
  begun_ = true;
}

void Auditor::update_limits(double t, const decide::Decision& decision) {
  for (const decide::ContactAtLimit& found : decision.at_limit) {
    const Extreme here{std::abs(found.margin), t, static_cast<int>(found.contact)};
    if (audit_.contacts_at_limit == 0 || here.value > audit_.at_limit.value) audit_.at_limit = here;
    if (!rested_at_limit_[found.contact]) ++audit_.contacts_at_limit;
    rested_at_limit_[found.contact] = true;
  }
}

void Auditor::update_peak_forces(std::size_t contact, double t, double N, double T) {
  Peak& peak = peaks_[contact];
  peak.N = std::max(peak.N, std::abs(N));
  peak.T = std::max(peak.T, std::abs(T));
  SupportLoad& load = supports_[contact];
  // An extreme keeps its first time if later values differ from it only by rounding.
  const double same = rounding::elimination * std::max(peak.N, peak.T);
  if (N < load.min_N.value - same) load.min_N = {N, t};
  if (N > load.max_N.value + same) load.max_N = {N, t};
  if (T < load.min_T.value - same) load.min_T = {T, t};
  if (T > load.max_T.value + same) load.max_T = {T, t};
}

double Auditor::slip(std::size_t contact, const ContactState& state, const ContactMotion& m) const {
  const bool anchored = state.state == State::stick && model_.contacts[contact].tangential_stiffness;
  return anchored ? state.anchor : contact::slip_of(model_.contacts[contact], m);
}

Auditor::Place Auditor::place_of(std::size_t k, const motion::Forcing& forcing, double t, State state,
                                 const motion::Point& point) const {
  const Contact& contact = model_.contacts[k];
  if (!contact.compliance_split())
    return {contact.normal.dot(point.u), motion::body_slide(contact, k, forcing, t, point.u, point.v).ut};
  ContactMotion m = motion(k, forcing, t, point);
  contact::remove_split_compliance(contact, state, m);
  return {m.gap - contact.gap, m.ut};
}

void Auditor::observe(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
                      const motion::Point& point) {
  for (std::size_t k = 0; k < states.size(); ++k) observe(k, forcing, t, states, point);
}

void Auditor::observe(std::size_t k, const motion::Forcing& forcing, double t,
                      const contact::ContactStates& states, const motion::Point& point) {
  const Contact& contact = model_.contacts[k];
  const ContactMotion m = motion(k, forcing, t, point);
  const int index = static_cast<int>(k);
  Peak& peak = peaks_[k];
  const Place place = contact.compliance_split() || contact.sliding_point()
                          ? place_of(k, forcing, t, states[k].state, point)
                          : Place{contact.normal.dot(point.u), m.ut};
  peak.tangential = std::max(peak.tangential, std::abs(place.ut - at_start_[k].ut));
  peak.normal = std::max(peak.normal, std::abs(place.normal - at_start_[k].normal));
  update_peak_forces(k, t, m.N, m.T);
  supports_[k].slip_at_end = slip(k, states[k], m);
  landings_.observe(k, m.N);

  const Violations off = contact::violations(contact, states[k].state, m);
  raise(audit_.tension, off.tension, t, index);
  raise(audit_.gap, off.gap, t, index);
  raise(audit_.penetration, off.penetration, t, index);
  raise(audit_.product, off.product, t, index);
  raise(audit_.friction, off.friction, t, index);
  raise(audit_.direction, off.direction, t, index);
}

void Auditor::equilibrium(double t, double residual) { raise(audit_.equilibrium, residual, t); }

double Auditor::work_of_jump(const motion::Forcing& forcing, double t, const motion::Point& before,
                             const decide::Decision& decision) const {
  Vector load = Vector::Zero(model_.size());
  forcing.add_load(t, 0, load.data());
  double work = 0.0;
  for (int i = 0; i < model_.size(); ++i)
    if (model_.dofs[static_cast<std::size_t>(i)].massless) work += load[i] * (decision.u[i] - before.u[i]);
  return work;
}

void Auditor::instant(double t, const decide::Decision& decision, const contact::ContactStates& old_states,
                      const motion::Point& before, const motion::Forcing& forcing, bool load_jumps) {
  landings_.instant(t, decision, old_states);
  update_limits(t, decision);
  work_.impact += decision.impact_loss;
  work_.surface += decision.impact_surface_work;
  for (const decide::Impulse& impulse : decision.impulses)
    if (impulse.normal > 0.0 && !impulse.hit) ++audit_.impulses_on_closed;
  const motion::Point after{decision.u, decision.v, decision.jet.forces.col(0)};
  // Constant loads do work on massless parts that jump.
  const bool any_jumps =
      std::find(decision.jumped.begin(), decision.jumped.end(), true) != decision.jumped.end();
  const double driven =
      massless_ && any_jumps && !load_jumps ? work_of_jump(forcing, t, before, decision) : 0.0;
  const double released = massless_ ? driven + stored(old_states, before).stored() -
                                          stored(decision.states, after).stored() -
                                          (decision.impact_loss - decision.impact_surface_work)
                                    : 0.0;
  work_.loads += driven;
  const Drops drops = drops_of(model_, decision);
  double lost = 0.0;  // energy dissipated by friction at this instant
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const ContactMotion &b = decision.before[k], &a = decision.after[k];
    update_peak_forces(k, t, b.N, b.T);
    const Contact& contact = model_.contacts[k];
    if (!decision.jumped[k] && !(massless_ && load_jumps)) continue;
    double loss = 0.0;
    if (!massless_) {
      loss = drops.own[k];
    } else if (load_jumps) {  // massless parts jump with the load; sliding contacts are at their limit
      loss = a.T * (contact::slip_of(contact, a) - contact::slip_of(contact, b));
    } else if (drops.any[k]) {  // massless parts jump: friction dissipates all energy that they release
      loss = drops.own[k] + (released - drops.sum) / drops.count;
    } else if (drops.count == 0 && contact.tangential_stiffness) {
      loss = released - lost;
    }
    friction_[k] += loss;
    lost += loss;
  }
  // The jump of a load is the limit of a fast ramp. Massless parts stay in equilibrium during the ramp, so the load's work
  // is the sum of the stored and the dissipated energy.
  if (massless_ && load_jumps) work_.loads += lost - released;
  work_.friction += lost;
}

Energy Auditor::stored(const contact::ContactStates& states, const motion::Point& point) const {
  Energy e;
  e.kinetic = point.energy ? point.energy->kinetic : 0.5 * structure_.quadratic(structure_.m, point.v.data());
  e.elastic = point.energy ? point.energy->elastic : 0.5 * structure_.quadratic(structure_.k, point.u.data());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    ContactMotion m;
    m.N = point.N(model_.layout, k);
    m.T = point.T(model_.layout, k);
    m.gap = contact.gap_at(point.u);
    m.vn = contact::gap_rate(contact, point.v);
    const double springs = contact::stored_energy(contact, states[k].state, m);
    (contact.compliance_split() ? e.elastic : e.contact) += springs;
    // The springs of a contact with a sliding point are part of K, so their energy moves from e.elastic to e.contact.
    if (const ShearElement* element = contact.sliding_point()) {
      const double strain = element->body.dot(point.u) - contact.tangent.dot(point.u);
      const double energy = 0.5 * element->stiffness * strain * strain;
      e.contact += energy;
      e.elastic -= energy;
    }
  }
  return e;
}

Energy Auditor::energy(double t, const contact::ContactStates& states, const motion::Point& point) {
  const Energy now = stored(states, point);
  Energy e = work_;
  e.kinetic = now.kinetic;
  e.elastic = now.elastic;
  e.contact = now.contact;
  return audit_balance(t, e);
}

Energy Auditor::energy(double t, const motion::WorkIntegrals& ahead, const contact::ContactStates& states,
                       const motion::Point& point) {
  return audit_balance(t, energy_before(ahead, states, point));
}

Energy Auditor::audit_balance(double t, Energy e) {
  const double unseen = model_.correction_energy(t);
  e.elastic -= unseen;
  e.loads -= unseen - correction_energy_at_start_;
  audit_.work_of_loads = std::max(audit_.work_of_loads, std::abs(e.loads));
  const double exchanged =
      std::max({std::abs(e.loads), std::abs(e.surface), e.kinetic, e.friction, e.damping});
  audit_.energy_scale = std::max(begun_ ? audit_.energy_scale : 0.0, exchanged);
  if (begun_) raise(audit_.energy, std::abs(e.balance() - audit_.initial.balance()), t);
  return e;
}

Energy Auditor::energy_before(const motion::WorkIntegrals& works, const contact::ContactStates& states,
                              const motion::Point& point) const {
  Energy e = stored(states, point);
  e.impact = work_.impact;
  e.loads = work_.loads - works.loads;
  e.damping = work_.damping - works.damping;
  e.friction = work_.friction - std::accumulate(works.friction.begin(), works.friction.end(), 0.0);
  e.surface = work_.surface - std::accumulate(works.surface.begin(), works.surface.end(), 0.0);
  return e;
}

ContactSample Auditor::sample(std::size_t k, const motion::Forcing& forcing, double t,
                              const ContactState& state, const motion::Point& point) const {
  const ContactMotion m = motion(k, forcing, t, point);
  ContactSample s;
  s.state = contact::representative_state(state.state);
  s.gap = m.gap;
  const motion::BodySlide slide = motion::body_slide(model_.contacts[k], k, forcing, t, point.u, point.v);
  s.ut = slide.ut;
  s.vt = slide.vt;
  s.N = m.N;
  s.T = m.T;
  s.slip = slip(k, state, m);
  if (model_.contacts[k].compliance_split()) {
    ContactMotion touching = m;
    contact::remove_split_compliance(model_.contacts[k], state.state, touching);
    s.gap = touching.gap;
    s.ut = touching.ut;
    s.vt = touching.vt;
  }
  if (!model_.contacts[k].obeys_coulomb()) s.memory = state.anchor;
  return s;
}

void Auditor::finish(Report& report, const Energy& last, double t,
                     const contact::ContactStates& states) const {
  report.landings = landings_.finish(t, states);
  report.audit = audit_;
  report.audit.final = last;
  report.audit.friction_work = friction_;
  report.audit.length_scale = model_.scales.displacement;
  report.audit.force_scale = model_.scales.force;
  report.audit.power_scale = model_.scales.force * model_.scales.velocity;
  if (report.audit.energy_scale <= 0.0)
    report.audit.energy_scale = model_.scales.force * model_.scales.displacement;
  report.peaks = peaks_;
  report.supports = supports_;
}

}  // namespace signorini::run
