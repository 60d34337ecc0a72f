// fault_injector.hpp: errors injected into a run by tests, to check that the law checker detects them.
//
//   engine -> instant (postponed) -> decision (changed) -> record -> law checker
//
// No scene uses this; a run without an injector is not affected.
#pragma once

#include "decide/contact_state_solver.hpp"
#include "engine/stepper.hpp"

namespace signorini::run {

class FaultInjector {
 public:
  virtual ~FaultInjector() = default;
  /// Restores the correct data in a copy of the computed model; the law checker receives this copy.
  virtual void correct(Model& /*model*/) {}
  /// Delay that is added to the time of a located event.
  virtual double late(const engine::Step& /*step*/, const decide::Decision& /*before*/) { return 0.0; }
  /// Sets guards that the engine is to miss to Guard::none.
  virtual void watch(std::vector<decide::GuardStart>& /*guards*/) {}
  /// Replaces the decided states, velocities and impulses. Returns true if the motion continues from the
  /// replacement.
  virtual bool change(const contact::ContactStates& /*mode_before*/, const Vector& /*v_before*/,
                      decide::Decision& /*decided*/) {
    return false;
  }
  /// True if peaks are taken at the ends of steps only.
  virtual bool skips_interior_peaks() { return false; }

  /// Changes the decision of this instant, and recomputes the quantities that follow from the change.
  void inject(decide::ContactStateSolver& decider, decide::Instant now, const motion::Forcing& forcing,
              decide::Decision& decided);
};

/// Run as in signorini/simulate.hpp, with injected errors.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              FaultInjector& faults);

}  // namespace signorini::run
