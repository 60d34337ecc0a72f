// stepper.hpp: what an engine does: advance the motion in one mode to its first event.
//
//   start(segment) -> advance() -> advance() ... -> an event or segment.end -> start(next segment)
//
// The loop (run/loop.hpp) decides, applies and notifies; a stepper advances and finds the instant at which the first
// guard falls. The motion on its last step is its dense output (engine/dense_output.hpp).
#pragma once

#include <optional>
#include <string>

#include "decide/decision.hpp"
#include "decide/instant.hpp"
#include "engine/dense_output.hpp"
#include "engine/falls/graze.hpp"
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

/// What an engine knows at the end of a run. Its times and gaps: in the units of the model.
struct StepperReport {
  Counters counters;
  std::vector<std::string> warnings;
  /// The first guard that came back into its tolerance and left it without a fall, where the engine looks for it.
  std::optional<Graze> graze;
  /// Gaps that came near to zero and opened again, where the engine looks for them.
  std::vector<NearHit> near_hits;
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void start(const Segment& segment) = 0;
  [[nodiscard]] virtual Step advance() = 0;
  /// The motion on the last step.
  [[nodiscard]] virtual DenseOutput& dense_output() = 0;
  /// How far off a guard's value may be, from one step's errors. Unit: that of the guard.
  [[nodiscard]] virtual double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                           std::size_t contact) const = 0;
  /// Puts the energy of the structure into a point that a decision has made, where the engine knows it better.
  virtual void set_energy(Point& /*point*/) const {}
  /// Once, after the last step.
  [[nodiscard]] virtual StepperReport report() { return {counters, warnings, {}, {}}; }

  Counters counters;                  ///< so far; complete in the report
  std::vector<std::string> warnings;  ///< of the run so far
  /// Whether a flight that begins with g = 0 and stays lower than the rounding of its gap is known: to a series. Else its
  /// landing is as late as that rounding makes it, and it lands faster than it left.
  bool knows_low_flights = false;
};

}  // namespace signorini
