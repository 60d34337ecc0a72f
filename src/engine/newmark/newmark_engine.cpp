#include "engine/newmark/newmark_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/rounding.hpp"
#include "engine/events/first_root.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int max_halvings = 60;
constexpr double rounding_of_guard = 1.0 / 16.0;  // part of level() up to which a guard is regarded as zero
constexpr int max_tangents = 4;       // number of tangents and secants before Brent's method is used
constexpr double spare = 1.0 / 16.0;  // step doubling: part of the tolerance below which steps grow
constexpr const char* singular = "the matrix of a step is singular; another dt may help";
constexpr double least_part = 1e-12;  // step doubling: shortest step, relative to dt
constexpr double forcing_step = 0.5;  // step doubling: largest phase angle of a load per step, rad

}  // namespace

NewmarkEngine::NewmarkEngine(const Model& model, const linear::SystemMatrices& structure,
                             motion::StateSystems& systems, const RunSpec& run,
                             const engine::Tolerance& tolerance)
    : model_(model),
      structure_(structure),
      consistent_(systems),
      tolerance_(tolerance),
      dt_(run.dt.value()),
      linear_(run.refine == Refine::linear),
      doubling_(run.step == StepControl::doubling),
      step_(model, structure),
      works_(model, structure),
      guards_(model),
      solves_massless_velocities_(linear::has_massless(model)),
      regular_(dt_) {}

void NewmarkEngine::start(const engine::Segment& segment) {
  segment_ = segment;
  const decide::Decision& decision = *segment.decision;
  t0_ = t1_ = decision.jet.t;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  NewmarkStep::Key key;
  key.reserve(decision.states.size());
  for (const ContactState& s : decision.states)
    key.push_back(static_cast<int>(contact::representative_state(s.state)));
  step_.set(std::move(key),
            std::shared_ptr<const std::vector<Rows>>(decision.system, &decision.system->rows()));
  inner_time_ = nan;
  a_before_.resize(0);
  h_ = h_before_ = 0.0;
  grid_length_ = 0.0;
  second_ = false;
  guards_.start(segment);
  guards_.evaluate(end_, t1_);
  // Step doubling compares displacements. A load on a contact that sticks rigidly causes no displacement, so the frequency of
  // the load limits the step.
  if (const double omega = doubling_ ? segment.forcing->max_omega() : 0.0; omega > 0.0)
    regular_ = std::min(regular_, forcing_step / omega);
  segment_dt_ = doubling_ ? dt_ : segment_step_length(model_, t0_, segment.end, dt_);
  ++counters.restarts;
}

/// Result of StepGuards::dip(). nullopt also if the dip is within the resolution of time of the beginning of the step.
std::optional<double> NewmarkEngine::dip_of(std::size_t slot, double h) const {
  const std::optional<double> x = guards_.dip(slot, h, h_before_);
  return x && *x * h > motion::resolution_at(t0_, h) ? x : std::nullopt;
}

/// Takes a step of length h from the beginning of the current step to t = t0_ + h. False: the matrix is singular.
bool NewmarkEngine::take(double h, double t, bool kept, motion::Point& to) {
  if (!step_.take(*segment_.forcing, begin_, t, h, kept, to)) return false;
  if (solves_massless_velocities_) consistent_.make(segment_.decision->system, *segment_.forcing, t, to);
  return true;
}

/// Value of the guard at the end of a step of length h from the beginning of the current step. NaN: singular matrix.
double NewmarkEngine::value_after(std::size_t slot, double h) {
  ++counters.guard_evaluations;
  inner_time_ = nan;
  tried_ = 0.0;
  if (!take(h, t0_ + h, false, inner_)) return nan;
  tried_ = h;
  return guards_.value(slot, t0_ + h, inner_);
}

/// Approximates value_after() by a step of only the contact's neighbourhood. longer: length of the step that ends in end_. NaN:
/// no local step is possible.
double NewmarkEngine::value_near(std::size_t slot, double h, double longer) {
  const motion::Point* near = step_.local_end(model_.layout.contact_of_guard(slot), *segment_.forcing, begin_,
                                              t0_ + h, h, end_, longer);
  if (near == nullptr) return nan;
  ++counters.guard_evaluations;
  return guards_.value(slot, t0_ + h, *near);
}

/// True if the contact has springs. Contacts without springs need a more accurate root: at an event the decision sets the
/// remaining gap, slip rate or force of such a contact to zero. This change is a small impulse that excites modes faster than
/// the step and so causes further events.
bool NewmarkEngine::has_springs(std::size_t slot) const {
  const Contact& contact = model_.contacts[model_.layout.contact_of_guard(slot)];
  return !contact.takes_impulses() && !contact.sticks_rigidly();
}

/// Largest magnitude of a guard that is regarded as zero. A root search for a smaller value would follow rounding errors.
double NewmarkEngine::zero_of(std::size_t slot) const {
  return has_springs(slot) ? rounding_of_guard * level(slot) : 0.0;
}

double NewmarkEngine::crossing_between(std::size_t slot, double lo, double g_lo, double hi, double g_hi,
                                       double floor) {
  double last = g_lo - floor;  // last finite value, used instead of a value from a singular matrix
  const auto value = [&](double h) {
    if (h == lo) return g_lo - floor;
    if (h == hi) return g_hi - floor;
    const double g = value_after(slot, h) - floor;
    if (std::abs(g) <= zero_of(slot)) return 0.0;
    return last = std::isfinite(g) ? g : last;
  };
  return events::root_between(value, lo, hi, 0.25 * motion::resolution_at(t0_ + hi, hi));
}

/// Finds the zero crossing along tangents and secants, with values from steps of the contact's neighbourhood. The caller must
/// confirm the result by a step of the whole structure. nullopt: no convergence.
std::optional<NewmarkEngine::Tangent> NewmarkEngine::tangent_near(std::size_t slot, double h, Tangent first) {
  Tangent next = first;
  double lo = 0.0, hi = h, before = nan, g_before = nan;
  for (int i = 0; i < max_tangents && next.slope < 0.0; ++i) {
    if (!(next.at > lo && next.at < hi)) return std::nullopt;
    const double g = value_near(slot, next.at, h);
    if (!std::isfinite(g)) return std::nullopt;
    if (i > 0) next.slope = (g - g_before) / (next.at - before);
    if (std::abs(g) <= zero_of(slot) || std::abs(g / next.slope) <= 0.25 * motion::resolution_at(t0_ + h, h))
      return next.slope < 0.0 ? std::optional(next) : std::nullopt;
    (g > 0.0 ? lo : hi) = before = next.at;
    g_before = g;
    next.at -= g / next.slope;
  }
  return std::nullopt;
}

/// Zero crossing of a guard that is positive at the beginning of the step and not positive at its end. The search starts at the
/// root of the Hermite cubic and continues along tangents and secants.
double NewmarkEngine::crossing_near(std::size_t slot, double h) {
  const events::GuardCubic path = guards_.path(slot, h);
  double lo = 0.0, g_lo = path.g0, hi = h, g_hi = path.g1;
  const auto narrow = [&](double at) {
    if (!(at > lo && at < hi)) return std::numeric_limits<double>::quiet_NaN();
    const double g = value_after(slot, at);
    if (g > 0.0) {
      lo = at;
      g_lo = g;
    } else if (g <= 0.0) {
      hi = at;
      g_hi = g;
    }
    return g;
  };
  const auto fall = guards_.has_rate(slot) ? path.cubic_root() : std::nullopt;
  Tangent next = fall ? Tangent{fall->x * h, fall->slope / h} : Tangent{nan, nan};
  const auto near = has_springs(slot) && fall ? tangent_near(slot, h, next) : std::nullopt;
  if (near) next = *near;
  double before = nan, g_before = nan;
  const int most = has_springs(slot) ? max_tangents : 1;
  for (int i = 0; i < most && next.slope < 0.0; ++i) {
    const double g = narrow(next.at);
    if (std::abs(g) <= zero_of(slot)) return next.at;
    if (i > 0 && !near) next.slope = (g - g_before) / (next.at - before);
    if (has_springs(slot) && std::abs(g / next.slope) <= 0.25 * motion::resolution_at(t0_ + h, h))
      return next.at;
    if (i == 0 && near) step_.double_radius();
    before = next.at;
    g_before = g;
    next.at -= g / next.slope;
  }
  if (next.slope < 0.0 && g_before != 0.0)
    (void)narrow(before - 2.0 * g_before / next.slope);  // narrow the bracket from the other side of the root
  return crossing_between(slot, lo, g_lo, hi, g_hi);
}

bool NewmarkEngine::interpolates(std::size_t slot) const { return linear_ && has_springs(slot); }

/// Step length by the paper's single linear interpolation. If the guard is still positive at this step length, the decision
/// would find no event. Then the step is extended by twice the next interpolation until the guard is not positive.
double NewmarkEngine::linear_root(std::size_t slot, double hi) {
  const events::GuardCubic path = guards_.path(slot, hi);
  const double g_hi = path.g1;
  double h = hi * path.linear_root();
  double g = value_after(slot, h);
  for (int i = 0; i < max_halvings && g > 0.0 && h < hi; ++i) {
    h = std::min(hi, h + 2.0 * (hi - h) * g / (g - g_hi) + motion::resolution_at(t0_ + h, 0.0));
    g = h < hi ? value_after(slot, h) : g_hi;
  }
  return h;
}

/// The guard that reaches zero first in the step of length h. located: this step already ends at the root of `slot`, so another
/// guard is a candidate only if its value at the end is clearly negative.
NewmarkEngine::Candidate NewmarkEngine::earliest_candidate(double h, bool located, std::size_t slot) {
  Candidate first;
  const auto consider = [&](Candidate::Kind kind, std::size_t s, double x) {
    if (x < first.x) first = {kind, s, x};
  };
  for (const std::size_t s : guards_.candidate_slots(h, h_before_)) {
    if (located && s == slot) continue;
    const events::GuardCubic path = guards_.path(s, h);
    if (!guards_.active_guards().armed(s)) {
      if (path.g1 < -level(s)) consider(Candidate::Kind::sink, s, 0.0);
    } else if (path.g1 <= (located ? -level(s) : 0.0)) {
      consider(Candidate::Kind::crossing, s, path.linear_root());
    } else if (path.g1 > 0.0) {
      if (const auto x = dip_of(s, h)) consider(Candidate::Kind::dip, s, *x);
    }
  }
  return first;
}

/// True if this guard caused the decision at the beginning of this step (NeverPositiveGuard), and the same guard is active after the
/// decision.
bool NewmarkEngine::was_never_positive(std::size_t slot) const {
  return never_positive_guard_ && never_positive_guard_->slot == slot &&
         never_positive_guard_->guard == segment_.decision->guards[slot].kind &&
         std::abs(t0_ - never_positive_guard_->t) <= motion::resolution_at(t0_, 0.0);
}

bool NewmarkEngine::locate(const Candidate& candidate, double& h) {
  const std::size_t slot = candidate.slot;
  const events::GuardCubic path = guards_.path(slot, h);
  switch (candidate.kind) {
    case Candidate::Kind::none:
      return false;
    case Candidate::Kind::crossing:
      h = interpolates(slot) ? linear_root(slot, h) : crossing_near(slot, h);
      return true;
    case Candidate::Kind::dip: {
      // The guard decreases and then increases in the step. A step up to the estimated minimum shows whether it reaches zero.
      const double x = candidate.x * h;
      ++counters.rolled_back;
      const double g = value_after(slot, x);
      if (!(g <= 0.0)) {
        guards_.dismiss(slot);
        return false;
      }
      h = interpolates(slot) ? x : crossing_between(slot, 0.0, path.g0, x, g);
      return true;
    }
    case Candidate::Kind::sink: {
      // The guard began at zero, rose, and reached zero again within the step. If this guard also caused the last decision and
      // did not rise (was_never_positive), any rise is below rounding. Then the root is the place where the guard becomes clearly
      // negative.
      const double floor = was_never_positive(slot) ? -2.0 * rounding_of_guard * level(slot) : 0.0;
      double hi = h, g_hi = path.g1;
      for (int i = 0; i < max_halvings; ++i) {
        const double lo = 0.5 * hi;
        if (!(lo > motion::resolution_at(t0_, 0.0))) break;
        const double g = value_after(slot, lo);
        if (!std::isfinite(g)) break;
        if (g > floor) {
          h = interpolates(slot) ? hi : crossing_between(slot, lo, g, hi, g_hi, floor);
          return true;
        }
        hi = lo;
        g_hi = g;
      }
      h = hi;  // the guard did not rise at any tried step length: the contact states are decided again
      never_positive_guard_ = NeverPositiveGuard{t0_ + h, slot, segment_.decision->guards[slot].kind};
      return true;
    }
  }
  return false;
}

engine::Step NewmarkEngine::failed(std::string reason) const {
  engine::Step step;
  step.kind = engine::Step::Kind::failed;
  step.begin = step.end = t0_;
  step.reason = std::move(reason);
  return step;
}

/// Step length h for which one step of length 2 h and two steps of length h differ by less than the tolerance.
double NewmarkEngine::length_by_doubling(double remaining) {
  if (std::exchange(second_, !second_)) return regular_;
  // h is at most half of the remaining time, so that two steps fit before the end of the segment.
  for (double h = std::min(regular_, 0.5 * remaining);; h *= 0.5) {
    if (h < least_part * dt_) return h;
    inner_time_ = nan;
    if (!take(2.0 * h, t0_ + 2.0 * h, true, coarse_) || !take(h, t0_ + h, true, inner_) ||
        !step_.take(*segment_.forcing, inner_, t0_ + 2.0 * h, h, true, fine_))
      continue;
    double change = 0.0;
    for (Eigen::Index i = 0; i < fine_.u.size(); ++i) {
      const Dof& dof = model_.dofs[static_cast<std::size_t>(i)];
      const double u = tolerance_.rtol * std::abs(fine_.u[i]) +
                       (dof.rotation ? tolerance_.rotation : tolerance_.displacement);
      const double v = tolerance_.rtol * std::abs(fine_.v[i]) +
                       (dof.rotation ? tolerance_.angular_velocity : tolerance_.velocity);
      change = std::max(change, std::abs(fine_.u[i] - coarse_.u[i]) / u);
      if (!dof.massless) change = std::max(change, std::abs(fine_.v[i] - coarse_.v[i]) / v);
    }
    if (change > 1.0) {
      ++counters.error_test_failures;
      continue;
    }
    regular_ = h;
    second_ = !(change < spare && 2.0 * h <= dt_ && 2.0 * h < remaining);
    if (!second_) regular_ = 2.0 * h;  // the next step is twice as long
    return h;
  }
}

/// Ends the step at t0_ + h. If h is the length of the last tried step, its result is used. False: the matrix is singular.
bool NewmarkEngine::end_after(double h) {
  t1_ = t0_ + h;
  if (tried_ == h)
    std::swap(end_, inner_);
  else if (!take(h, t1_, false, end_))
    return false;
  tried_ = 0.0;
  guards_.evaluate(end_, t1_);
  return true;
}

engine::Step NewmarkEngine::advance() {
  // The end of the last step is the beginning of this step. Swapping reuses the memory of the vectors.
  std::swap(a_before_, begin_.a);
  if (h_ == 0.0) a_before_.resize(0);
  std::swap(begin_, end_);
  t0_ = t1_;
  h_before_ = h_;
  guards_.begin_next_step();
  const double remaining = segment_.end - t0_;
  double h = doubling_ ? length_by_doubling(remaining) : segment_dt_;
  inner_time_ = nan;
  tried_ = 0.0;
  const bool last = remaining <= h * (1.0 + length_tolerance);
  if (last) h = remaining;
  if (h != grid_length_) {
    grid_begin_ = t0_;
    grid_length_ = h;
    grid_steps_ = 0;
  }
  t1_ = last ? segment_.end : grid_begin_ + static_cast<double>(++grid_steps_) * h;
  if (!(t1_ > t0_))
    return failed(doubling_ ? "the step is shorter than the resolution of time; a larger rtol may help"
                            : "the step is shorter than the resolution of time; a larger dt may help");
  if (!take(h, t1_, !last, end_)) return failed(singular);
  if (!end_.u.allFinite() || !end_.v.allFinite())
    return failed("the motion overflows and is no longer finite");
  guards_.evaluate(end_, t1_);

  engine::Step step;
  step.begin = t0_;
  std::size_t slot = 0;
  bool event = false;
  for (Candidate c = earliest_candidate(h, false, 0); c.kind != Candidate::Kind::none;
       c = earliest_candidate(h, event, slot)) {
    const double longer = h;
    if (!locate(c, h)) continue;
    const bool known = std::exchange(event, true);
    slot = c.slot;
    grid_length_ = 0.0;
    if (h < longer && !end_after(h)) return failed(singular);
    if (known && longer - h <= motion::resolution_at(t1_, h)) break;  // same time as the previous event
  }
  h_ = h;
  ++counters.steps;
  step_.count(counters);
  step.end = t1_;
  step.resolution = motion::resolution_at(t1_, h);
  if (event) {
    step.kind = engine::Step::Kind::event;
    step.triggered = {{model_.layout.contact_of_guard(slot), segment_.decision->guards[slot].kind}};
  }
  guards_.update_active_guards(t1_, end_);
  return step;
}

/// True if a guard is clearly negative at `point`, the end of a shorter step to t inside the last step. This may happen if the
/// last step is far longer than the periods of the highest modes, because the error of a step depends on its length.
bool NewmarkEngine::violates_guard(double t, const motion::Point& point) const {
  for (std::size_t s = 0; s < guards_.active_guards().size(); ++s)
    if (!guards_.active_guards().idle(s) && guards_.value(s, t, point) < -level(s)) return true;
  return false;
}

/// Solution at t inside the last step, by a shorter step to t. If this solution violates a guard, linear interpolation between
/// the ends is used instead. It satisfies all contact laws, because these are linear or convex cones.
const motion::Point& NewmarkEngine::point_inside(double t) {
  if (t == t1_) return end_;
  if (t == t0_) return begin_;
  if (t != inner_time_) {
    inner_time_ = t;
    if (!take(t - t0_, t, false, inner_) || violates_guard(t, inner_))
      inner_ = motion::interpolate(begin_, end_, (t - t0_) / (t1_ - t0_));
  }
  return inner_;
}

void NewmarkEngine::evaluate(double t, motion::Point& point) { point = point_inside(t); }

/// Adds the accelerations of massless degrees of freedom. The step has already computed the accelerations of all other degrees
/// of freedom.
void NewmarkEngine::accelerate(double t, motion::Point& point) {
  if (!solves_massless_velocities_) return;
  const Vector of_step = point.a;
  consistent_.accelerate(segment_.decision->system, *segment_.forcing, t, point);
  for (Eigen::Index i = 0; i < of_step.size(); ++i)
    if (!model_.dofs[static_cast<std::size_t>(i)].massless) point.a[i] = of_step[i];
}

/// Interpolates degrees of freedom with mass by a parabola (the step assumes a constant acceleration), and forces and massless
/// degrees of freedom linearly. Unlike evaluate(), needs no factorisation.
void NewmarkEngine::interpolate(double t, motion::Point& point) {
  if (t == t1_ || t == t0_ || !(t1_ > t0_)) {
    point = t == t0_ && t1_ > t0_ ? begin_ : end_;
    return;
  }
  const double h = t1_ - t0_, x = (t - t0_) / h;
  point = motion::interpolate(begin_, end_, x);
  for (Eigen::Index i = 0; i < point.u.size(); ++i)
    if (!model_.dofs[static_cast<std::size_t>(i)].massless)
      point.u[i] = begin_.u[i] + x * (h * begin_.v[i] + x * (end_.u[i] - begin_.u[i] - h * begin_.v[i]));
}

void NewmarkEngine::integrate(double from, double to, motion::WorkIntegrals& works) {
  const auto until = [&](double t, double factor) {
    works_.add(*segment_.forcing, segment_.decision->states, begin_, t0_, point_inside(t), t, factor, works);
  };
  if (from > t0_) until(from, -1.0);
  until(to, 1.0);
}

/// Bound on the guard's error due to the error of one step: h^2/12 |a1 - a0| in displacements, h/12 |a1 - 2 a0 + a_before| in
/// velocities.
double NewmarkEngine::guard_error(const GuardForm& guard, const ContactMotion& motion, std::size_t k) const {
  if (begin_.a.size() == 0) return 0.0;  // no step was taken yet
  const Contact& contact = model_.contacts[k];
  const auto errors = [&](const Combination& c, double& u, double& v) {
    const double change = c.dot(end_.a) - c.dot(begin_.a);
    const double before = a_before_.size() > 0 ? c.dot(begin_.a) - c.dot(a_before_) : 0.0;
    u = h_ * h_ / 12.0 * std::abs(change);
    v = h_ / 12.0 * std::abs(change - before);
  };
  ContactMotion e;
  errors(contact.normal, e.gap, e.vn);
  errors(contact.tangent, e.ut, e.vt);
  e.N = step_.rows()[k].normal.magnitude(e);
  e.T = step_.rows()[k].tangent.magnitude(e);
  return guard.rounding(&motion, &e, 0);
}

}  // namespace signorini::newmark
