// alignment.hpp: two lists of events, one by one.
//
//   reference  a1 a2 b1 a3 ...        partners have the same contact, event, from and to, and each contact's
//   other      a1 b1 a2 a3 ...        events keep their order; the first that has no partner ends the list
//
// Only the order of events of different contacts may differ, and only where it means nothing: within one
// instant, or closer than the events' own uncertainties in one of the two lists (then counted as `swapped`).
// `time` rows mark jumps of the loads, not changes of the motion; they take no part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/event.hpp"

namespace signorini {

/// A row of events.csv, as far as lists are compared.
struct LoggedEvent {
  double t = 0.0;
  std::string contact, type, from, to;
  double uncertainty = 0.0;  ///< t_uncertainty; 0 where the run gave none

  /// Of a state; else a load jumped.
  [[nodiscard]] bool is_change() const { return type != to_string(EventType::time); }
  /// "first slip, stick -> slip+"
  [[nodiscard]] std::string name() const;
};

struct AlignedPair {
  std::size_t reference = 0, other = 0;  ///< indices into the two lists
  bool swapped = false;                  ///< stands after an event that it precedes in the reference
};

struct Alignment {
  std::vector<AlignedPair> pairs;  ///< in the order of the reference
  std::size_t swapped = 0;
  /// Where the sequences part: the events that stand there, absent on the side that has no more.
  struct Split {
    double t = 0.0;  ///< the earlier of the two
    std::optional<std::size_t> reference, other;
    std::size_t unaligned = 0;  ///< events from there on, in the longer list
  };
  std::optional<Split> split;
};

struct AlignmentSettings {
  double t_end = 0.0;    ///< both runs reached it; later events are left out
  double instant = 0.0;  ///< events that lie no further apart have no order; at least roundoff of t_end
};

/// Both lists ascend in t. Cost: proportional to the events, times how many share an instant.
[[nodiscard]] Alignment align(const std::vector<LoggedEvent>& reference,
                              const std::vector<LoggedEvent>& other, const AlignmentSettings& settings);

}  // namespace signorini
