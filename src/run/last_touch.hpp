// last_touch.hpp: when each contact was last at g = 0, exactly: what rounding has carried its gap since.
//
//   touched_k = the last instant at which k was closed, before or after, or took an impulse; 0: it never did
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
