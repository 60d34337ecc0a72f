// steering.hpp: changes of loads during a run, and breakpoints of the forcing.
//
//   set_load at t_1:   f(t) stays the old history for t < t_1, and is the new history for t >= t_1
//
// Replaced histories stay in memory until the run ends, because forcings refer to their pieces.
#pragma once

#include "run/engines.hpp"
#include "signorini/model.hpp"

namespace signorini::run {

/// Replaces load histories of the computed model on request. set_load() takes histories in the scene's units.
class LoadChanges final : public Steering {
 public:
  /// All arguments must outlive the object.
  LoadChanges(Model& model, const RunSpec& run, const EngineRow& engine, const Method& method)
      : model_(model), run_(run), engine_(engine), method_(method) {}

  void set_load(const std::string& name, const History& history) override;

  /// Sets the current time, in the units of the computation.
  void set_time(double t) { t_ = t; }
  /// any: a load has changed; jump: the value of a load jumps.
  struct Change {
    bool any = false, jump = false;
  };
  /// Turns the requests since the last call into the change at the current instant.
  void apply() { change_ = std::exchange(requested_, {}); }
  /// Change at the current instant.
  [[nodiscard]] const Change& change() const { return change_; }

 private:
  Model& model_;
  const RunSpec& run_;
  const EngineRow& engine_;
  const Method& method_;
  double t_ = 0.0;
  Change requested_, change_;
  std::vector<History> past_;
};

// Breakpoints: times at which the forcing of a model is not smooth; integrators stop at these times.

/// Breakpoints of all forcing in (0, t_end), ascending; `jump` is set if a value jumps. Breakpoints closer than the
/// resolution of the clock are merged into one at the last of their times, so that every history has reached its next piece. If
/// one history has several of these breakpoints, `jump` is set if its values before and after differ.
[[nodiscard]] std::vector<Breakpoint> breakpoints(const Model& model, double t_end);

/// Breakpoints of a run, in ascending order.
class BreakpointQueue {
 public:
  BreakpointQueue(const Model& model, double t_end) : list_(breakpoints(model, t_end)), t_end_(t_end) {}

  /// Time up to which the forcing is smooth: the next breakpoint, or t_end.
  [[nodiscard]] double next() const { return next_ < list_.size() ? list_[next_].time : t_end_; }
  /// any: a breakpoint was passed; jump: a value jumps at one of the passed breakpoints.
  struct Passed {
    bool any = false, jump = false;
  };
  /// Passes all breakpoints up to t + resolution, and sets t to the last passed breakpoint, if there is one.
  Passed pass(double& t, double resolution);
  /// Computes the breakpoints after t again, for changed loads.
  void loads_changed(const Model& model, double t);

 private:
  std::vector<Breakpoint> list_;
  double t_end_;
  std::size_t next_ = 0;
};

}  // namespace signorini::run
