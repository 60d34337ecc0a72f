// loop.hpp: the time loop of signorini/simulate.hpp, for a model or for one of its independent parts.
//
//   Loop loop(model, spec, engine, method, recorder, hooks);
//   loop.begin();   loop.advance_to(t_1);   loop.advance_to(t_2); ...   loop.end()
//
// At each event the loop decides the contact states, applies them and notifies the listeners (run_listener.hpp). The last
// listener is the loop's own record (run_record.hpp). The time at which advance_to() pauses does not influence results:
// the next call continues with the next step of the engine.
#pragma once

#include <memory>
#include <optional>

#include "decide/contact_state_solver.hpp"
#include "run/engines.hpp"
#include "run/foot_releases.hpp"
#include "run/run_limits.hpp"
#include "run/run_record.hpp"
#include "run/steering.hpp"
#include "run/touch_tracker.hpp"

namespace signorini::run {

/// Results of a loop, in the units of its model; times in texts are in the scene's units.
struct RunEnd {
  Report report;
  /// Rounding error of the stored energy; it is large if the terms of this energy are far larger than their sum.
  double energy_rounding = 0.0;
  bool law_violated = false;  ///< the law checker stopped the run
};

class Loop {
 public:
  /// All referenced objects must outlive the loop.
  Loop(Model& model, const RunSpec& spec, const EngineRow& engine, Method method, Recorder& recorder,
       RunHooks hooks, const PartShare& share = {});
  /// Not copyable, because members refer to other members.
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// Decides the states at t = 0. Called once, first.
  void begin();
  /// True if the contact states at t = 0 could be decided.
  [[nodiscard]] bool begun() const { return begun_; }
  /// Advances to the first step that ends at `until` or later, to t_end at most, or until the run stops.
  void advance_to(double until);
  [[nodiscard]] double t() const { return state_.t; }
  [[nodiscard]] const Outcome& outcome() const { return report_.outcome; }
  /// True if advance_to() can continue.
  [[nodiscard]] bool is_running() const { return running_ && state_.t < spec_.t_end; }
  /// Ends the run and returns its results. Called once, last.
  [[nodiscard]] RunEnd end();

 private:
  bool stop(std::string reason, Outcome::Kind kind = Outcome::Kind::stopped);
  bool refuse(const Refusal& refusal);
  bool start();
  bool step();
  void finish_step(engine::Step& step);
  bool steer();
  bool steered();
  bool instant(std::vector<decide::TriggeredGuard> fired,
               std::optional<contact::ContactStates> adopted = std::nullopt);
  [[nodiscard]] bool has_no_unexplained_violation();
  [[nodiscard]] decide::Instant instant_now(std::vector<decide::TriggeredGuard> fired) const;
  [[nodiscard]] motion::Point decided_point(const decide::Decision& decision) const;
  [[nodiscard]] RunPoint current_point() const {
    return {state_.t, state_.forcing, state_.decision.states, state_.point};
  }

  Model& model_;
  const RunSpec& spec_;
  Recorder& recorder_;
  RunHooks hooks_;
  Report report_;
  linear::SystemMatrices structure_;
  motion::StateSystems systems_;
  decide::ContactStateSolver decider_;
  std::unique_ptr<engine::Stepper> engine_;
  RunRecord record_;
  TouchTracker touches_;
  StallDetector stall_detector_;
  BreakpointQueue breakpoints_;
  LoadChanges changes_;
  struct State {
    motion::Forcing forcing;  // forcing from t on
    decide::Decision decision = {};
    motion::Point point = {};
    double t = 0.0, resolution = 0.0;
  } state_;
  struct Stretch {
    double end = 0.0;
    bool open = false;
    bool same_forcing = false;  // the last instant has not changed the forcing
    FootReleases releases;      // of feet at rest
  } stretch_;                   // interval of smooth motion from the last instant to `end`
  bool begun_ = false, running_ = false;
};

}  // namespace signorini::run
