// tracker.hpp: data recorded from a run and from its companions.
//
//   Tracker own(model, run, &recorder)      forwards everything to the recorder
//   Tracker other(model, run)               keeps events and the columns of history.csv, without forwarding
//
// A companion runs in its own thread: it stops where the run has ended, or on request.
#pragma once

#include <atomic>
#include <limits>
#include <vector>

#include "certify/judge.hpp"
#include "run/forwarding_recorder.hpp"

namespace signorini {

/// Columns of history.csv, row by row; then N and T of each contact, and the outputs, if requested.
struct KeptRows {
  std::size_t width = 0;
  std::vector<double> t, values;
};

/// Limit of the companions' time; changed by the run's thread.
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
  /// Both arguments must outlive the object; without a recorder nothing is forwarded. `all`: also forces and outputs.
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
  const Leash* leash = nullptr;                                 ///< only for a companion
  double most_steps = std::numeric_limits<double>::infinity();  ///< only for a companion
  bool too_long = false;                                        ///< it was ended by most_steps
  double moved = 0.0;  ///< for a companion: part of the time of the next events that it has added itself

 private:
  const Model& model_;
  bool all_, companion_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();  // time of the last outputs
  std::vector<double> last_outputs_;
  double steps_ = 0.0;
};

}  // namespace signorini
