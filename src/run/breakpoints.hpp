// breakpoints.hpp: where the forcing of a model is not smooth; integrators stop there.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Breakpoints of all forcing in (0, t_end), ascending; `jump` where any value jumps. Those that the clock
/// cannot tell apart are one, at the last of their times: every history is on its next piece there. Where one
/// history has several of them, its value jumps if they leave it another.
[[nodiscard]] std::vector<Breakpoint> breakpoints(const Model& model, double t_end);

/// Those of a run, one after the other.
class BreakpointQueue {
 public:
  BreakpointQueue(const Model& model, double t_end) : list_(breakpoints(model, t_end)), t_end_(t_end) {}

  /// Where the forcing is smooth up to: the next breakpoint, or t_end.
  [[nodiscard]] double next() const { return next_ < list_.size() ? list_[next_].time : t_end_; }
  /// Puts the clock on those that it cannot tell from t, if there are any.
  struct Passed {
    bool any = false, jump = false;
  };
  Passed pass(double& t, double resolution);
  /// The model's loads are others from t on.
  void loads_changed(const Model& model, double t);

 private:
  std::vector<Breakpoint> list_;
  double t_end_;
  std::size_t next_ = 0;
};

}  // namespace signorini
