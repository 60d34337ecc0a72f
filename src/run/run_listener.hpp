// run_listener.hpp: interface of listeners to the steps and decisions of a run.
//
//   begin(decision at 0)
//   { step(dense output) reached(its end)   before(an instant) instant(decision before, after) } ...
//   end
//
// All values are in the units of the computed model. Arguments are valid during the call. A listener does not
// influence the run.
// The two objects that influence a run have interfaces of their own: EventShift here, and FaultInjector
// (run/fault_injector.hpp); loads are steered by a Recorder (signorini/result.hpp).
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
  const decide::Decision& decision;  ///< the contact states of the step
  const motion::Forcing& forcing;
  engine::DenseOutput& motion;
};

/// Motion at a time, in the contact states before it.
struct RunPoint {
  double t = 0.0;
  const motion::Forcing& forcing;
  const contact::ContactStates& states;
  const motion::Point& point;
};

/// An instant at which states were decided.
struct RunInstant {
  double t = 0.0, resolution = 0.0;
  const std::vector<decide::TriggeredGuard>& triggered;
  bool breakpoint = false;  ///< the forcing is not smooth here
  const contact::ContactStates& states_before;
  const decide::Decision& after;
  const motion::Forcing &forcing_before, &forcing_after;
  const Vector& v_before;  ///< velocities before; u is that of `after`
  bool load_jumps = false;
  bool adopted = false;  ///< the engine found states, and no time
  /// Points of the loop; null if an instant is computed again without a loop.
  const motion::Point *point_before = nullptr, *point_after = nullptr;
};

/// Requirements of a listener for the engine of the run.
struct ListenerNeeds {
  /// Data that engine `exact` in modes shares with the listener (engine/exact/modal/modal_flow.hpp); null: none.
  modal::SharedModalData* modal = nullptr;
  /// True if the largest N, T, gap and ut inside steps are needed. `exact` in modes computes them only then.
  bool peaks = true;
  /// Seed, not 0: engine `exact` in series varies the lengths of its steps randomly.
  std::uint64_t step_seed = 0;
};

class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void begin(const RunInstant& /*start*/) {}
  virtual void step(const RunStep& /*step*/) {}
  /// Receives the end of the step, after step().
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

/// Shifts located events, so that a companion run represents the uncertainty that rounding hides in their
/// times.
class EventShift {
 public:
  virtual ~EventShift() = default;
  /// Time by which the event at the end of the step is shifted.
  virtual double shift(const engine::Step& step) = 0;
};

/// Listeners of a run, and objects that influence it; empty or null: none.
struct RunHooks {
  RunListeners listeners = {};
  ListenerNeeds needs = {};
  RoundListener rounds = {};
  EventShift* event_shift = nullptr;
  FaultInjector* faults = nullptr;

  [[nodiscard]] bool none() const { return listeners.none() && !rounds && !event_shift && !faults; }
};

/// Run as in signorini/simulate.hpp with a listener, for any engine.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              RunListener& listener, const ListenerNeeds& needs = {},
                              EventShift* event_shift = nullptr);

}  // namespace signorini::run
