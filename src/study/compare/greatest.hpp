// greatest.hpp: the greatest of many differences, and where it is.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace signorini {

struct Greatest {
  double value = 0.0;
  double t = 0.0;
  std::string where;  ///< a column, a contact, an event

  /// Keeps the greater one. A difference that is no number counts as greater than all that are.
  void take(double difference, double at, const std::string& place) {
    if (std::isnan(value) || difference <= value) return;
    value = difference;
    t = at;
    where = place;
  }
};

/// One quantity: over the whole time that both runs cover, and up to where their sequences part.
struct Deviation {
  Greatest whole, until_split;
  std::size_t count = 0;              ///< pairs compared; 0: nothing to compare
  std::size_t count_until_split = 0;  ///< of these, after t = 0 and before the sequences part
  std::vector<std::string> alone;     ///< columns, or contacts, that one of the two runs has only

  void take(double difference, double at, const std::string& place, double split) {
    ++count;
    whole.take(difference, at, place);
    if (!(at < split)) return;
    until_split.take(difference, at, place);
    if (at > 0.0) ++count_until_split;
  }
};

}  // namespace signorini
