#include "run/audit.hpp"

#include <algorithm>
#include <cmath>

#include "contact/law.hpp"

namespace signorini {
namespace {

/// There are degrees of freedom with neither mass nor damping.
bool moves_at_once(const Model& model) {
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless && model.damping.coeff(i, i) == 0.0) return true;
  return false;
}

void raise(Extreme& extreme, double value, double t, int contact = -1) {
  if (value > extreme.value) extreme = {value, t, contact};
}

}  // namespace

Auditor::Auditor(const Model& model, const Structure& structure)
    : model_(model),
      structure_(structure),
      friction_(model.contacts.size(), 0.0),
      peaks_(model.contacts.size()),
      landings_(model),
      massless_(moves_at_once(model)) {}

void Auditor::add(const Works& works) {
  landings_.add(works);
  work_.loads += works.loads;
  work_.damping += works.damping;
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    friction_[k] += works.friction[k];
    work_.friction += works.friction[k];
    work_.surface += works.surface[k];
  }
}

void Auditor::begin(const Decision& decision, const Mode& first, const Forcing& forcing) {
  const Point point{decision.u, decision.v, decision.jet.forces.col(0)};
  for (std::size_t k = 0; k < peaks_.size(); ++k)
    at_start_.push_back({model_.contacts[k].normal.dot(point.u),
                         slide_of(model_.contacts[k], k, forcing, decision.jet.t, point.u, point.v).ut});
  landings_.begin(decision.jet.t, first);
  landings_.instant(decision.jet.t, decision, first);
  work_.impact += decision.impact_loss;
  work_.surface += decision.impact_surface_work;
  audit_.initial = energy(decision.jet.t, decision.mode, point);
  begun_ = true;
}

void Auditor::observe(const Forcing& forcing, double t, const Mode& mode, const Point& point) {
  for (std::size_t k = 0; k < mode.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactMotion m = motion(k, forcing, t, point);
    const int index = static_cast<int>(k);
    Peak& peak = peaks_[k];
    const double ut = slide_of(contact, k, forcing, t, point.u, point.v).ut;
    peak.horizontal = std::max(peak.horizontal, std::abs(ut - at_start_[k].ut));
    peak.vertical = std::max(peak.vertical, std::abs(contact.normal.dot(point.u) - at_start_[k].normal));
    peak.N = std::max(peak.N, std::abs(m.N));
    peak.T = std::max(peak.T, std::abs(m.T));
    landings_.observe(k, m.N);

    raise(audit_.tension, m.N, t, index);
    if (contact.law == Law::compliant) {
      // The surface in contact: the element's own length, which a dashpot may leave short (inside).
      const bool closed = mode[k].state != State::open;
      const double element = closed ? (m.N - contact.normal_damping * m.vn) / contact.normal_stiffness
                             : mode[k].inside ? m.gap
                                              : 0.0;
      const double gap = m.gap - element;
      raise(audit_.gap, -gap, t, index);
      raise(audit_.product, std::abs(gap * m.N), t, index);
    }
    if (contact.law == Law::rigid) {
      const bool closed = mode[k].state != State::open;
      raise(audit_.penetration, closed ? std::abs(m.gap) : -m.gap, t, index);
      raise(audit_.product, std::abs(m.gap * m.N), t, index);
    }
    const int s = slip_sign(mode[k].state);
    const double friction = s == 0 ? contact.static_friction : sliding_friction(contact, s * m.vt);
    if (mode[k].state != State::open) raise(audit_.friction, std::abs(m.T) + friction * m.N, t, index);
    if (s != 0) raise(audit_.direction, -m.T * slip_rate(contact, s).value(m), t, index);
  }
}

void Auditor::equilibrium(double t, double residual) { raise(audit_.equilibrium, residual, t); }

void Auditor::instant(double t, const Decision& decision, const Mode& old_mode, const Point& before,
                      bool load_jumps) {
  landings_.instant(t, decision, old_mode);
  work_.impact += decision.impact_loss;
  work_.surface += decision.impact_surface_work;
  for (const Impulse& impulse : decision.impulses)
    if (impulse.normal > 0.0 && !impulse.hit) ++audit_.impulses_on_closed;
  const Point after{decision.u, decision.v, decision.jet.forces.col(0)};
  const double released = massless_
                              ? stored(old_mode, before).stored() - stored(decision.mode, after).stored() -
                                    (decision.impact_loss - decision.impact_surface_work)
                              : 0.0;
  double lost = 0.0;  // by friction, at this instant
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const ContactMotion &b = decision.before[k], &a = decision.after[k];
    peaks_[k].N = std::max(peaks_[k].N, std::abs(b.N));
    peaks_[k].T = std::max(peaks_[k].T, std::abs(b.T));
    const Contact& contact = model_.contacts[k];
    const auto& kt = contact.tangential_stiffness;
    if (!decision.jumped[k] && !(massless_ && load_jumps)) continue;
    double loss = 0.0;
    if (!massless_) {
      if (kt && std::abs(a.T) < std::abs(b.T)) loss = (b.T * b.T - a.T * a.T) / (2.0 * *kt);
    } else if (load_jumps) {  // parts without mass move at once; what slips does so at its limit
      loss = a.T * (a.ut - b.ut - (kt ? (a.T - b.T) / *kt : 0.0));
    } else if (kt) {  // a force that drops where parts without mass follow: friction takes all that is
                      // released
      loss = released - lost;
    }
    friction_[k] += loss;
    lost += loss;
  }
  // The jump of a load is the limit of a fast ramp, along which parts without mass stay in equilibrium: its
  // work is what is stored and what is lost.
  if (massless_ && load_jumps) work_.loads += lost - released;
  work_.friction += lost;
}

Energy Auditor::stored(const Mode& mode, const Point& point) const {
  Energy e;
  e.kinetic = 0.5 * structure_.quadratic(structure_.m, point.v.data());
  e.elastic = 0.5 * structure_.quadratic(structure_.k, point.u.data());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const double N = point.forces[static_cast<Eigen::Index>(2 * k)];
    const double T = point.forces[static_cast<Eigen::Index>(2 * k) + 1];
    if (contact.law == Law::compliant) {
      const double spring = N - contact.normal_damping * contact.normal.dot(point.v);
      if (mode[k].state != State::open) e.contact += spring * spring / (2.0 * contact.normal_stiffness);
      if (mode[k].inside) {  // N = 0: the spring is as long as the gap is deep
        const double gap = contact.gap + contact.normal.dot(point.u);
        e.contact += 0.5 * contact.normal_stiffness * gap * gap;
      }
    }
    if (contact.tangential_stiffness) e.contact += T * T / (2.0 * *contact.tangential_stiffness);
  }
  return e;
}

Energy Auditor::energy(double t, const Mode& mode, const Point& point) {
  const Energy now = stored(mode, point);
  Energy e = work_;
  e.kinetic = now.kinetic;
  e.elastic = now.elastic;
  e.contact = now.contact;
  audit_.work_of_loads = std::max(audit_.work_of_loads, std::abs(e.loads));
  const double exchanged =
      std::max({std::abs(e.loads), std::abs(e.surface), e.kinetic, e.friction, e.damping});
  audit_.energy_scale = std::max(begun_ ? audit_.energy_scale : 0.0, exchanged);
  if (begun_) raise(audit_.energy, std::abs(e.balance() - audit_.initial.balance()), t);
  return e;
}

ContactSample Auditor::sample(std::size_t k, const Forcing& forcing, double t, const ContactState& state,
                              const Point& point) const {
  const ContactMotion m = motion(k, forcing, t, point);
  ContactSample s;
  s.state = state.state;
  s.gap = m.gap;
  const BodySlide slide = slide_of(model_.contacts[k], k, forcing, t, point.u, point.v);
  s.ut = slide.ut;
  s.vt = slide.vt;
  s.N = m.N;
  s.T = m.T;
  const auto& kt = model_.contacts[k].tangential_stiffness;
  s.slip = state.state == State::stick && kt ? state.anchor : m.ut - (kt ? m.T / *kt : 0.0);
  return s;
}

void Auditor::finish(Report& report, const Energy& last, double t, const Mode& mode) const {
  report.landings = landings_.finish(t, mode);
  report.audit = audit_;
  report.audit.final = last;
  report.audit.friction_work = friction_;
  report.audit.length_scale = model_.scales.displacement;
  report.audit.force_scale = model_.scales.force;
  report.audit.power_scale = model_.scales.force * model_.scales.velocity;
  if (report.audit.energy_scale <= 0.0)
    report.audit.energy_scale = model_.scales.force * model_.scales.displacement;
  report.peaks = peaks_;
}

}  // namespace signorini
