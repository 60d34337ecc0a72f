#include "engine/exact/exact_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "model/decay.hpp"
#include "model/said.hpp"
#include "motion/clock.hpp"
#include "motion/equilibrium.hpp"
#include "motion/hold.hpp"

namespace signorini {
namespace {

constexpr int fewest_levels = 12, more_levels = 3;
constexpr int probe_levels = 20;
constexpr double growth_margin = 1.25;  // on a growth that is computed from twenty powers of the flow
constexpr double most_beside =
    0.1;  // of the square of a growth: steps are five in a hundred shorter at most; chosen
constexpr double least_share = 1e-6;    // of the greatest motion, down to which each one keeps its digits
constexpr std::size_t first_terms = 4;  // of a series: a motion may start from rest under a load that grows
constexpr double flights_a_step = 3.0;
constexpr double longer = 1.5, much_longer = 4.0;  // than the step before
constexpr double least_step = 1.0 / longer;        // of those by chance: then steps still grow
// With events at random, tau apart, a step h finds one with 1 - exp(-h/tau), and takes 14 levels for half a radian, 18 for
// one, 30 for four: least work an event is at 2 tau. Below `shortest_turn` rad a step takes 12 levels in any case.
constexpr double times_pace = 2.0, shortest_turn = 0.3;
constexpr double fresh = 0.25;          // weight of the last time between events among those before; chosen
constexpr double most_cancelled = 0.9;  // greatest later term over the greatest first one
constexpr double rounding_of_guard = 1.0 / 16.0;  // of the bound that the decision uses
constexpr int most_touches = 5;                   // warnings about one and the same thing
constexpr char overflow[] = "the motion leaves the range of numbers";

}  // namespace

ExactEngine::ExactEngine(const Model& model, const Structure& structure, ModeSystems& systems, double t_end,
                         std::uint64_t step_seed)
    : model_(model),
      structure_(structure),
      taylor_(systems),
      t_end_(t_end),
      norm_(model),
      contacts_(model.contacts.size()),
      sizes_(most_levels + 3),
      guard_(most_levels + 1),
      works_(model, structure),
      turns_(model.contacts.size()) {
  for (const Dof& dof : model.dofs)
    scales_.push_back(1.0 / (dof.rotation ? model.scales.rotation : model.scales.displacement));
  weights_ = scales_;
  if (step_seed != 0) chance_.emplace(step_seed);
  fastest_ =
      std::max({model.omega_max, 1.0 / t_end,
                diagonal_decay(model.mass.diagonal(), model.damping.diagonal(), model.stiffness.diagonal())});
}

double ExactEngine::growth_of(const ModeSystemPtr& system) {
  std::vector<State> states = states_of(system->mode());
  if (const double* known = growth_.find(states)) return *known;
  if (const auto beside = growth_beside(*system)) return *beside;
  near_growth_ = probed_growth(system);
  growth_.insert(states, near_growth_, states.size() * sizeof(State));
  near_ = std::move(states);
  return near_growth_;
}

/// What a contact adds at most to the square of the growth, by closing, sticking or slipping.
double ExactEngine::stiffening(const ModeSystem& system, std::size_t c) {
  double& known = stiffenings_[c];
  if (known >= 0.0) return known;
  const Contact& contact = model_.contacts[c];
  Vector x(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  const auto effect = [&](const Combination& form) {
    x.setZero();
    form.add_to(x, 1.0);
    system.solve(x.data(), work.data());
    return norm_.of(x.head(model_.size()));
  };
  const double n = effect(contact.normal), t = effect(contact.tangent);
  const double kn = contact.normal_stiffness, kt = contact.tangential_stiffness.value_or(0.0);
  const double friction = std::max(static_friction(contact), kinetic_friction(contact));
  return known = kn * (n + friction * t) * norm_.normal(c) + kt * t * norm_.tangent(c);
}

/// The growth of states that differ from the nearest known ones in few soft contacts. Nothing: in more than that.
std::optional<double> ExactEngine::growth_beside(const ModeSystem& system) {
  if (near_.empty() || !system.factorised().by_mass) return std::nullopt;
  stiffenings_.resize(near_.size(), -1.0);
  const double square = near_growth_ * near_growth_;
  double more = 0.0;
  for (std::size_t c = 0; c < near_.size(); ++c) {
    if (system.mode()[c].state == near_[c]) continue;
    const Contact& contact = model_.contacts[c];
    // Rows on accelerations, dashpots and forces that are no product of these stiffnesses change the growth otherwise.
    if (contact.normal_damping > 0.0 || contact.own || contact.takes_impulses() || contact.sticks_rigidly() ||
        contact.friction.varies() || contact.bowl)
      return std::nullopt;
    more += growth_margin * growth_margin * stiffening(system, c);
    if (!(more <= most_beside * square)) return std::nullopt;
  }
  return std::sqrt(square + more);
}

/// |x_(k+1)| (k+1)/s over |x_k| for large k, from a motion in which all modes take part.
double ExactEngine::probed_growth(const ModeSystemPtr& system) {
  const Eigen::Index n = model_.size();
  Vector u(n), v(n);
  std::mt19937_64 random(1);  // the same motion in every run
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    u[i] = uniform(random) / scales_[static_cast<std::size_t>(i)];
    v[i] = fastest_ * uniform(random) / scales_[static_cast<std::size_t>(i)];
  }
  Series series;
  taylor_.expand(system, Forcing::none(model_), 0.0, u, v, probe_levels, 1.0 / fastest_, series);
  double greatest = 0.0;
  for (Eigen::Index k = probe_levels / 2; k + 2 <= probe_levels - 2; ++k) {
    const double a = norm_.of(series.u.col(k)), b = norm_.of(series.u.col(k + 2));
    if (a > 0.0)
      greatest = std::max(greatest, fastest_ * std::sqrt(static_cast<double>((k + 1) * (k + 2)) * b / a));
  }
  return growth_margin * greatest;
}

void ExactEngine::start(const Segment& segment) {
  segment_ = segment;
  const Decision& decision = *segment.decision;
  t_ = decision.jet.t;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  growth_now_ = std::max({growth_of(decision.system), 2.0 * segment.forcing->greatest_omega(), 1.0 / t_end_});
  choose_first_step();
  polynomial_ = segment.forcing->greatest_degree();
  arming_.start(decision.guards);
  turns_.start(decision);
  ++counters.restarts;
}

void ExactEngine::choose_first_step() {
  if (counters.restarts > 0) pace_ += (pace_ > 0.0 ? fresh : 1.0) * (t_ - begun_ - pace_);
  begun_ = t_;
  const double flights = few_flights();
  paced_ = !(flights > 0.0) && pace_ > 0.0;
  next_ = flights > 0.0 ? longer * flights
          : paced_      ? std::max(times_pace * pace_, shortest_turn / growth_now_)
                        : std::numeric_limits<double>::infinity();
}

/// Of the length that a step could have. Steps of one length multiply the motion by one matrix, whose entries have the same
/// roundings each time: N steps grow or damp a swing by N times one rounding, and turn it as much. Whoever takes the same
/// lengths has the same error. Lengths by chance draw another rounding each step, and N of these add up to sqrt(N). The first
/// step of a segment keeps its length, since no other like it follows: where a guard leaves zero below rounding the event of
/// that step is as uncertain as it says, and no later one.
double ExactEngine::share_of_step() {
  if (!chance_ || t_ == begun_) return 1.0;
  return std::uniform_real_distribution<double>(least_step, 1.0)(*chance_);
}

/// A few times the shortest flight that lies ahead, 0: none does. What rounding makes of a
/// gap grows with the whole step's motion, and must stay small beside the flight's height.
double ExactEngine::few_flights() const {
  const Decision& decision = *segment_.decision;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < decision.mode.size(); ++c) {
    const ContactMotion& m = decision.after[c];
    if (!model_.contacts[c].takes_impulses() || !decision.mode[c].is_open() || !(m.an < 0.0)) continue;
    // What leaves with g' = 0 flies by later derivatives: its g'' is rounding, and so is a flight made of it.
    const GuardStart& closing = decision.guards[guard_slot(c, 0)];
    if (closing.leading < 0 || closing.leading > 1) continue;
    const double height = std::max(m.gap, 0.0);
    shortest = std::min(shortest, (m.vn + std::sqrt(m.vn * m.vn - 2.0 * m.an * height)) / -m.an);
  }
  if (!std::isfinite(shortest) || !(shortest > 0.0)) return 0.0;
  return flights_a_step * shortest;
}

/// Weights of the degrees of freedom from their own motion, so that each keeps its digits.
void ExactEngine::weigh() {
  const std::size_t n = scales_.size();
  double greatest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0.0;
    for (std::size_t k = 0; k < first_terms; ++k)
      size = std::max(size, std::abs(series_.u.data()[k * n + i]));
    weights_[i] = scales_[i] * size;
    greatest = std::max(greatest, weights_[i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    weights_[i] = greatest > 0.0 ? scales_[i] / std::max(weights_[i], least_share * greatest) : scales_[i];
}

/// Sizes of the coefficients first .. last, relative to the first ones of their degrees of freedom.
void ExactEngine::measure(std::size_t first, std::size_t last) {
  for (std::size_t k = first; k <= last; ++k) {
    const double* u = series_.u.data() + k * weights_.size();
    double size = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) size = std::max(size, weights_[i] * std::abs(u[i]));
    sizes_[k] = size;
  }
}

/// Do the coefficients 0 .. last make a series that stands up to x when cut after `degree_`: what follows
/// below rounding, no term much greater than the first ones that are not zero?
bool ExactEngine::stands(const double* a, std::size_t last, double x) const {
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
    else if (term > most_cancelled * first)
      return false;
  }
  return true;
}

/// The motion's series and those of all that drives it: with a block that sticks, T follows its load alone.
bool ExactEngine::stands(double x) const {
  if (!stands(sizes_.data(), degree_ + 2, x)) return false;
  const ForcingSeries& f = series_.forcing;
  for (const std::vector<double>* rows : {&f.loads, &f.pressing, &f.surface})
    for (std::size_t i = 0; i + f.count <= rows->size(); i += f.count)
      if (!stands(rows->data() + i, f.count - 1, x)) return false;
  return true;
}

/// Expands to as many levels as a step of the given scale needs, all at most; returns the part of it that
/// the series then reaches.
double ExactEngine::expand(double scale) {
  const int late = taylor_.massless() ? 2 : 0;  // u_k of massless parts is complete two levels later
  taylor_.begin(segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v, most_levels, scale,
                series_);
  std::size_t measured = 0;
  for (int level = fewest_levels;; level = std::min(level + more_levels, most_levels)) {
    taylor_.extend(*segment_.forcing, level, series_);
    degree_ = static_cast<std::size_t>(level - late);
    if (measured == 0) weigh();
    measure(measured, degree_ + 2);
    measured = static_cast<std::size_t>(std::max(0, level - late - 2));
    // |x_(k+1)| <= |x_k|/2 from here on, so two small terms make a small rest
    if (degree_ >= polynomial_ && growth_now_ * scale <= 0.5 * static_cast<double>(degree_ + 2) &&
        stands(1.0))
      break;
    if (level == most_levels) break;
  }
  counters.solves += series_.levels + 1;
  double x = std::min(1.0, 0.5 * static_cast<double>(degree_ + 2) / (growth_now_ * scale));
  while (x > std::numeric_limits<double>::min() && !stands(x)) x *= 0.9;
  return x;
}

/// Bound on what the polynomial of a form leaves out on [0, x]; rest: of the displacements, in norm_.
double ExactEngine::rest_of(const Form& form, std::size_t c, double x, double rest) const {
  const Contact& contact = model_.contacts[c];
  const double rate = static_cast<double>(degree_ + 3) / (series_.scale * x);
  const double gap = norm_.normal(c) * rest, ut = norm_.tangent(c) * rest;
  double N = contact.normal_stiffness * gap + contact.normal_damping * rate * gap, T = 0.0;
  const State state = segment_.decision->mode[c].state;
  if (contact.takes_impulses() && !is_open(state)) N = rate * rate * rest / norm_.normal(c);
  if (slip_sign(state) != 0)
    T = slipping_friction(contact, state) * N;
  else if (contact.tangential_stiffness)
    T = *contact.tangential_stiffness * ut;
  else if (state == State::stick && norm_.tangent(c) > 0.0)
    T = rate * rate * rest / norm_.tangent(c);
  return std::abs(form.N) * N + std::abs(form.T) * T + std::abs(form.gap) * gap + std::abs(form.ut) * ut +
         std::abs(form.vn) * rate * gap + std::abs(form.vt) * rate * ut +
         std::abs(form.an) * rate * rate * gap;
}

/// GuardStart::drift up to the place x of the step.
double ExactEngine::drift_of(const GuardStart& guard, double x) const {
  return guard.drift(t_ + x * series_.scale - segment_.decision->jet.t);
}

FirstFall ExactEngine::fall_of(std::size_t slot, double x, double rest) {
  const GuardStart& guard = segment_.decision->guards[slot];
  const std::size_t c = contact_of_guard(slot);
  contacts_[c].combine(guard.form, guard_.data());
  double power = 1.0, terms = 0.0;
  for (std::size_t k = 0; k <= degree_; ++k, power *= x) {
    guard_[k] *= power;
    terms += std::abs(guard_[k]);
  }
  const double rounding = rounding::of_few * terms;
  const double slack = rest_of(guard.form, c, x, rest) + rounding + rounding_of_guard * guard.noise;
  if (arming_.armed(slot)) return first_fall(guard_.data(), degree_, slack);
  if (const std::size_t m = arming_.leading(slot); m > 0)  // the decision found what is below to be zero
    return first_fall(guard_.data() + m, degree_ - m, rounding::of_few * std::abs(guard_[m]));
  guard_[0] += guard.noise + slack + drift_of(guard, x);
  return first_fall(guard_.data(), degree_, 0.0);
}

Step ExactEngine::failed(std::string reason) {
  step_ = {};
  step_.kind = Step::Kind::failed;
  step_.begin = step_.end = t_;
  step_.reason = std::move(reason);
  return step_;
}

/// Why no step of this length can be made from here; empty: one can.
std::string ExactEngine::hindrance(double scale) const {
  if (growth_now_ * resolution_at(t_, 0.0) > 1.0)
    return fmt::format(
        "the fastest motion, {:.3g} rad per unit of time, is too fast for the resolution of time here",
        said(model_, growth_now_ / growth_margin, unit::rate));
  if (!end_.u.allFinite()) return overflow;
  if (!(scale > 0.0)) return "the step has fallen below the resolution of time";
  return {};
}

/// Bound on what all displacements leave out on [0, x], in norm_: from |x_k| on the series is below a
/// geometric one with ratio 1/2.
double ExactEngine::rest_of_series(double x) {
  double rest = 0.0;
  for (int k = 1; k <= 2; ++k) {
    const auto order = static_cast<Eigen::Index>(degree_) + k;
    rest = std::max(rest, 2.0 * norm_.of(series_.u.col(order)) * std::pow(x, static_cast<double>(order)));
  }
  return rest;
}

ExactEngine::Earliest ExactEngine::earliest_fall(double x) {
  const double rest = rest_of_series(x);
  Earliest first;
  std::vector<std::pair<std::size_t, double>> touches;  // slot, place in the step
  for (std::size_t slot = 0; slot < arming_.size(); ++slot) {
    if (arming_.idle(slot)) continue;
    const FirstFall fall = fall_of(slot, x, rest);
    if (fall.kind == FirstFall::Kind::lost) {
      first.lost = true;
      return first;
    }
    if (fall.kind == FirstFall::Kind::fall && (!first.slot || fall.x < first.at)) {
      first.slot = slot;
      first.at = fall.x;
    } else if (fall.kind == FirstFall::Kind::touch && arming_.armed(slot)) {
      touches.emplace_back(slot, fall.x);
    }
  }
  for (const auto& [slot, where] : touches)
    if (where < first.at) warn_of_touch(slot, t_ + where * x * series_.scale);
  return first;
}

void ExactEngine::warn_of_touch(std::size_t slot, double t) {
  ++touches_;
  if (touches_ <= most_touches)
    warnings.push_back(
        fmt::format("contact '{}': its {} touches zero at {:.9g}; whether it falls there is not decidable "
                    "at this precision; it counts as not fallen",
                    model_.contacts[contact_of_guard(slot)].name,
                    to_string(segment_.decision->guards[slot].kind), said_time(model_, t)));
  else if (touches_ == most_touches + 1)
    warnings.emplace_back("more guards touch zero; these are not listed");
}

/// Guards that were zero when the segment began, at the end of a step without a fall.
void ExactEngine::see_unarmed(double x) {
  for (std::size_t slot = 0; slot < arming_.size(); ++slot) {
    if (arming_.idle(slot) || arming_.armed(slot)) continue;
    const GuardStart& guard = segment_.decision->guards[slot];
    contacts_[contact_of_guard(slot)].combine(guard.form, guard_.data());
    arming_.see(slot, value_at(guard_.data(), degree_, x), 4.0 * (guard.noise + drift_of(guard, x)));
  }
}

Step ExactEngine::advance() {
  const double remaining = segment_.end - t_;
  const double longest = 0.5 * static_cast<double>(most_levels) / growth_now_;
  const double scale = std::min(share_of_step() * std::min(longest, next_), remaining);
  if (std::string why = hindrance(scale); !why.empty()) return failed(std::move(why));
  ++counters.steps;
  double x = expand(scale);
  paced_ = paced_ && x == 1.0;
  next_ = (paced_ ? much_longer : longer) * scale * x;
  double end = t_ + scale * x;
  if (end > segment_.end || segment_.end - end < 0.01 * scale * x) end = segment_.end;
  x = (end - t_) / scale;
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    contacts_[c].fill(model_.contacts[c], c, series_, degree_);

  const Earliest first = earliest_fall(x);
  if (first.lost) return failed(overflow);
  step_ = {};
  step_.begin = t_;
  if (first.slot) {
    step_.kind = Step::Kind::event;
    step_.fired = {{contact_of_guard(*first.slot), segment_.decision->guards[*first.slot].kind,
                    !arming_.armed(*first.slot)}};
    x *= first.at;
    end = t_ + scale * x;
  } else {
    see_unarmed(x);
  }
  step_.end = end;
  step_.resolution = resolution_at(end, end - t_);
  turns_.find(contacts_, series_, x);
  end_x_ = x;
  evaluate_at(x, end_);  // sharper than at the rounded time
  t_ = end;
  // Roundoff in g'' adds up twice over a long phase.
  hold(model_, *segment_.decision->system, *segment_.forcing, t_, end_.u, end_.v);
  return step_;
}

void ExactEngine::evaluate(double t, Point& point) {
  if (t == t_ && end_.u.size() > 0) {
    point = end_;
    return;
  }
  evaluate_at((t - series_.t) / series_.scale, point);
}

void ExactEngine::glimpse(double t, Point& point) {
  if (t == t_ && end_.u.size() > 0) return evaluate(t, point);
  point.a.resize(0);
  place_at((t - series_.t) / series_.scale, point);
}

std::optional<std::vector<Stepper::ContactTurn>> ExactEngine::contact_turns() const {
  std::vector<ContactTurn> result;
  for (const TurningPoints::Turn& turn : turns_.turns()) result.push_back({turn.contact(), turn.time});
  return result;
}

/// The same sums as place_at, of the degrees of freedom and forces of one contact.
void ExactEngine::glimpse(double t, std::size_t contact, Point& point) {
  if (t == t_ && end_.u.size() > 0) return evaluate(t, point);
  const double x = (t - series_.t) / series_.scale;
  point.a.resize(0);
  point.u.resize(series_.u.rows());
  point.v.resize(series_.u.rows());
  point.forces.resize(series_.forces.rows());
  const Contact& c = model_.contacts[contact];
  for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
    for (const auto& term : form->terms) {
      const auto i = static_cast<Eigen::Index>(term.first);
      double u = 0.0, v = 0.0;
      for (auto k = static_cast<Eigen::Index>(degree_) + 1; k-- > 0;) {
        u = u * x + series_.u(i, k);
        v = v * x + static_cast<double>(k + 1) / series_.scale * series_.u(i, k + 1);
      }
      point.u[i] = u;
      point.v[i] = v;
    }
  for (const std::size_t slot : {normal_slot(contact), tangent_slot(contact)}) {
    const auto i = static_cast<Eigen::Index>(slot);
    double f = 0.0;
    for (auto k = static_cast<Eigen::Index>(degree_) + 1; k-- > 0;) f = f * x + series_.forces(i, k);
    point.forces[i] = f;
  }
}

/// All but accelerations.
void ExactEngine::place_at(double x, Point& point) const {
  const auto n = static_cast<std::size_t>(series_.u.rows());
  point.u.setZero(series_.u.rows());
  point.v.setZero(series_.u.rows());
  point.forces.setZero(series_.forces.rows());
  double *u = point.u.data(), *v = point.v.data(), *f = point.forces.data();
  const auto forces = static_cast<std::size_t>(series_.forces.rows());
  for (std::size_t k = degree_ + 1; k-- > 0;) {
    const double* c0 = series_.u.data() + k * n;
    const double* c1 = c0 + n;
    const double first = static_cast<double>(k + 1) / series_.scale;
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = u[i] * x + c0[i];
      v[i] = v[i] * x + first * c1[i];
    }
    const double* g = series_.forces.data() + k * forces;
    for (std::size_t i = 0; i < forces; ++i) f[i] = f[i] * x + g[i];
  }
}

void ExactEngine::evaluate_at(double x, Point& point) const {
  place_at(x, point);
  const auto n = static_cast<std::size_t>(series_.u.rows());
  point.a.setZero(series_.u.rows());
  double* a = point.a.data();
  for (std::size_t k = degree_ + 1; k-- > 0;) {
    const double* c2 = series_.u.data() + (k + 2) * n;
    const double first = static_cast<double>(k + 1) / series_.scale;
    const double second = first * static_cast<double>(k + 2) / series_.scale;
    for (std::size_t i = 0; i < n; ++i) a[i] = a[i] * x + second * c2[i];
  }
}

void ExactEngine::integrate(double from, double to, Works& works) {
  works_.add(segment_.decision->mode, *segment_.forcing, series_, contacts_, degree_, from, to, works);
}

double ExactEngine::residual() { return imbalance(model_, structure_, *segment_.forcing, t_, end_); }

}  // namespace signorini
