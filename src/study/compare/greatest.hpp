// greatest.hpp: the largest of many differences, and its place.
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

  /// Keeps the larger difference. NaN counts as larger than all numbers.
  void take(double difference, double at, const std::string& place) {
    if (std::isnan(value) || difference <= value) return;
    value = difference;
    t = at;
    where = place;
  }
};

/// Largest difference of one quantity: over the time that both runs cover, and up to the first difference of their
/// sequences.
struct Deviation {
  Greatest whole, until_split;
  std::size_t count = 0;              ///< number of compared pairs; 0: nothing to compare
  std::size_t count_until_split = 0;  ///< number of pairs after t = 0 and before the sequences differ
  std::vector<std::string> alone;     ///< columns or contacts that only one of the two runs has

  void take(double difference, double at, const std::string& place, double split) {
    ++count;
    whole.take(difference, at, place);
    if (!(at < split)) return;
    until_split.take(difference, at, place);
    if (at > 0.0) ++count_until_split;
  }
};

}  // namespace signorini
