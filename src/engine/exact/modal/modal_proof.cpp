#include "engine/exact/modal/modal_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/law.hpp"
#include "engine/events/first_root.hpp"

namespace signorini::modal {
namespace {

/// True if the guard's rate, including a bound on fast modes, is negative between the places `from` and `to` (0 to 1) of the
/// step.
bool decreases(const GuardOnStep& guard, double h, double from, double to) {
  const std::vector<double>& p = guard.p;
  std::vector<double> q(p.size() - 1);
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = -static_cast<double>(j + 1) * p[j + 1];
  for (std::size_t i = 0; i + 1 < q.size(); ++i)  // shift the polynomial to the origin `from`
    for (std::size_t j = q.size() - 1; j-- > i;) q[j] += from * q[j + 1];
  double power = 1.0, rest = 0.0;
  for (double& entry : q) {
    entry *= power;
    power *= to - from;
    rest = std::max(rest, std::abs(entry));
  }
  q[0] -= guard.fast_rate_bound * h + rounding::elimination * rest;
  return q[0] > 0.0 && events::first_root(q.data(), q.size() - 1, 0.0).kind == events::FirstRoot::Kind::none;
}

/// Returns the only zero of g between two places of the step, by the Illinois method (bracketed secants). Without a change of
/// sign: `from` if g(from) <= 0, otherwise `to`.
double only_crossing(const std::function<double(double)>& g, double from, double to) {
  double low = g(from), high = g(to);
  if (!(low > 0.0)) return from;
  if (!(high < 0.0)) return to;
  int side = 0;
  double x = from;
  for (int i = 0; i < 100; ++i) {
    const double next = from + (to - from) * low / (low - high);
    const double step = std::abs(next - x);
    x = std::clamp(next, from, to);
    const double now = g(x);
    if (now == 0.0 || (i > 0 && step <= 2.0 * rounding::eps * to)) break;
    if (now > 0.0) {
      from = x;
      low = now;
      if (side > 0) high *= 0.5;
      side = 1;
    } else {
      to = x;
      high = now;
      if (side < 0) low *= 0.5;
      side = -1;
    }
    if (to - from <= 2.0 * rounding::eps * to) break;
  }
  return x;
}

/// find_guard_zero() for a guard that starts at zero and is represented by its leading derivative. False: this representation
/// is not used any more, and the step must be repeated.
bool examine_rising_guard(GuardOnStep& guard, std::size_t slot, events::ActiveGuards& arming, double& limit) {
  std::vector<double>& q = guard.p;
  double scale = 0.0;
  for (const double entry : q) scale += std::abs(entry);
  // Subtract the bounds on fast modes and rounding, but at most half of the derivative at x = 0, which the decision has proved
  // to be positive.
  q[0] -= std::min(guard.fast_bound + rounding::many_operations * scale, 0.5 * q[0]);
  if (!(q[0] > 0.0)) {
    arming.discard_leading_order(slot);
    return false;
  }
  const events::FirstRoot fall = events::first_root(q.data(), q.size() - 1, 0.0);
  if (fall.kind == events::FirstRoot::Kind::crossing) limit = std::min(limit, 0.9 * fall.x);
  return true;
}

}  // namespace

std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h) {
  std::vector<double> q(p.begin() + static_cast<std::ptrdiff_t>(m), p.end());
  double factor = 1.0;
  for (std::size_t i = 1; i <= m; ++i) factor *= static_cast<double>(i) / h;
  for (std::size_t j = 0; j < q.size(); ++j) {
    q[j] *= factor;
    factor *= static_cast<double>(j + m + 1) / static_cast<double>(j + 1);
  }
  return q;
}

bool find_guard_zero(GuardOnStep& guard, std::size_t slot, double h,
                     const std::function<double(double)>& value_at, events::ActiveGuards& arming,
                     Passage& passage, double& limit, double& event) {
  std::vector<double>& p = guard.p;
  const std::size_t degree = p.size() - 1;
  const auto fires = [&](double x) {
    if (x >= event) return;
    event = x;
    passage.triggered = slot;
    passage.unseen = !guard.armed;
  };
  if (guard.leading_order > 0) return examine_rising_guard(guard, slot, arming, limit);
  if (!guard.armed) {
    p[0] += guard.noise + guard.slack;
    const events::FirstRoot fall = events::first_root(p.data(), degree, 0.0);
    if (fall.kind == events::FirstRoot::Kind::crossing) fires(fall.x);
    return true;
  }
  if (guard.fast_bound == 0.0) {
    const events::FirstRoot fall = events::first_root(p.data(), degree, guard.slack);
    if (fall.kind == events::FirstRoot::Kind::crossing) fires(fall.x);
    if (fall.kind == events::FirstRoot::Kind::touch) passage.touches.push_back(slot);
    return true;
  }
  const double off = guard.slack + guard.fast_bound, start = p[0];
  p[0] = start - 2.0 * off;
  const events::FirstRoot doubtful = events::first_root(p.data(), degree, 0.0);
  if (doubtful.kind != events::FirstRoot::Kind::crossing || doubtful.x >= event) return true;
  p[0] = start + off;
  const events::FirstRoot certain = events::first_root(p.data(), degree, 0.0);
  if (certain.kind == events::FirstRoot::Kind::crossing && decreases(guard, h, doubtful.x, certain.x))
    fires(only_crossing(value_at, doubtful.x, certain.x));
  else
    limit = std::min(limit, doubtful.x);
  return true;
}

std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event, double h,
                                   bool& full) {
  // limit == 0: a guard is so small that the bound on the fast modes exceeds it, so the next attempt has no fast modes.
  if (doubted || (limit == 0.0 && !full)) {
    full = full || !doubted;
    return std::nullopt;
  }
  if (limit < event) passage.triggered.reset();
  const double x = std::min(limit, event > 1.0 ? 1.0 : event);
  full = !passage.triggered && x < 1e-3;
  passage.length = h * x;
  return passage;
}

double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                   std::vector<double>& p) {
  double power = 1.0;
  for (std::size_t j = 0; j <= degree; ++j, power *= x_end) p[j] = sign * a[j] * power;
  p[0] += above;
  if (!(p[0] > 0.0)) return 0.0;
  const events::FirstRoot fall = events::first_root(p.data(), degree, 0.0);
  return fall.kind == events::FirstRoot::Kind::none ? 1.0 : fall.x;
}

namespace {

constexpr double quarter = 0.25;  // limit of the sum of all fast modes, as a part of the guard
constexpr double rounding_of_guard = 1.0 / 16.0;  // part of the decision's rounding bound in a guard's slack

double sum_of(const Amplitudes& weights, const Amplitudes& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < values.real.size(); ++k) sum += weights.real[k] * values.real[k];
  for (std::size_t k = 0; k < values.pair.size(); ++k)
    sum += real_contribution(weights.pair[k] * values.pair[k]);
  return sum;
}

double size_of_sum(const Amplitudes& weights, const Amplitudes& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < values.real.size(); ++k) sum += std::abs(weights.real[k] * values.real[k]);
  for (std::size_t k = 0; k < values.pair.size(); ++k) sum += 2.0 * size_of(weights.pair[k] * values.pair[k]);
  return sum;
}

/// Replaces N and T in the guard's form by their laws. Returns the coefficients of g, ut, vn and vt; constant: receives the
/// constant term.
ModalKinematics reduced(const Form& form, const ForceLaw& law, double& constant) {
  ModalKinematics result;
  const double N = form.N;
  result.gap = form.gap + N * law.N_gap + form.T * law.T_gap;
  result.ut = form.ut + form.T * law.T_ut;
  result.vn = form.vn;
  result.vt = form.vt;
  constant = form.constant + N * law.N_constant + form.T * law.T_constant;
  return result;
}

}  // namespace

ModalProof::ModalProof(const Model& model, double alpha)
    : model_(model), alpha_(alpha), slow_(model.contacts.size()) {}

void ModalProof::start(const engine::Segment& segment, const StateModes& state,
                       const Oscillators& oscillators, const Amplitudes& forces) {
  state_ = &state;
  oscillators_ = &oscillators;
  forces_ = &forces;
  decision_ = segment.decision;
  all_slow_ = false;
  const std::size_t contacts = model_.contacts.size();
  laws_.clear();
  surface_.clear();
  for (std::size_t c = 0; c < contacts; ++c) {
    laws_.push_back(force_law(model_.contacts[c], decision_->states[c],
                              segment.forcing->applied_normal_force(c, decision_->jet.t, 0)));
    surface_.push_back(segment.forcing->surface(c, decision_->jet.t, 0));
  }
  const std::vector<double>& l = oscillators.real();
  const auto still = [&](const std::vector<Amplitudes>& rows, std::vector<std::vector<double>>& out) {
    out.assign(contacts, std::vector<double>(l.size() + 1, 0.0));
    for (std::size_t c = 0; c < contacts; ++c)
      for (std::size_t k = l.size(); k-- > 0;)
        out[c][k] = out[c][k + 1] +
                    (oscillators.damped_omega()[k] > 0.0 ? rows[c].real[k] * forces.real[k] / l[k] : 0.0);
  };
  still(state.normal, static_normal_);
  still(state.tangent, static_tangent_);
  watch(segment, state);
}

void ModalProof::watch(const engine::Segment& segment, const StateModes& state) {
  guards_.clear();
  active_guards_.start(decision_->guards);
  const std::vector<double>& l = oscillators_->real();
  for (std::size_t slot = 0; slot < decision_->guards.size(); ++slot) {
    if (active_guards_.idle(slot)) continue;
    const Form& form = decision_->form(slot);
    const std::size_t c = decision_->layout.contact_of_guard(slot);
    Watched guard;
    guard.slot = slot;
    guard.noise = decision_->guards[slot].noise;
    guard.form = reduced(form, laws_[c], guard.constant);
    guard.constant +=
        form.applied_normal_force * segment.forcing->applied_normal_force(c, decision_->jet.t, 0);
    guard.constant += guard.form.gap * model_.contacts[c].gap - guard.form.ut * surface_[c];
    const Amplitudes &n = state.normal[c], &t = state.tangent[c];
    const auto mix = [&](double a, double b, Amplitudes& out) {
      out.real.resize(n.real.size());
      out.pair.resize(n.pair.size());
      for (std::size_t k = 0; k < n.real.size(); ++k) out.real[k] = a * n.real[k] + b * t.real[k];
      for (std::size_t k = 0; k < n.pair.size(); ++k) out.pair[k] = n.pair[k] * a + t.pair[k] * b;
    };
    mix(guard.form.gap, guard.form.ut, guard.place);
    mix(guard.form.vn, guard.form.vt, guard.rate);
    for (std::size_t k = 0; k < l.size(); ++k)
      guard.size.push_back(std::abs(guard.place.real[k]) +
                           std::abs(guard.rate.real[k]) * std::sqrt(std::abs(l[k])));
    guards_.push_back(std::move(guard));
  }
}

double ModalProof::value(const Watched& guard, const ModalPoint& at) const {
  return guard.constant + sum_of(guard.place, at.z) + sum_of(guard.rate, at.rate);
}

double ModalProof::magnitude(std::size_t slot, const ModalPoint& at) const {
  const auto guard =
      std::find_if(guards_.begin(), guards_.end(), [&](const Watched& w) { return w.slot == slot; });
  if (guard == guards_.end()) return 0.0;
  return std::abs(guard->constant) + size_of_sum(guard->place, at.z) + size_of_sum(guard->rate, at.rate);
}

/// Value of the guard's leading derivative: its time derivative of order leading_order().
double ModalProof::derivative(const Watched& guard, const ModalPoint& at) const {
  const std::size_t order = active_guards_.leading_order(guard.slot);
  double sum = 0.0;
  const auto add = [&](auto z, auto rate, auto p, auto l, auto place, auto slope) {
    for (std::size_t j = 0; j < order; ++j) {
      const auto next = (j == 0 ? p : decltype(p)(0.0)) - z * l - rate * alpha_;
      z = rate;
      rate = next;
    }
    sum += real_contribution(place * z + slope * rate);
  };
  for (std::size_t k = 0; k < at.z.real.size(); ++k)
    add(at.z.real[k], at.rate.real[k], forces_->real[k], oscillators_->real()[k], guard.place.real[k],
        guard.rate.real[k]);
  for (std::size_t k = 0; k < at.z.pair.size(); ++k)
    add(at.z.pair[k], at.rate.pair[k], forces_->pair[k], oscillators_->pairs()[k], guard.place.pair[k],
        guard.rate.pair[k]);
  return sum;
}

void ModalProof::rearm(const ModalPoint& at) {
  for (const Watched& guard : guards_)
    if (!active_guards_.armed(guard.slot))
      active_guards_.update(guard.slot, value(guard, at), 4.0 * guard.noise);
}

ModalKinematics ModalProof::kinematics(std::size_t c, const ModalPoint& at) const {
  return {model_.contacts[c].gap + sum_of(state_->normal[c], at.z),
          sum_of(state_->tangent[c], at.z) - surface_[c], sum_of(state_->normal[c], at.rate),
          sum_of(state_->tangent[c], at.rate)};
}

void ModalProof::measure(const ModalPoint& at) {
  oscillators_->amplitudes(at, *forces_, amplitude_, pair_amplitude_);
  for (Watched& guard : guards_) guard.now = starts_at_zero(guard) ? derivative(guard, at) : value(guard, at);
  const std::size_t contacts = model_.contacts.size();
  normal_size_.resize(contacts);
  tangent_size_.resize(contacts);
  for (std::size_t c = 0; c < contacts; ++c) {
    normal_size_[c] = {std::abs(model_.contacts[c].gap) + size_of_sum(state_->normal[c], at.z),
                       size_of_sum(state_->normal[c], at.rate)};
    tangent_size_[c] = {std::abs(surface_[c]) + size_of_sum(state_->tangent[c], at.z),
                        size_of_sum(state_->tangent[c], at.rate)};
  }
}

/// Coefficient |w_k| of mode k in the bound on the guard; for the leading derivative of order m: |w_k| omega_k^m.
double ModalProof::weight_of(const Watched& guard, std::size_t k) const {
  double weight = guard.size[k];
  if (starts_at_zero(guard)) weight *= std::pow(std::abs(oscillators_->real()[k]), 0.5 * order_of(guard));
  return weight;
}

std::size_t ModalProof::first_fast() const {
  const std::size_t n = amplitude_.size();
  std::size_t first = all_slow_ ? n : 0;
  for (const Watched& guard : guards_) {
    if (unknown(guard) || !(guard.now > 0.0)) return n;
    double sum = 0.0;
    std::size_t k = n;
    for (; k > first; --k) {
      sum += weight_of(guard, k - 1) * amplitude_[k - 1];
      if (sum > quarter * guard.now) break;
    }
    first = std::max(first, k);
  }
  return first;
}

void ModalProof::choose_step(double remaining) {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  const std::size_t first = first_fast();
  h_ = std::min(remaining, max_decay / alpha_);
  if (!l.empty()) {
    const double fastest = l[std::min(first, l.size() - 1)];
    if (fastest > 0.0) h_ = std::min(h_, max_slow_angle / std::sqrt(fastest));
  }
  // Pairs of complex modes may grow. So every pair with a significant contribution to a guard is treated as slow, and limits
  // the step length.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const bool shows = std::any_of(guards_.begin(), guards_.end(), [&](const Watched& guard) {
      const double root = std::sqrt(size_of(pairs[k]));
      const double most =
          2.0 * (size_of(guard.place.pair[k]) + size_of(guard.rate.pair[k]) * root) * pair_amplitude_[k];
      const double order = order_of(guard);
      return !(4.0 * most * std::pow(root, order) <
               0.5 * quarter * guard.now / static_cast<double>(pairs.size()));
    });
    if (shows || first == l.size()) h_ = std::min(h_, max_slow_angle / std::sqrt(size_of(pairs[k])));
  }
  split_modes(first == l.size());
}

void ModalProof::bound_fast_modes() {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  for (Watched& guard : guards_) {
    guard.fast_bound = guard.fast_rate_bound = 0.0;
    for (std::size_t k = fast_; k < l.size(); ++k) {
      const double fast_part = weight_of(guard, k) * amplitude_[k];
      guard.fast_bound += fast_part;
      guard.fast_rate_bound += fast_part * std::sqrt(l[k]);
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (pair_slow_[k]) continue;
      const double root = std::sqrt(size_of(pairs[k]));
      // growth e^(gamma h) with gamma <= |Im w|
      const double growth =
          std::exp(std::abs(complex_sqrt(pairs[k] - Complex(0.25 * alpha_ * alpha_)).im) * h_);
      const double order = order_of(guard);
      const double fast_part = 2.0 * growth * pair_amplitude_[k] * std::pow(root, order) *
                               (size_of(guard.place.pair[k]) + size_of(guard.rate.pair[k]) * root);
      guard.fast_bound += fast_part;
      guard.fast_rate_bound += fast_part * root;
    }
  }
}

/// Computes the polynomial p of the guard's slow part, and the bound `slack` on the error of p.
void ModalProof::combine(const Watched& guard, std::vector<double>& p, double& slack) const {
  const std::size_t c = decision_->layout.contact_of_guard(guard.slot);
  p.assign(degree_ + 1, 0.0);
  slow_[c].combine(decision_->form(guard.slot), p.data());
  const ModalKinematics& form = guard.form;
  const auto with = [&](const Size& n, const Size& t) {
    return std::abs(form.gap) * n.place + std::abs(form.ut) * t.place + std::abs(form.vn) * n.rate +
           std::abs(form.vt) * t.rate;
  };
  slack = with(normal_rest_[c], tangent_rest_[c]) +
          rounding::few_operations * (with(normal_size_[c], tangent_size_[c]) + std::abs(guard.constant)) +
          rounding_of_guard * guard.noise;
}

bool ModalProof::find_zero(const Watched& guard, const ModalPoint& at, Passage& passage, double& limit,
                           double& event) {
  GuardOnStep on_step;
  combine(guard, on_step.p, on_step.slack);
  on_step.fast_bound = guard.fast_bound;
  on_step.fast_rate_bound = guard.fast_rate_bound;
  on_step.noise = guard.noise;
  on_step.leading_order = active_guards_.leading_order(guard.slot);
  on_step.armed = active_guards_.armed(guard.slot);
  if (on_step.leading_order > 0) on_step.p = derivative_of(on_step.p, on_step.leading_order, h_);
  ModalPoint point;
  const auto value_at = [&](double x) {
    oscillators_->advance(at, *forces_, h_ * x, point);
    return value(guard, point);
  };
  return find_guard_zero(on_step, guard.slot, h_, value_at, active_guards_, passage, limit, event);
}

Passage ModalProof::pass(const ModalPoint& at, double remaining) {
  measure(at);
  for (const Watched& guard : guards_)
    if (starts_at_zero(guard) && !(guard.now > 0.0)) active_guards_.discard_leading_order(guard.slot);
  choose_step(remaining);
  bound_fast_modes();
  expand(at);
  Passage passage;
  double limit = 1.0, event = 2.0;
  bool doubted = false;
  for (const Watched& guard : guards_) doubted = !find_zero(guard, at, passage, limit, event) || doubted;
  const auto done = end_of_step(std::move(passage), doubted, limit, event, h_, all_slow_);
  return done ? *done : pass(at, remaining);
}

}  // namespace signorini::modal
