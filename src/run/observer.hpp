// observer.hpp: somebody who follows the motion of a run from inside: its series, its decisions.
//
//   begin(decision at 0)  { step(series of the step) ... instant(decision before, after) } ... end
//
// All in the units of the model that is computed, the machine's. What is handed over lives until the call
// ends.
#pragma once

#include <cstdint>

#include "engine/stepper.hpp"

namespace signorini {

struct ModalShare;

/// A step that was made.
struct ObservedStep {
  const Step& step;
  const Expansion& expansion;
  const Decision& decision;  ///< the mode of the step
  const Forcing& forcing;
  const std::vector<double>& turns;  ///< Stepper::turning_points()
};

/// An instant at which states were decided.
struct ObservedInstant {
  double t = 0.0, resolution = 0.0;
  const std::vector<Fired>& fired;
  bool breakpoint = false;  ///< the forcing is not smooth here
  const Mode& mode_before;
  const Decision& after;
  const Forcing &forcing_before, &forcing_after;
  const Vector& v_before;  ///< u is that of `after`
  bool load_jumps = false;
};

class MotionObserver {
 public:
  virtual ~MotionObserver() = default;
  virtual void begin(const ObservedInstant& start) = 0;
  virtual void step(const ObservedStep& step) = 0;
  virtual void instant(const ObservedInstant& instant) = 0;
  /// What engine `exact` in modes shares with it (engine/exact/modal/modal_memory.hpp); null: nothing.
  virtual ModalShare* modal() { return nullptr; }
  /// Whether anybody asks for the greatest N, T, gap and ut inside of steps. `exact` in modes looks for them only then.
  virtual bool asks_peaks() { return true; }
  /// By how much an event is moved that an engine has found: a companion carries on what rounding hides of its time.
  virtual double moves(const Step& /*step*/) { return 0.0; }
  /// Not 0: engine `exact` in series takes steps of other lengths than without, by chance from this seed.
  virtual std::uint64_t step_seed() { return 0; }
  /// The run ends here, between events.
  virtual void end(double /*t*/) {}
  /// After the end: the first of them, its time in the units of the scene.
  virtual void graze(const Graze& /*graze*/) {}
  /// After the end: gaps that came near to zero and opened again, in the units of the scene.
  virtual void near_hits(std::vector<NearHit> /*list*/) {}
};

/// signorini/simulate.hpp, and the observer follows: of any engine.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              MotionObserver& observer);

}  // namespace signorini
