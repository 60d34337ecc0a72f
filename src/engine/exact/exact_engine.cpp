#include "engine/exact/exact_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/rounding.hpp"
#include "contact/law.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"
#include "motion/state_systems.hpp"

namespace signorini::exact {
namespace {

constexpr int min_levels = 12, level_increment = 3;  // number of levels at first, and of each extension
// A degree of freedom whose motion exceeds this part of the greatest motion keeps all its digits.
constexpr double least_share = 1e-6;
// Number of first terms that measure the size of a motion. Several, because the first ones are zero if the body starts at rest.
constexpr std::size_t first_terms = 4;
constexpr double step_in_flights = 3.0;  // limit of the step length, in durations of the shortest flight
constexpr double longer = 1.5, much_longer = 4.0;  // limits of the step length, relative to the previous step
constexpr double min_step_factor =
    1.0 / longer;  // lower limit of random_step_factor(), so that steps can grow
// Random events at mean intervals tau occur in a step of length h with the probability 1 - exp(-h/tau). A step needs 14 levels
// for a phase angle of 0.5 rad, 18 for 1 rad, 30 for 4 rad. So the work per event is least at h = 2 tau. Steps below a phase
// angle of `min_step_angle` (rad) save nothing, because every step has at least 12 levels.
constexpr double step_in_event_intervals = 2.0, min_step_angle = 0.3;
// With local updates, one series is used across several events. A series longer than the phase angle `max_series_angle` (rad) needs
// so many levels that it is slower than two series.
constexpr double events_per_series = 12.0, max_series_angle = 2.0;
constexpr double least_left = 0.5;  // a local update must be valid on this part of the remaining series
constexpr double fresh = 0.25;      // weight of the last interval in the mean interval between events; chosen
constexpr double max_cancelled = 0.9;  // limit of later terms, relative to the greatest of the first terms
constexpr double rounding_of_guard = 1.0 / 16.0;  // part of the decision's rounding bound in a guard's slack
constexpr int max_touches = 5;                    // limit of the number of warnings about touches
constexpr char overflow[] = "the motion overflows and is no longer finite";

}  // namespace

ExactEngine::ExactEngine(const Model& model, const linear::SystemMatrices& structure,
                         motion::StateSystems& systems, double t_end, const SeriesOptions& use)
    : model_(model),
      structure_(structure),
      taylor_(systems),
      t_end_(t_end),
      norm_(model),
      growth_(model, taylor_, norm_, scales_, t_end),
      motion_(model),
      local_remainders_(model.contacts.size()),
      crossings_(model.layout.guard_count()),
      sizes_(max_levels + 3),
      guard_(std::max<std::size_t>(max_levels, events::max_root_degree) + 1),
      works_(model, structure),
      turns_(model.contacts.size()) {
  for (const Dof& dof : model.dofs)
    scales_.push_back(1.0 / (dof.rotation ? model.scales.rotation : model.scales.displacement));
  weights_ = scales_;
  if (use.local_updates && model.size() >= motion::large_structure && motion::follows_from_motion(model))
    local_series_.emplace(systems);
  if (use.step_seed != 0) random_.emplace(use.step_seed);
  resolves_low_flights = true;
}

void ExactEngine::start(const engine::Segment& segment) {
  segment_ = segment;
  const decide::Decision& decision = *segment.decision;
  const bool same_motion = can_continue_series(decision, segment.same_forcing);
  const contact::ContactStates before =
      local_series_ ? std::exchange(states_, decision.states) : contact::ContactStates();
  if (decision.jet.t != t_) rest_ = 0.0;
  t_ = decision.jet.t;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  growth_now_ =
      std::max({growth_.growth_rate(decision.system), 2.0 * segment.forcing->max_omega(), 1.0 / t_end_});
  choose_first_step();
  forcing_polynomial_degree_ = segment.forcing->max_degree();
  active_guards_.start(decision.guards);
  turns_.start(decision);
  series_continued_ = same_motion && continue_series(before);
  ++counters.restarts;
}

/// True if the segment continues the motion of the last step, and the series of this step is valid beyond the end of the step.
bool ExactEngine::can_continue_series(const decide::Decision& decision, bool same_forcing) const {
  return local_series_ && local_series_->possible() && same_forcing && decision.jet.t == t_ &&
         end_x_ < reach_ && decision.u == end_.u && decision.v == end_.v;
}

/// Continues the series of the last step, with local updates near the contacts whose state has changed. False: a new series is
/// needed.
bool ExactEngine::continue_series(const contact::ContactStates& before) {
  std::vector<std::size_t> changed;
  for (std::size_t c = 0; c < states_.size(); ++c)
    if (states_[c] != before[c]) changed.push_back(c);
  const double rest = reach_ - end_x_;
  std::optional<motion::LocalSeries::LocalExpansion> near;
  if (!changed.empty()) {
    near = local_series_->expand(changed, segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v,
                                 motion_.whole.levels, motion_.whole.scale, rest,
                                 {scales_, least_share * greatest_},
                                 {[&](int dof, double* out) { motion_.displacement(dof, end_x_, out); },
                                  [&](std::size_t slot, double* out) { motion_.force(slot, end_x_, out); }});
    if (!near) return false;
    const double reach = local_radius(*near, rest);
    if (reach < least_left * rest) return false;
    if (reach < rest) {
      reach_ = end_x_ + reach;
      valid_end_time_ = motion_.whole.t + motion_.whole.scale * reach_;
    }
    motion_.patch(*near, end_x_, reach);
    const LocalRemainder reached{local_remainder(*near, reach), reach};
    for (const std::size_t c : near->where->contacts) {
      local_remainders_[c] = reached;
      for (std::size_t slot = model_.layout.guard(c); slot < model_.layout.guard_end(c); ++slot)
        crossings_[slot] = {};
    }
  }
  begin_x_ = end_x_;
  return true;
}

void ExactEngine::choose_first_step() {
  if (counters.restarts > 0)
    event_interval_ += (event_interval_ > 0.0 ? fresh : 1.0) * (t_ - segment_begin_ - event_interval_);
  segment_begin_ = t_;
  const double flights = flights_limit();
  limited_by_events_ = !(flights > 0.0) && event_interval_ > 0.0;
  max_next_step_ = flights > 0.0        ? longer * flights
                   : limited_by_events_ ? length_by_event_rate()
                                        : std::numeric_limits<double>::infinity();
}

double ExactEngine::length_by_event_rate() const {
  const double shortest = min_step_angle / growth_now_, longest = max_series_angle / growth_now_;
  if (local_series_ && local_series_->possible() && event_interval_ < longest)
    return std::clamp(events_per_series * event_interval_, shortest, longest);
  return std::max(step_in_event_intervals * event_interval_, shortest);
}

/// Random factor on the length of a step; 1 without a step_seed. Steps of equal length multiply the motion by the same matrix
/// with the same rounding errors. So N steps change amplitude and phase of an oscillation by N times one error, and all runs
/// with these lengths have the same error. With random lengths the rounding errors differ, and their sum grows like sqrt(N).
/// The first step of a segment has its full length, because a guard may start at zero up to rounding: an event in that step is
/// then as uncertain as reported.
double ExactEngine::random_step_factor() {
  if (!random_ || t_ == segment_begin_) return 1.0;
  return std::uniform_real_distribution<double>(min_step_factor, 1.0)(*random_);
}

/// Limit of the step length if a rigid contact opens at t_: a few times the duration of the shortest flight. 0: no limit.
/// Reason: the rounding error of a gap grows with the motion on the whole step, but must stay small relative to the height of
/// the flight.
double ExactEngine::flights_limit() const {
  const decide::Decision& decision = *segment_.decision;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < decision.states.size(); ++c) {
    const ContactMotion& m = decision.after[c];
    if (!model_.contacts[c].takes_impulses() || !decision.states[c].is_open() || !(m.an < 0.0)) continue;
    // If g' = 0 and the leading derivative of the gap is of higher order than two, g'' is only a rounding error, and a flight
    // computed from g'' would be meaningless. If the guard is omitted, other contacts keep the gap.
    const decide::GuardStart& closing = decision.guards[model_.layout.guard(c)];
    if (closing.kind == Guard::none || closing.leading_order < 0 || closing.leading_order > 1) continue;
    const double height = std::max(m.gap, 0.0);
    shortest = std::min(shortest, (m.vn + std::sqrt(m.vn * m.vn - 2.0 * m.an * height)) / -m.an);
  }
  if (!std::isfinite(shortest) || !(shortest > 0.0)) return 0.0;
  return step_in_flights * shortest;
}

/// Sets the weight of each degree of freedom to the reciprocal size of its motion, so that the convergence test also covers
/// small motions.
void ExactEngine::set_weights() {
  const std::size_t n = scales_.size();
  double greatest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0.0;
    for (std::size_t k = 0; k < first_terms; ++k)
      size = std::max(size, std::abs(motion_.whole.u.data()[k * n + i]));
    weights_[i] = scales_[i] * size;
    greatest = std::max(greatest, weights_[i]);
  }
  greatest_ = greatest;
  for (std::size_t i = 0; i < n; ++i)
    weights_[i] = greatest > 0.0 ? scales_[i] / std::max(weights_[i], least_share * greatest) : scales_[i];
}

/// Sets sizes_[k], k = first .. last, to the largest weighted coefficient u_ik of all degrees of freedom i.
void ExactEngine::measure_coefficients(std::size_t first, std::size_t last) {
  for (std::size_t k = first; k <= last; ++k) {
    const double* u = motion_.whole.u.data() + k * weights_.size();
    double size = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) size = std::max(size, weights_[i] * std::abs(u[i]));
    sizes_[k] = size;
  }
}

/// True if the series with the coefficients a[0 .. last], cut after degree_, is valid up to x: the remainder is below rounding,
/// and no later term exceeds max_cancelled times the greatest of the first terms.
bool ExactEngine::converges(const double* a, std::size_t last, double x) const {
  double first = 0.0, power = 1.0;
  std::size_t begin = last + 1;
  for (std::size_t k = 0; k <= last; ++k, power *= x) {
    const double term = std::abs(a[k]) * power;
    if (k > degree_) {
      if (term > 0.25 * rounding::eps * first) return false;
      continue;
    }
    if (begin > last && term > 0.0) begin = k;
    if (k < begin + first_terms)
      first = std::max(first, term);
    else if (term > max_cancelled * first)
      return false;
  }
  return true;
}

/// True if the series of the motion and of the forcing are valid up to x. The forcing is checked separately, because T of a
/// block that sticks rigidly depends on the load alone.
bool ExactEngine::converges(const std::vector<double>& sizes, const motion::ForcingSeries& f,
                            double x) const {
  if (!converges(sizes.data(), degree_ + 2, x)) return false;
  for (const std::vector<double>* rows : {&f.loads, &f.applied_normal_force, &f.surface})
    for (std::size_t i = 0; i + f.count <= rows->size(); i += f.count)
      if (!converges(rows->data() + i, f.count - 1, x)) return false;
  return true;
}

/// Expands the motion to as many levels as a step of length `scale` needs, but at most max_levels. Returns the part of the
/// step, 0 to 1, on which the series is valid.
double ExactEngine::expand(double scale) {
  motion::Series& series = motion_.whole;
  const int late = taylor_.massless() ? 2 : 0;  // u_k of massless parts needs two more levels
  taylor_.begin(segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v, max_levels, scale, series);
  std::size_t measured = 0;
  for (int level = min_levels;; level = std::min(level + level_increment, max_levels)) {
    taylor_.extend(*segment_.forcing, level, series);
    degree_ = static_cast<std::size_t>(level - late);
    if (measured == 0) set_weights();
    measure_coefficients(measured, degree_ + 2);
    measured = static_cast<std::size_t>(std::max(0, level - late - 2));
    // For k > degree_ + 1, |u_(k+1)| <= |u_k|/2. So the remainder is small if the two terms after degree_ are small.
    if (degree_ >= forcing_polynomial_degree_ &&
        growth_now_ * scale <= 0.5 * static_cast<double>(degree_ + 2) &&
        converges(sizes_, series.forcing, 1.0) && taylor_.friction_reach(degree_, 1.0) == 1.0)
      break;
    if (level == max_levels) break;
  }
  counters.solves += series.levels + 1;
  double x = std::min(1.0, 0.5 * static_cast<double>(degree_ + 2) / (growth_now_ * scale));
  while (x > std::numeric_limits<double>::min() && !converges(sizes_, series.forcing, x)) x *= 0.9;
  return taylor_.friction_reach(degree_, x);
}

/// Bounds on the remainders of N and T on [0, x], from the rows of the contact: a row gives its force, or is a constraint on an
/// acceleration.
ContactMotion ExactEngine::force_remainders(std::size_t c, double rest, const MotionRemainder& motion) const {
  const auto& [normal, tangent] = segment_.decision->system->rows()[c];
  ContactMotion m;
  if (normal.N != 0.0 && tangent.T != 0.0) {  // both forces from two linear equations
    const double n = motion.of(normal), t = motion.of(tangent);
    const double det = std::abs(normal.N * tangent.T - normal.T * tangent.N);
    m.N = (std::abs(tangent.T) * n + std::abs(normal.T) * t) / det;
    m.T = (std::abs(tangent.N) * n + std::abs(normal.N) * t) / det;
    return m;
  }
  const double of_acceleration = motion.rate * motion.rate * rest;
  m.N = normal.N != 0.0 ? motion.of(normal) / std::abs(normal.N) : of_acceleration / norm_.normal(c);
  if (tangent.T != 0.0)
    m.T = (motion.of(tangent) + std::abs(tangent.N) * m.N) / std::abs(tangent.T);
  else if (norm_.tangent(c) > 0.0)
    m.T = of_acceleration / norm_.tangent(c);
  return m;
}

/// Bound on the remainder of a form's polynomial on [0, x]. rest: bound on the remainder of the displacements, in the norm
/// `norm_`.
double ExactEngine::remainder_of(const Form& form, std::size_t c, double x, double rest) const {
  const MotionRemainder motion{norm_.normal(c) * rest, norm_.tangent(c) * rest,
                               static_cast<double>(degree_ + 3) / (motion_.whole.scale * x)};
  double sum = motion.of(form);
  if (form.N != 0.0 || form.T != 0.0) {
    const ContactMotion forces = force_remainders(c, rest, motion);
    sum += std::abs(form.N) * forces.N + std::abs(form.T) * forces.T;
  }
  return sum;
}

/// Bound on the remainder of a guard, from the bounds on the remainders of its forms.
double ExactEngine::remainder_of(const GuardForm& guard, std::size_t c, double x, double rest) const {
  const motion::ContactSeries& contact = motion_.contacts()[c];
  return guard.error([&](const Form& form) { return remainder_of(form, c, x, rest); },
                     [&](const Form& form) { return contact.magnitude(form, reach_ - contact.origin()); });
}

/// GuardStart::drift() for the interval from the decision to the time t_ + x scale.
double ExactEngine::drift_of(const decide::GuardStart& guard, double x) const {
  return guard.drift(t_ + x * motion_.whole.scale - segment_.decision->jet.t);
}

/// First zero crossing of a guard between begin_x_ and reach_. x of the result is relative: 0 at begin_x_ and 1 at reach_.
events::FirstRoot ExactEngine::first_root_of(std::size_t slot) {
  const decide::GuardStart& guard = segment_.decision->guards[slot];
  const std::size_t c = model_.layout.contact_of_guard(slot);
  const motion::ContactSeries& contact = motion_.contacts()[c];
  const GuardForm& form = segment_.decision->guard(slot);
  const auto [degree, cut, products] =
      contact.expand(form, reach_ - contact.origin(), events::max_root_degree, guard_.data());
  const double from = begin_x_ - contact.origin(), x = reach_ - begin_x_;
  double power = 1.0, terms = products;
  if (from > 0.0) {  // the sum of |terms| about the origin bounds the sum about begin_x_
    for (std::size_t k = 0; k <= degree; ++k, power *= reach_ - contact.origin())
      terms += std::abs(guard_[k]) * power;
    motion::shift(guard_.data(), degree, from);
    power = 1.0;
    for (std::size_t k = 0; k <= degree; ++k, power *= x) guard_[k] *= power;
  } else {
    for (std::size_t k = 0; k <= degree; ++k, power *= x) {
      guard_[k] *= power;
      terms += std::abs(guard_[k]);
    }
  }
  const double rounding = (from > 0.0 ? rounding::many_operations : rounding::few_operations) * terms;
  const double slack = remainder_of(form, c, local_remainders_[c].x, local_remainders_[c].rest) + cut +
                       rounding + rounding_of_guard * guard.noise;
  if (active_guards_.armed(slot)) return events::first_root(guard_.data(), degree, slack);
  if (const std::size_t m = active_guards_.leading_order(slot);
      m > 0)  // the decision has proved that the coefficients below order m are zero
    return events::first_root(guard_.data() + m, degree - m, rounding::few_operations * std::abs(guard_[m]));
  guard_[0] += guard.noise + slack + drift_of(guard, x);
  return events::first_root(guard_.data(), degree, 0.0);
}

engine::Step ExactEngine::failed(std::string reason) {
  step_ = {};
  step_.kind = engine::Step::Kind::failed;
  step_.begin = step_.end = t_;
  step_.reason = std::move(reason);
  return step_;
}

/// Reason why no step of length `scale` can be taken from t_. Empty: the step is possible.
std::string ExactEngine::failure_reason(double scale) const {
  if (growth_now_ * motion::resolution_at(t_, 0.0) > 1.0)
    return fmt::format(
        "the fastest motion, {:.3g} rad per unit of time, is too fast for the resolution of time at this "
        "time",
        model::in_scene_units(model_, growth_now_ / FlowGrowth::margin, unit::rate));
  if (!end_.u.allFinite()) return overflow;
  if (!(scale > 0.0)) return "the step length is below the resolution of time";
  return {};
}

/// Bound on the remainder of all displacements on [0, x], in the norm `norm_`. The omitted terms decrease at least like a
/// geometric series with ratio 1/2, so their sum is at most twice the first omitted term.
double ExactEngine::series_remainder(double x) {
  double rest = 0.0;
  for (int k = 1; k <= 2; ++k) {
    const auto order = static_cast<Eigen::Index>(degree_) + k;
    rest = std::max(rest,
                    2.0 * norm_.norm(motion_.whole.u.col(order)) * std::pow(x, static_cast<double>(order)));
  }
  return rest;
}

/// Bound on the remainder of the displacements in a locally updated region, by the method of series_remainder().
double ExactEngine::local_remainder(const motion::LocalSeries::LocalExpansion& near, double x) {
  double rest = 0.0;
  local_column_.setZero(model_.size());
  for (int k = 1; k <= 2; ++k) {
    const auto order = static_cast<Eigen::Index>(degree_) + k;
    local_column_(near.where->dofs) = near.series->u.col(order);
    rest = std::max(rest, 2.0 * norm_.norm(local_column_) * std::pow(x, static_cast<double>(order)));
  }
  return rest;
}

/// Largest place, at most x, up to which the series of a locally updated region are valid. Same criteria as for the whole
/// structure: set_weights(), measure_coefficients() and expand().
double ExactEngine::local_radius(const motion::LocalSeries::LocalExpansion& near, double x) {
  const std::vector<int>& dofs = near.where->dofs;
  const Eigen::MatrixXd& u = near.series->u;
  local_sizes_.assign(degree_ + 3, 0.0);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double size = 0.0;
    for (std::size_t k = 0; k < first_terms; ++k)
      size = std::max(size, std::abs(u(row, static_cast<Eigen::Index>(k))));
    const double scale = scales_[static_cast<std::size_t>(dofs[i])];
    greatest_ = std::max(greatest_, scale * size);
    const double weight = greatest_ > 0.0 ? scale / std::max(scale * size, least_share * greatest_) : scale;
    for (std::size_t k = 0; k < local_sizes_.size(); ++k)
      local_sizes_[k] = std::max(local_sizes_[k], weight * std::abs(u(row, static_cast<Eigen::Index>(k))));
  }
  x = std::min(x, 0.5 * static_cast<double>(degree_ + 2) / (growth_now_ * near.series->scale));
  while (x > std::numeric_limits<double>::min() && !converges(local_sizes_, near.series->forcing, x))
    x *= 0.9;
  return x;
}

ExactEngine::Earliest ExactEngine::earliest_crossing() {
  Earliest first;
  first.at = reach_;
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    if (active_guards_.idle(slot)) continue;
    ZeroCrossing& known = crossings_[slot];
    // The decision at an earlier crossing has found no event, so the search continues after this crossing.
    const bool past = known.kind != events::FirstRoot::Kind::none && known.at <= begin_x_;
    if (!known.stands || !active_guards_.armed(slot) || past) {
      const events::FirstRoot fall = first_root_of(slot);
      if (fall.kind == events::FirstRoot::Kind::not_finite) {
        first.not_finite = true;
        return first;
      }
      known = {fall.kind, active_guards_.armed(slot), begin_x_ + fall.x * (reach_ - begin_x_)};
    }
    if (known.kind == events::FirstRoot::Kind::crossing && known.at <= reach_ &&
        (!first.slot || known.at < first.at)) {
      first.slot = slot;
      first.at = known.at;
    }
  }
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    ZeroCrossing& known = crossings_[slot];
    if (known.kind != events::FirstRoot::Kind::touch || active_guards_.idle(slot) || !(known.at < first.at))
      continue;
    if (active_guards_.armed(slot)) warn_of_touch(slot, motion_.whole.t + known.at * motion_.whole.scale);
    known.kind = events::FirstRoot::Kind::none;  // one warning for each touch
  }
  return first;
}

void ExactEngine::warn_of_touch(std::size_t slot, double t) {
  ++touches_;
  if (touches_ <= max_touches)
    warnings.push_back(fmt::format(
        "contact '{}': its {} touches zero at t = {:.9g}; double precision cannot decide whether it crosses "
        "zero, so no event is recorded",
        model_.contacts[model_.layout.contact_of_guard(slot)].name,
        contact::to_string(segment_.decision->guards[slot].kind), model::time_in_scene_units(model_, t)));
  else if (touches_ == max_touches + 1)
    warnings.emplace_back("more contacts touch zero; these touches are not listed");
}

/// Arms waiting guards that are clearly positive at the end x of a step without an event.
void ExactEngine::update_unarmed(double x) {
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    if (active_guards_.idle(slot) || active_guards_.armed(slot)) continue;
    const decide::GuardStart& guard = segment_.decision->guards[slot];
    const motion::ContactSeries& contact = motion_.contacts()[model_.layout.contact_of_guard(slot)];
    const auto polynomial = contact.expand(segment_.decision->guard(slot), x - contact.origin(),
                                           events::max_root_degree, guard_.data());
    active_guards_.update(slot, motion::value_at(guard_.data(), polynomial.degree, x - contact.origin()),
                          4.0 * (guard.noise + drift_of(guard, x - begin_x_)));
  }
}

/// Expands the series of the whole structure about t_.
void ExactEngine::begin_series(double scale) {
  double x = expand(scale);
  limited_by_events_ = limited_by_events_ && x == 1.0;
  max_next_step_ = (limited_by_events_ ? much_longer : longer) * scale * x;
  valid_end_time_ = t_ + scale * x;
  // A short remainder of the segment becomes part of the step, unless friction that depends on the slip rate changes there.
  const double all = (segment_.end - t_) / scale;
  if (valid_end_time_ > segment_.end ||
      (segment_.end - valid_end_time_ < 0.01 * scale * x && taylor_.friction_reach(degree_, all) == all))
    valid_end_time_ = segment_.end;
  begin_x_ = 0.0;
  origin_rest_ = rest_;
  reach_ = (valid_end_time_ - t_ - rest_) / scale;
  motion_.set_complete(degree_);
  if (local_series_) motion_.bound_rates(reach_);
  local_remainders_.assign(local_remainders_.size(), {series_remainder(reach_), reach_});
  crossings_.assign(crossings_.size(), {});
}

engine::Step ExactEngine::advance() {
  if (!std::exchange(series_continued_, false)) {
    const double remaining = segment_.end - t_;
    const double longest = 0.5 * static_cast<double>(max_levels) / growth_now_;
    const double scale = std::min(random_step_factor() * std::min(longest, max_next_step_), remaining);
    if (std::string why = failure_reason(scale); !why.empty()) return failed(std::move(why));
    begin_series(scale);
  }
  ++counters.steps;
  const Earliest first = earliest_crossing();
  if (first.not_finite) return failed(overflow);
  step_ = {};
  step_.begin = t_;
  const double x = first.at;
  double end = valid_end_time_;
  const double passed = motion_.whole.scale * x + origin_rest_;
  if (first.slot) {
    step_.kind = engine::Step::Kind::event;
    step_.triggered = {{model_.layout.contact_of_guard(*first.slot),
                        segment_.decision->guards[*first.slot].kind, !active_guards_.armed(*first.slot)}};
    end = motion_.whole.t + passed;
  } else {
    update_unarmed(x);
  }
  step_.end = end;
  step_.resolution = motion::resolution_at(end, end - t_);
  turns_.find(motion_.contacts(), motion_.whole, begin_x_, x);
  end_x_ = x;
  motion_.evaluate_at(x, end_);  // more accurate than at `end`, which is rounded
  rest_ = rest_of_sum(motion_.whole.t, passed, end);
  t_ = end;
  // A closed rigid contact satisfies only g'' = 0, whose rounding errors are integrated twice: restore g = 0 and g' = 0.
  if (!local_series_)
    motion::project_constraints(model_, *segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v);
  return step_;
}

void ExactEngine::evaluate(double t, motion::Point& point) {
  if (t == t_ && end_.u.size() > 0)
    point = end_;
  else
    motion_.evaluate_at(x_of(t), point);
}

void ExactEngine::evaluate_watched(double t, std::optional<std::size_t> contact, motion::Point& point) {
  if (t == t_ && end_.u.size() > 0) return evaluate(t, point);
  point.a.resize(0);
  if (contact)
    motion_.evaluate_without_accelerations(x_of(t), *contact, point);
  else
    motion_.evaluate_without_accelerations(x_of(t), point);
}

engine::StepFacts ExactEngine::facts() const {
  engine::StepFacts facts;
  facts.turning_points = turns_.times();
  facts.contact_turning_points = &turns_.turning_points();
  facts.expansion = {&motion_.whole, motion_.degree(), end_x_, taylor_.system().get()};
  facts.phase_angle = std::numbers::pi * static_cast<double>(motion_.degree());
  return facts;
}

void ExactEngine::integrate(double from, double to, motion::WorkIntegrals& works) {
  works_.add(segment_.decision->states, *segment_.forcing, motion_, growth_now_, from, to, works);
}

double ExactEngine::residual() {
  return motion::equilibrium_residual(model_, structure_, *segment_.forcing, t_, end_);
}

}  // namespace signorini::exact
