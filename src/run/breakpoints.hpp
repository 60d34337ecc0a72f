// breakpoints.hpp: times at which the forcing of a model is not smooth; integrators stop there.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Breakpoints of all forcing in (0, t_end), ascending; `jump` if a value jumps. Breakpoints closer than the resolution
/// of the clock are merged into one at the last of their times, where every history is on its next piece. If one
/// history has several of them, `jump` is set if its values before and after differ.
[[nodiscard]] std::vector<Breakpoint> breakpoints(const Model& model, double t_end);

/// Breakpoints of a run, in order.
class BreakpointQueue {
 public:
  BreakpointQueue(const Model& model, double t_end) : list_(breakpoints(model, t_end)), t_end_(t_end) {}

  /// Time up to which the forcing is smooth: the next breakpoint, or t_end.
  [[nodiscard]] double next() const { return next_ < list_.size() ? list_[next_].time : t_end_; }
  /// Moves t to the last breakpoint that is within the resolution of t, if there is one.
  struct Passed {
    bool any = false, jump = false;
  };
  Passed pass(double& t, double resolution);
  /// Updates the breakpoints after t for changed loads.
  void loads_changed(const Model& model, double t);

 private:
  std::vector<Breakpoint> list_;
  double t_end_;
  std::size_t next_ = 0;
};

}  // namespace signorini
