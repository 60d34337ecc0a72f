#include "sensitivity/tangent_run.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "run/audit.hpp"
#include "run/engines.hpp"

namespace signorini::sensitivity {
namespace {

// Least number of degrees of freedom for tangents in modes; with fewer, series are as fast (run/choose_engine.hpp).
constexpr Eigen::Index min_modal = 16;
constexpr int max_turn_steps = 6;  // largest number of Newton steps for a turning point
constexpr std::size_t forcing_terms =
    6;  // coefficients that are computed to check that the forcing is constant

/// Taylor series about an instant, with scale 1, from the derivatives of a jet.
motion::Series series_of(const motion::Jet& jet, const motion::Forcing& forcing) {
  motion::Series s;
  s.t = jet.t;
  s.levels = static_cast<int>(jet.forces.cols()) - 1;
  s.u = jet.u;
  s.forces = jet.forces;
  double factorial = 1.0;
  for (Eigen::Index k = 2; k < s.u.cols(); ++k) {
    factorial *= static_cast<double>(k);
    s.u.col(k) /= factorial;
    if (k < s.forces.cols()) s.forces.col(k) /= factorial;
  }
  forcing.expand(s.t, 1.0, static_cast<std::size_t>(s.u.cols()), s.forcing);
  return s;
}

/// Relative error of a stretch in modes: two products with the mode shapes, which are sums of n terms.
double error_in_modes(const Model& model) { return 2.0 * static_cast<double>(model.size()) * rounding::eps; }

std::vector<const ModelDerivative*> pointers_to(const std::vector<ModelDerivative>& derivatives) {
  std::vector<const ModelDerivative*> all;
  for (const ModelDerivative& d : derivatives) all.push_back(&d);
  return all;
}

}  // namespace

TangentRun::TangentRun(const Model& model, const RunSpec& run,
                       const std::vector<ModelDerivative>& derivatives, const std::vector<double>& sizes,
                       TangentListener& listener, bool losses)
    : model_(model),
      structure_(model),
      systems_(model, structure_),
      listener_(listener),
      grid_(run.grid()),
      data_(pointers_to(derivatives)),
      losses_(losses),
      series_(model, systems_, data_, losses),
      recomputed_motion_(model, structure_, systems_, run),
      closed_form_flow_(run::engine_row(run.engine).capabilities.closed_form_flow) {
  states_.reserve(derivatives.size());
  for (std::size_t p = 0; p < derivatives.size(); ++p) {
    states_.emplace_back(model, structure_, systems_, derivatives[p], sizes[p], run.t_end);
    if (!losses) continue;
    states_.back().works.emplace(model, derivatives[p]);
    states_.back().losses.emplace(model, derivatives[p], run::has_instantaneous_parts(model));
  }
  if (!losses && model.size() >= min_modal && model.size() <= max_modal_tangent_dofs &&
      modal::proportional_refusal(model).empty())
    modal_.emplace(model, data_, run.output_dt.value_or(0.0));
}

void TangentRun::begin(const run::RunInstant& start) {
  end_.u = model_.u0;
  end_.v = model_.v0;
  end_.a = Vector::Zero(model_.size());
  end_.forces = end_.force_rates = Vector::Zero(model_.force_count());
  for (TangentState& state : states_) {
    const ModelDerivative& d = state.derivative;
    ForcingDerivatives series;
    ForcingRates(model_, d, 0.0, motion::Side::after).expand(0.0, 1.0, 3, series);
    SeriesPoint& w = state.now.point;
    w.u = d.u0;
    w.v = d.v0;
    w.a = Vector::Zero(model_.size());
    w.forces = w.force_rates = end_.forces;
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = d.contacts[c];
      state.now.driven.push_back(driven_rates(series, 1.0, c, 0.0));
      const double ut = contact.tangent.dot(d.u0) + rates.tangent.dot(model_.u0) - series.surface[3 * c];
      const double kt = contact.tangential_stiffness.value_or(0.0), T = contact.initial_shear;
      state.now.start.anchors.push_back(
          kt > 0.0 ? ut - rates.initial_shear / kt + T * rates.tangential_stiffness / (kt * kt) : ut);
    }
    for (const MovingBreakpoint& b : breakpoints_at(model_, d, 0.0, 0.0))
      if (b.rate != 0.0) {
        state.valid = false;
        state.reason =
            "a load starts at t = 0, but after t = 0 for neighbouring values of the key on one side: "
            "derivatives from both sides differ";
      }
  }
  recomputed_motion_.begin(start.after);
  pass(start);
}

/// Starts a stretch in modes, at the beginning of `step`. Returns false if its tangents cannot be computed in modes.
bool TangentRun::starts_in_modes(const run::RunStep& step) {
  if (!modal_ || step.forcing.varies()) return false;
  modal::ModalSystem* modes = share_->modes != nullptr ? share_->modes : recomputed_motion_.modes();
  if (modes == nullptr) return false;
  const decide::Decision& from = engine_without_series_ ? recomputed_motion_.stretch() : step.decision;
  std::vector<TangentSource> sources(states_.size());
  for (std::size_t p = 0; p < states_.size(); ++p) {
    if (!states_[p].valid) continue;
    sources[p].start = &states_[p].now.start;
    states_[p].forcing->expand(from.jet.t, 1.0, forcing_terms, sources[p].forcing);
  }
  return modal_->start(*modes, from, step.forcing, std::move(sources));
}

/// True if flow_ can cross the stretch in closed form; only for tangents with respect to the initial state alone.
bool TangentRun::crosses(const run::RunStep& step) {
  if (flow_ == nullptr || !closed_form_flow_ || !flow_->has_accurate_modes(step.decision.states))
    return false;
  crossed_ = step.decision.states;
  engine_without_series_ = false;
  return true;
}

/// Crosses the stretch up to t in closed form, if that is the method of the stretch.
void TangentRun::cross(double t) {
  if (stretch_method_ != StretchMethod::closed_form || !(t > begin_)) return;
  flow_->advance(crossed_, t - begin_, states_);
  for (TangentState& state : states_) state.error += error_in_modes(model_);
  begin_ = t;
}

TangentRun::StretchMethod TangentRun::choose_stretch_method(const run::RunStep& step) {
  if (crosses(step)) return StretchMethod::closed_form;
  const bool knew = !engine_without_series_;
  engine_without_series_ = share_->modes == nullptr && step.facts.expansion.series == nullptr;
  // The recomputed motion is not up to date after stretches that used the engine's own series.
  if (engine_without_series_ && knew) recomputed_motion_.begin(step.decision);
  if (engine_without_series_) recomputed_motion_.start(step.forcing);
  const bool modes = starts_in_modes(step);
  if (modes && !engine_without_series_) return StretchMethod::modes;
  if (!modes && step.facts.expansion.series != nullptr) return StretchMethod::series;
  if (!engine_without_series_) {
    recomputed_motion_.begin(step.decision);
    recomputed_motion_.start(step.forcing);
  }
  return modes ? StretchMethod::recomputed_modes : StretchMethod::recomputed_series;
}

void TangentRun::step(const run::RunStep& step) {
  if (stretch_method_ == StretchMethod::unknown) {
    stretch_method_ = choose_stretch_method(step);
    const bool in_modes = stretch_method_ == StretchMethod::modes ||
                          stretch_method_ == StretchMethod::recomputed_modes ||
                          stretch_method_ == StretchMethod::closed_form;
    ++(in_modes ? stretches_.modes : stretches_.series);
    if (is_followed()) ++stretches_.followed;
  }
  if (stretch_method_ == StretchMethod::series || stretch_method_ == StretchMethod::modes) observe(step);
}

void TangentRun::observe(const run::RunStep& step) {
  if (stretch_method_ == StretchMethod::series || stretch_method_ == StretchMethod::recomputed_series)
    observe_series(step);
  else
    observe_modes(step);
}

/// Recomputes the stretch that has ended at t, with its tangents.
void TangentRun::follow(double t) {
  if (!is_followed() || t <= recomputed_motion_.t()) return;
  engine::Stepper& engine = recomputed_motion_.engine(stretch_method_ == StretchMethod::recomputed_modes);
  engine.start({t, &recomputed_motion_.stretch(), &recomputed_motion_.forcing()});
  for (;;) {
    const engine::Step step = engine.advance();
    if (step.kind == engine::Step::Kind::failed) {
      for (TangentState& state : states_)
        if (std::exchange(state.valid, false)) {
          state.valid_until = step.begin;
          state.reason = step.reason;
        }
      return;
    }
    const engine::StepFacts facts = engine.dense_output().facts();
    observe({step, facts, recomputed_motion_.stretch(), recomputed_motion_.forcing(), engine.dense_output()});
    if (step.end >= t) return;
  }
}

/// Computes the tangents just before the instant at t.
void TangentRun::arrive(double t) {
  follow(t);
  cross(t);
  if (stretch_method_ != StretchMethod::modes && stretch_method_ != StretchMethod::recomputed_modes) return;
  MotionAndTangents at = modal_->at(t, true);
  end_ = std::move(at.motion);
  for (std::size_t p = 0; p < states_.size(); ++p) {
    TangentState& state = states_[p];
    if (!state.valid) continue;
    state.now.start.u = at.tangents[p].u;
    state.now.start.v = at.tangents[p].v;
    state.error += error_in_modes(model_);
    state.now.point = std::move(at.tangents[p]);
  }
}

/// State just before an instant, if the stretch was recomputed: the engine's u and v, with forces consistent with them.
SeriesPoint TangentRun::just_before(const run::RunInstant& instant) {
  const motion::StateSystemPtr system = systems_.system_of(instant.states_before);
  if (!system) return end_;
  motion::Taylor taylor(systems_);
  motion::Series series;
  const int levels = taylor.massless() ? 4 : 2;
  taylor.expand(system, instant.forcing_before, instant.t, instant.after.u, instant.v_before, levels, 1.0,
                series);
  return point_at(series.u, series.forces, 1.0, 2, 0.0);
}

std::vector<RequestedPlace> TangentRun::wanted(const run::RunStep& step, std::span<const double> turns) {
  std::vector<RequestedPlace> list;
  for (; next_ < grid_.size() && grid_[next_] < step.step.end; ++next_)
    list.push_back({grid_[next_], 0.0, true, false});
  for (const double t : turns) list.push_back({t, 0.0, false, true});
  std::sort(list.begin(), list.end(),
            [](const RequestedPlace& a, const RequestedPlace& b) { return a.t < b.t; });
  return list;
}

/// Time of a turning point, by Newton's method for a zero of the rate. t: turning point from the engine, which resolves slow
/// modes only.
double TangentRun::refine_turning_point(double t, std::size_t c, std::size_t which,
                                        const run::RunStep& step) const {
  double at = t;
  for (int i = 0; i < max_turn_steps; ++i) {
    const MotionAndTangents here = modal_->motion(at);
    const WatchedMotion m =
        watched(model_.contacts[c], model_.layout, c, model_.u0, here.motion, here.force_bends);
    if (m.bends[which] == 0.0) return t;
    const double next = at - m.slopes[which] / m.bends[which];
    if (!(next > step.step.begin && next < step.step.end)) return t;
    if (std::abs(next - at) <= 4.0 * rounding::eps * next) return next;
    at = next;
  }
  return at;
}

/// Times in a step at which a watched quantity has a local extreme that exceeds all earlier values of the quantity.
std::vector<double> TangentRun::turns_in_modes(const run::RunStep& step) const {
  std::vector<double> turns;
  for (const double t : step.facts.turning_points) {
    if (t < step.step.begin || t > step.step.end) continue;
    const MotionAndTangents here = modal_->motion(t);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const WatchedMotion m =
          watched(model_.contacts[c], model_.layout, c, model_.u0, here.motion, here.force_bends);
      for (std::size_t which = 0; which < m.values.size(); ++which)
        if (listener_.exceeds(c, which, m.values[which]))
          turns.push_back(refine_turning_point(t, c, which, step));
    }
  }
  std::sort(turns.begin(), turns.end());
  turns.erase(std::unique(turns.begin(), turns.end()), turns.end());
  return turns;
}

void TangentRun::observe_modes(const run::RunStep& step) {
  const std::vector<double> turns = turns_in_modes(step);
  for (const RequestedPlace& output : wanted(step, turns)) {
    MotionAndTangents at = modal_->at(output.t, false);
    TangentSample sample{output.t,
                         step.forcing,
                         step.decision.states,
                         std::move(at.motion),
                         std::move(at.force_bends),
                         std::move(at.tangents),
                         {},
                         {}};
    for (const TangentState& state : states_) {  // forcing is constant on the stretch
      sample.driven.push_back(state.now.driven);
      sample.anchors.push_back(state.now.start.anchors);
    }
    listener_.sample(sample, output.row, output.turn);
  }
}

void TangentRun::observe_series(const run::RunStep& step) {
  const engine::Expansion& e = step.facts.expansion;
  std::vector<double> turns(step.facts.turning_points.begin(), step.facts.turning_points.end());
  if (losses_) {
    const std::vector<double> more = compression_maxima(model_, step);
    turns.insert(turns.end(), more.begin(), more.end());
  }
  std::vector<RequestedPlace> places = wanted(step, turns);
  for (RequestedPlace& output : places)
    output.x = std::clamp((output.t - e.series->t) / e.series->scale, 0.0, e.x);
  std::vector<TangentSample> samples;
  for (const RequestedPlace& output : places) {
    samples.push_back({output.t, step.forcing, step.decision.states,
                       point_at(e.series->u, e.series->forces, e.series->scale, e.degree, output.x),
                       output.turn ? force_bends(*e.series, e.degree, output.x) : Vector(),
                       std::vector<SeriesPoint>(states_.size()),
                       std::vector<std::vector<DrivenRates>>(states_.size()),
                       std::vector<std::vector<double>>(states_.size()),
                       std::vector<WorkRates>(losses_ ? states_.size() : 0)});
  }
  for (std::size_t p = 0; p < states_.size(); ++p)
    if (states_[p].valid) series_.advance(states_[p], step, places, samples, p);
  for (std::size_t i = 0; i < samples.size(); ++i)
    listener_.sample(samples[i], places[i].row, places[i].turn);
  end_ = point_at(e.series->u, e.series->forces, e.series->scale, e.degree, e.x);
}

void TangentRun::instant(const run::RunInstant& instant) {
  if (engine_without_series_) {
    follow_instant(instant);
  } else {
    arrive(instant.t);
    if (is_followed() || stretch_method_ == StretchMethod::closed_form) end_ = just_before(instant);
    pass(instant);
  }
  stretch_method_ = StretchMethod::unknown;
}

/// Passes an instant of an engine without series, at the time and in the state of the recomputed motion.
void TangentRun::follow_instant(const run::RunInstant& instant) {
  std::optional<double> t;
  if (is_followed())
    t = recomputed_motion_.time_of(instant, [&](double at) {
      return stretch_method_ == StretchMethod::recomputed_modes ? modal_->motion(at).motion
                                                                : recomputed_motion_.at(at);
    });
  const bool moves = is_followed() && t.value_or(instant.t) > recomputed_motion_.t();
  if (moves) arrive(t.value_or(instant.t));
  const run::RunInstant seen = moves && t ? recomputed_motion_.pass(instant, *t, end_)
                                          : recomputed_motion_.adopt_engine_state(instant);
  if (moves) end_ = just_before(seen);
  pass(seen);
}

Stretches TangentRun::stretches() const {
  Stretches all = stretches_;
  all.taken = recomputed_motion_.fallback_count();
  all.correction = recomputed_motion_.correction();
  return all;
}

void TangentRun::end(const run::RunPoint& last, const engine::StepperReport& /*engine*/) {
  follow(last.t);
  cross(last.t);
}

void TangentRun::pass(const run::RunInstant& instant) {
  const motion::Jet& jet = instant.after.jet;
  const SeriesPoint after{instant.after.u, instant.after.v, jet.a(), jet.forces.col(0), jet.forces.col(1)};
  const motion::Series series = series_of(jet, instant.forcing_after);
  InstantMotion motion{instant, end_, after, series, {}, {}, {}, {}};
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    motion.motion_before.push_back(motion_of(contact, c, instant.forcing_before, instant.t, end_));
    motion.rate_before.push_back(time_rate(model_.layout, c, motion.motion_before[c], end_));
    motion.motion_after.push_back(motion_of(contact, c, instant.forcing_after, instant.t, after));
    motion.rate_after.push_back(time_rate(model_.layout, c, motion.motion_after[c], after));
  }
  for (TangentState& state : states_) {
    state.rates.assign(model_.contacts.size(), EventRates{});
    state.dt = EventRates::none;
    if (!state.valid) continue;
    state.impulses.clear();
    TangentAfter next = state.events.pass(motion, state.now, state.series);
    if (!next.rates.empty()) {
      state.rates = std::move(next.rates);
      state.dt = next.dt;
    }
    if (!next.reason.empty()) {
      state.valid = false;
      state.valid_until = instant.t;
      state.reason = std::move(next.reason);
      continue;
    }
    if (losses_) {
      next.rates = state.rates;
      state.along = state.losses->pass(motion, state.now, next, *state.works);
      state.impulses = next.impulse_n;
    }
    state.now = {std::move(next.start), std::move(next.point), std::move(next.driven)};
    state.forcing.emplace(model_, state.derivative, instant.t, motion::Side::after);
  }
  listener_.at_instant(motion, states_);
  rows_at(instant, after);
  begin_ = instant.t;
  end_ = after;
}

/// Writes output rows at the instant itself; they contain the values just after the instant.
void TangentRun::rows_at(const run::RunInstant& instant, const SeriesPoint& after) {
  for (; next_ < grid_.size() && grid_[next_] <= instant.t; ++next_) {
    TangentSample sample{grid_[next_], instant.forcing_after, instant.after.states, after, {}, {}, {}, {}};
    for (const TangentState& state : states_) {
      sample.tangents.push_back(state.valid ? state.now.point : SeriesPoint{});
      sample.driven.push_back(state.valid ? state.now.driven : std::vector<DrivenRates>{});
      sample.anchors.push_back(state.now.start.anchors);
      if (losses_) sample.works.push_back(state.works->now());
    }
    listener_.sample(sample, true, false);
  }
}

namespace {

template <class Value>
std::vector<double> rate_of_each_state(const std::vector<TangentState>& states, const Value& value) {
  std::vector<double> rates;
  for (const TangentState& state : states) rates.push_back(state.valid ? value(state) : EventRates::none);
  return rates;
}

}  // namespace

void LandingRecord::begin(std::size_t c, const std::vector<double>& start,
                          const std::vector<TangentState>& states) {
  ContactPhase& phase = all_[c].emplace_back();
  phase.landing.contact = static_cast<int>(c);
  phase.from = rate_of_each_state(
      states, [&](const TangentState& s) { return s.along.works.applied_normal_force[c]; });
  for (const double t : start) phase.landing.rates.push_back({t, t, 0.0, 0.0});
}

void LandingRecord::update_peak(std::size_t c, double force, const std::vector<double>& rates) {
  MovingLanding& landing = all_[c].back().landing;
  if (!(force > landing.value.peak_force)) return;
  landing.value.peak_force = force;
  for (std::size_t p = 0; p < parameters_; ++p) landing.rates[p].peak_force = rates[p];
}

void LandingRecord::turn(const TangentSample& s) {
  for (std::size_t c = 0; c < all_.size(); ++c) {
    if (!active_[c]) continue;
    const auto n = static_cast<Eigen::Index>(model_.layout.normal(c));
    std::vector<double> rates;
    for (const SeriesPoint& w : s.tangents) rates.push_back(w.u.size() > 0 ? -w.forces[n] : EventRates::none);
    update_peak(c, -s.point.forces[n], rates);
  }
}

void LandingRecord::instant(const InstantMotion& m, const std::vector<TangentState>& states) {
  const decide::Decision& decision = m.instant.after;
  for (std::size_t c = 0; c < all_.size(); ++c) {
    if (model_.contacts[c].normal_force_given()) continue;
    const bool was = !m.instant.states_before[c].is_open(), is = !decision.states[c].is_open();
    if (!begun_ && was) begin(c, std::vector<double>(parameters_, 0.0), states);
    const double pushed = decision.impulses.empty() ? 0.0 : decision.impulses[c].normal;
    const std::vector<double> t =
        rate_of_each_state(states, [&](const TangentState& s) { return s.rates[c].t; });
    if (was)
      update_peak(c, -m.motion_before[c].N,
                  rate_of_each_state(states, [&](const auto& s) { return -s.rates[c].N; }));
    if (!was && (is || pushed > 0.0)) begin(c, t, states);
    active_[c] = is;
    if (!was && !is && !(pushed > 0.0)) continue;
    ContactPhase& phase = all_[c].back();
    const auto work = rate_of_each_state(
        states, [&](const TangentState& s) { return s.along.works.applied_normal_force[c]; });
    for (std::size_t p = 0; p < parameters_; ++p) {
      LandingRates& rates = phase.landing.rates[p];
      rates.end = t[p];
      rates.impulse += work[p] - phase.from[p];
      if (pushed > 0.0) rates.impulse += states[p].valid ? states[p].impulses[c] : EventRates::none;
    }
    phase.from = work;
    if (is)
      update_peak(c, -m.motion_after[c].N,
                  rate_of_each_state(states, [&](const auto& s) { return -s.rates[c].N_after; }));
  }
  begun_ = true;
}

std::vector<std::vector<MovingLanding>> LandingRecord::finish(const std::vector<TangentState>& states) const {
  std::vector<std::vector<MovingLanding>> result(all_.size());
  for (std::size_t c = 0; c < all_.size(); ++c) {
    for (const ContactPhase& phase : all_[c]) result[c].push_back(phase.landing);
    if (!active_[c]) continue;
    const ContactPhase& last = all_[c].back();
    const auto work = rate_of_each_state(
        states, [&](const TangentState& s) { return s.works->now().works.applied_normal_force[c]; });
    for (std::size_t p = 0; p < parameters_; ++p) {
      LandingRates& rates = result[c].back().rates[p];
      rates.end = states[p].valid ? 0.0 : EventRates::none;
      rates.impulse += work[p] - last.from[p];
    }
  }
  return result;
}

}  // namespace signorini::sensitivity
