// band_order.hpp: an order of degrees of freedom in which matrices have a narrow band (Cuthill, McKee 1969).
//
//   |place(i) - place(j)| <= width   wherever M, C, K, or one contact, couple i and j
//
// From an end of each component its neighbours follow level by level, those with few neighbours first. The ends of a
// component are far from each other: two searches for the last level find them.
#pragma once

#include <cstddef>
#include <vector>

#include "linear/structure.hpp"

namespace signorini {

struct BandOrder {
  std::vector<int> place;  ///< place of each degree of freedom
  std::size_t width = 0;
};

[[nodiscard]] BandOrder band_order(const Model& model, const Structure& structure);

}  // namespace signorini
