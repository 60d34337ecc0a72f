#include "engine/ida/ida_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contact/friction.hpp"
#include "decide/guard_signs.hpp"
#include "decide/massless_jump.hpp"
#include "engine/ida/locate.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"

namespace signorini::ida {
namespace {

/// Key and value of the tolerance of a guard in the units of the scene, such as "run.atol.velocity (1e-09 m/s here)".
std::string tolerance_in_force(Guard guard, const engine::Tolerance& tolerance, const Model& model) {
  const auto as_key = [&](const char* key, double value, const Unit& unit, const std::string& name) {
    return fmt::format("run.atol.{} ({:.2g} {} here)", key, model::in_scene_units(model, value, unit), name);
  };
  const Units& units = model.units;
  if (guard == Guard::sliding)
    return as_key("velocity", tolerance.velocity, unit::velocity, units.length + "/" + units.time);
  if (guard == Guard::closing || guard == Guard::opening)
    return as_key("displacement", tolerance.displacement, unit::length, units.length);
  return as_key("force", tolerance.force, unit::force, units.force);
}

}  // namespace

IdaEngine::IdaEngine(const Model& model, const linear::SystemMatrices& structure,
                     motion::StateSystems& systems, const engine::Tolerance& tolerance, int max_order,
                     double t_end, double flight_tolerances)
    : model_(model),
      consistent_(systems),
      jets_(systems),
      tolerance_(tolerance),
      flight_tolerances_(flight_tolerances),
      powers_(model, structure),
      motions_(model.contacts.size()),
      bdf_(model, structure, tolerance, max_order, counters),
      turns_(model.contacts.size(), model.layout.guard_count() + powers_.count()),
      history_(model.layout.guard_count() + powers_.count() + turns_.count()),
      flights_(model, structure, systems, t_end),
      integrals_(powers_.count()) {
  for (const Contact& contact : model.contacts)
    guards_need_accelerations_ = guards_need_accelerations_ || contact.normal_damping > 0.0;
  resolves_low_flights = follows_low_flights(model);
}

bool IdaEngine::follows_low_flights(const Model& model) {
  return std::none_of(model.contacts.begin(), model.contacts.end(), contact::friction_varies);
}

/// Writes the scalars of the history at time t to `out`: guards, powers, and N, T, gap and ut of the contacts.
void IdaEngine::fill(double t, const motion::Point& point, double* out) {
  const decide::Decision& decision = *segment_.decision;
  const ForceLayout& layout = model_.layout;
  const double* const guards = out;
  double* const powers = out + layout.guard_count();
  double* shown = powers + powers_.count();
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactMotion& m = motions_[k] = motion::motion_of(contact, k, *segment_.forcing, t, point);
    const double still = segment_.forcing->surface_moves(k) ? 0.0 : segment_.forcing->surface(k, t, 0);
    // The motion s(t) of a moving surface is not subtracted here, see HistoryTurningPoints in locate.hpp.
    const double ut = contact.body_tangent().dot(point.u) - still;
    for (const double value : {m.N, m.T, m.gap, ut})
      *shown++ = value;  // in the order of TurningPointDetector::watched_fields
    const GuardForm* guard = decision.forms[k].data();
    for (const GuardForm* const end = guard + layout.guards(k); guard != end; ++guard)
      *out++ = guard->is_linear() ? decide::QuickForm(guard->form).value(m) : guard->value(m);
    for (const double* const end = guards + layout.guard_end(k); out != end;)
      *out++ = 0.0;  // slots without a guard
  }
  powers_.at(*segment_.forcing, t, decision.states, point, motions_, powers);
}

/// Height below which the Taylor series computes a flight: the geometric mean of the gap's tolerance and the size of the gap's
/// terms. Below this height, the integrator would lose half of the digits of the gap. Impacts of case 04a at rtol 1e-10 are
/// then accurate to 3e-9 s; with the re-arming level as limit, only to 1e-7 s.
double IdaEngine::flight_level(const Contact& contact, const Vector& u) const {
  double size = std::abs(contact.gap) + contact.normal.magnitude(u), absolute = 0.0;
  for (const auto& [dof, factor] : contact.normal.terms) absolute += std::abs(factor);  // sum over all terms
  const double tolerance = flight_tolerances_ * (tolerance_.rtol * size + absolute * tolerance_.displacement);
  size = std::max(size, absolute * model_.scales.displacement);
  return std::max(std::sqrt(tolerance * size), 2.0 * events::re_arm_tolerances * tolerance);
}

/// True if the structure has massless parts and no damper acts on them. The velocities of these parts are then computed from
/// K v = P' - ..., because the derivative of a step's polynomial has the error h u''/2 after a restart, far above the tolerance
/// of velocities. If a damper acts on a massless part, BdfIntegrator corrects the velocities.
bool IdaEngine::has_undamped_massless_parts() const {
  if (!consistent_.massless()) return false;
  const std::vector<linear::DofKind>& kinds = segment_.decision->system->kinds();
  return std::find(kinds.begin(), kinds.end(), linear::DofKind::damped) == kinds.end();
}

void IdaEngine::start(const engine::Segment& segment) {
  graze_detector_.end(triggered_slots_);
  triggered_slots_.clear();
  segment_ = segment;
  zero_start_guards_.clear();
  const decide::Decision& decision = *segment.decision;
  makes_points_consistent_ = guards_need_accelerations_ || has_undamped_massless_parts();
  flight_ = flights_.take(segment, [&](const Contact& contact) { return flight_level(contact, decision.u); });
  if (flight_) return;
  std::vector<double> levels;
  for (std::size_t slot = 0; slot < decision.guards.size(); ++slot) {
    const decide::GuardStart& guard = decision.guards[slot];
    if (guard.kind == Guard::none) {
      levels.push_back(0.0);
      continue;
    }
    const ContactMotion& motion = decision.after[model_.layout.contact_of_guard(slot)];
    double level =
        guard.noise + events::re_arm_tolerances * engine::tolerance(decision.guard(slot), motion, tolerance_);
    // The decision regards a guard as zero if its value is below its rate times the resolution of time. At a stiff contact,
    // such a value may exceed the tolerance, so the level includes the value.
    if (guard.at_zero) level += 2.0 * std::abs(decision.guard(slot).value(motion));
    levels.push_back(level);
    if (guard.at_zero && guard.kind != Guard::closing) add_zero_start_guard(slot);
  }
  graze_detector_.start(decision.guards, levels);
  near_hits_.start(decision.guards, levels, decision.layout);
  turns_.start(decision, *segment.forcing);
  guard_monitor_.start(decision.guards, decision.forms, std::move(levels), decision.layout);
  if (!decision.jet.is_complete())
    jet_ = jets_.expand(decision.system, *segment.forcing, decision.jet.t, decision.u, decision.v);
  const motion::Jet& jet = decision.jet.is_complete() ? decision.jet : jet_;
  restart_history(jet, bdf_.start(segment, jet, guard_monitor_));
}

/// Fills the history with the points of IDA's steps before the segment (restart_order.hpp) and with the beginning of the
/// segment. The polynomials of the first steps need these values.
void IdaEngine::restart_history(const motion::Jet& jet, const RestartOrder& past) {
  const decide::Decision& decision = *segment_.decision;
  const double t = jet.t;
  for (int i = past.steps; i > 0; --i) {
    const double x = -i * past.length;
    const auto along = [&](Eigen::Index p, Vector& places) {
      places.resize(jet.u.rows());
      displacement_derivatives(
          jet, p, x, consistent_.massless(),
          [&](Eigen::Index dof) { return model_.dofs[static_cast<std::size_t>(dof)].massless; }, places);
    };
    along(0, point_.u);
    along(1, point_.v);
    along(2, point_.a);
    point_.forces.resize(jet.forces.rows());
    taylor_derivatives(jet.forces, motion::Jet::orders, 0, x, point_.forces);
    fill(t + x, point_, i == past.steps ? history_.restart(t + x) : history_.push(t + x, past.length));
  }
  const motion::Point point{decision.u, decision.v, jet.forces.col(0), jet.a()};
  fill(t, point, past.steps > 0 ? history_.push(t, past.length) : history_.restart(t));
}

void IdaEngine::evaluate(double t, motion::Point& point) {
  if (flight_) return flights_.motion().evaluate(t, point);
  bdf_.evaluate(t, point);
  if (makes_points_consistent_)
    consistent_.make(segment_.decision->system, *segment_.forcing, t, point);
  else
    point.a.resize(0);  // the accelerations in `point` belong to another time
}

/// Computes the accelerations from the equation of motion. u and v of the point do not change.
void IdaEngine::accelerate(double t, motion::Point& point) {
  if (flight_ || (point.a.size() > 0 && !consistent_.massless())) return;
  consistent_.accelerate(segment_.decision->system, *segment_.forcing, t, point);
}

/// The phase angle is that of a polynomial of degree 5, the highest order of BDF.
engine::StepFacts IdaEngine::facts() const {
  engine::StepFacts facts;
  if (flight_) {
    const engine::StepFacts flight = flights_.motion().facts();
    facts.turning_points = flight.turning_points;
    facts.phase_angle = flight.phase_angle;
    return facts;
  }
  facts.turning_points = turns_.times();
  facts.contact_turning_points = &turns_.turning_points();
  facts.phase_angle = std::numbers::pi * 5.0;
  return facts;
}

double IdaEngine::residual() { return flight_ ? flights_.motion().residual() : bdf_.residual(); }

engine::Step IdaEngine::advance() {
  if (flight_) {
    ++counters.restarts;
    ++counters.steps;
    return *flight_;
  }
  BdfStep bdf = bdf_.advance();
  engine::Step step;
  step.begin = bdf.begin;
  step.end = bdf.end;
  if (bdf.kind == BdfStep::Kind::failed) {
    step.kind = engine::Step::Kind::failed;
    step.reason = std::move(bdf.reason);
    return step;
  }
  if (!(bdf.end > bdf.begin)) {
    step.kind = engine::Step::Kind::failed;
    step.reason =
        "the step size has fallen below the resolution of time, so the tolerance cannot be met; a larger "
        "rtol may help";
    return step;
  }
  bdf_.evaluate(bdf.end, point_);
  if (makes_points_consistent_)
    consistent_.make(segment_.decision->system, *segment_.forcing, bdf.end, point_);
  fill(bdf.end, point_, history_.push(bdf.end, bdf.length));
  history_.prepare(bdf.order);
  add_errors();
  step.resolution = motion::resolution_at(bdf.end, bdf.end - bdf.begin);
  const auto event = first_event(bdf, step.resolution);
  const double part = event ? (event->time - bdf.begin) / (bdf.end - bdf.begin) : 1.0;
  graze_detector_.update(history_, part);
  near_hits_.update(history_, part);
  if (event) {
    triggered_slots_ = {event->slot};
    step.kind = engine::Step::Kind::event;
    step.end = event->time;
    step.triggered = {{model_.layout.contact_of_guard(event->slot),
                       segment_.decision->guards[event->slot].kind, !guard_monitor_.armed(event->slot)}};
  }
  turns_.find(history_, event ? (event->time - bdf.begin) / (bdf.end - bdf.begin) : 1.0);
  return step;
}

/// First downward zero crossing of a guard in the last step, refined. nullopt: no event in this step.
std::optional<IdaEngine::Located> IdaEngine::first_event(const BdfStep& step, double resolution) {
  const double h = step.end - step.begin;
  const std::vector<decide::GuardStart>& guards = segment_.decision->guards;
  std::vector<Located> candidates;
  for (const events::ZeroCrossing& fall : guard_monitor_.check(history_, 1.0))
    candidates.push_back({fall.slot, step.begin + fall.x * h});
  for (const decide::TriggeredGuard& fired : step.triggered)
    for (std::size_t slot = model_.layout.guard(fired.contact); slot < model_.layout.guard_end(fired.contact);
         ++slot) {
      if (guards[slot].kind != fired.guard) continue;
      const auto same = std::find_if(candidates.begin(), candidates.end(),
                                     [&](const Located& c) { return c.slot == slot; });
      if (same == candidates.end()) candidates.push_back({slot, step.root});
    }
  std::erase_if(candidates, [&](const Located& c) {
    if (!is_touch(c.slot, (c.time - step.begin) / h)) return false;
    guard_monitor_.set_waiting(c.slot, error_bound_since_start(c.slot));
    if (!std::exchange(touch_warned_, true))
      warnings.push_back(fmt::format(
          "contact '{}': its {} touches zero at t = {:.9g}, and falls below zero by less than the error of "
          "the steps, so no event is recorded; a smaller {}, or engine exact, decides whether it crosses "
          "zero; later touches are not reported",
          model_.contacts[model_.layout.contact_of_guard(c.slot)].name,
          contact::to_string(guards[c.slot].kind), model::time_in_scene_units(model_, c.time),
          tolerance_in_force(guards[c.slot].kind, tolerance_, model_)));
    return true;
  });
  if (candidates.empty()) return std::nullopt;
  for (Located& c : candidates)
    c.time = locate(bdf_, consistent_, segment_, model_, c.slot, step.begin, step.end, c.time, resolution);
  if (step.kind != BdfStep::Kind::root) ++counters.rolled_back;
  const Located first = *std::min_element(candidates.begin(), candidates.end(),
                                          [](const Located& a, const Located& b) { return a.time < b.time; });
  for (const Located& c : candidates)
    if (opens_instead(first, c, (first.time - step.begin) / h, h)) return c;
  return first;
}

/// True if the contact opens while it sticks, although the slip guard reached zero shortly before. The friction limit tends to
/// zero with N, so any error of T exceeds the limit shortly before the contact opens. The slip is regarded as such an error if
/// |T| exceeds the limit by less than the tolerance until the opening. x: place of the slip in the step, 0 to 1; h: step
/// length.
bool IdaEngine::opens_instead(const Located& slip, const Located& opening, double x, double h) const {
  const std::size_t contact = model_.layout.contact_of_guard(slip.slot);
  const std::vector<decide::GuardStart>& guards = segment_.decision->guards;
  if (contact != model_.layout.contact_of_guard(opening.slot) ||
      guards[opening.slot].kind != Guard::separation || !contact::is_friction_limit(guards[slip.slot].kind))
    return false;
  const double rate = -history_.polynomial(slip.slot).derivative().value(x) / h;
  return (opening.time - slip.time) * rate <=
         engine::tolerance(segment_.decision->guard(slip.slot), ContactMotion{}, tolerance_);
}

/// True if a guard that started at zero only touches zero at the place x (0 to 1) of the step. Example: a contact with a spring
/// sticks exactly at its friction limit. A motion that conserves energy brings its guard back to zero, and a negative value is
/// only the error of the steps. Two exceptions: a gap that opened and returns to zero is a landing, even after a very short
/// flight; and if friction rises with the slip rate, a guard that crosses zero stays negative.
bool IdaEngine::is_touch(std::size_t slot, double x) const {
  const decide::GuardStart& guard = segment_.decision->guards[slot];
  if (guard.kind == Guard::closing || !guard.at_zero || !guard_monitor_.armed(slot)) return false;
  const std::size_t contact = model_.layout.contact_of_guard(slot);
  if (model_.contacts[contact].friction.is_rate_strengthening() &&
      slip_sign(segment_.decision->states[contact].state) != 0)
    return false;
  const events::Bernstein p = history_.polynomial(slot), slope = p.derivative();
  const double value = std::min(p.value(x), 0.0), rate = slope.value(x), bend = slope.derivative().value(x);
  if (!(bend > 0.0)) return false;
  const double depth = (rate < 0.0 ? rate * rate / (2.0 * bend) : 0.0) - value;
  return depth <= error_bound_since_start(slot);
}

void IdaEngine::add_zero_start_guard(std::size_t slot) {
  const decide::Decision& decision = *segment_.decision;
  const std::size_t contact = model_.layout.contact_of_guard(slot);
  const GuardForm& guard = decision.guard(slot);
  const bool massless = decide::acts_on_massless(model_, model_.contacts[contact]);
  const bool known = !guard.any_form([&](const Form& form) {
    return form.limit != 0.0 || form.limit_rate != 0.0 || form.an != 0.0 || form.at != 0.0 ||
           (massless && (form.vn != 0.0 || form.vt != 0.0));
  });
  zero_start_guards_.push_back(
      {slot, engine::tolerance(guard, decision.after[contact], tolerance_), known, 0.0});
}

/// Adds the error of the last step to the error bound of each guard that began at zero. Estimate of this error: the change of
/// the guard due to IDA's correction, but at most one tolerance; one tolerance if this change is unknown.
void IdaEngine::add_errors() {
  if (zero_start_guards_.empty()) return;
  bdf_.keep_correction();
  for (ZeroStartGuard& guard : zero_start_guards_) {
    const std::size_t contact = model_.layout.contact_of_guard(guard.slot);
    const double change =
        guard.known
            ? std::abs(segment_.decision->guard(guard.slot).rate(motions_[contact], bdf_.correction(contact)))
            : guard.tolerance;
    guard.off += std::min(change, guard.tolerance);
  }
}

/// Bound on the error of a guard that began at zero: sum of the errors of all steps of the segment, plus one tolerance for the
/// present value.
double IdaEngine::error_bound_since_start(std::size_t slot) const {
  const auto guard = std::lower_bound(zero_start_guards_.begin(), zero_start_guards_.end(), slot,
                                      [](const ZeroStartGuard& g, std::size_t s) { return g.slot < s; });
  return guard->off + guard->tolerance;
}

void IdaEngine::integrate(double from, double to, motion::WorkIntegrals& works) {
  if (flight_) return flights_.motion().integrate(from, to, works);
  const double h = history_.end() - history_.begin();
  const double a = (from - history_.begin()) / h, b = (to - history_.begin()) / h;
  const std::size_t offset = segment_.decision->guards.size();
  for (std::size_t i = 0; i < integrals_.size(); ++i) {
    if (a == 0.0 && b == 1.0) {
      integrals_[i] = history_.integral(offset + i);
    } else {
      const events::Bernstein p = history_.power(offset + i);
      integrals_[i] = h * (p.integral(b) - (a > 0.0 ? p.integral(a) : 0.0));
    }
  }
  powers_.add(integrals_.data(), 1.0, works);
  const contact::ContactStates& states = segment_.decision->states;
  if (std::none_of(states.begin(), states.end(),
                   [](const ContactState& s) { return s.state == State::inside; }))
    return;
  motion::Point first, last;
  bdf_.evaluate(from, first);
  bdf_.evaluate(to, last);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    works.damping += contact::dashpot_loss_inside(contact, states[k].state, contact.gap_at(first.u),
                                                  contact.gap_at(last.u));
  }
}

engine::StepperReport IdaEngine::report() {
  bdf_.count();
  engine::StepperReport report{counters, warnings, {}, near_hits_.list()};
  if (const auto& first = graze_detector_.first())
    report.graze = {first->t, static_cast<int>(model_.layout.contact_of_guard(first->slot)),
                    contact::to_string(first->guard)};
  return report;
}

/// One tolerance, plus the level of a waiting guard: such a guard triggers its event only if its value is below -level.
double IdaEngine::guard_error(const GuardForm& guard, const ContactMotion& motion,
                              std::size_t contact) const {
  return engine::tolerance(guard, motion, tolerance_) +
         (flight_ ? 0.0 : guard_monitor_.allowed_depth(contact, guard));
}

}  // namespace signorini::ida
