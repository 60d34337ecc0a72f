// event_log.hpp: converts decisions to rows of events.csv, and detects events whose order is unknown.
//
// At each instant a contact has at most one row, with the values just before and just after all changes of the instant.
//
//   from -> to               event
//   any -> open              separation
//   open -> any              contact
//   slip s -> slip -s        reversal
//   stick -> slip            slip             also stick -> stick after slip within the instant
//   slip -> stick            stick
//   any -> any, with a hit   impact
//   forces jump with a load  time
//
// Uncertainty of a time: an error delta of the guard g shifts the event by the smallest of (m! delta / |g^(m)|)^(1/m),
// m = 1, 2, ... A warning reports events that are closer than their uncertainties, because their order is unknown. It
// also reports hits of coupled contacts whose times differ by less than the accuracy of the data: delta does not include
// accumulated errors, and successive hits have other results than simultaneous hits.
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
// Each event is compared with the last earlier event whose t_uncertainty is known.

class EventOrder {
 public:
  /// Model and report must outlive the object. Warnings go to the report.
  EventOrder(const Model& model, Report& report) : model_(model), report_(report) {}

  /// Adds an event whose t_uncertainty is known. resolution: times that differ by at most this are one instant.
  void event(const Event& event, double resolution);
  void load_jump(double t);
  void warn(const std::string& which);
  void finish();

 private:
  [[nodiscard]] std::string described(const Event& event) const;

  const Model& model_;
  Report& report_;
  Event last_;         // last event with a contact and a known t_uncertainty
  int unordered_ = 0;  // number of pairs of events whose order is unknown
};

/// Event type of a change of state; nullopt if the change is no event. slipped_within_instant: the contact sticks before and after the
/// instant, but slipped within it.
[[nodiscard]] std::optional<EventType> classify(State from, State to, bool slipped_within_instant);

/// Uncertainty of the time at which a guard is zero. error: error of the guard's value; nullopt: all known derivatives of
/// the guard are zero.
[[nodiscard]] std::optional<double> time_uncertainty(const decide::Crossing& crossing, double error);

/// Writes the events of a run. Values are in the units of the model, except guard_rate, which is in the scene's units,
/// because its unit depends on the guard.
class EventLog {
 public:
  /// The report receives the number of events by type, and warnings. whole: false for a part of a model; PartRows then
  /// checks the order of events.
  EventLog(const Model& model, Recorder& recorder, Report& report, bool whole)
      : model_(model), recorder_(recorder), report_(report), order_(model, report), whole_(whole) {}

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const decide::Decision* decision = nullptr;
    const contact::ContactStates* before = nullptr;  ///< states just before
    bool load_jumps = false;
    /// Durations for which the triggered guards had been zero up to rounding before t (ZeroTracker), one entry per
    /// contact; empty if no triggered guard had been zero.
    std::vector<double> unseen = {};
  };
  /// Logs the events of the start: hits of rigid contacts. In a run that continues another one, the start may be an event of
  /// the whole motion: a hit, or a guard that is zero there. Changes of contacts from their saved states are then events, too.
  void start(const Instant& now, const engine::Stepper& stepper);
  void instant(const Instant& now, const engine::Stepper& stepper);
  void finish();
  /// Events of the last instant that have a contact, in the units of the model; guard_rate is in the scene's units.
  [[nodiscard]] const std::vector<Event>& latest() const { return latest_; }

 private:
  void load_jump(const Instant& now);
  void continued(const Instant& now, std::size_t k, const engine::Stepper& stepper);
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
    std::vector<bool> moves;  ///< for each contact: the hit changed its normal velocity; empty: no hit so far
  } last_hit_;
  long load_jumps_ = 0;
  EventOrder order_;
  bool whole_;
};

}  // namespace signorini::run
