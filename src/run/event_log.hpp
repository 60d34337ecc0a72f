// event_log.hpp: from decisions to rows of events.csv.
//
//   from -> to               event            a contact
//   any -> open              separation       has at most one row an instant, with what was just before and
//   open -> any              contact          what is just after everything that happens at it
//   slip s -> slip -s        reversal
//   stick -> slip            slip             also stick -> stick where friction let go and took hold again
//   slip -> stick            stick
//   a hit, whatever follows  impact
//   forces jump with a load  time
//
// How sharp a time is: the guard moves by |g'| dt, so an error delta of the guard shifts the event by the
// least of (m! delta / |g^(m)|)^(1/m); events closer than their uncertainties have no known order, and a
// warning. So have hits of contacts that act on each other within what data are known to: errors carried
// along are not in delta, and one hit after the other ends otherwise than both at once.
#pragma once

#include <optional>

#include "engine/stepper.hpp"
#include "run/event_order.hpp"

namespace signorini {

/// let_go: friction let the contact go within the instant, although it sticks before and after.
[[nodiscard]] std::optional<EventType> classify(State from, State to, bool let_go);

/// Of the instant at which a guard fell whose value is off by `error`; nothing where no derivative is known.
[[nodiscard]] std::optional<double> time_uncertainty(const Crossing& crossing, double error);

/// guard_rate, whose unit is that of the guard, goes out in the scene's units; all else in those of the
/// model.
class EventLog {
 public:
  /// Counts by type and warnings go to the report. whole: else what is logged are the events of a part, whose order among
  /// others it does not know.
  EventLog(const Model& model, Recorder& recorder, Report& report, bool whole)
      : model_(model), recorder_(recorder), report_(report), order_(model, report), whole_(whole) {}

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const Decision* decision = nullptr;
    const Mode* before = nullptr;  ///< the states just before
    bool load_jumps = false;
    /// For how long the guard that fell had been zero to its rounding, one a contact; empty: none had.
    std::vector<double> unseen = {};
  };
  /// Hits of rigid contacts; nothing else is an event at the start.
  void start(const Instant& now, const Stepper& stepper);
  void instant(const Instant& now, const Stepper& stepper);
  void finish();
  /// The rows of the last instant that have a contact, in the units of the model but for guard_rate.
  [[nodiscard]] const std::vector<Event>& latest() const { return latest_; }

 private:
  void load_jump(const Instant& now);
  void contact(const Instant& now, std::size_t k, EventType type, const Stepper& stepper);
  void add_conditioning(const Instant& now, const Stepper& stepper, std::size_t k, Event& event);
  void see_hits(const Instant& now);

  const Model& model_;
  Recorder& recorder_;
  Report& report_;
  std::vector<Event> latest_;
  struct Hit {
    double t = 0.0;
    std::size_t contact = 0;
    std::vector<bool> moves;  ///< whose normal velocities it changed; empty: there is none
  } last_hit_;
  long load_jumps_ = 0;
  EventOrder order_;
  bool whole_;
};

}  // namespace signorini
