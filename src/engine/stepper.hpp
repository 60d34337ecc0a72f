// stepper.hpp: interface of an engine, which advances the motion with constant contact states to the first event.
//
//   start(segment) -> advance() -> advance() ... -> an event or segment.end -> start(next segment)
//
// The loop (run/loop.hpp) decides contact states, applies impacts and notifies listeners. A stepper advances the motion and
// finds the time at which the first guard reaches zero. Its dense output gives the motion on the last step
// (engine/dense_output.hpp).
#pragma once

#include <optional>
#include <string>

#include "decide/decision.hpp"
#include "decide/instant.hpp"
#include "engine/dense_output.hpp"
#include "engine/events/graze.hpp"
#include "signorini/result.hpp"

namespace signorini::engine {

/// Time interval with constant contact states: from a decision to the next discontinuity of the forcing.
struct Segment {
  double end = 0.0;
  const decide::Decision* decision = nullptr;  ///< motion, contact states, jet and guards at the beginning
  const motion::Forcing* forcing = nullptr;
  /// True if the previous segment ended at the beginning of this one and had the same forcing.
  bool same_forcing = false;
};

/// Result of advance().
struct Step {
  enum class Kind { accepted, event, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;                  ///< end: end of the accepted step, or time of the event
  double resolution = 0.0;                        ///< times with a smaller difference are the same instant
  std::vector<decide::TriggeredGuard> triggered;  ///< guards that reach zero; only for Kind::event
  /// Only for Kind::event: contact states after the event, if the engine computes them itself. `triggered` is then empty.
  std::optional<contact::ContactStates> engine_states;
  std::string reason;  ///< reason of the failure; only for Kind::failed
};

/// Counters, warnings and near hits of a run, reported by the engine at the end. Times and gaps are in model units.
struct StepperReport {
  Counters counters;
  std::vector<std::string> warnings;
  /// First guard that decreased to within its tolerance of zero and rose again, if the engine detects such guards.
  std::optional<events::Graze> graze;
  /// Gaps that approached zero and opened again, if the engine detects such gaps.
  std::vector<events::NearHit> near_hits;
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Begins a segment. `segment` must stay valid until the next call of start().
  virtual void start(const Segment& segment) = 0;
  /// Takes one step, which ends at the first event or at segment.end at the latest.
  [[nodiscard]] virtual Step advance() = 0;
  /// The motion on the last step.
  [[nodiscard]] virtual DenseOutput& dense_output() = 0;
  /// Bound on the error of the guard's value due to the error of one step. Unit: that of the guard.
  [[nodiscard]] virtual double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                           std::size_t contact) const = 0;
  /// Overwrites the energy of `point`, which a decision has computed, if the engine computes the energy more accurately.
  virtual void set_energy(motion::Point& /*point*/) const {}
  /// Returns the counters, warnings and near hits of the run. Called once, after the last step.
  [[nodiscard]] virtual StepperReport report() { return {counters, warnings, {}, {}}; }

  Counters counters;                  ///< counts so far; complete in the report
  std::vector<std::string> warnings;  ///< warnings of the run so far
  /// True if the engine resolves a flight that begins with g = 0 and is lower than the rounding error of the gap (engines with
  /// series). Otherwise this rounding error delays the landing, so the contact lands faster than it took off.
  bool resolves_low_flights = false;
};

}  // namespace signorini::engine
