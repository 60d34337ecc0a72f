// event_matcher.hpp: determines the certified part of a run from its events and the events of its companions
// (signorini/certify.hpp).
//
//   t, t'                                          times of the same event in the run and in a companion
//   D_k = largest |t - t'| of the last five events, over all contacts and companions
//   t_error = c D_k + uncertainty + 2 eps t        uncertainty: t_uncertainty in the run or in a companion, the larger one;
//                                                  changes at one instant share the largest value
//
// The certified sequence ends at the first of these times:
//
// - two successive events of one contact are too close to be ordered (u: uncertainties of an engine with rounding errors
//   only, of the run or else of the companion):
//
//     c |(t_i - t'_i) - (t_i-1 - t'_i-1)| + u_i + u_i-1 > (t_i - t_i-1) / 2
//
// - a contact that touched may rest or rebound, because the error of its speed is too large:
//
//     c R_k max(r, 1) >= |r - 1|        R = |r - r'| / max(r, r', 1)
//
//   r: speed of the contact / smallest speed of a rebound (Event::departure); R_k: largest R of the contact's last five
//   touches. Beyond this limit both runs may make the same wrong decision.
// - a guard of the companion came within its tolerance of zero without an event (engine/events/graze_detector.hpp), or
//   rounding left several contact states possible.
//
// An event is not certified if t + t_error is later than this end minus c D; `until` is the smallest t - t_error of the
// events that are not certified.
//
// The times of jumps of loads are known: their error is rounding, and they do not contribute to D.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/events/graze.hpp"
#include "signorini/event.hpp"

namespace signorini::certify {

/// Number of events or rows over which the largest difference is taken, because a single difference may be small by
/// chance. Chosen value; the test "certify: the greatest of five" depends on it.
inline constexpr std::size_t difference_window = 5;

/// Data of an event that the comparison needs.
struct TimedEvent {
  double t = 0.0;
  /// Event::t_uncertainty, or the fraction of it that is added to t_error; 0: none.
  float uncertainty = 0.0F;
  int contact = -1;  ///< -1: a jump of a load
  EventType type = EventType::time;
  State from = State::open, to = State::open;
  bool is_located = false;  ///< true: a guard reached zero; false: a jump of a load changed the state
  double departure = std::numeric_limits<double>::quiet_NaN();  ///< Event::departure; NaN: not known

  /// True for a change of a contact's state; false for a jump of a load.
  [[nodiscard]] bool is_change() const { return contact >= 0 && type != EventType::time; }
};
/// Copies the data that the comparison needs from an event.
[[nodiscard]] TimedEvent timed_event(const Event& event);

/// Events of a run or of a companion in order of time, and the reasons why its sequence may be uncertain.
struct EventSequence {
  /// First violation that the law checker of the run has found, or another reason why the run is uncertain from t on.
  struct FirstViolation {
    double t = 0.0;
    std::string sentence;
  };

  std::vector<TimedEvent> events;
  double reached = 0.0;
  std::string stop;  ///< reason why the run stopped early; empty: it reached t_end
  /// First time at which rounding left several contact states possible (Report::first_undecided).
  std::optional<double> first_undecided_t = {};
  /// For a companion: a guard that came within the companion's tolerance of zero without an event.
  std::optional<events::Graze> graze = {};
  std::optional<FirstViolation> first_violation = {};
  bool rounded = false;  ///< for a companion: its engine has rounding errors only
};

struct MatchResult {
  double until = 0.0;
  /// Reason for the end at `until`; empty: certified up to the time that the run reached.
  std::string reason;
  std::optional<std::size_t> first_uncertain;
  std::vector<double> t_errors;  ///< one entry per event; NaN: not certified
  /// Number of successive certified events of different contacts in unknown order.
  std::size_t unordered = 0;
  double spread = 0.0;  ///< uncertainty c D of event times at `until`, or at the end
};

/// Compares the events of a run with those of its companions. factor: c; names: names of the contacts, for reasons;
/// rounded: the engine of the run has rounding errors only. Cost: proportional to the number of events.
[[nodiscard]] MatchResult match_events(const EventSequence& run, const std::vector<EventSequence>& companions,
                                       double factor, const std::vector<std::string>& names,
                                       bool rounded = false);

}  // namespace signorini::certify
