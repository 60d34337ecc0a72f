// dense_output.hpp: the motion on the last step of an engine, and what can be asked of it.
//
//   u(t), v(t), forces(t)   begin <= t <= end       evaluate, evaluate_watched, interpolate; accelerate adds a(t)
//   int powers dt                                   integrate
//   |M a + C v + K u + n N + t T - P|               residual, at the end
//
// Facts about the step as a whole (where something turns, its series, how fast it turns, its fast modes) are one
// struct, StepFacts. An engine fills it when it is asked for; what it points to lives until the engine's next step.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "engine/falls/turning_points.hpp"
#include "engine/ripple.hpp"
#include "motion/powers.hpp"
#include "motion/series.hpp"

namespace signorini {

/// The motion on the last step as a series: its end is at t + scale x.
struct Expansion {
  const Series* series = nullptr;  ///< null: the engine knows none
  std::size_t degree = 0;          ///< up to which u, v, a and forces are complete
  double x = 0.0;
  const ModeSystem* system = nullptr;  ///< with friction at the slip rates where the series begins
};

/// Bounds on the fast part of the last step, where an engine follows modes.
class FastModes {
 public:
  virtual ~FastModes() = default;
  /// Bounds on all that turns faster than omega, rad per time. nullopt: not known, or something does that does not swing.
  [[nodiscard]] virtual std::optional<Ripple> fast_mode_bound(double omega) const = 0;
  /// The sizes of the terms that u, v, a and forces of the step are sums of, fast modes or not. Rounding is relative to
  /// that.
  [[nodiscard]] virtual Ripple term_sizes() const = 0;
  /// The greatest form . u of all u with |u|_M = 1.
  [[nodiscard]] virtual double form_norm(const Combination& form) const = 0;
};

struct StepFacts {
  /// Times inside the step where N, T, g or ut of a contact turns beyond all its values before, ascending.
  std::span<const double> turning_points = {};
  /// Whose turns they are, in no order. Null: evaluate_watched() of all contacts costs no more than of one.
  const std::vector<TurningPoints::Turn>* contact_turns = nullptr;
  Expansion expansion = {};
  /// By how much roundings of sums over modes are greater than where these are orthogonal: greatest |x| |y| of the modes
  /// that the step was followed in, y . x = 1; or more, where their terms are greater than the motion and cancel.
  /// 1: it was followed in none.
  double eigenvector_condition = 1.0;
  /// By how many radians u, v, a and forces turn at most, forcing aside: polynomials of degree n by n pi. Infinite: the
  /// frequencies of the model are the bound.
  double radians = std::numeric_limits<double>::infinity();
  const FastModes* fast_modes = nullptr;  ///< null: the engine knows no modes of the model
};

class DenseOutput {
 public:
  virtual ~DenseOutput() = default;
  /// u, v and forces at begin <= t <= end.
  virtual void evaluate(double t, Point& point) = 0;
  /// The same of the entries of u and v that are watched, those of contacts and EngineParts::watched; others may be no
  /// numbers. contact: no more than this one touches, where StepFacts::contact_turns names any.
  virtual void evaluate_watched(double t, std::optional<std::size_t> /*contact*/, Point& point) {
    evaluate(t, point);
  }
  /// Puts accelerations into a point that was evaluated at t, where they are missing.
  virtual void accelerate(double /*t*/, Point& /*point*/) {}
  /// evaluate and accelerate, but as cheap as the engine has it: of fixed steps between their ends.
  virtual void interpolate(double t, Point& point) {
    evaluate(t, point);
    accelerate(t, point);
  }
  /// Adds the integrals of all powers over the part [from, to].
  virtual void integrate(double from, double to, Works& works) = 0;
  /// Greatest entry of the residual of the equation of motion at the end. Unit: force.
  [[nodiscard]] virtual double residual() = 0;
  [[nodiscard]] virtual StepFacts facts() const = 0;
};

}  // namespace signorini
