// fault_injector.hpp: errors injected into a run by tests, to check that the law checker detects them.
//
//   engine -> instant (delayed) -> decision (changed) -> record -> law checker
//
// Only tests use fault injectors.
#pragma once

#include "decide/contact_state_solver.hpp"
#include "engine/stepper.hpp"

namespace signorini::run {

class FaultInjector {
 public:
  virtual ~FaultInjector() = default;
  /// Corrects a copy of the computed model, whose data may be wrong on purpose; the law checker receives this copy.
  virtual void correct(Model& /*model*/) {}
  /// Delay of a located event, added to its time; 0: no fault.
  virtual double late(const engine::Step& /*step*/, const decide::Decision& /*before*/) { return 0.0; }
  /// Sets guards to Guard::none, so that the engine misses their events.
  virtual void watch(std::vector<decide::GuardStart>& /*guards*/) {}
  /// Changes the states, velocities and impulses in `decided`. Returns true if the run is to continue from these states and
  /// velocities; false: `decided` is not used.
  virtual bool change(const contact::ContactStates& /*states_before*/, const Vector& /*v_before*/,
                      decide::Decision& /*decided*/) {
    return false;
  }
  /// True if the run is to record peaks only at the ends of steps.
  virtual bool skips_interior_peaks() { return false; }

  /// Calls change() for the decision of this instant, and recomputes the quantities that depend on the change.
  void inject(decide::ContactStateSolver& decider, decide::Instant now, const motion::Forcing& forcing,
              decide::Decision& decided);
};

/// Same as simulate() in signorini/simulate.hpp, with injected errors.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              FaultInjector& faults);

}  // namespace signorini::run
