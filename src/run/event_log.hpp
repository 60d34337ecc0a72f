// event_log.hpp: converts decisions to rows of events.csv, and detects events whose order is unknown.
//
//   from -> to               event            a contact
//   any -> open              separation       has at most one row per instant, with the values just before
//   open -> any              contact          and just after all changes of this instant
//   slip s -> slip -s        reversal
//   stick -> slip            slip             also stick -> stick after slip within the instant
//   slip -> stick            stick
//   any, with a hit          impact
//   forces jump with a load  time
//
// Uncertainty of a time: the guard changes by |g'| dt, so an error delta of the guard moves the event by the smallest
// of (m! delta / |g^(m)|)^(1/m). The order of events closer than their uncertainties is unknown, and a
// warning reports it. A warning also reports hits of coupled contacts within the accuracy of the data: delta
// excludes accumulated errors, and successive hits have other results than simultaneous ones.
#pragma once

#include <optional>
#include <string>

#include "engine/stepper.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

// Detects events whose order is unknown.
//
//   t_2 - t_1 < e_1 + e_2      e: uncertainty of an event's time;   events of one instant are not compared
//
// Each event is compared with the last earlier event whose guard reached zero.

class EventOrder {
 public:
  /// Model and report must outlive the object. Warnings go to the report.
  EventOrder(const Model& model, Report& report) : model_(model), report_(report) {}

  /// Adds an event whose t_uncertainty is known.
  void event(const Event& event, double resolution);
  void load_jump(double t);
  void warn(const std::string& which);
  void finish();

 private:
  [[nodiscard]] std::string described(const Event& event) const;

  const Model& model_;
  Report& report_;
  Event last_;  // last event with a contact and a guard
  int unordered_ = 0;
};

/// Event type of a change of state; nullopt if the change is no event. let_go: the contact slipped within the
/// instant, although it sticks before and after.
[[nodiscard]] std::optional<EventType> classify(State from, State to, bool let_go);

/// Uncertainty of the time at which a guard is zero, for an error of its value; nullopt: no derivative is known.
[[nodiscard]] std::optional<double> time_uncertainty(const decide::Crossing& crossing, double error);

/// Writes the events of a run. guard_rate, whose unit depends on the guard, is in the scene's units; all
/// other values are in the units of the model.
class EventLog {
 public:
  /// Counts by type and warnings go to the report. whole: false for the events of a part, whose order among
  /// events of other parts is unknown.
  EventLog(const Model& model, Recorder& recorder, Report& report, bool whole)
      : model_(model), recorder_(recorder), report_(report), order_(model, report), whole_(whole) {}

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const decide::Decision* decision = nullptr;
    const contact::ContactStates* before = nullptr;  ///< states just before
    bool load_jumps = false;
    /// Durations for which the triggered guards had been zero up to rounding (ZeroTracker), one entry per
    /// contact; empty if no guard had.
    std::vector<double> unseen = {};
  };
  /// Logs hits of rigid contacts; there are no other events at the start.
  void start(const Instant& now, const engine::Stepper& stepper);
  void instant(const Instant& now, const engine::Stepper& stepper);
  void finish();
  /// Rows of the last instant that have a contact, in the units of the model except guard_rate.
  [[nodiscard]] const std::vector<Event>& latest() const { return latest_; }

 private:
  void load_jump(const Instant& now);
  void contact(const Instant& now, std::size_t k, EventType type, const engine::Stepper& stepper);
  void add_conditioning(const Instant& now, const engine::Stepper& stepper, std::size_t k, Event& event);
  void check_hit_order(const Instant& now);

  const Model& model_;
  Recorder& recorder_;
  Report& report_;
  std::vector<Event> latest_;
  struct Hit {
    double t = 0.0;
    std::size_t contact = 0;
    std::vector<bool> moves;  ///< contacts whose normal velocities the hit changed; empty: no hit
  } last_hit_;
  long load_jumps_ = 0;
  EventOrder order_;
  bool whole_;
};

}  // namespace signorini::run
