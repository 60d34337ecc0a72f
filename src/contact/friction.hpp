// friction.hpp: magnitude of the friction force, and its derivatives.
//
//   stick   |T| <= fs |N|
//   slip s  T + s f(s p') N = 0,   f(x) = fk + (fs - fk) exp(-x / v_s)    without v_s: f = fk
//
// fs > fk: Stribeck friction, which decreases with the slip rate. fs < fk: friction that rises with the slip rate, from fs
// (slow) to fk (fast).
//
// The linearised slip row at a motion is dT + s f dN + f' N dvt. Taylor coefficients along the motion, with E = exp(g):
//   k E_k = sum_j j g_j E_(k-j),   f_k = (fs - fk) E_k,   T_k + s f_0 N_k = -s sum_(j = 1..k) f_j N_(k-j)
// Hence f_0 is a matrix entry, and the right-hand side is known before the equations are solved for N_k and T_k.
//
// The derivatives of these equations with respect to a parameter p are
//   T_p + s f N_p + s f_p N = 0,   f_p = fk_p (1 - E) + fs_p E + (fs - fk) E ( x v_p/v_s - x_p ) / v_s,   x = s p'
//
// A friction law consists of the functions in this file and its constants (friction_constants); all other code calls these
// functions. Unit: f is dimensionless.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "signorini/contact.hpp"
#include "signorini/scene.hpp"

namespace signorini::contact {

// Friction whose coefficient depends on the normal force.
//
//   |T| <= F in stick,  T = s F in slip,  F(x) = f(x) x,
//   f(x) = fh + (fl - fh) exp(-x / Nc),  x = |N|              fl, fh: f for light and heavy loads, Nc: `force`
//   F'(x) = fh + (fl - fh) (1 - x / Nc) exp(-x / Nc)
//
// F is smooth, F(0) = 0 and F'(0) = fl. For x < 0, F continues as a straight line, so that a root finder may evaluate F
// slightly beyond a separation. Taylor coefficients along a series of x, with E = exp(-x / Nc):
//   k E_k = -(1 / Nc) sum_(j = 1..k) j x_j E_(k-j),   F_k = fh x_k + (fl - fh) sum_(j = 0..k) x_j E_(k-j)
// F'(x_0) x_k is the part of F_k that depends on x_k. Units: F, x and Nc are forces, f is dimensionless.

/// Limit F at the compression x = -N, and slope F'(x), for friction that depends on N. Units: force; dimensionless.
[[nodiscard]] double friction_limit(const Friction& friction, double x);
[[nodiscard]] double friction_limit_slope(const Friction& friction, double x);

/// Sets the members `limit` and `limit_rate` in the motion m of a closed contact, from N, g' and q'. Does nothing if friction
/// does not depend on N.
void set_limit(const Contact& contact, ContactMotion& m);

/// Taylor coefficients F_k of the friction limit F(x), from the Taylor coefficients x_k of the compression.
class LimitSeries {
 public:
  LimitSeries(const Friction& friction, double x0);

  /// Slope F'(x_0) of the limit.
  [[nodiscard]] double slope() const { return slope_; }
  /// Part F_k - F'(x_0) x_k of the next coefficient F_k. This part does not depend on x_k.
  [[nodiscard]] double known() const;
  /// Appends the next coefficient x_k, for k = 1, 2, ...; returns F_k.
  double take(double x);

 private:
  [[nodiscard]] double known_exponential() const;

  double range_, force_;  // fl - fh; Nc
  double slope_;
  std::vector<double> x_, e_;  // coefficients x_k, and coefficients of exp(-x / Nc)
};

/// static_friction: greatest ratio |T| / |N| in stick, over all N. kinetic_friction: least ratio |T| / |N| in slip, over all
/// slip rates.
[[nodiscard]] inline double static_friction(const Contact& contact) {
  const Friction& f = contact.friction;
  return f.is_load_dependent() ? std::max(f.static_, f.kinetic) : f.static_;
}
[[nodiscard]] inline double kinetic_friction(const Contact& contact) {
  return contact.friction.is_rate_strengthening() ? contact.friction.static_ : contact.friction.kinetic;
}
/// Ratio |T| / |N| in a slipping state, or its least value if it varies with the slip rate. In a state at the static limit:
/// the static coefficient.
[[nodiscard]] inline double slipping_friction(const Contact& contact, State state) {
  return is_at_static_limit(state) ? static_friction(contact) : kinetic_friction(contact);
}
/// Friction force at the normal force N <= 0: sticking_limit is the greatest |T| in stick, sliding_limit is |T| when slip
/// begins. Unit: force.
[[nodiscard]] inline double sticking_limit(const Contact& contact, double N) {
  const Friction& f = contact.friction;
  return f.is_load_dependent() ? friction_limit(f, -N) : f.static_ * (0.0 - N);
}
[[nodiscard]] inline double sliding_limit(const Contact& contact, double N) {
  return contact.friction.is_load_dependent() ? friction_limit(contact.friction, -N)
                                              : kinetic_friction(contact) * (0.0 - N);
}
/// Coefficient of friction at the slip rate `along` = s p', and its derivative with respect to `along`. Both are also defined
/// for `along` < 0.
[[nodiscard]] double sliding_friction(const Contact& contact, double along);
[[nodiscard]] double sliding_friction_slope(const Contact& contact, double along);

/// True if the coefficient depends on the slip rate or on N, so that the row of a slipping contact is nonlinear.
[[nodiscard]] inline bool friction_varies(const Contact& contact) {
  return contact.friction.is_rate_dependent() || contact.friction.is_load_dependent();
}
/// Name of varying friction in messages; only valid if friction_varies().
[[nodiscard]] inline const char* friction_description(const Contact& contact) {
  return contact.friction.is_load_dependent() ? "friction that depends on the normal force"
                                              : "friction that depends on the slip rate";
}
/// True if the contact slips in this state and its friction coefficient varies.
[[nodiscard]] inline bool slips_nonlinearly(const Contact& contact, State state) {
  return friction_varies(contact) && slip_sign(state) != 0;
}

/// Linear row of a contact that slips in direction s with the coefficient f: T + s f N.
[[nodiscard]] Form sliding_row(int s, double f);
/// Residual of the nonlinear slip row at a motion m, for a contact that slips in direction s. Unit: force.
[[nodiscard]] double sliding_row_value(const Contact& contact, int s, const ContactMotion& m);
/// Linearisation of the nonlinear slip row at a motion m.
[[nodiscard]] Form sliding_row_tangent(const Contact& contact, int s, const ContactMotion& m);

/// Taylor coefficients f_k of the coefficient of friction, from the Taylor coefficients of the slip rate ut'.
class FrictionRecursion {
 public:
  /// Starts the series of a contact that slips in direction s. rate: coefficient 0 of the Taylor series of ut'.
  void begin(const Contact& contact, int s, double rate);
  /// Initial coefficient of friction f_0, the factor in the row entry s f_0 N.
  [[nodiscard]] double first() const { return first_; }
  /// Appends coefficient k of ut', for k = 1, 2, ...; returns s sum_(j = 1..k) f_j N_(k-j). applied(i) must return N_i.
  template <class Pressing>
  [[nodiscard]] double next(double rate, const Pressing& applied) {
    extend(rate);
    return known(applied);
  }
  /// Returns the sum of next() without the part that depends on coefficient k of ut', for use if coefficient k is still
  /// unknown. take_rate() must be called when coefficient k is known.
  template <class Pressing>
  [[nodiscard]] double without_rate(const Pressing& applied) {
    extend(0.0);
    return known(applied);
  }
  /// Sets coefficient k of ut' after without_rate().
  void take_rate(double rate);

 private:
  template <class Pressing>
  [[nodiscard]] double known(const Pressing& applied) const {
    const std::size_t k = varying_.size() - 1;
    double known = 0.0;
    for (std::size_t j = 1; j <= k; ++j) known += varying_[j] * applied(k - j);
    return s_ * known;
  }

  void extend(double rate);

  double first_ = 0.0, velocity_ = 0.0;  // f_0, v_s
  int s_ = 0;
  std::vector<double> exponent_, varying_;  // g_k, (fs - fk) E_k
};

/// Derivative of the friction series with respect to a parameter p, computed together with the Taylor coefficients of the
/// motion. At order k only N_p,k is unknown: x_k and x_p,k, the coefficients of the slip rate, follow from order k - 1.
class FrictionTangent {
 public:
  /// s: direction of slip. by: derivatives of the friction constants with respect to the parameter.
  FrictionTangent(const Friction& friction, const Friction& by, int s);

  /// Appends coefficient k of ut' and of its derivative with respect to p, for k = 0, 1, ... applied(i) returns N_i, moved(i)
  /// returns N_p,i. Returns s sum_(j = 1..k) f_j N_p,(k-j) + s sum_(j = 0..k) f_p,j N_(k-j).
  template <class Pressing, class Moved>
  [[nodiscard]] double next(double rate, double moved_rate, const Pressing& applied, const Moved& moved) {
    extend(rate, moved_rate);
    const std::size_t k = e_.size() - 1;
    double sum = 0.0;
    for (std::size_t j = 1; j <= k; ++j) sum += (static_ - kinetic_) * e_[j] * moved(k - j);
    for (std::size_t j = 0; j <= k; ++j) sum += friction_rates_[j] * applied(k - j);
    return s_ * sum;
  }

 private:
  void extend(double rate, double moved_rate);

  double static_, kinetic_, velocity_ = 1.0;           // fs, fk, v_s
  double by_static_, by_kinetic_, by_velocity_ = 0.0;  // derivatives of fs, fk, v_s with respect to p
  int s_;
  std::vector<double> exponent_, e_, y_, friction_rates_;  // -x/v_s, E, ( x v_p/v_s - x_p )/v_s and f_p
};

// Slip rate of a massless sliding point whose friction rises with the slip rate.
//
//   pull - c x = f(x) |N|,   f(x) = fast - (fast - slow) exp(-x / v)      x = s p', c: dashpot parallel to kt
//   c = 0:  x = -v ln m,   m = (fast |N| - pull) / ((fast - slow) |N|)
//
// The spring force T acts on the point, so friction determines the slip rate. The left side decreases with x and the right
// side increases, hence x is unique. If pull < slow |N|, x is negative and the point sticks. If c = 0 and pull >= fast |N|,
// there is no solution, and the point moves instantaneously. Units: x, v length/time.

/// Distance of the coefficient from `fast`, as a fraction of fast - slow, below which the coefficient is treated as `fast`; the
/// pull then does not determine the rate. Chosen value; tests/unit/contact/massless_slip.cpp depends on it.
inline constexpr double saturation_tolerance = 1e-8;

/// Slip rate beyond which the coefficient is treated as `fast`: -v ln(saturation_tolerance). Unit: length/time.
[[nodiscard]] double saturation_rate(const Friction& friction);

/// Slip rate x. pull: force along the slip at x = 0; pressed: |N| > 0; damping >= 0. nullopt: friction has reached its
/// greatest value, so the pull does not determine x.
[[nodiscard]] std::optional<double> massless_slip_rate(const Friction& friction, double pull, double damping,
                                                       double pressed);

}  // namespace signorini::contact
