// thinned.hpp: what a picture can show of many rows.
//
//   of each bin [i w, (i + 1) w) of time: the first row, the last, and those with the least and the greatest
//   of every quantity, in their order
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace signorini {

/// value(row, i): the i-th of `count` quantities. Rows have a time t, ascending; width > 0.
template <class Row, class Value>
[[nodiscard]] std::vector<Row> thinned(std::vector<Row> rows, double width, std::size_t count,
                                       const Value& value) {
  std::vector<Row> kept;
  std::vector<std::size_t> chosen;
  for (std::size_t begin = 0; begin < rows.size();) {
    const double bin = std::floor(rows[begin].t / width);
    std::size_t end = begin;
    while (end < rows.size() && std::floor(rows[end].t / width) == bin) ++end;
    chosen.assign({begin, end - 1});
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t least = begin, greatest = begin;
      for (std::size_t j = begin; j < end; ++j) {
        if (value(rows[j], i) < value(rows[least], i)) least = j;
        if (value(rows[j], i) > value(rows[greatest], i)) greatest = j;
      }
      chosen.push_back(least);
      chosen.push_back(greatest);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t j : chosen) kept.push_back(std::move(rows[j]));
    begin = end;
  }
  return kept;
}

}  // namespace signorini
