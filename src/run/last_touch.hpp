// last_touch.hpp: last time at which each contact had exactly g = 0; rounding has accumulated in its gap since then.
//
//   touched_k = the last instant at which k was closed, before or after, or took an impulse; 0: never
#pragma once

#include "decide/decision.hpp"

namespace signorini {

class LastTouch {
 public:
  explicit LastTouch(std::size_t contacts) : times_(contacts, 0.0) {}

  void instant(double t, const Mode& before, const Decision& decision) {
    for (std::size_t k = 0; k < times_.size(); ++k)
      if (!before[k].is_open() || !decision.mode[k].is_open() ||
          (!decision.impulses.empty() && decision.impulses[k].normal > 0.0))
        times_[k] = t;
  }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  std::vector<double> times_;
};

}  // namespace signorini
