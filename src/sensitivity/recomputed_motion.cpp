#include "sensitivity/recomputed_motion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/tolerance.hpp"
#include "sensitivity/contact_rates.hpp"

namespace signorini::sensitivity {
namespace {

// Largest number of Newton iterations for an event time; three are enough unless the guard nearly grazes zero.
constexpr int max_corrections = 8;

bool same_states(const contact::ContactStates& a, const contact::ContactStates& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ContactState& x, const ContactState& y) { return x.state == y.state; });
}

}  // namespace

RecomputedMotion::RecomputedMotion(const Model& model, const linear::SystemMatrices& structure,
                                   motion::StateSystems& systems, const RunSpec& run)
    : model_(model),
      structure_(structure),
      systems_(systems),
      t_end_(run.t_end),
      decider_(systems, run.max_events_at_once, engine::tolerance_of(model, run).capture_velocity()),
      touches_(model.contacts.size()) {}

void RecomputedMotion::begin(const decide::Decision& start) { now_ = start; }

void RecomputedMotion::start(const motion::Forcing& forcing) {
  stretch_ = now_;
  for (decide::GuardStart& guard : stretch_.guards) guard = {};
  forcing_.emplace(forcing);
}

modal::ModalSystem* RecomputedMotion::modes() {
  if (!modal_) modal_ = std::make_unique<modal::ModalEngine>(model_, structure_, systems_, t_end_);
  return modal_->modes();
}

engine::Stepper& RecomputedMotion::engine(bool in_modes) {
  if (in_modes) return *modal_;
  if (!series_) series_ = std::make_unique<exact::ExactEngine>(model_, structure_, systems_, t_end_);
  return *series_;
}

SeriesPoint RecomputedMotion::at(double t) {
  // A separate engine is used, so that this search does not change the state of the engine that computes the stretch.
  if (!event_search_)
    event_search_ = std::make_unique<exact::ExactEngine>(model_, structure_, systems_, t_end_);
  engine::Stepper& engine = *event_search_;
  engine.start({t, &stretch_, &*forcing_});
  for (;;) {
    const engine::Step step = engine.advance();
    const engine::Expansion e = engine.dense_output().facts().expansion;
    if (step.kind == engine::Step::Kind::failed || step.end >= t)
      return point_at(e.series->u, e.series->forces, e.series->scale, e.degree, e.x);
  }
}

std::optional<double> RecomputedMotion::time_of(const run::RunInstant& instant, const MotionAt& at) const {
  if (instant.breakpoint) return instant.t;
  if (instant.triggered.empty()) {  // end of the run, or a change of states at the end of a step
    if (same_states(instant.states_before, instant.after.states)) return instant.t;
    return std::nullopt;
  }
  const decide::TriggeredGuard& triggered = instant.triggered.front();
  const auto forms = contact::guards(model_.contacts[triggered.contact], now_.states[triggered.contact]);
  const auto guard =
      std::find_if(forms.begin(), forms.end(), [&](const GuardForm& g) { return g.kind == triggered.guard; });
  if (guard == forms.end()) return std::nullopt;
  const decide::Crossing* crossing = instant.after.crossing(triggered.contact);
  const double noise = crossing != nullptr ? crossing->noise : 0.0;
  double t = instant.t, last = instant.t - now_.jet.t;
  for (int i = 0; i < max_corrections; ++i) {
    const SeriesPoint point = at(t);
    const ContactMotion m =
        motion_of(model_.contacts[triggered.contact], triggered.contact, *forcing_, t, point);
    const double rate = guard->rate(m, time_rate(model_.layout, triggered.contact, m, point));
    if (!(rate < 0.0)) return std::nullopt;
    const double off = -guard->value(m) / rate;
    if (!(t + off > now_.jet.t)) return std::nullopt;
    // Newton's method has converged: below the time resolution of instants, or below the rounding error of the guard
    if (std::abs(off) <= std::max(instant.resolution, -4.0 * noise / rate)) return t + off;
    if (!(std::abs(off) < std::abs(last))) return std::nullopt;
    t += off;
    last = off;
  }
  return std::nullopt;
}

run::RunInstant RecomputedMotion::adopt_engine_state(const run::RunInstant& instant) {
  ++fallback_count_;
  now_ = instant.after;
  touches_.instant(instant.t, instant.states_before, instant.after);
  return instant;
}

run::RunInstant RecomputedMotion::pass(const run::RunInstant& instant, double t, const SeriesPoint& before) {
  decide::Instant at;
  at.t = t;
  at.resolution = instant.resolution;
  at.u = before.u;
  at.v = before.v;
  at.states = now_.states;
  at.triggered = instant.triggered;
  at.resting_limits = decide::find_resting_limits(now_);
  at.last_touch = touches_.times();
  at.jump = instant.breakpoint;
  decide::Decision next = decider_.decide(std::move(at), instant.forcing_before, instant.forcing_after);
  if (!next.consistent || !same_states(next.states, instant.after.states)) return adopt_engine_state(instant);
  states_before_ = now_.states;
  v_before_ = before.v;
  touches_.instant(t, states_before_, next);
  now_ = std::move(next);
  correction_ = std::max(correction_, std::abs(t - instant.t));
  return {t,    instant.resolution,     instant.triggered,     instant.breakpoint, states_before_,
          now_, instant.forcing_before, instant.forcing_after, v_before_,          instant.load_jumps};
}

}  // namespace signorini::sensitivity
