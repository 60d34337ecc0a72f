#include "run/event_log.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "contact/motion.hpp"
#include "decide/massless_jump.hpp"
#include "model/internal_units.hpp"
#include "run/scene_units.hpp"

namespace signorini::run {
namespace {

// Hits of coupled contacts whose times differ by less than this fraction of t cause a warning. Chosen value: data are rarely
// known more accurately; tests/behaviour/awkward.cpp depends on it.
constexpr double coincidence = 1e-9;

bool is_hit(const decide::Decision& decision, std::size_t k) {
  return !decision.impulses.empty() && decision.impulses[k].hit;
}

/// Value of Event::departure: a speed relative to the least speed of a rebound. A rebound below the limit 1 counts alone;
/// otherwise, of the rebound and the later departure, the one closer to 1. nullopt: neither is known.
std::optional<double> departure_of(const decide::Decision& decision, std::size_t k) {
  const auto known = [](double ratio) { return std::isfinite(ratio) && ratio > 0.0; };
  const double rebound =
      decision.impulses.empty() ? std::numeric_limits<double>::quiet_NaN() : decision.impulses[k].rebound;
  const double left =
      decision.departures.empty() ? std::numeric_limits<double>::quiet_NaN() : decision.departures[k];
  if (!known(rebound)) return known(left) ? std::optional(left) : std::nullopt;
  if (!known(left) || rebound < 1.0) return rebound;
  return std::abs(std::log(left)) < std::abs(std::log(rebound)) ? left : rebound;
}

/// Sets quantities to zero that are zero by the type of the event, if they are below the error of the guard: the gap if
/// the contact closes; if it opens, N, T because |T| <= f |N|, and the gap -N / k of a contact spring.
void settle(const Contact& contact, double error, Event& event) {
  if (!contact.obeys_coulomb()) return;
  const auto vanishes = [&](double value) { return std::abs(value) <= error; };
  if (event.type == EventType::contact && event.gap && vanishes(*event.gap)) event.gap = 0.0;
  if (event.type != EventType::separation || !vanishes(event.N)) return;
  event.N = event.T = 0.0;
  if (event.gap && vanishes(contact.normal_stiffness * *event.gap)) event.gap = 0.0;
}

/// True if the sliding point can jump: it has no mass, or a spring connects it to the mass.
bool can_slide_instantaneously(const Model& model, const Contact& contact) {
  return !contact.takes_impulses() && (!contact.sticks_rigidly() || decide::acts_on_massless(model, contact));
}

/// State as named in events.csv, where a contact at its static limit has the state slip.
State in_events(State state) {
  return is_at_static_limit(state) ? kind_of(state) : contact::representative_state(state);
}

/// Event of contact k from the decision, without guard_rate and t_uncertainty.
Event event_of(const EventLog::Instant& now, std::size_t k, EventType type, const Contact& contact) {
  const decide::Decision& decision = *now.decision;
  ContactMotion before = decision.before[k], after = decision.after[k];
  double vt = decision.slides_before[k].vt, vt_after = decision.slides_after[k].vt;
  if (contact.compliance_split()) {
    contact::remove_split_compliance(contact, (*now.before)[k].state, before);
    contact::remove_split_compliance(contact, decision.states[k].state, after);
    vt = before.vt;
    vt_after = after.vt;
  }
  Event event;
  event.t = now.t;
  event.contact = static_cast<int>(k);
  event.type = type;
  event.from = in_events((*now.before)[k].state);
  event.to = in_events(decision.states[k].state);
  if (is_hit(decision, k)) {
    event.impulse_n = decision.impulses[k].normal;
    event.impulse_t = decision.impulses[k].tangent;
  }
  event.gap = contact.optional_gap(after.gap);
  event.N = before.N;
  event.T = before.T;
  event.N_after = after.N;
  event.T_after = after.T;
  event.vn = before.vn;
  event.vn_after = after.vn;
  event.vt = vt;
  event.vt_after = vt_after;
  event.departure = departure_of(decision, k);
  return event;
}

}  // namespace

std::optional<EventType> classify(State from, State to, bool slipped_within_instant) {
  if (from == to) return slipped_within_instant ? std::optional(EventType::slip) : std::nullopt;
  if (is_open(to)) return EventType::separation;
  if (is_open(from)) return EventType::contact;
  if (slip_sign(from) != 0 && slip_sign(to) != 0) return EventType::reversal;
  return slip_sign(to) != 0 || slip_sign(from) == 0 ? EventType::slip : EventType::stick;
}

std::optional<double> time_uncertainty(const decide::Crossing& crossing, double error) {
  double off = std::numeric_limits<double>::infinity(), factorial = 1.0;
  for (std::size_t m = 0; m < crossing.derivatives.size(); ++m) {
    const auto order = static_cast<double>(m + 1);
    factorial *= order;
    if (const double d = std::abs(crossing.derivatives[m]); d > 0.0)
      off = std::min(off, std::pow(factorial * error / d, 1.0 / order));
  }
  return std::isfinite(off) ? std::optional(off) : std::nullopt;
}

void EventLog::start(const Instant& now, const engine::Stepper& stepper) {
  latest_.clear();
  bool hits = false;
  for (std::size_t k = 0; k < now.before->size(); ++k) hits = hits || is_hit(*now.decision, k);
  for (std::size_t k = 0; k < now.before->size(); ++k)
    if (is_hit(*now.decision, k))
      contact(now, k, EventType::impact, stepper);
    else if (hits || now.decision->crossing(k) != nullptr)
      continued(now, k, stepper);
}

/// Logs the change of a contact from the state, with its forces, that the saved run left it in.
void EventLog::continued(const Instant& now, std::size_t k, const engine::Stepper& stepper) {
  const Contact& of = model_.contacts[k];
  if (model_.saved_contacts.empty() || of.compliance_split()) return;
  const SavedState::FinalContact& left = model_.saved_contacts[k];
  State from = in_events((*now.before)[k].state);
  if (of.obeys_coulomb())  // the states before the start are guesses, except those of user laws
    for (const State state : {State::open, State::closed, State::stick, State::slip_plus, State::slip_minus})
      if (left.state == to_string(state)) from = state;
  const auto type = classify(from, in_events(now.decision->states[k].state), false);
  if (!type) return;
  ++report_.events_by_type[to_string(*type)];
  Event event = event_of(now, k, *type, of);
  event.from = from;
  event.N = left.N;
  event.T = left.T;
  add_conditioning(now, stepper, k, event);
  recorder_.event(event);
  latest_.push_back(std::move(event));
}

void EventLog::instant(const Instant& now, const engine::Stepper& stepper) {
  latest_.clear();
  if (now.load_jumps) load_jump(now);
  const decide::Decision& decision = *now.decision;
  for (std::size_t k = 0; k < now.before->size(); ++k) {
    const State from = in_events((*now.before)[k].state), to = in_events(decision.states[k].state);
    const bool slipped_within_instant = from == State::stick && decision.visited[k] && decision.jumped[k] &&
                                        can_slide_instantaneously(model_, model_.contacts[k]);
    auto type =
        is_hit(decision, k) ? std::optional(EventType::impact) : classify(from, to, slipped_within_instant);
    if (!type && now.load_jumps && decision.jumped[k]) type = EventType::time;
    if (type) contact(now, k, *type, stepper);
  }
  check_hit_order(now);
}

void EventLog::check_hit_order(const Instant& now) {
  const decide::Decision& decision = *now.decision;
  for (std::size_t k = 0; k < decision.impulses.size(); ++k) {
    if (!decision.impulses[k].hit) continue;
    const double apart = now.t - last_hit_.t;
    if (!last_hit_.moves.empty() && last_hit_.moves[k] && apart > now.resolution &&
        apart < coincidence * now.t)
      order_.warn(fmt::format("the interacting hits of '{}' at {:.12g} and of '{}' {:.2g} later",
                              model_.contacts[last_hit_.contact].name,
                              model::time_in_scene_units(model_, last_hit_.t), model_.contacts[k].name,
                              model::time_in_scene_units(model_, apart)));
  }
  Hit hit;
  for (std::size_t k = 0; k < decision.impulses.size(); ++k)
    if (decision.impulses[k].hit) hit = {now.t, k, std::vector<bool>(decision.impulses.size(), false)};
  if (hit.moves.empty()) return;
  const auto jump = [&](std::size_t k) { return std::abs(decision.after[k].vn - decision.before[k].vn); };
  for (std::size_t k = 0; k < hit.moves.size(); ++k)
    hit.moves[k] = !decision.impulses[k].hit && jump(k) > rounding::many_operations * jump(hit.contact);
  last_hit_ = std::move(hit);
}

void EventLog::finish() {
  report_.counters.time_events = load_jumps_;
  order_.finish();
}

/// Logs a jump of loads in a row without a contact.
void EventLog::load_jump(const Instant& now) {
  ++load_jumps_;
  ++report_.events_by_type[to_string(EventType::time)];
  Event event;
  event.t = now.t;
  recorder_.event(event);
  if (whole_) order_.load_jump(now.t);
}

void EventLog::contact(const Instant& now, std::size_t k, EventType type, const engine::Stepper& stepper) {
  if (type != EventType::time) ++report_.events_by_type[to_string(type)];
  Event event = event_of(now, k, type, model_.contacts[k]);
  add_conditioning(now, stepper, k, event);
  recorder_.event(event);
  latest_.push_back(std::move(event));
}

/// Adds the uncertainty of an event's time, and checks its order among other events.
void EventLog::add_conditioning(const Instant& now, const engine::Stepper& stepper, std::size_t k,
                                Event& event) {
  const decide::Crossing* failed = now.decision->crossing(k);
  if (failed == nullptr) return;
  const decide::Crossing& crossing = *failed;
  event.guard_rate = model::in_scene_units(model_, crossing.derivatives[0], contact::unit_of(crossing.form)) *
                     model::in_scene_units(model_, 1.0, unit::rate);
  const double error =
      std::max(crossing.noise, stepper.guard_error(crossing.form, now.decision->before[k], k));
  // The time of the instant is also uncertain by the resolution of the clock.
  settle(model_.contacts[k], error + std::abs(crossing.derivatives[0]) * now.resolution, event);
  const std::optional<double> off = time_uncertainty(crossing, error);
  const double unseen = now.unseen.empty() ? 0.0 : now.unseen[k];
  if (!off && !(unseen > 0.0)) return;
  event.t_uncertainty = std::max({off.value_or(0.0), now.resolution, unseen});
  if (whole_) order_.event(event, now.resolution);
}

namespace {

constexpr int max_warnings = 5;  // limit of the number of warnings about pairs of events in unknown order

}  // namespace

std::string EventOrder::described(const Event& event) const {
  return fmt::format("'{}' at {:.12g}", model_.contacts[static_cast<std::size_t>(event.contact)].name,
                     model::time_in_scene_units(model_, event.t));
}

void EventOrder::event(const Event& event, double resolution) {
  if (last_.contact >= 0 && last_.contact != event.contact && event.t - last_.t > resolution &&
      event.t - last_.t < *last_.t_uncertainty + *event.t_uncertainty)
    warn(fmt::format("the events of {} and of {}", described(last_), described(event)));
  last_ = event;
}

void EventOrder::load_jump(double t) {
  if (last_.contact >= 0 && t - last_.t < *last_.t_uncertainty)
    warn(fmt::format("the event of {} and the jump of a load at {:.12g}", described(last_),
                     model::time_in_scene_units(model_, t)));
}

void EventOrder::warn(const std::string& which) {
  if (++unordered_ <= max_warnings)
    report_.warnings.push_back(
        fmt::format("the order of {} is not determined, because their times are uncertain "
                    "(column {} of events.csv)",
                    which, event_column(&Event::t_uncertainty)));
}

void EventOrder::finish() {
  if (unordered_ > max_warnings)
    report_.warnings.push_back(
        fmt::format("the order of {} more pairs of events is not determined", unordered_ - max_warnings));
}

}  // namespace signorini::run
