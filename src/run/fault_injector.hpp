// fault_injector.hpp: errors that a test plants in a run, to see that its witness notices them.
//
//   engine -> instant (postponed) -> decision (changed) -> record -> witness
//
// No scene reaches this; a run without an injector asks nobody.
#pragma once

#include "decide/decider.hpp"
#include "engine/stepper.hpp"

namespace signorini {

class FaultInjector {
 public:
  virtual ~FaultInjector() = default;
  /// The model of which the run computes another one, as rescaled for it: the witness is given this.
  virtual void correct(Model& /*model*/) {}
  /// By how much an event is found too late.
  virtual double late(const Step& /*step*/, const Decision& /*before*/) { return 0.0; }
  /// Guards that the engine will not see are set to Guard::none.
  virtual void watch(std::vector<GuardStart>& /*guards*/) {}
  /// Other states, velocities and impulses than those that were decided. True: the motion goes on from these.
  virtual bool change(const Mode& /*mode_before*/, const Vector& /*v_before*/, Decision& /*decided*/) {
    return false;
  }
  /// Peaks are those of the ends of steps.
  virtual bool forgets_peaks_inside() { return false; }

  /// The decision of this instant, and what follows from what was changed in it.
  void inject(Decider& decider, Instant now, const Forcing& forcing, Decision& decided);
};

/// signorini/simulate.hpp, with errors planted.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              FaultInjector& faults);

}  // namespace signorini
