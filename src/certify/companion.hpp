// companion.hpp: choice of the companion runs that certify a run, their expected cost, and their recorded data.
//
//   engine of the run  companion  setting                          factor c  reason
//   not exact          exact      unchanged                        1.5       the difference is the error of the run
//   ida                finer      rtol / 100, atol / 100           2         at rtol / 10 both errors may be similar
//   fixed steps dt     ida        rtol 1e-9 at most                1.5       the difference is the error of the run
//   fixed steps dt     finer      dt / 2                           3         in theory 4/3 at order 2, 2 at order 1
//   exact              finer      two runs with perturbed data     5         two samples of a random error
//
// A fraction of each event's t_uncertainty is added to the error bound: one tenth if ida has the companion exact, because
// the difference of the runs contains ida's local error except near grazing guards; one half with rtol / 100, because in
// chatter both runs have similar errors; otherwise all of it, because the companion's local error is as large.
//
// Series repeat the same rounding errors in steps of equal length (exact_engine.cpp, random_step_factor): after N steps they
// add up to N roundings. Perturbed data do not reveal this error, because they change the phase of a motion but not its
// amplitude. So companions of `exact` also use random step lengths.
//
// In modes the time of an event has an error tau due to the rounding of sums over modes. Two runs seldom differ by as much
// as the bound tau, but later motion depends on this time. So companions of `exact` shift each such event by tau / c. The
// row of the event itself has the unshifted time. The effect of the shift on later events is part of their difference D,
// so c D bounds the effect of tau.
//
// If a step dt does not resolve a motion, dt / 2 does not resolve it either: for example, motions with stiff dashpots
// oscillate with both steps. So dt / 2 is used on request only, and certifies a run only if
// dt max(omega_max, fastest decay) <= 1.
//
// All companions use the run's tolerance for decisions that depend on a tolerance: velocities below which rebounds come to
// rest, and heights below which ida computes flights with a series. A finer run that integrated these flights would be
// less accurate, because the errors of thousands of impacts accumulate. The values of c are tested in
// validation/certified.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "certify/event_matcher.hpp"
#include "run/forwarding_recorder.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::certify {

struct CompanionRun {
  Model model;
  RunSpec run;
  std::uint64_t seed = 0;
  /// In modes: events are shifted forwards or backwards by this fraction of the rounding error of their times, which is
  /// Step::resolution minus the resolution of the clock.
  double event_shift = 0.0;
};

struct CompanionPlan {
  std::vector<CompanionRun> runs;
  Engine engine = Engine::automatic;  ///< engine of the companions
  std::string name;                   ///< "exact", "ida, rtol 1e-10"
  std::string choice;                 ///< "as given", or "auto: ..."
  /// Reason why the companion cannot certify the run; empty: the companion can certify it.
  std::string limitation;
  double factor = 1.0;  ///< factor c of the error bounds
  /// Fraction of t_uncertainty that is added to error bounds, because the difference of the runs does not contain it.
  double local = 1.0;
  double cost = 0.0;     ///< expected cost of the companions / cost of the run; 0: unknown
  double seconds = 0.0;  ///< expected duration of the companions
  double steps = 0.0;    ///< expected number of steps of one companion; 0: unknown
  double run_seconds = 0.0,
         run_steps = 0.0;  ///< expected duration and number of steps of the run; 0: unknown
};

/// Sets the capture velocity of all contacts of `model` for which the scene gives none.
void set_capture_velocities(Model& model, double capture_velocity);

/// Companion runs that certify `run`. run.engine must not be automatic. Errors: SceneError if a requested
/// companion refuses the model.
[[nodiscard]] CompanionPlan plan_companion(const Model& model, const RunSpec& run);

// Data recorded from a run and from its companions.
//
//   CompanionTracker own(model, all, &recorder)      for the run: also forwards all data to the recorder
//   CompanionTracker other(model, all)               for a companion: keeps events and the columns of history.csv
//
// A companion runs in its own thread; it stops at the time at which the run has ended, or on request.

/// Rows with the columns of history.csv; if requested, also N and T of each contact, and the outputs. `values` contains
/// the rows one after another, with `width` numbers each.
struct RecordedRows {
  std::size_t width = 0;
  std::vector<double> t, values;
};

/// Time of the run beyond which companions stop; the thread of the run sets it, companions read it.
class CompanionLimit {
 public:
  void stop_at(double t) { end_.store(t, std::memory_order_relaxed); }
  void stop() { stop_at(-std::numeric_limits<double>::infinity()); }
  [[nodiscard]] bool allows(double t) const { return t <= end_.load(std::memory_order_relaxed); }

 private:
  std::atomic<double> end_{std::numeric_limits<double>::infinity()};
};

/// Number of columns per contact in RecordedRows: N and T.
inline constexpr std::size_t forces_per_contact = 2;

class CompanionTracker : public run::ForwardingRecorder {
 public:
  /// Model and `next` must outlive the object. all: also keep forces and outputs. next: receives all data; null: the
  /// object tracks a companion.
  explicit CompanionTracker(const Model& model, bool all, Recorder* next = nullptr)
      : run::ForwardingRecorder(next), model_(model), all_(all), companion_(next == nullptr) {
    rows.width =
        model.columns.size() + (all ? forces_per_contact * model.contacts.size() + model.outputs.size() : 0);
  }

  void event(const Event& event) override;
  void sample(const Sample& sample) override;
  void response(double t, const std::vector<double>& values) override;
  bool progress(double t) override;

  std::vector<TimedEvent> events;
  RecordedRows rows;
  const CompanionLimit* limit = nullptr;                       ///< of a companion; null: none
  double max_steps = std::numeric_limits<double>::infinity();  ///< of a companion
  bool too_long = false;                                       ///< the companion was stopped after max_steps
  /// For a companion: shift of the next events / their time, which event() subtracts again.
  double event_shift = 0.0;

 private:
  const Model& model_;
  bool all_, companion_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();  // time of the last outputs
  std::vector<double> last_outputs_;
  double steps_ = 0.0;
};

}  // namespace signorini::certify
