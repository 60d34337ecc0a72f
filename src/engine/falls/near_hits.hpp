// near_hits.hpp: gaps of an integrator that came near to zero and opened again.
//
//   g_a > g_b <= g_c  at three looks that follow each other:  a least gap at the parabola's vertex
//   g > level         at some look before, since the last one: what touches and stays is none
//
// Kept where it is below 1e4 levels (watch.hpp) above zero: errors of thousands of steps add up to that. Whether a hit was missed
// there only the error of the run tells, which this run does not know (certify/open_hits.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include "decide/decision.hpp"
#include "engine/falls/graze.hpp"
#include "engine/falls/step_history.hpp"

namespace signorini {

class NearHits {
 public:
  /// levels: one a slot, as for Watch.
  void start(const std::vector<GuardStart>& guards, const std::vector<double>& levels);
  /// The part [0, limit] of the last step, where scalars 0.. of the history are the guards.
  void see(const StepHistory& history, double limit);
  /// Of the run so far, in the order of time but for those of one step.
  [[nodiscard]] const std::vector<NearHit>& list() const { return list_; }

 private:
  struct Look {
    double t = 0.0, gap = 0.0;
  };
  struct Watched {
    std::size_t slot = 0;
    double level = 0.0;
    double high = 0.0;  // the greatest since the last least gap
    int looks = 0;      // that are kept, the last ones
    Look before, last;
  };
  void look(Watched& gap, const Look& now);

  std::vector<Watched> gaps_;
  std::vector<NearHit> list_;
};

}  // namespace signorini
