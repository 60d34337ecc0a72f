// tracker.hpp: what is kept of a run and of its companions, while they run.
//
//   Tracker own(model, run, &recorder)      passes all on to the recorder
//   Tracker other(model, run)               keeps events and the columns of history.csv, passes nothing on
//
// A companion runs in a thread of its own: it stops where the run has ended, or where it is told to.
#pragma once

#include <atomic>
#include <limits>
#include <vector>

#include "certify/judge.hpp"
#include "run/forwarding_recorder.hpp"

namespace signorini {

/// Columns of history.csv, row by row; then N and T of each contact, and the outputs, where they are wanted.
struct KeptRows {
  std::size_t width = 0;
  std::vector<double> t, values;
};

/// How far companions may go; changed by the run's thread.
class Leash {
 public:
  void stop_at(double t) { end_.store(t, std::memory_order_relaxed); }
  void stop() { stop_at(-std::numeric_limits<double>::infinity()); }
  [[nodiscard]] bool allows(double t) const { return t <= end_.load(std::memory_order_relaxed); }

 private:
  std::atomic<double> end_{std::numeric_limits<double>::infinity()};
};

/// N and T: columns of a row that each contact has.
inline constexpr std::size_t forces_a_row = 2;

class Tracker : public ForwardingRecorder {
 public:
  /// Both must outlive it; without a recorder nothing is passed on.
  /// `all`: forces and outputs, too.
  explicit Tracker(const Model& model, bool all, Recorder* next = nullptr)
      : ForwardingRecorder(next), model_(model), all_(all), companion_(next == nullptr) {
    rows.width =
        model.columns.size() + (all ? forces_a_row * model.contacts.size() + model.outputs.size() : 0);
  }

  void event(const Event& event) override;
  void sample(const Sample& sample) override;
  void response(double t, const std::vector<double>& values) override;
  bool progress(double t) override;

  std::vector<TimedEvent> events;
  KeptRows rows;
  const Leash* leash = nullptr;                                 ///< of a companion
  double most_steps = std::numeric_limits<double>::infinity();  ///< of a companion
  bool too_long = false;                                        ///< it was ended by most_steps
  double moved = 0.0;  ///< of a companion: part of the time of the next events that it has added itself

 private:
  const Model& model_;
  bool all_, companion_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();  // of the outputs that came last
  std::vector<double> last_outputs_;
  double steps_ = 0.0;
};

}  // namespace signorini
