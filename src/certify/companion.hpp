// companion.hpp: choice of the companion runs that certify a run, their expected cost, and their recorded
// data.
//
//   run       companion  setting                          c    reason
//   not exact exact      unchanged                        1.5  the difference is the error
//   ida       finer      rtol / 100, atol / 100           2    at rtol / 10 the errors may be similar
//   with dt   ida        rtol 1e-9 at most                1.5  the difference is the error
//   with dt   finer      dt / 2                           3    4/3 at order two, 2 at order one
//   exact     finer      twice, data off by one rounding  5    two samples of a random error
//
// With exact as companion, the difference contains ida's own local error: a tenth of t_uncertainty is added for the
// part that grazing guards hide. With rtol / 100 half of t_uncertainty is added, since in chatter the
// companion has similar errors. In all other cases all of it is added, since the companion's own error is as
// large.
//
// A run in series makes the same rounding errors in each step of the same length (exact_engine.cpp, share_of_step):
// after N steps they add up to N roundings. Perturbed data do not show this, because they rotate a motion but neither
// damp nor excite it. So companions of `exact` take steps of other, random lengths.
//
// In modes an event's time has an error tau from the rounding of a sum over modes, a bound that two samples seldom
// approach. The later motion starts at that time, so companions of `exact` shift each such event by tau / c, along the
// motion. The event's own row has the unshifted time; the later effect of the shift is part of D, and c D bounds the
// effect of tau.
//
// If a step does not resolve a motion, half the step does not resolve it either: stiff dashpots, and contacts
// with such dashpots, oscillate with both. So dt / 2 is used on request only, and certifies a run only if dt
// max(omega_max, fastest decay) <= 1.
//
// Decisions that depend on a tolerance use the run's tolerance in all companions: velocities below which rebounds come
// to rest, and heights below which ida leaves flights to the series. A finer run that integrated flights which the run
// computes exactly would be less accurate: the errors of thousands of impacts accumulate. The values of c are tested in
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
  /// Events of a companion in modes are shifted by this fraction of the rounding error of their times
  /// (Step::resolution beyond the time resolution), in either direction.
  double event_shift = 0.0;
};

struct CompanionPlan {
  std::vector<CompanionRun> runs;
  std::string name;        ///< "exact", "ida, rtol 1e-10"
  std::string choice;      ///< "as given", or "auto: ..."
  std::string limitation;  ///< reason why the companion cannot certify anything; empty: it can
  double factor = 1.0;
  /// Fraction of t_uncertainty that is added: the part that the difference does not contain.
  double local = 1.0;
  double cost = 0.0;     ///< expected, relative to the run; 0: unknown
  double seconds = 0.0;  ///< expected duration of the companion itself
  double steps = 0.0;    ///< expected number, for one companion; 0: unknown
};

/// Sets this capture velocity for all contacts of `model` that have none.
void set_capture_velocities(Model& model, double capture_velocity);

/// Companion runs that certify `run`. run.engine must not be automatic. Errors: SceneError if a requested
/// companion refuses the model.
[[nodiscard]] CompanionPlan plan_companion(const Model& model, const RunSpec& run);

// Data recorded from a run and from its companions.
//
//   CompanionTracker own(model, run, &recorder)      forwards everything to the recorder
//   CompanionTracker other(model, run)               keeps events and the columns of history.csv, without forwarding
//
// A companion runs in its own thread: it stops where the run has ended, or on request.

/// Columns of history.csv, row by row; then N and T of each contact, and the outputs, if requested.
struct RecordedRows {
  std::size_t width = 0;
  std::vector<double> t, values;
};

/// Limit of the companions' time; changed by the run's thread.
class CompanionLimit {
 public:
  void stop_at(double t) { end_.store(t, std::memory_order_relaxed); }
  void stop() { stop_at(-std::numeric_limits<double>::infinity()); }
  [[nodiscard]] bool allows(double t) const { return t <= end_.load(std::memory_order_relaxed); }

 private:
  std::atomic<double> end_{std::numeric_limits<double>::infinity()};
};

/// Each contact has two columns in a row: N and T.
inline constexpr std::size_t forces_per_contact = 2;

class CompanionTracker : public run::ForwardingRecorder {
 public:
  /// Both arguments must outlive the object; without a recorder nothing is forwarded. `all`: also forces and outputs.
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
  const CompanionLimit* limit = nullptr;                       ///< only for a companion
  double max_steps = std::numeric_limits<double>::infinity();  ///< only for a companion
  bool too_long = false;                                       ///< max_steps ended it
  double event_shift =
      0.0;  ///< for a companion: part of the time of the next events that it has added itself

 private:
  const Model& model_;
  bool all_, companion_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();  // time of the last outputs
  std::vector<double> last_outputs_;
  double steps_ = 0.0;
};

}  // namespace signorini::certify
