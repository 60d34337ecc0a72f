#include "contact/friction.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::contact {
namespace {

/// Taylor coefficient E_k of E = exp(g) times a constant, from E_0 ... E_(k-1) and g_0 ... g_k.
double next_exponential_coefficient(const std::vector<double>& g, const std::vector<double>& e) {
  const std::size_t k = e.size();
  double sum = 0.0;
  for (std::size_t j = 1; j <= k; ++j) sum += static_cast<double>(j) * g[j] * e[k - j];
  return sum / static_cast<double>(k);
}

}  // namespace

double sliding_friction(const Contact& contact, double along) {
  const Friction& f = contact.friction;
  if (!f.is_rate_dependent()) return f.kinetic;
  // Below zero slip rate, rising friction continues as a straight line, because the exponential would grow without bound.
  if (f.is_rate_strengthening() && along < 0.0)
    return f.static_ + (f.kinetic - f.static_) * along / f.decay_velocity();
  return f.kinetic + (f.static_ - f.kinetic) * std::exp(-along / f.decay_velocity());
}

double sliding_friction_slope(const Contact& contact, double along) {
  const Friction& f = contact.friction;
  if (!f.is_rate_dependent()) return 0.0;
  if (f.is_rate_strengthening() && along < 0.0) return (f.kinetic - f.static_) / f.decay_velocity();
  return (f.kinetic - sliding_friction(contact, along)) / f.decay_velocity();
}

Form sliding_row(int s, double f) {
  Form row;
  row.T = 1.0;
  row.N = s * f;
  return row;
}

double sliding_row_value(const Contact& contact, int s, const ContactMotion& m) {
  if (contact.friction.is_load_dependent()) return m.T - s * friction_limit(contact.friction, -m.N);
  return m.T + s * sliding_friction(contact, s * m.vt) * m.N;
}

Form sliding_row_tangent(const Contact& contact, int s, const ContactMotion& m) {
  if (contact.friction.is_load_dependent())
    return sliding_row(s, friction_limit_slope(contact.friction, -m.N));
  Form row = sliding_row(s, sliding_friction(contact, s * m.vt));
  row.vt = sliding_friction_slope(contact, s * m.vt) * m.N;
  return row;
}

void FrictionRecursion::begin(const Contact& contact, int s, double rate) {
  s_ = s;
  velocity_ = contact.friction.decay_velocity();
  const double along = s * rate;
  first_ = sliding_friction(contact, along);
  varying_.assign(1, first_ - contact.friction.kinetic);
  exponent_.assign(1, -along / velocity_);
}

void FrictionRecursion::take_rate(double rate) {
  exponent_.pop_back();
  varying_.pop_back();
  extend(rate);
}

void FrictionRecursion::extend(double rate) {
  exponent_.push_back(-s_ * rate / velocity_);
  varying_.push_back(next_exponential_coefficient(exponent_, varying_));
}

FrictionTangent::FrictionTangent(const Friction& friction, const Friction& by, int s)
    : static_(friction.static_),
      kinetic_(friction.kinetic),
      velocity_(friction.decay_velocity()),
      by_static_(by.static_),
      by_kinetic_(by.kinetic),
      by_velocity_((friction.is_rate_strengthening() ? by.velocity : by.stribeck_velocity).value_or(0.0)),
      s_(s) {}

void FrictionTangent::extend(double rate, double moved_rate) {
  const std::size_t k = e_.size();
  const double x = s_ * rate;
  exponent_.push_back(-x / velocity_);
  y_.push_back((x * by_velocity_ / velocity_ - s_ * moved_rate) / velocity_);
  e_.push_back(k == 0 ? std::exp(exponent_[0]) : next_exponential_coefficient(exponent_, e_));
  double product = 0.0;
  for (std::size_t j = 0; j <= k; ++j) product += e_[j] * y_[k - j];
  friction_rates_.push_back((k == 0 ? by_kinetic_ : 0.0) + (by_static_ - by_kinetic_) * e_[k] +
                            (static_ - kinetic_) * product);
}

double friction_limit(const Friction& f, double x) {
  if (x <= 0.0) return f.static_ * x;
  return (f.kinetic + (f.static_ - f.kinetic) * std::exp(-x / *f.force)) * x;
}

double friction_limit_slope(const Friction& f, double x) {
  if (x <= 0.0) return f.static_;
  const double ratio = x / *f.force;
  return f.kinetic + (f.static_ - f.kinetic) * (1.0 - ratio) * std::exp(-ratio);
}

void set_limit(const Contact& contact, ContactMotion& m) {
  const Friction& f = contact.friction;
  if (!f.is_load_dependent()) return;
  m.limit = friction_limit(f, -m.N);
  m.limit_rate =
      friction_limit_slope(f, -m.N) *
      (contact.normal_force_given() ? m.applied_normal_force_rate : -contact.normal_stiffness * m.vn);
}

LimitSeries::LimitSeries(const Friction& friction, double x0)
    : range_(friction.static_ - friction.kinetic),
      force_(*friction.force),
      slope_(friction_limit_slope(friction, x0)),
      x_{x0},
      e_{std::exp(-std::max(x0, 0.0) / force_)} {}

/// Part of E_k that does not depend on x_k: all terms except -x_k E_0 / Nc.
double LimitSeries::known_exponential() const {
  const std::size_t k = x_.size();
  double sum = 0.0;
  for (std::size_t j = 1; j < k; ++j) sum += static_cast<double>(j) * x_[j] * e_[k - j];
  return -sum / (force_ * static_cast<double>(k));
}

double LimitSeries::known() const {
  const std::size_t k = x_.size();
  double sum = x_[0] * known_exponential();
  for (std::size_t j = 1; j < k; ++j) sum += x_[j] * e_[k - j];
  return range_ * sum;
}

double LimitSeries::take(double x) {
  const double limit = slope_ * x + known();
  const double e = known_exponential() - x * e_[0] / force_;
  x_.push_back(x);
  e_.push_back(e);
  return limit;
}

namespace {

// Limit of the number of Newton steps: each of the first steps increases x by at least v, the last steps converge
// quadratically.
constexpr int most_steps = 200;

}  // namespace

double saturation_rate(const Friction& friction) {
  return -friction.decay_velocity() * std::log(saturation_tolerance);
}

std::optional<double> massless_slip_rate(const Friction& friction, double pull, double damping,
                                         double pressed) {
  const double slow = friction.static_, fast = friction.kinetic, v = friction.decay_velocity();
  // Below slow |N|, friction continues as a straight line, as in sliding_friction().
  if (pull <= slow * pressed) return (pull - slow * pressed) / (damping + (fast - slow) / v * pressed);
  if (!(damping > 0.0)) {
    const double rest = (fast * pressed - pull) / ((fast - slow) * pressed);
    if (!(rest > saturation_tolerance)) return std::nullopt;
    return -v * std::log(rest);
  }
  // The residual decreases and is convex in x, so Newton's method that starts below the root never exceeds the root.
  double x = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const double exponential_part = (fast - slow) * std::exp(-x / v) * pressed;
    const double step =
        (pull - damping * x - fast * pressed + exponential_part) / (damping + exponential_part / v);
    x += step;
    if (std::abs(step) <= rounding::few_operations * (std::abs(x) + v)) break;
  }
  return x;
}

}  // namespace signorini::contact
