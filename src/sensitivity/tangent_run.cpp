#include "sensitivity/tangent_run.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr int most_halvings = 30;
constexpr int fewest_tangent_levels = 12;
constexpr double bolder = 1.5;  // than the last part that converged

Vector force_bends(const Series& series, std::size_t degree, double x) {
  Vector sum = Vector::Zero(series.forces.rows());
  for (std::size_t k = degree; k-- > 0;) {
    if (k + 2 > degree) continue;
    const double factor = static_cast<double>((k + 1) * (k + 2)) / (series.scale * series.scale);
    sum = sum * x + factor * series.forces.col(static_cast<Eigen::Index>(k + 2));
  }
  return sum;
}

/// About an instant, of scale 1, from derivatives.
Series series_of(const Jet& jet, const Forcing& forcing) {
  Series s;
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

}  // namespace

TangentRun::TangentRun(const Model& model, const RunSpec& run,
                       const std::vector<ModelDerivative>& derivatives, const std::vector<double>& sizes,
                       TangentListener& listener)
    : model_(model), structure_(model), systems_(model, structure_), listener_(listener), grid_(run.grid()) {
  states_.reserve(derivatives.size());
  for (std::size_t p = 0; p < derivatives.size(); ++p)
    states_.emplace_back(model, structure_, systems_, derivatives[p], sizes[p], run.t_end);
}

void TangentRun::begin(const ObservedInstant& start) {
  end_.u = model_.u0;
  end_.v = model_.v0;
  end_.a = Vector::Zero(model_.size());
  end_.forces = end_.force_rates = Vector::Zero(static_cast<Eigen::Index>(2 * model_.contacts.size()));
  for (TangentState& state : states_) {
    const ModelDerivative& d = state.derivative;
    ForcingRatesSeries series;
    ForcingRates(model_, d, 0.0, Side::after).expand(0.0, 1.0, 3, series);
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
        state.alive = false;
        state.reason = "what begins at t = 0 begins later for values on one side only";
      }
  }
  pass(start);
}

std::vector<TangentRun::Output> TangentRun::outputs(const ObservedStep& step) {
  std::vector<Output> list;
  const Series& series = *step.expansion.series;
  for (; next_ < grid_.size() && grid_[next_] < step.step.end; ++next_)
    list.push_back({grid_[next_], 0.0, true, false});
  for (const double t : step.turns) list.push_back({t, 0.0, false, true});
  std::sort(list.begin(), list.end(), [](const Output& a, const Output& b) { return a.t < b.t; });
  for (Output& output : list)
    output.x = std::clamp((output.t - series.t) / series.scale, 0.0, step.expansion.x);
  return list;
}

/// One tangent to the end of the step, part by part.
void TangentRun::advance(TangentState& state, const ObservedStep& step, const std::vector<Output>& wanted,
                         std::vector<TangentSample>& samples, std::size_t p) const {
  const Expansion& e = step.expansion;
  const ModeSystem& system = *step.decision.system;
  const int levels = std::max(fewest_tangent_levels, static_cast<int>(step.forcing.greatest_degree()) + 2);
  Series moved;
  std::size_t next = 0;
  double from = 0.0;
  int halvings = 0;
  while (from < e.x || from == 0.0) {
    const double rest = e.x - from;
    double length = rest;
    if (state.reach > 0.0) length = std::min(rest, bolder * state.reach / e.series->scale);
    if (length < rest && length > 0.6 * rest) length = 0.5 * rest;
    if (from > 0.0) recentre(*e.series, step.forcing, from, 1.0, moved);
    const Series& motion = from > 0.0 ? moved : *e.series;
    while (length > 0.0 &&
           !state.series.expand(system, motion, *state.forcing, state.now.start, length, levels)) {
      if (++halvings > most_halvings) {
        state.alive = false;
        state.until = motion.t;
        state.reason = "its series does not converge";
        return;
      }
      length *= 0.5;
      state.reach = length * e.series->scale;
    }
    if (length == 0.0)
      state.series.expand_to(system, motion, *state.forcing, state.now.start, motion.levels);
    else
      state.reach = std::max(state.reach, length * e.series->scale);
    const double to = length == rest ? e.x : from + length;
    for (; next < wanted.size() && wanted[next].x <= to; ++next) {
      const double x = wanted[next].x - from;
      samples[next].tangents[p] = state.series.at(x);
      for (std::size_t c = 0; c < model_.contacts.size(); ++c)
        samples[next].driven[p].push_back(driven_rates(state.series.forcing(), e.series->scale, c, x));
      samples[next].anchors[p] = state.now.start.anchors;
    }
    state.now.point = state.series.at(length);
    state.now.driven.clear();
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      state.now.driven.push_back(driven_rates(state.series.forcing(), e.series->scale, c, length));
    state.now.start.u = state.now.point.u;
    state.now.start.v = state.now.point.v;
    if (to >= e.x) break;
    from = to;
  }
}

void TangentRun::step(const ObservedStep& step) {
  const Expansion& e = step.expansion;
  const std::vector<Output> wanted = outputs(step);
  std::vector<TangentSample> samples;
  for (const Output& output : wanted) {
    samples.push_back({output.t, step.forcing, step.decision.mode,
                       point_at(e.series->u, e.series->forces, e.series->scale, e.degree, output.x),
                       output.turn ? force_bends(*e.series, e.degree, output.x) : Vector(),
                       std::vector<SeriesPoint>(states_.size()),
                       std::vector<std::vector<DrivenRates>>(states_.size()),
                       std::vector<std::vector<double>>(states_.size())});
  }
  for (std::size_t p = 0; p < states_.size(); ++p)
    if (states_[p].alive) advance(states_[p], step, wanted, samples, p);
  for (std::size_t i = 0; i < samples.size(); ++i)
    listener_.sample(samples[i], wanted[i].row, wanted[i].turn);
  end_ = point_at(e.series->u, e.series->forces, e.series->scale, e.degree, e.x);
}

void TangentRun::instant(const ObservedInstant& instant) { pass(instant); }

void TangentRun::pass(const ObservedInstant& instant) {
  const Jet& jet = instant.after.jet;
  const SeriesPoint after{instant.after.u, instant.after.v, jet.a(), jet.forces.col(0), jet.forces.col(1)};
  const Series series = series_of(jet, instant.forcing_after);
  InstantMotion motion{instant, end_, after, series, {}, {}, {}, {}};
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    motion.motion_before.push_back(motion_of(contact, c, instant.forcing_before, instant.t, end_));
    motion.rate_before.push_back(time_rate(c, motion.motion_before[c], end_));
    motion.motion_after.push_back(motion_of(contact, c, instant.forcing_after, instant.t, after));
    motion.rate_after.push_back(time_rate(c, motion.motion_after[c], after));
  }
  for (TangentState& state : states_) {
    state.rates.assign(model_.contacts.size(), EventRates{});
    state.dt = EventRates::none;
    if (!state.alive) continue;
    TangentAfter next = state.events.pass(motion, state.now, state.series);
    if (!next.rates.empty()) {
      state.rates = std::move(next.rates);
      state.dt = next.dt;
    }
    if (!next.reason.empty()) {
      state.alive = false;
      state.until = instant.t;
      state.reason = std::move(next.reason);
      continue;
    }
    state.now = {std::move(next.start), std::move(next.point), std::move(next.driven)};
    state.forcing.emplace(model_, state.derivative, instant.t, Side::after);
  }
  listener_.instant(motion, states_);
  rows_at(instant, after);
  end_ = after;
}

/// A row asked for at the instant itself shows what is just after.
void TangentRun::rows_at(const ObservedInstant& instant, const SeriesPoint& after) {
  for (; next_ < grid_.size() && grid_[next_] <= instant.t; ++next_) {
    TangentSample sample{grid_[next_], instant.forcing_after, instant.after.mode, after, {}, {}, {}, {}};
    for (const TangentState& state : states_) {
      sample.tangents.push_back(state.alive ? state.now.point : SeriesPoint{});
      sample.driven.push_back(state.alive ? state.now.driven : std::vector<DrivenRates>{});
      sample.anchors.push_back(state.now.start.anchors);
    }
    listener_.sample(sample, true, false);
  }
}

}  // namespace signorini
