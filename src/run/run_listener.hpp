// run_listener.hpp: interface of listeners to the steps and decisions of a run.
//
//   begin(decision at t = 0)
//   { step(dense output) reached(end of the step)   before(point before an instant) instant(both sides) } ...
//   end(last point)
//
// All values are in the units of the computed model. Arguments are valid only during the call. A listener does not
// influence the run. Objects that influence a run have other interfaces: EventShift below, FaultInjector
// (run/fault_injector.hpp), and a Recorder that steers loads (signorini/result.hpp).
#pragma once

#include <cstdint>
#include <utility>

#include "engine/stepper.hpp"
#include "signorini/trace.hpp"

namespace signorini::modal {
struct SharedModalData;
}  // namespace signorini::modal

namespace signorini::run {

class FaultInjector;

/// A completed step.
struct RunStep {
  const engine::Step& step;
  const engine::StepFacts& facts;
  /// Decision at the last instant; its contact states are those of the step.
  const decide::Decision& decision;
  const motion::Forcing& forcing;
  engine::DenseOutput& motion;
};

/// Motion at the time t, before any change of contact states at t.
struct RunPoint {
  double t = 0.0;
  const motion::Forcing& forcing;
  const contact::ContactStates& states;
  const motion::Point& point;
};

/// An instant at which contact states were decided.
struct RunInstant {
  double t = 0.0, resolution = 0.0;
  const std::vector<decide::TriggeredGuard>& triggered;
  bool breakpoint = false;  ///< the forcing is not smooth here
  const contact::ContactStates& states_before;
  const decide::Decision& after;
  const motion::Forcing &forcing_before, &forcing_after;
  const Vector& v_before;  ///< velocities just before the instant; displacements u: those of `after`
  bool load_jumps = false;
  bool adopted = false;  ///< the engine found the states, but did not locate the time
  /// Motion just before and just after; null if the instant is computed again outside of a run's loop.
  const motion::Point *point_before = nullptr, *point_after = nullptr;
};

/// Requirements of a listener for the engine of the run.
struct ListenerNeeds {
  /// Data that engine `exact` in modes shares with the listener (engine/exact/modal/modal_flow.hpp); null: none.
  modal::SharedModalData* modal = nullptr;
  /// True if the listener needs the extremes of N, T, gap and ut inside steps; if false, `exact` in modes omits them.
  bool peaks = true;
  /// Seed for random step lengths of engine `exact` with series; 0: the usual step lengths.
  std::uint64_t step_seed = 0;
};

class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void begin(const RunInstant& /*start*/) {}
  virtual void step(const RunStep& /*step*/) {}
  /// Receives the motion at the end of the step; called after step().
  virtual void reached(const RunStep& /*step*/, const RunPoint& /*end*/) {}
  /// Receives the motion just before an instant whose states are not decided yet.
  virtual void before(const RunPoint& /*point*/) {}
  virtual void instant(const RunInstant& /*instant*/) {}
  /// Receives the end of the run; the near hits and the graze of `engine` are in the units of the scene.
  virtual void end(const RunPoint& /*last*/, const engine::StepperReport& /*engine*/) {}
};

/// A list of listeners, called in the order in which they were added.
class RunListeners final : public RunListener {
 public:
  /// The listener must outlive the list.
  void add(RunListener& listener) { list_.push_back(&listener); }
  [[nodiscard]] bool none() const { return list_.empty(); }

  void begin(const RunInstant& start) override {
    for (RunListener* listener : list_) listener->begin(start);
  }
  void step(const RunStep& step) override {
    for (RunListener* listener : list_) listener->step(step);
  }
  void reached(const RunStep& step, const RunPoint& end) override {
    for (RunListener* listener : list_) listener->reached(step, end);
  }
  void before(const RunPoint& point) override {
    for (RunListener* listener : list_) listener->before(point);
  }
  void instant(const RunInstant& instant) override {
    for (RunListener* listener : list_) listener->instant(instant);
  }
  void end(const RunPoint& last, const engine::StepperReport& engine) override {
    for (RunListener* listener : list_) listener->end(last, engine);
  }

 private:
  std::vector<RunListener*> list_;
};

/// Shifts located events of a companion run, so that its difference to the run includes the rounding errors of event
/// times.
class EventShift {
 public:
  virtual ~EventShift() = default;
  /// Time that is added to the time of the event at the end of the step.
  virtual double shift(const engine::Step& step) = 0;
};

/// Listeners of a run, and objects that influence the run. Every member may be empty or null.
struct RunHooks {
  RunListeners listeners = {};
  ListenerNeeds needs = {};
  RoundListener rounds = {};
  EventShift* event_shift = nullptr;
  FaultInjector* faults = nullptr;

  [[nodiscard]] bool none() const { return listeners.none() && !rounds && !event_shift && !faults; }
};

/// Same as simulate() in signorini/simulate.hpp, with a listener. event_shift: null, or shifts of located events.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              RunListener& listener, const ListenerNeeds& needs = {},
                              EventShift* event_shift = nullptr);

}  // namespace signorini::run
