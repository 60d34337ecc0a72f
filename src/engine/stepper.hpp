// stepper.hpp: what an engine does: advance the motion in one mode to its first event.
//
//   start(segment) -> advance() -> advance() ... -> an event or segment.end -> start(next segment)
//
// The loop (run/loop.hpp) decides, applies and records; a stepper advances, finds the instant at
// which the first guard falls, and integrates works over what it has passed.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "decide/decision.hpp"
#include "decide/instant.hpp"
#include "engine/graze.hpp"
#include "engine/ripple.hpp"
#include "motion/powers.hpp"
#include "motion/series.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// The stretch up to the next discontinuity of the forcing, in one mode.
struct Segment {
  double end = 0.0;
  const Decision* decision = nullptr;  ///< state, mode, jet and guards at the beginning
  const Forcing* forcing = nullptr;
  bool same_forcing = false;  ///< it is that of the stretch before, which ended here
};

struct Step {
  enum class Kind { accepted, event, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;  ///< end: of the accepted step, or the instant of the event
  double resolution = 0.0;        ///< times closer than this are one instant
  std::vector<Fired> fired;       ///< Kind::event
  std::optional<Mode> adopted;    ///< Kind::event: states that the engine found itself, instead of `fired`
  std::string reason;             ///< Kind::failed
};

/// The motion on the last step as a series: its end is at t + scale x.
struct Expansion {
  const Series* series = nullptr;  ///< null: the engine knows none
  std::size_t degree = 0;          ///< up to which u, v, a and forces are complete
  double x = 0.0;
  const ModeSystem* system = nullptr;  ///< with friction at the slip rates where the series begins
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void start(const Segment& segment) = 0;
  [[nodiscard]] virtual Step advance() = 0;
  /// The solution at begin <= t <= end of the last step.
  virtual void evaluate(double t, Point& point) = 0;
  /// Entries of u and v that glimpses are asked for, beside those of contacts.
  virtual void watch(const std::vector<int>& /*dofs*/) {}
  /// The same as evaluate, of the watched entries of u and v; others may be no numbers.
  virtual void glimpse(double t, Point& point) { evaluate(t, point); }
  /// Puts accelerations into a point that evaluate() has made at t, where they are missing.
  virtual void accelerate(double /*t*/, Point& /*point*/) {}
  /// Puts the energy of the structure into a point that a decision has made, where the engine knows it better.
  virtual void know_energy(Point& /*point*/) const {}
  /// The same as evaluate and accelerate, but as cheap as the engine has it: of fixed steps between their
  /// ends.
  virtual void interpolate(double t, Point& point) {
    evaluate(t, point);
    accelerate(t, point);
  }
  /// Adds the integrals of all powers over the part [from, to] of the last step.
  virtual void integrate(double from, double to, Works& works) = 0;
  /// Greatest entry of the residual of the equation of motion at the end of the last step. Unit: force.
  [[nodiscard]] virtual double residual() = 0;
  /// How far off a guard's value may be, from one step's errors. Unit: that of the guard.
  [[nodiscard]] virtual double guard_error(const Form& form, const ContactMotion& motion,
                                           std::size_t contact) const = 0;

  /// Whether a flight that begins with g = 0 and stays lower than the rounding of its gap is known: to a
  /// series. Else its landing is as late as that rounding makes it, and it lands faster than it left.
  [[nodiscard]] virtual bool knows_low_flights() const { return false; }

  /// Times inside the last step where N, T, g or ut of a contact turns beyond all its values before.
  [[nodiscard]] virtual const std::vector<double>& turning_points() const {
    static const std::vector<double> none;
    return none;
  }

  /// One of those turns.
  struct ContactTurn {
    std::size_t contact = 0;
    double t = 0.0;
  };
  /// Whose turns they are, in no order. Nothing: glimpse() of all contacts at each time costs no more than of one.
  [[nodiscard]] virtual std::optional<std::vector<ContactTurn>> contact_turns() const { return std::nullopt; }
  /// The same as glimpse, of what one contact touches; where contact_turns() tells of any.
  virtual void glimpse(double t, std::size_t /*contact*/, Point& point) { glimpse(t, point); }

  [[nodiscard]] virtual Expansion expansion() const { return {}; }

  /// By how much roundings of sums over modes are greater than where these are orthogonal: greatest |x| |y| of the modes
  /// that the last step was followed in, y . x = 1; or more, where their terms are greater than the motion and cancel.
  /// 1: it was followed in none.
  [[nodiscard]] virtual double dependence() const { return 1.0; }

  /// By how many radians u, v, a and forces turn at most in the last step, forcing aside: polynomials of degree n by n pi.
  /// Infinite: by what frequencies say.
  [[nodiscard]] virtual double turns() const { return std::numeric_limits<double>::infinity(); }
  /// Of what turns faster than that in the last step, rad per time. Nothing: not known, or something does that does not
  /// swing.
  [[nodiscard]] virtual std::optional<Ripple> ripple(double /*omega*/) const { return std::nullopt; }
  /// Where ripples are known: the sizes of the terms that u, v, a and forces of the last step are sums of, fast modes or
  /// not. Rounding is relative to that.
  [[nodiscard]] virtual Ripple whole() const { return {}; }
  /// The greatest form . u of all u with |u|_M = 1; asked where ripples are known.
  [[nodiscard]] virtual double reach(const Combination& /*form*/) const { return 0.0; }

  /// The first guard that came back into its tolerance and left it without a fall, where the engine looks for it.
  [[nodiscard]] virtual std::optional<Graze> graze() const { return std::nullopt; }

  /// Gaps that came near to zero and opened again, where the engine looks for them.
  [[nodiscard]] virtual std::vector<NearHit> near_hits() const { return {}; }

  /// Brings `counters` up to date.
  virtual void count() {}

  Counters counters;
  std::vector<std::string> warnings;  ///< of the run so far
};

}  // namespace signorini
