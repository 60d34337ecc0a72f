#include "engine/exact/exact_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"
#include "motion/state_systems.hpp"

namespace signorini::exact {
namespace {

constexpr int min_levels = 12, more_levels = 3;
constexpr double least_share = 1e-6;    // of the greatest motion; degrees of freedom above it keep all digits
constexpr std::size_t first_terms = 4;  // of a series: a motion may start from rest under a growing load
constexpr double flights_a_step = 3.0;
constexpr double longer = 1.5, much_longer = 4.0;  // than the previous step
constexpr double least_step = 1.0 / longer;        // lower limit of a random share: steps can still grow
// With random events at a mean distance tau, a step h contains one with the probability 1 - exp(-h/tau). A
// step takes 14 levels for a phase angle of half a radian, 18 for one, 30 for four. So the work for each
// event is least at h = 2 tau. Below `shortest_turn` rad a step takes 12 levels in any case.
constexpr double times_pace = 2.0, shortest_turn = 0.3;
// With local updates a series spans several events, up to a phase angle at which more levels would cost more
// than they save.
constexpr double events_a_series = 12.0, longest_turn = 2.0;
constexpr double least_left = 0.5;     // least valid part of the remaining series after a local update
constexpr double fresh = 0.25;         // weight of the last time between events among those before; chosen
constexpr double max_cancelled = 0.9;  // greatest later term over the greatest first one
constexpr double rounding_of_guard = 1.0 / 16.0;  // relative to the bound that the decision uses
constexpr int max_touches = 5;                    // warnings of the same kind
constexpr char overflow[] = "the motion leaves the range of numbers";

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
  t_ = decision.jet.t;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  growth_now_ =
      std::max({growth_.growth_rate(decision.system), 2.0 * segment.forcing->max_omega(), 1.0 / t_end_});
  choose_first_step();
  polynomial_ = segment.forcing->max_degree();
  active_guards_.start(decision.guards);
  turns_.start(decision);
  series_continued_ = same_motion && continue_series(before);
  ++counters.restarts;
}

/// True if the motion begins at the end of the last step, within its series.
bool ExactEngine::can_continue_series(const decide::Decision& decision, bool same_forcing) const {
  return local_series_ && local_series_->possible() && same_forcing && decision.jet.t == t_ &&
         end_x_ < reach_ && decision.u == end_.u && decision.v == end_.v;
}

/// Continues the series of the last step with the changes by the event. False: the series must be made anew.
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
      reach_time_ = motion_.whole.t + motion_.whole.scale * reach_;
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
  paced_ = !(flights > 0.0) && event_interval_ > 0.0;
  max_next_step_ = flights > 0.0 ? longer * flights
                   : paced_      ? paced_length()
                                 : std::numeric_limits<double>::infinity();
}

double ExactEngine::paced_length() const {
  const double shortest = shortest_turn / growth_now_, longest = longest_turn / growth_now_;
  if (local_series_ && local_series_->possible() && event_interval_ < longest)
    return std::clamp(events_a_series * event_interval_, shortest, longest);
  return std::max(times_pace * event_interval_, shortest);
}

/// Random share of the possible length of a step; 1 without a step_seed. Steps of equal length multiply the
/// motion by the same matrix with the same rounding. So N steps change the amplitude and phase of an
/// oscillation by N times one rounding, and every run with the same lengths has the same error. With random
/// lengths the rounding differs in each step, and the sum grows like sqrt(N). The first step of a segment has
/// its full length, because a guard may leave zero within rounding: its event in that step is then as
/// uncertain as reported.
double ExactEngine::share_of_step() {
  if (!random_ || t_ == segment_begin_) return 1.0;
  return std::uniform_real_distribution<double>(least_step, 1.0)(*random_);
}

/// A few times the duration of the shortest flight that begins now; 0: none. The rounding of a gap grows with
/// the motion on the whole step, and must stay small relative to the height of the flight.
double ExactEngine::flights_limit() const {
  const decide::Decision& decision = *segment_.decision;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < decision.states.size(); ++c) {
    const ContactMotion& m = decision.after[c];
    if (!model_.contacts[c].takes_impulses() || !decision.states[c].is_open() || !(m.an < 0.0)) continue;
    // A contact that leaves with g' = 0 flies by later derivatives: its g'' is rounding, and so is a flight computed
    // from it. Without the guard other contacts keep its gap.
    const decide::GuardStart& closing = decision.guards[model_.layout.guard(c)];
    if (closing.kind == Guard::none || closing.leading_order < 0 || closing.leading_order > 1) continue;
    const double height = std::max(m.gap, 0.0);
    shortest = std::min(shortest, (m.vn + std::sqrt(m.vn * m.vn - 2.0 * m.an * height)) / -m.an);
  }
  if (!std::isfinite(shortest) || !(shortest > 0.0)) return 0.0;
  return flights_a_step * shortest;
}

/// Weights of the degrees of freedom from their own motion, so that each keeps its digits.
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

/// Sizes of the coefficients first .. last, relative to the first ones of their degrees of freedom.
void ExactEngine::measure_coefficients(std::size_t first, std::size_t last) {
  for (std::size_t k = first; k <= last; ++k) {
    const double* u = motion_.whole.u.data() + k * weights_.size();
    double size = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) size = std::max(size, weights_[i] * std::abs(u[i]));
    sizes_[k] = size;
  }
}

/// True if the coefficients 0 .. last form a series that is valid up to x when cut after `degree_`: the remainder is
/// below rounding, and no term is much greater than the first nonzero ones.
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

/// Checks the series of the motion and of its forcing: in a block that sticks, T follows its load alone.
bool ExactEngine::converges(const std::vector<double>& sizes, const motion::ForcingSeries& f,
                            double x) const {
  if (!converges(sizes.data(), degree_ + 2, x)) return false;
  for (const std::vector<double>* rows : {&f.loads, &f.applied_normal_force, &f.surface})
    for (std::size_t i = 0; i + f.count <= rows->size(); i += f.count)
      if (!converges(rows->data() + i, f.count - 1, x)) return false;
  return true;
}

/// Expands to the number of levels that a step of the given scale needs, limited by max_levels; returns the part of
/// the step that the series reaches.
double ExactEngine::expand(double scale) {
  motion::Series& series = motion_.whole;
  const int late = taylor_.massless() ? 2 : 0;  // u_k of massless parts is complete two levels later
  taylor_.begin(segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v, max_levels, scale, series);
  std::size_t measured = 0;
  for (int level = min_levels;; level = std::min(level + more_levels, max_levels)) {
    taylor_.extend(*segment_.forcing, level, series);
    degree_ = static_cast<std::size_t>(level - late);
    if (measured == 0) set_weights();
    measure_coefficients(measured, degree_ + 2);
    measured = static_cast<std::size_t>(std::max(0, level - late - 2));
    // |x_(k+1)| <= |x_k|/2 from here on, so two small terms make a small rest
    if (degree_ >= polynomial_ && growth_now_ * scale <= 0.5 * static_cast<double>(degree_ + 2) &&
        converges(sizes_, series.forcing, 1.0))
      break;
    if (level == max_levels) break;
  }
  counters.solves += series.levels + 1;
  double x = std::min(1.0, 0.5 * static_cast<double>(degree_ + 2) / (growth_now_ * scale));
  while (x > std::numeric_limits<double>::min() && !converges(sizes_, series.forcing, x)) x *= 0.9;
  return x;
}

/// Bound on the remainder of a form's polynomial on [0, x]; rest: that of the displacements, in norm_.
double ExactEngine::remainder_of(const Form& form, std::size_t c, double x, double rest) const {
  const Contact& contact = model_.contacts[c];
  const double rate = static_cast<double>(degree_ + 3) / (motion_.whole.scale * x);
  const double gap = norm_.normal(c) * rest, ut = norm_.tangent(c) * rest;
  double N = contact.normal_stiffness * gap + contact.normal_damping * rate * gap, T = 0.0;
  const State state = segment_.decision->states[c].state;
  if (contact.takes_impulses() && !is_open(state)) N = rate * rate * rest / norm_.normal(c);
  if (slip_sign(state) != 0)
    T = contact::slipping_friction(contact, state) * N;
  else if (contact.tangential_stiffness)
    T = *contact.tangential_stiffness * ut;
  else if (state == State::stick && norm_.tangent(c) > 0.0)
    T = rate * rate * rest / norm_.tangent(c);
  return std::abs(form.N) * N + std::abs(form.T) * T + std::abs(form.gap) * gap + std::abs(form.ut) * ut +
         std::abs(form.vn) * rate * gap + std::abs(form.vt) * rate * ut +
         std::abs(form.an) * rate * rate * gap;
}

/// |a b - p q| <= |p| db + (|q| + db) da where p, q are the polynomials of a, b
double ExactEngine::remainder_of(const GuardForm& guard, std::size_t c, double x, double rest) const {
  double sum = remainder_of(guard.form, c, x, rest);
  const motion::ContactSeries& contact = motion_.contacts()[c];
  for (std::size_t i = 0; !guard.is_linear() && i < guard.products->size(); ++i) {
    const auto& [a, b] = (*guard.products)[i];
    const double reach = reach_ - contact.origin(), da = remainder_of(a, c, x, rest),
                 db = remainder_of(b, c, x, rest);
    sum += contact.magnitude(a, reach) * db + (contact.magnitude(b, reach) + db) * da;
  }
  return sum;
}

/// GuardStart::drift up to the place x of the step.
double ExactEngine::drift_of(const decide::GuardStart& guard, double x) const {
  return guard.drift(t_ + x * motion_.whole.scale - segment_.decision->jet.t);
}

/// First zero crossing on the remaining series; x: 1 at its end.
events::FirstRoot ExactEngine::first_root_of(std::size_t slot) {
  const decide::GuardStart& guard = segment_.decision->guards[slot];
  const std::size_t c = model_.layout.contact_of_guard(slot);
  const motion::ContactSeries& contact = motion_.contacts()[c];
  const GuardForm& form = segment_.decision->guard(slot);
  const auto [degree, cut, products] =
      contact.expand(form, reach_ - contact.origin(), events::max_root_degree, guard_.data());
  const double from = begin_x_ - contact.origin(), x = reach_ - begin_x_;
  double power = 1.0, terms = products;
  if (from > 0.0) {  // terms about the origin bound those about the step's beginning
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
      m > 0)  // the decision found the lower orders to be zero
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

/// Reason why no step of this length is possible from here; empty: it is possible.
std::string ExactEngine::failure_reason(double scale) const {
  if (growth_now_ * motion::resolution_at(t_, 0.0) > 1.0)
    return fmt::format(
        "the fastest motion, {:.3g} rad per unit of time, is too fast for the resolution of time here",
        model::in_scene_units(model_, growth_now_ / FlowGrowth::margin, unit::rate));
  if (!end_.u.allFinite()) return overflow;
  if (!(scale > 0.0)) return "the step has fallen below the resolution of time";
  return {};
}

/// Bound on the remainder of all displacements on [0, x], in norm_: its terms are below those of a geometric
/// series with ratio 1/2.
double ExactEngine::series_remainder(double x) {
  double rest = 0.0;
  for (int k = 1; k <= 2; ++k) {
    const auto order = static_cast<Eigen::Index>(degree_) + k;
    rest = std::max(rest,
                    2.0 * norm_.norm(motion_.whole.u.col(order)) * std::pow(x, static_cast<double>(order)));
  }
  return rest;
}

/// Same for a locally updated part.
double ExactEngine::local_remainder(const motion::LocalSeries::LocalExpansion& near, double x) {
  double rest = 0.0;
  near_column_.setZero(model_.size());
  for (int k = 1; k <= 2; ++k) {
    const auto order = static_cast<Eigen::Index>(degree_) + k;
    near_column_(near.where->dofs) = near.series->u.col(order);
    rest = std::max(rest, 2.0 * norm_.norm(near_column_) * std::pow(x, static_cast<double>(order)));
  }
  return rest;
}

/// Place up to which a locally updated part is valid, x at most: by the criteria of set_weights(),
/// measure_coefficients() and expand() for the whole structure.
double ExactEngine::local_radius(const motion::LocalSeries::LocalExpansion& near, double x) {
  const std::vector<int>& dofs = near.where->dofs;
  const Eigen::MatrixXd& u = near.series->u;
  near_sizes_.assign(degree_ + 3, 0.0);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double size = 0.0;
    for (std::size_t k = 0; k < first_terms; ++k)
      size = std::max(size, std::abs(u(row, static_cast<Eigen::Index>(k))));
    const double scale = scales_[static_cast<std::size_t>(dofs[i])];
    greatest_ = std::max(greatest_, scale * size);
    const double weight = greatest_ > 0.0 ? scale / std::max(scale * size, least_share * greatest_) : scale;
    for (std::size_t k = 0; k < near_sizes_.size(); ++k)
      near_sizes_[k] = std::max(near_sizes_[k], weight * std::abs(u(row, static_cast<Eigen::Index>(k))));
  }
  x = std::min(x, 0.5 * static_cast<double>(degree_ + 2) / (growth_now_ * near.series->scale));
  while (x > std::numeric_limits<double>::min() && !converges(near_sizes_, near.series->forcing, x)) x *= 0.9;
  return x;
}

ExactEngine::Earliest ExactEngine::earliest_crossing() {
  Earliest first;
  first.at = reach_;
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    if (active_guards_.idle(slot)) continue;
    ZeroCrossing& known = crossings_[slot];
    // A crossing before the beginning of this step was no event by a later decision.
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
    known.kind = events::FirstRoot::Kind::none;  // the warning has been issued
  }
  return first;
}

void ExactEngine::warn_of_touch(std::size_t slot, double t) {
  ++touches_;
  if (touches_ <= max_touches)
    warnings.push_back(fmt::format(
        "contact '{}': its {} touches zero at {:.9g}; this precision cannot decide whether it crosses zero; "
        "no event is recorded",
        model_.contacts[model_.layout.contact_of_guard(slot)].name,
        contact::to_string(segment_.decision->guards[slot].kind), model::time_in_scene_units(model_, t)));
  else if (touches_ == max_touches + 1)
    warnings.emplace_back("more guards touch zero; these are not listed");
}

/// Updates waiting guards at the end x of a step without an event.
void ExactEngine::update_unarmed(double x) {
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    if (active_guards_.idle(slot) || active_guards_.armed(slot)) continue;
    const decide::GuardStart& guard = segment_.decision->guards[slot];
    const motion::ContactSeries& contact = motion_.contacts()[model_.layout.contact_of_guard(slot)];
    const auto polynomial = contact.expand(segment_.decision->guard(slot), x - contact.origin(),
                                           events::max_root_degree, guard_.data());
    active_guards_.update(slot, motion::value_at(guard_.data(), polynomial.degree, x - contact.origin()),
                          4.0 * (guard.noise + drift_of(guard, x)));
  }
}

/// Begins the series of the whole structure here.
void ExactEngine::begin_series(double scale) {
  double x = expand(scale);
  paced_ = paced_ && x == 1.0;
  max_next_step_ = (paced_ ? much_longer : longer) * scale * x;
  reach_time_ = t_ + scale * x;
  if (reach_time_ > segment_.end || segment_.end - reach_time_ < 0.01 * scale * x) reach_time_ = segment_.end;
  begin_x_ = 0.0;
  reach_ = (reach_time_ - t_) / scale;
  motion_.set_complete(degree_);
  if (local_series_) motion_.bound_rates(reach_);
  local_remainders_.assign(local_remainders_.size(), {series_remainder(reach_), reach_});
  crossings_.assign(crossings_.size(), {});
}

engine::Step ExactEngine::advance() {
  if (!std::exchange(series_continued_, false)) {
    const double remaining = segment_.end - t_;
    const double longest = 0.5 * static_cast<double>(max_levels) / growth_now_;
    const double scale = std::min(share_of_step() * std::min(longest, max_next_step_), remaining);
    if (std::string why = failure_reason(scale); !why.empty()) return failed(std::move(why));
    begin_series(scale);
  }
  ++counters.steps;
  const Earliest first = earliest_crossing();
  if (first.not_finite) return failed(overflow);
  step_ = {};
  step_.begin = t_;
  const double x = first.at;
  double end = reach_time_;
  if (first.slot) {
    step_.kind = engine::Step::Kind::event;
    step_.triggered = {{model_.layout.contact_of_guard(*first.slot),
                        segment_.decision->guards[*first.slot].kind, !active_guards_.armed(*first.slot)}};
    end = motion_.whole.t + motion_.whole.scale * x;
  } else {
    update_unarmed(x);
  }
  step_.end = end;
  step_.resolution = motion::resolution_at(end, end - t_);
  turns_.find(motion_.contacts(), motion_.whole, begin_x_, x);
  end_x_ = x;
  motion_.evaluate_at(x, end_);  // more accurate than at the rounded time
  t_ = end;
  // Rounding in g'' is integrated twice over a long contact phase.
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
