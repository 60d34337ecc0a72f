// alignment.hpp: pairs the events of two lists.
//
//   reference  a1 a2 b1 a3 ...        partners have the same contact, event, from and to, and each contact's
//   other      a1 b1 a2 a3 ...        events keep their order; the first event without a partner ends the list
//
// Only the order of events of different contacts may differ, and only if it is insignificant: within one instant, or
// closer than the events' own uncertainties in one of the two lists (then counted as `swapped`). `time` rows mark jumps
// of the loads, not changes of the motion; they are ignored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/event.hpp"

namespace signorini {

/// Columns of a row of events.csv that are needed for the comparison.
struct LoggedEvent {
  double t = 0.0;
  std::string contact, type, from, to;
  double uncertainty = 0.0;  ///< t_uncertainty; 0 if the run has none

  /// True for a change of state; false for a jump of a load.
  [[nodiscard]] bool is_change() const { return type != to_string(EventType::time); }
  /// "first slip, stick -> slip+"
  [[nodiscard]] std::string name() const;
};

struct AlignedPair {
  std::size_t reference = 0, other = 0;  ///< indices into the two lists
  bool swapped = false;                  ///< in the other list it comes after an event that follows it in the
                                         ///< reference
};

struct Alignment {
  std::vector<AlignedPair> pairs;  ///< in the order of the reference
  std::size_t swapped = 0;
  /// First difference of the sequences: the events there, absent for a list without further events.
  struct Split {
    double t = 0.0;  ///< earlier time of the two events
    std::optional<std::size_t> reference, other;
    std::size_t unaligned = 0;  ///< remaining events of the longer list
  };
  std::optional<Split> split;
};

struct AlignmentSettings {
  double t_end = 0.0;    ///< both runs reached it; later events are ignored
  double instant = 0.0;  ///< events closer than this have no order; at least rounding of t_end
};

/// Both lists must ascend in t. Cost: proportional to the number of events times the number of events per instant.
[[nodiscard]] Alignment align(const std::vector<LoggedEvent>& reference,
                              const std::vector<LoggedEvent>& other, const AlignmentSettings& settings);

}  // namespace signorini
