// near_hits.hpp: gaps of an integrator that approached zero and opened again.
//
//   g_a > g_b <= g_c  at three consecutive samples:  a least gap at the parabola's vertex
//   g > level         at some sample before, since the last one: a gap that touches and stays closed is none
//
// Near hits are kept if the gap is below 1e4 levels (watch.hpp) above zero: errors of thousands of steps add up to
// that. Only the error of the run decides whether a hit was missed there, and this run does not know it
// (certify/open_hits.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include "decide/decision.hpp"
#include "engine/falls/graze.hpp"
#include "engine/falls/step_history.hpp"

namespace signorini {

class NearHits {
 public:
  /// levels: one for each slot, as for Watch.
  void start(const std::vector<GuardStart>& guards, const std::vector<double>& levels);
  /// Examines the part [0, limit] of the last step; scalars 0.. of the history are the guards.
  void see(const StepHistory& history, double limit);
  /// Near hits of the run so far, in the order of time except for those of the same step.
  [[nodiscard]] const std::vector<NearHit>& list() const { return list_; }

 private:
  struct Look {
    double t = 0.0, gap = 0.0;
  };
  struct Watched {
    std::size_t slot = 0;
    double level = 0.0;
    double high = 0.0;  // greatest gap since the last least gap
    int looks = 0;      // number of last samples that are kept
    Look before, last;
  };
  void look(Watched& gap, const Look& now);

  std::vector<Watched> gaps_;
  std::vector<NearHit> list_;
};

}  // namespace signorini
