// meddler.hpp: errors that a test plants in a run, to see that its witness notices them.
//
//   engine -> instant (postponed) -> decision (changed) -> record -> witness
//
// No scene reaches this; a run without a meddler asks nobody.
#pragma once

#include "run/observer.hpp"

namespace signorini {

class Meddler {
 public:
  virtual ~Meddler() = default;
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
};

/// signorini/simulate.hpp, with errors planted.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              Meddler& meddler);

}  // namespace signorini
