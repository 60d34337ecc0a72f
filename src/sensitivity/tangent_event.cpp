#include "sensitivity/tangent_event.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "contact/friction.hpp"
#include "decide/impact.hpp"
#include "run/scene_units.hpp"

namespace signorini::sensitivity {

ImpactRates impact_rates(motion::StateSystems& systems, const ModelDerivative& derivative,
                         contact::ContactStates states, const decide::Decision& after, const Vector& v,
                         const Vector& Dv, const std::vector<double>& surface) {
  const Model& model = systems.model();
  ImpactRates result;
  states = decide::states_of_impact(model, std::move(states), after.impulses);
  const motion::StateSystemPtr system = systems.system_of(states);
  if (!system) return result;
  const linear::Unknowns& at = system->unknowns();
  std::vector<double> x(at.size(), 0.0), work(at.size());
  Eigen::Map<Vector> momentum(x.data(), model.size());
  const Vector jump = after.v - v;
  if (derivative.mass.nonZeros() > 0) momentum -= derivative.mass * jump;
  for (std::size_t c = 0; c < states.size(); ++c) {
    const decide::Impulse& impulse = after.impulses[c];
    if (!(impulse.normal > 0.0)) continue;
    const Contact& contact = model.contacts[c];
    const ContactRates& rates = derivative.contacts[c];
    rates.normal.add_to(momentum, impulse.normal);
    rates.tangent.add_to(momentum, impulse.tangent);
    const double vn = contact.normal.dot(v);
    const double Dvn = contact.normal.dot(Dv) + rates.normal.dot(v);
    double rebound = 0.0;
    if (!impulse.rests && vn < 0.0) rebound = -contact.restitution * Dvn - rates.restitution * vn;
    x[at.normal(c)] = rebound - rates.normal.dot(after.v) - contact.normal.dot(Dv);
    if (states[c].state == State::stick)
      x[at.tangent(c)] = surface[c] - rates.tangent.dot(after.v) - contact.tangent.dot(Dv);
    else if (const int s = slip_sign(states[c].state); s != 0)
      x[at.tangent(c)] = s * rates.friction.kinetic * impulse.normal;
  }
  system->solve(x.data(), work.data());
  result.known = true;
  result.v = Dv;
  for (std::size_t i = 0; i < at.dofs; ++i)
    if (system->kinds()[i] == linear::DofKind::massive) result.v[static_cast<Eigen::Index>(i)] += x[i];
  for (std::size_t c = 0; c < states.size(); ++c) {
    const bool takes = after.impulses[c].normal > 0.0;
    result.normal.push_back(takes ? -x[at.normal(c)] : 0.0);
    result.tangent.push_back(takes ? -x[at.tangent(c)] : 0.0);
  }
  return result;
}

namespace {

// Relative difference up to which two derivatives are treated as equal. It is far above rounding errors and far below actual
// differences. Chosen value; tests of symmetric frames in tests/unit/sensitivity depend on it.
constexpr double same = 1e-7;
// Largest relative difference of velocities and accelerations that is not a jump.
constexpr double same_motion = 1e-9;
// A guard g with the noise n_g grazes zero if g'^2 <= 2 grazes |g''| n_g. The time of its zero then does not depend smoothly
// on the parameter.
constexpr double grazes = 1e3;

double greatest(const Vector& x, const Model& model) {
  double size = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    size = std::max(size, std::abs(x[i]) / (turns ? model.scales.rotation : model.scales.displacement));
  }
  return size;
}

/// True if the size of b - a exceeds the fraction `part` of the largest of the sizes of a and b and `least`.
bool differ(const Vector& a, const Vector& b, const Model& model, double part, double least) {
  return greatest(b - a, model) > part * std::max({greatest(a, model), greatest(b, model), least});
}

double scale_of(const Form& form, const Scales& scales) {
  if (form.N != 0.0 || form.T != 0.0) return scales.force;
  if (form.gap != 0.0 || form.ut != 0.0) return scales.displacement;
  return scales.velocity;
}

/// Motion with all components equal to one.
ContactMotion unit_motion() {
  ContactMotion m;
  m.N = m.T = m.gap = m.ut = m.vn = m.vt = m.an = m.at = m.applied_normal_force =
      m.applied_normal_force_rate = 1.0;
  return m;
}

Vector massive(Vector x, const std::vector<linear::DofKind>& kinds) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (kinds[static_cast<std::size_t>(i)] != linear::DofKind::massive) x[i] = 0.0;
  return x;
}

}  // namespace

struct TangentEvents::PassState {
  const InstantMotion& m;
  const TangentBefore& before;
  TangentSeries& series;
  TangentAfter after;
  std::vector<std::optional<double>> own;  // dt/dp by the contact's own triggered guard
  std::vector<ContactMotion>
      p_before;  // derivatives of the motion before, at fixed time, one entry per contact

  [[nodiscard]] double dt_of(std::size_t c) const { return own[c].value_or(after.dt); }
  void stop(std::string why) {
    if (after.reason.empty()) after.reason = std::move(why);
  }
};

/// dt/dp from the guard of contact c; nullopt: the guard has no zero at the instant, or dt/dp does not exist.
std::optional<double> TangentEvents::time_of(PassState& course, std::size_t c) const {
  const run::RunInstant& now = course.m.instant;
  const Contact& contact = model_.contacts[c];
  const ContactState& state = now.states_before[c];
  const auto forms = contact::guards(contact, state);
  decide::Crossing crossing;
  if (const decide::Crossing* failed = now.after.crossing(c)) {
    crossing = *failed;
  } else {
    if (now.after.impulses.empty() || !now.after.impulses[c].hit) return std::nullopt;
    crossing = {forms[0], {course.m.motion_before[c].vn, course.m.motion_before[c].an}, 0.0};
  }
  const auto guard = std::find_if(forms.begin(), forms.end(), [&](const GuardForm& g) {
    return g.kind != Guard::none && g == crossing.form;
  });
  const bool fired = std::any_of(now.triggered.begin(), now.triggered.end(),
                                 [&](const decide::TriggeredGuard& f) { return f.contact == c; });
  if (guard == forms.end()) {
    if (fired && crossing.form.kind == Guard::none)
      course.stop(
          fmt::format("contact '{}', which shares forces with other contacts, is released from its friction "
                      "limit or begins to "
                      "bear; derivatives of the time of such an event are not supported",
                      contact.name));
    return std::nullopt;  // the guard belongs to an intermediate state
  }
  const double value = crossing.form.value(course.m.motion_before[c]);
  const bool hit = !now.after.impulses.empty() && now.after.impulses[c].hit;
  // The guard is not zero just before the instant, so another contact has changed the state of this contact.
  if (!fired && !hit && std::abs(value) > 4.0 * crossing.noise) return std::nullopt;
  const double rate = fired ? crossing.derivatives[0]
                            : crossing.form.rate(course.m.motion_before[c], course.m.rate_before[c]);
  if (!(rate < 0.0) || rate * rate <= grazes * 2.0 * std::abs(crossing.derivatives[1]) * crossing.noise) {
    if (crosses_grazes_ && is_smooth(course) && !sets_moving_anchor(course, c)) return std::nullopt;
    course.stop(fmt::format(
        "the {} of contact '{}' grazes zero: its rate is only {:.3g}, so the time of the event has no "
        "derivative",
        contact::to_string(guard->kind), contact.name,
        rate * scene::factor_of(contact::unit_of(crossing.form), model_.unit) / model_.unit.time));
    return std::nullopt;
  }
  const Form& form_rate =
      derivative_.contacts[c].guards[index_of(state.state)][static_cast<std::size_t>(guard - forms.begin())];
  const double moved = form_rate.value(course.m.motion_before[c]) +
                       crossing.form.rate(course.m.motion_before[c], course.p_before[c]);
  return -moved / rate;
}

/// True if velocities and accelerations of degrees of freedom with mass do not jump at the instant.
bool TangentEvents::is_smooth(const PassState& course) const {
  const std::vector<linear::DofKind>& kinds = course.m.instant.after.system->kinds();
  const double rate = model_.scales.velocity / model_.scales.displacement;
  return !differ(massive(course.m.before.a, kinds), massive(course.m.after.a, kinds), model_, same_motion,
                 rate * rate) &&
         !differ(massive(course.m.before.v, kinds), massive(course.m.after.v, kinds), model_, same_motion,
                 rate);
}

/// True if the contact gets a new anchor whose position depends on the time of the instant, because ut - T/kt varies with
/// time.
bool TangentEvents::sets_moving_anchor(const PassState& course, std::size_t c) const {
  const State before = course.m.instant.states_before[c].state,
              after = course.m.instant.after.states[c].state;
  if (after != State::stick || before == State::stick) return false;
  const ContactMotion& rate = course.m.rate_before[c];
  const double force_rate = model_.scales.force * model_.scales.velocity / model_.scales.displacement;
  return is_open(before) || std::abs(rate.T) > same_motion * force_rate;
}

void TangentEvents::find_times(PassState& course) const {
  const run::RunInstant& now = course.m.instant;
  std::vector<double> times;
  if (!now.triggered.empty() || now.breakpoint)
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      course.own[c] = time_of(course, c);
      if (course.own[c]) times.push_back(*course.own[c]);
    }
  if (now.breakpoint)
    for (const MovingBreakpoint& b : breakpoints_at(model_, derivative_, now.t, now.resolution))
      times.push_back(b.rate);
  if (times.empty()) return;
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  course.after.dt = times.front();
  if (*most - *least <= same * std::max(std::abs(*least), std::abs(*most)) + least_) return;
  if (is_smooth(course)) {
    course.after.dt = 0.0;  // without jumps the motion does not depend on these times
    return;
  }
  course.stop(
      "simultaneous events separate when the key changes, and the later motion depends on their order");
}

/// Computes the tangent of the state just after the instant.
void TangentEvents::move_state(PassState& course) const {
  const InstantMotion& m = course.m;
  const run::RunInstant& now = m.instant;
  const SeriesPoint& w = course.before.point;
  const double dt = course.after.dt;
  const Vector Du = w.u + dt * m.before.v;
  Vector Dv = w.v + dt * m.before.a;
  const bool hit = std::any_of(now.after.impulses.begin(), now.after.impulses.end(),
                               [](const decide::Impulse& i) { return i.normal > 0.0; });
  if (hit) {
    std::vector<double> surface;
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      surface.push_back(course.before.driven[c].surface[1] + dt * now.forcing_before.surface(c, now.t, 2));
    ImpactRates rates =
        impact_rates(systems_, derivative_, now.states_before, now.after, m.before.v, Dv, surface);
    if (!rates.known) return course.stop("the equations of the impact are singular");
    Dv = std::move(rates.v);
    course.after.impulse_n = std::move(rates.normal);
    course.after.impulse_t = std::move(rates.tangent);
  } else if (const auto& kinds = now.after.system->kinds();
             differ(massive(m.before.v, kinds), massive(m.after.v, kinds), model_, same,
                    model_.scales.velocity / model_.scales.displacement)) {
    return course.stop("velocities jump without an impact");
  }
  course.after.start.u = Du - dt * m.after.v;
  course.after.start.v = Dv - dt * m.after.a;
}

/// Computes the derivatives of new anchors. An anchor is the slip position ut - T/kt at the end of the slip. T is the force
/// just before the instant, or the kinetic friction force if the contact slipped before it sticks.
void TangentEvents::move_anchors(PassState& course) const {
  const InstantMotion& m = course.m;
  course.after.start.anchors = course.before.start.anchors;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactState &old = m.instant.states_before[c], &now = m.instant.after.states[c];
    if (!contact.tangential_stiffness || now.state != State::stick) continue;
    if (old.state == State::stick && old.anchor == now.anchor) continue;
    const ContactRates& rates = derivative_.contacts[c];
    const double kt = *contact.tangential_stiffness;
    const ContactMotion& before = m.motion_before[c];
    const ContactMotion D = sum(course.p_before[c], m.rate_before[c], course.dt_of(c));
    const double size = std::abs(before.ut) + std::abs(before.T / kt) + std::abs(now.anchor) +
                        1e-6 * model_.scales.displacement;
    const auto matches = [&](double T) {
      return std::abs(before.ut - T / kt - now.anchor) <= same_motion * size;
    };
    double T = before.T, DT = D.T;
    for (const int s : {1, -1}) {
      if (matches(T)) break;
      T = -s * contact::kinetic_friction(contact) * before.N;
      DT = -s * (rates.friction.kinetic * before.N + contact::kinetic_friction(contact) * D.N);
    }
    if (!matches(T))
      return course.stop(fmt::format(
          "contact '{}' releases and sticks again within one instant: the derivative of its new anchor "
          "is not known",
          contact.name));
    course.after.start.anchors[c] = D.ut - DT / kt + T * rates.tangential_stiffness / (kt * kt);
  }
}

/// True if a rate is zero up to the rounding error of its terms, or relative to a typical size.
bool TangentEvents::vanishes(double rate, double terms, double scale) const {
  return std::abs(rate) <= 10.0 * same * terms + same_motion * scale / size_;
}

/// Checks that the constraints of the contact states are also satisfied for other values of the parameter; otherwise the
/// derivative exists on one side only.
void TangentEvents::check_resting_guards(PassState& course) const {
  const InstantMotion& m = course.m;
  const TangentAfter& after = course.after;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const State state = m.instant.after.states[c].state;
    const ContactMotion D = sum(parameter_rate(contact, derivative_.contacts[c], model_.layout, c, m.after,
                                               after.point, after.driven[c]),
                                m.rate_after[c], course.dt_of(c));
    const Scales& scales = model_.scales;
    bool held = true;
    if (contact.takes_impulses() && !is_open(state))
      held = vanishes(D.gap, contact.normal.magnitude(after.point.u), scales.displacement) &&
             vanishes(D.vn, contact.normal.magnitude(after.point.v), scales.velocity);
    if (contact.sticks_rigidly() && state == State::stick)
      held = held &&
             vanishes(D.vt, contact.tangent.magnitude(after.point.v) + std::abs(after.driven[c].surface[1]),
                      scales.velocity);
    if (!held)
      return course.stop(
          fmt::format("contact '{}' keeps its state only for this value of the key: derivatives from "
                      "both sides differ",
                      contact.name));
  }
}

/// Checks for kinks: a guard that is zero just after the instant, but not for neighbouring values of the parameter, is
/// triggered on one side only.
void TangentEvents::check_kinks(PassState& course) const {
  const InstantMotion& m = course.m;
  const decide::Decision& decision = m.instant.after;
  const Vector &w = course.after.point.u, &wv = course.after.point.v;
  for (std::size_t slot = 0; slot < decision.guards.size(); ++slot) {
    const decide::GuardStart& guard = decision.guards[slot];
    if (guard.kind == Guard::none || !guard.at_zero) continue;
    const Form& form = decision.form(slot);  // guards with products are refused (contact_rates.hpp)
    if (form.an != 0.0) continue;
    const std::size_t c = decision.layout.contact_of_guard(slot);
    const Contact& contact = model_.contacts[c];
    const double dt = course.dt_of(c);
    const ContactMotion p = parameter_rate(contact, derivative_.contacts[c], model_.layout, c, m.after,
                                           course.after.point, course.after.driven[c]);
    const Form& form_rate =
        derivative_.contacts[c]
            .guards[index_of(decision.states[c].state)][decision.layout.guard_within(slot)];
    const ContactMotion D = sum(p, m.rate_after[c], dt);
    const double value = form_rate.value(m.motion_after[c]) + form.rate(D);
    ContactMotion terms = p;
    terms.gap = std::abs(p.gap) + contact.normal.magnitude(w);
    terms.ut = std::abs(p.ut) + contact.tangent.magnitude(w);
    terms.vn = std::abs(p.vn) + contact.normal.magnitude(wv);
    terms.vt = std::abs(p.vt) + contact.tangent.magnitude(wv);
    const double size = form_rate.magnitude(m.motion_after[c]) + form.magnitude(terms) +
                        std::abs(dt) * form.magnitude(m.rate_after[c]);
    // If a gap opens from rest, the derivative of its rate must be zero, too.
    const bool opens_slowly = guard.kind == Guard::closing && guard.leading_order != 1;
    if (vanishes(value, size, form.magnitude(unit_motion()) * scale_of(form, model_.scales)) &&
        (!opens_slowly || vanishes(D.vn, contact.normal.magnitude(wv), model_.scales.velocity)))
      continue;
    return course.stop(
        fmt::format("the {} of contact '{}' is zero only for this value of the key: derivatives from "
                    "both sides differ",
                    contact::to_string(guard.kind), contact.name));
  }
}

void TangentEvents::fill_rates(PassState& course) const {
  const InstantMotion& m = course.m;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = derivative_.contacts[c];
    const double dt = course.dt_of(c);
    const ContactMotion before = sum(course.p_before[c], m.rate_before[c], dt);
    const ContactMotion after = sum(
        parameter_rate(contact, rates, model_.layout, c, m.after, course.after.point, course.after.driven[c]),
        m.rate_after[c], dt);
    const double t = m.instant.t;
    EventRates row;
    row.t = dt;
    row.gap = contact.optional_gap(after.gap).value_or(row.gap);
    row.N = before.N;
    row.T = before.T;
    row.vn = before.vn;
    row.N_after = after.N;
    row.T_after = after.T;
    row.vn_after = after.vn;
    row.vt = slide_rate(contact, rates, m.before, course.before.point, course.before.driven[c]).vt +
             dt * (contact.body_tangent().dot(m.before.a) - m.instant.forcing_before.surface(c, t, 2));
    row.vt_after = slide_rate(contact, rates, m.after, course.after.point, course.after.driven[c]).vt +
                   dt * (contact.body_tangent().dot(m.after.a) - m.instant.forcing_after.surface(c, t, 2));
    if (!course.after.impulse_n.empty() && m.instant.after.impulses[c].hit) {
      row.impulse_n = course.after.impulse_n[c];
      row.impulse_t = course.after.impulse_t[c];
    }
    course.after.rates.push_back(row);
  }
}

TangentAfter TangentEvents::pass(const InstantMotion& motion, const TangentBefore& before,
                                 TangentSeries& series) const {
  PassState course{motion, before, series, {}, {}, {}};
  const std::size_t count = model_.contacts.size();
  course.own.resize(count);
  for (std::size_t c = 0; c < count; ++c)
    course.p_before.push_back(parameter_rate(model_.contacts[c], derivative_.contacts[c], model_.layout, c,
                                             motion.before, before.point, before.driven[c]));
  find_times(course);
  if (course.after.reason.empty()) move_state(course);
  if (course.after.reason.empty()) move_anchors(course);
  if (!course.after.reason.empty()) return std::move(course.after);
  const double t = motion.instant.t;
  const ForcingRates forcing(model_, derivative_, t, motion::Side::after);
  series.expand_to(*motion.instant.after.jet.system, motion.series_after, forcing, course.after.start,
                   linear::has_massless(model_) ? 2 : 0);
  course.after.point = series.at(0.0);
  for (std::size_t c = 0; c < count; ++c)
    course.after.driven.push_back(driven_rates(series.forcing(), series.scale(), c, 0.0));
  check_resting_guards(course);
  check_kinks(course);
  fill_rates(course);
  return std::move(course.after);
}

}  // namespace signorini::sensitivity
