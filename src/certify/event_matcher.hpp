// event_matcher.hpp: determines the certain part of a run from its events and those of its companions
// (signorini/certify.hpp).
//
//   D_k = largest |t - t'| over the last five events, all contacts and companions
//   t_error = c D_k + uncertainty + 2 eps t        uncertainty: the event's own, or its partner's if larger; the
//                                                      largest of all changes at the same instant
//
// The certain sequence ends where neighbours of one contact have
//
//   c |(t_i - t'_i) - (t_i-1 - t'_i-1)| + u_i + u_i-1 > (t_i - t_i-1) / 2        u: uncertainties that are roundings,
//                                                                   of the run or, where it has none, of the companion
//
// or where the error of its speed leaves open whether a contact that touched rests or rebounds:
//
//   c R_k max(r, 1) >= |r - 1|        R = |r - r'| / max(r, r', 1)
//
// r: speed of the contact / smallest speed of a rebound (Event::departure); R_k: the largest R of the
// contact's last five differences.
//
// Both runs may make the same wrong decision there. The certain sequence also ends where a guard entered the
// companion's tolerance and left it without an event (engine/events/graze_detector.hpp), or where rounding
// left several states open.
//
// An event with t + t_error beyond that end minus c D is not certain; `until` is the smallest t - t_error of these.
//
// Events of jumps of loads have known times: their error is rounding, and they do not contribute to D.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/events/graze.hpp"
#include "signorini/event.hpp"

namespace signorini::certify {

/// Number of events or rows over which the largest difference is taken, because a single one may vanish by chance.
/// Chosen value; the test "certify: the greatest of five" depends on it.
inline constexpr std::size_t difference_window = 5;

/// Columns of a row of events that are needed for the comparison.
struct TimedEvent {
  double t = 0.0;
  float uncertainty = 0.0F;  ///< part of its t_error that belongs to its own instant; 0: none
  int contact = -1;          ///< -1: a jump of a load
  EventType type = EventType::time;
  State from = State::open, to = State::open;
  bool is_located = false;  ///< a guard reached zero; else a jump of a load changed the state
  double departure = std::numeric_limits<double>::quiet_NaN();  ///< Event::departure; NaN: there is none

  /// True for a change of a contact's state; false for a jump of a load.
  [[nodiscard]] bool is_change() const { return contact >= 0 && type != EventType::time; }
};
/// The columns of an event that the comparison needs.
[[nodiscard]] TimedEvent timed_event(const Event& event);

/// Events in order, and the time that the run reached.
struct EventSequence {
  /// The first violation that the law checker of a run has found.
  struct FirstViolation {
    double t = 0.0;
    std::string sentence;
  };

  std::vector<TimedEvent> events;
  double reached = 0.0;
  std::string stop;  ///< reason why it stopped earlier; empty at t_end
  /// Time at which rounding first left several states open (Report::forgiven_at).
  std::optional<double> forgiven_at = {};
  /// For a companion: a decision that the companion leaves open and so cannot confirm for the run.
  std::optional<events::Graze> graze = {};
  std::optional<FirstViolation> first_violation = {};
  bool rounded = false;  ///< for a companion: its uncertainties are roundings
};

struct MatchResult {
  double until = 0.0;
  std::string reason;  ///< empty: certain up to the time that the run reached
  std::optional<std::size_t> first_uncertain;
  std::vector<double> t_errors;  ///< NaN: not certain
  std::size_t unordered = 0;
  double spread = 0.0;  ///< c D at `until`, or at the end
};

/// `names` of the contacts, for the reason; `factor`: c; `rounded`: uncertainties are roundings, which no two events
/// share. Cost: proportional to the number of events.
[[nodiscard]] MatchResult match_events(const EventSequence& run, const std::vector<EventSequence>& companions,
                                       double factor, const std::vector<std::string>& names,
                                       bool rounded = false);

}  // namespace signorini::certify
