// run_listener.hpp: who follows a run from inside: its steps, its decisions.
//
//   begin(decision at 0)
//   { step(dense output) reached(its end)   before(an instant) instant(decision before, after) } ...
//   end
//
// All in the units of the model that is computed, the machine's. What is handed over lives until the call
// ends. A listener changes nothing. The two that answer back have interfaces of their own: EventShift here, and
// FaultInjector (run/fault_injector.hpp); loads are steered by a Recorder (signorini/result.hpp).
#pragma once

#include <cstdint>
#include <utility>

#include "engine/stepper.hpp"
#include "signorini/trace.hpp"

namespace signorini {

struct ModalShare;
class FaultInjector;

/// A step that was made.
struct RunStep {
  const Step& step;
  const StepFacts& facts;
  const Decision& decision;  ///< the mode of the step
  const Forcing& forcing;
  DenseOutput& motion;
};

/// The motion at a time, in the mode up to there.
struct RunPoint {
  double t = 0.0;
  const Forcing& forcing;
  const Mode& mode;
  const Point& point;
};

/// An instant at which states were decided.
struct RunInstant {
  double t = 0.0, resolution = 0.0;
  const std::vector<Fired>& fired;
  bool breakpoint = false;  ///< the forcing is not smooth here
  const Mode& mode_before;
  const Decision& after;
  const Forcing &forcing_before, &forcing_after;
  const Vector& v_before;  ///< u is that of `after`
  bool load_jumps = false;
  bool adopted = false;  ///< the engine found states, and no time
  /// What the loop has beside; null where an instant is computed once more without a loop.
  const Point *point_before = nullptr, *point_after = nullptr;
};

/// What a listener needs of the engine that is made for the run.
struct ListenerNeeds {
  /// What engine `exact` in modes shares with it (engine/exact/modal/modal_memory.hpp); null: nothing.
  ModalShare* modal = nullptr;
  /// Whether anybody asks for the greatest N, T, gap and ut inside of steps. `exact` in modes looks for them only then.
  bool peaks = true;
  /// Not 0: engine `exact` in series takes steps of other lengths than without, by chance from this seed.
  std::uint64_t step_seed = 0;
};

class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void begin(const RunInstant& /*start*/) {}
  virtual void step(const RunStep& /*step*/) {}
  /// The end of the step, after step().
  virtual void reached(const RunStep& /*step*/, const RunPoint& /*end*/) {}
  /// The motion just before an instant whose states are not decided yet.
  virtual void before(const RunPoint& /*point*/) {}
  virtual void instant(const RunInstant& /*instant*/) {}
  /// The run ends here; near hits and the graze of the engine are in the units of the scene.
  virtual void end(const RunPoint& /*last*/, const StepperReport& /*engine*/) {}
};

/// Several of them, in the order in which they were added.
class RunListeners final : public RunListener {
 public:
  /// It must outlive this.
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
  void end(const RunPoint& last, const StepperReport& engine) override {
    for (RunListener* listener : list_) listener->end(last, engine);
  }

 private:
  std::vector<RunListener*> list_;
};

/// By how much an event is moved that an engine has found: a companion carries on what rounding hides of its time.
class EventShift {
 public:
  virtual ~EventShift() = default;
  virtual double shift(const Step& step) = 0;
};

/// Who follows a run from inside, and what answers back; nobody: empty, or null.
struct RunHooks {
  RunListeners listeners = {};
  ListenerNeeds needs = {};
  RoundListener rounds = {};
  EventShift* event_shift = nullptr;
  FaultInjector* faults = nullptr;

  [[nodiscard]] bool none() const { return listeners.none() && !rounds && !event_shift && !faults; }
};

/// signorini/simulate.hpp, and the listener follows: of any engine.
[[nodiscard]] Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder,
                              RunListener& listener, const ListenerNeeds& needs = {},
                              EventShift* event_shift = nullptr);

}  // namespace signorini
