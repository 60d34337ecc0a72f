// stepper.hpp: interface of an engine: it advances the motion in one contact state to the first event.
//
//   start(segment) -> advance() -> advance() ... -> an event or segment.end -> start(next segment)
//
// The loop (run/loop.hpp) decides states, applies impacts and notifies listeners; a stepper advances and finds the time
// at which the first guard reaches zero. Its dense output gives the motion on the last step (engine/dense_output.hpp).
#pragma once

#include <optional>
#include <string>

#include "decide/decision.hpp"
#include "decide/instant.hpp"
#include "engine/dense_output.hpp"
#include "engine/events/graze.hpp"
#include "signorini/result.hpp"

namespace signorini::engine {

/// The interval from a decision to the next discontinuity of the forcing, in constant contact states.
struct Segment {
  double end = 0.0;
  const decide::Decision* decision = nullptr;  ///< motion, contact states, jet and guards at the beginning
  const motion::Forcing* forcing = nullptr;
  bool same_forcing = false;  ///< the forcing equals that of the previous segment, which ended here
};

/// Result of advance().
struct Step {
  enum class Kind { accepted, event, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;                  ///< end: of the accepted step, or the instant of the event
  double resolution = 0.0;                        ///< times closer than this are the same instant
  std::vector<decide::TriggeredGuard> triggered;  ///< Kind::event
  /// Kind::event: states found by the engine, which then sets no `triggered`.
  std::optional<contact::ContactStates> engine_states;
  std::string reason;  ///< Kind::failed
};

/// Results that an engine reports at the end of a run. Times and gaps are in model units.
struct StepperReport {
  Counters counters;
  std::vector<std::string> warnings;
  /// First guard that returned into its tolerance and left it without reaching zero; only some engines detect this.
  std::optional<events::Graze> graze;
  /// Gaps that approached zero and opened again; only some engines detect this.
  std::vector<events::NearHit> near_hits;
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Begins a segment, which must live until the next start.
  virtual void start(const Segment& segment) = 0;
  /// Takes one step, up to the first event or segment.end at most.
  [[nodiscard]] virtual Step advance() = 0;
  /// The motion on the last step.
  [[nodiscard]] virtual DenseOutput& dense_output() = 0;
  /// Bound on the error of a guard's value from the error of one step. Unit: that of the guard.
  [[nodiscard]] virtual double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                           std::size_t contact) const = 0;
  /// Writes the energy of the structure into a point made by a decision, if the engine knows it more accurately.
  virtual void set_energy(motion::Point& /*point*/) const {}
  /// Called once, after the last step.
  [[nodiscard]] virtual StepperReport report() { return {counters, warnings, {}, {}}; }

  Counters counters;                  ///< counts so far; complete in the report
  std::vector<std::string> warnings;  ///< warnings of the run so far
  /// True if the engine resolves a flight that begins with g = 0 and stays lower than the rounding of its
  /// gap, as a series does. Otherwise this rounding delays the landing, and the contact lands faster than it
  /// left.
  bool resolves_low_flights = false;
};

}  // namespace signorini::engine
