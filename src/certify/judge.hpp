// judge.hpp: from the events of a run and of its companions to what is certain (signorini/certify.hpp).
//
//   D_k = greatest |t - t'| over the last five events, all contacts and companions
//   t_error = c D_k + uncertainty + 2 eps t        uncertainty: the event's own, or that of its partner if greater; the
//                                                      greatest of all changes at the same instant
//
// The sequence ends to be certain where neighbours of one contact have
//
//   c |(t_i - t'_i) - (t_i-1 - t'_i-1)| + u_i + u_i-1 > (t_i - t_i-1) / 2        u: uncertainties that are roundings,
//                                                                   of the run or, where it has none, of the companion
//
// Or where a contact that touched rests or flies on by less than its speed may be off, r being that speed over
// the slowest that flies (Event::departure), R_k the greatest of the contact's last five differences:
//
//   c R_k max(r, 1) >= |r - 1|        R: |r - r'| / max(r, r', 1)
//
// Both runs may decide such a thing alike, and wrongly. Or where a guard came back into the companion's tolerance
// and left it without a fall (engine/falls/grazes.hpp), or rounding left several states open.
//
// An event with t + t_error beyond that end, less c D, is not certain; `until` is the least t - t_error of these.
//
// Events of jumps of loads happen at a time that is known: their error is rounding, and D knows nothing of
// them.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/falls/graze.hpp"
#include "signorini/event.hpp"

namespace signorini {

/// Over how many events or rows the greatest difference is taken: one may vanish by chance. Chosen; changing
/// it moves "certify: the greatest of five".
inline constexpr std::size_t remembered = 5;

/// A row of events, as far as runs are compared.
struct TimedEvent {
  double t = 0.0;
  float uncertainty = 0.0F;  ///< what is to be added for its own instant; 0: none
  int contact = -1;          ///< -1: a load jumped
  EventType type = EventType::time;
  State from = State::open, to = State::open;
  bool fell = false;  ///< a guard fell; else a jump of a load changed the state
  double departure = std::numeric_limits<double>::quiet_NaN();  ///< Event::departure; NaN: there is none

  /// Of a contact's state; else a load jumped.
  [[nodiscard]] bool is_change() const { return contact >= 0 && type != EventType::time; }
};
[[nodiscard]] TimedEvent timed(const Event& event);

/// Events in order, and how far the run came.
struct Track {
  /// The first violation that the witness of a run has found.
  struct Objection {
    double t = 0.0;
    std::string sentence;
  };

  std::vector<TimedEvent> events;
  double reached = 0.0;
  std::string stop;  ///< why it reached no more; empty at t_end
  /// When rounding first left several states open (Report::forgiven_at).
  std::optional<double> forgiven_at = {};
  /// Of a companion: what it leaves open, it cannot tell of the run.
  std::optional<Graze> graze = {};
  std::optional<Objection> objection = {};
  bool rounded = false;  ///< of a companion: its uncertainties are roundings
};

struct Verdict {
  double until = 0.0;
  std::string reason;  ///< empty: to where the run came
  std::optional<std::size_t> first_uncertain;
  std::vector<double> t_errors;  ///< NaN: not certain
  std::size_t unordered = 0;
  double spread = 0.0;  ///< c D at `until`, or at the end
};

/// `names` of the contacts, for the reason; `factor`: c; `rounded`: uncertainties are roundings, which no two events share.
/// Cost: proportional to the events.
[[nodiscard]] Verdict judge(const Track& run, const std::vector<Track>& companions, double factor,
                            const std::vector<std::string>& names, bool rounded = false);

}  // namespace signorini
