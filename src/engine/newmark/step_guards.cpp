#include "engine/newmark/step_guards.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/rounding.hpp"
#include "decide/guard_signs.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

StepGuards::StepGuards(const Model& model)
    : model_(model), contact_guards_(model.contacts.size()), before_(model.layout.guard_count(), 1.0) {
  g0_ = g1_ = before_;
  rate0_.assign(before_.size(), 0.0);
  rate1_ = rate0_;
  has_rate_.assign(before_.size(), 0);
  for (const Contact& contact : model.contacts) {
    std::map<int, std::pair<double, double>> parts;
    for (const auto& [dof, factor] : contact.normal.terms) parts[dof].first += factor;
    for (const auto& [dof, factor] : contact.tangent.terms) parts[dof].second += factor;
    for (const auto& [dof, part] : parts)
      terms_.push_back({static_cast<std::size_t>(dof), part.first, part.second});
    ends_.push_back(terms_.size());
  }
}

void StepGuards::start(const engine::Segment& segment) {
  const bool others = segment_.forcing != segment.forcing || !segment.same_forcing;
  segment_ = segment;
  const decide::Decision& decision = *segment.decision;
  active_guards_.start(decision.guards);
  waiting_.clear();
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot)
    if (!active_guards_.idle(slot) && !active_guards_.armed(slot)) waiting_.push_back(slot);
  dismissed_.clear();
  const bool all = others || states_.size() != decision.states.size();
  states_.resize(decision.states.size());
  for (std::size_t k = 0; k < contact_guards_.size(); ++k)
    if (all || decision.states[k] != states_[k] || !contact_guards_[k].is_linear) gather(k);
}

void StepGuards::gather(std::size_t k) {
  const decide::Decision& decision = *segment_.decision;
  const Rows& rows = decision.system->rows()[k];
  states_[k] = decision.states[k];
  ContactGuards& guards = contact_guards_[k];
  guards = {};
  // Guards of a rigidly sticking contact may depend on the states of other contacts. With is_linear = false, start() collects
  // them for every segment.
  guards.is_linear = decide::is_plain(rows.normal) && decide::is_plain(rows.tangent) &&
                     rows.normal.vn == 0.0 && !segment_.forcing->is_driven(k) &&
                     !model_.contacts[k].sticks_rigidly();
  guards.gap = model_.contacts[k].gap;
  guards.surface = segment_.forcing->surface(k, decision.jet.t, 0);
  guards.normal_gap = rows.normal.gap;
  guards.tangent_N = rows.tangent.N;
  guards.tangent_ut = rows.tangent.ut;
  for (std::size_t i = 0; i < model_.layout.guards(k); ++i) {
    const std::size_t slot = model_.layout.guard(k, i);
    const bool idle = active_guards_.idle(slot);
    has_rate_[slot] = !idle && rates_known(slot);
    for (std::vector<double>* values : {&before_, &g0_, &g1_}) (*values)[slot] = 1.0;
    rate0_[slot] = rate1_[slot] = 0.0;
    guards.guards[i].constant = 1.0;
    if (idle) continue;
    guards.watched = true;
    const Form& f = decision.form(slot);
    guards.is_linear = guards.is_linear && decide::is_plain(f);
    guards.needs_accelerations =
        guards.needs_accelerations || (has_rate_[slot] && (f.vn != 0.0 || f.vt != 0.0));
    guards.guards[i] = {f.N, f.T, f.gap, f.ut, f.vn, f.vt, f.constant};
  }
}

/// True if displacements, velocities and accelerations determine the derivative of the guard.
bool StepGuards::rates_known(std::size_t slot) const {
  const std::size_t k = model_.layout.contact_of_guard(slot);
  const Form& form = segment_.decision->form(slot);
  const Rows& rows = segment_.decision->system->rows()[k];
  const bool through_T = form.T != 0.0, through_N = form.N != 0.0 || (through_T && rows.tangent.N != 0.0);
  if (form.an != 0.0 || form.at != 0.0) return false;
  if (through_N && (rows.normal.N != 1.0 || rows.normal.an != 0.0)) return false;
  if (through_T && rows.tangent.T != 1.0) return false;
  const auto massless = [&](const Combination& c) {
    return std::any_of(c.terms.begin(), c.terms.end(), [&](const auto& term) {
      return model_.dofs[static_cast<std::size_t>(term.first)].massless;
    });
  };
  const bool accelerates = form.vn != 0.0 || form.vt != 0.0 || (through_N && rows.normal.vn != 0.0);
  return !accelerates || (!massless(model_.contacts[k].normal) && !massless(model_.contacts[k].tangent));
}

void StepGuards::evaluate(const motion::Point& point, double t) {
  for (std::size_t k = 0; k < contact_guards_.size(); ++k) {
    if (!contact_guards_[k].watched) continue;
    if (contact_guards_[k].is_linear)
      evaluate_linear(k, point);
    else
      evaluate_general(k, point, t);
  }
}

void StepGuards::evaluate_linear(std::size_t k, const motion::Point& point) {
  const ContactGuards& guards = contact_guards_[k];
  const double *u = point.u.data(), *v = point.v.data(), *a = point.a.data();
  double gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0, an = 0.0, at = 0.0;
  for (std::size_t i = ends_[k]; i < ends_[k + 1]; ++i) {
    const Term& term = terms_[i];
    gap += term.n * u[term.dof];
    ut += term.t * u[term.dof];
    vn += term.n * v[term.dof];
    vt += term.t * v[term.dof];
    if (!guards.needs_accelerations) continue;
    an += term.n * a[term.dof];
    at += term.t * a[term.dof];
  }
  gap += guards.gap;
  ut -= guards.surface;
  const double N = point.N(model_.layout, k), T = point.T(model_.layout, k);
  const double dN = -(guards.normal_gap * vn), dT = -(guards.tangent_N * dN + guards.tangent_ut * vt);
  for (std::size_t i = 0; i < model_.layout.guards(k); ++i) {
    const LinearGuard& g = guards.guards[i];
    const std::size_t slot = model_.layout.guard(k, i);
    g1_[slot] = g.constant + (g.N * N + g.T * T + g.gap * gap + g.ut * ut + g.vn * vn + g.vt * vt);
    if (has_rate_[slot]) rate1_[slot] = g.N * dN + g.T * dT + g.gap * vn + g.ut * vt + g.vn * an + g.vt * at;
  }
}

void StepGuards::evaluate_general(std::size_t k, const motion::Point& point, double t) {
  const motion::Forcing& forcing = *segment_.forcing;
  const ContactMotion m = motion::motion_of(model_.contacts[k], k, forcing, t, point);
  ContactMotion d;  // time derivative of m; d.N and d.T are computed from the rows below
  d.gap = m.vn;
  d.ut = m.vt;
  d.vn = m.an;
  d.vt = m.at;
  d.applied_normal_force = m.applied_normal_force_rate;
  d.applied_normal_force_rate = forcing.applied_normal_force(k, t, 2);
  const Rows& rows = segment_.decision->system->rows()[k];
  d.N = -(rows.normal.gap * d.gap + rows.normal.vn * d.vn +
          rows.normal.applied_normal_force * d.applied_normal_force);
  // Used only if rates_known(): the row of T then contains no velocities.
  d.T = -(rows.tangent.N * d.N + rows.tangent.ut * d.ut);
  for (std::size_t slot = model_.layout.guard(k); slot < model_.layout.guard_end(k); ++slot) {
    if (active_guards_.idle(slot)) continue;
    const Form& form = segment_.decision->form(slot);
    g1_[slot] = form.value(m);
    if (has_rate_[slot]) rate1_[slot] = form.rate(d);
  }
}

void StepGuards::begin_next_step() {
  before_.swap(g0_);
  g0_.swap(g1_);
  rate0_.swap(rate1_);
  dismissed_.clear();
}

double StepGuards::value(std::size_t slot, double t, const motion::Point& point) const {
  const std::size_t k = model_.layout.contact_of_guard(slot);
  return segment_.decision->form(slot).value(
      motion::motion_of(model_.contacts[k], k, *segment_.forcing, t, point));
}

double StepGuards::level(std::size_t slot, double t, const motion::Point& point) const {
  const std::size_t k = model_.layout.contact_of_guard(slot);
  const decide::GuardStart& guard = segment_.decision->guards[slot];
  return guard.noise + rounding::many_operations * segment_.decision->form(slot).magnitude(motion::motion_of(
                                                       model_.contacts[k], k, *segment_.forcing, t, point));
}

std::optional<double> StepGuards::dip(std::size_t slot, double h, double h_before) const {
  if (std::find(dismissed_.begin(), dismissed_.end(), slot) != dismissed_.end()) return std::nullopt;
  events::GuardCubic along = path(slot, h);
  std::optional<double> x = has_rate(slot) ? along.interior_minimum() : std::nullopt;
  if (!x) {
    events::rates_from_values(along, h, before_[slot], h_before);
    x = along.interior_minimum();
  }
  return x;
}

const std::vector<std::size_t>& StepGuards::candidate_slots(double h, double h_before) {
  candidate_slots_.clear();
  for (std::size_t slot = 0; slot < g1_.size(); ++slot) {
    const double g0 = g0_[slot], g1 = g1_[slot];
    bool holds = g1 > 0.0 && g0 + h * rate0_[slot] / 3.0 > 0.0 && g1 - h * rate1_[slot] / 3.0 > 0.0;
    if (h_before > 0.0) {
      events::GuardCubic along{g0, g1};
      events::rates_from_values(along, h, before_[slot], h_before);
      holds = holds && g0 + along.r0 / 3.0 > 0.0 && g1 - along.r1 / 3.0 > 0.0;
    }
    if (!holds) candidate_slots_.push_back(slot);
  }
  const auto own = static_cast<std::ptrdiff_t>(candidate_slots_.size());
  candidate_slots_.insert(candidate_slots_.end(), waiting_.begin(), waiting_.end());
  std::inplace_merge(candidate_slots_.begin(), candidate_slots_.begin() + own, candidate_slots_.end());
  candidate_slots_.erase(std::unique(candidate_slots_.begin(), candidate_slots_.end()),
                         candidate_slots_.end());
  return candidate_slots_;
}

void StepGuards::update_active_guards(double t, const motion::Point& point) {
  std::erase_if(waiting_, [&](std::size_t slot) {
    active_guards_.update(slot, g1_[slot], level(slot, t, point));
    return active_guards_.armed(slot);
  });
}

}  // namespace signorini::newmark
