// part_share.hpp: what a run that computes a part of a model has in common with those of the others.
//
//   rows a contact, points a curve:   as if all parts were one
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace signorini {

struct Energy;

/// As it is: the whole.
struct PartShare {
  std::size_t parts = 1;
  std::size_t contacts = 0, columns = 0;                      ///< of the whole; columns: that are drawn
  std::vector<std::size_t> numbers = {};                      ///< in the whole, one a contact
  std::shared_ptr<const std::vector<double>> grid = nullptr;  ///< of output times; null: its own
  std::function<void(double t, const Energy&)> energies =
      {};  ///< hears of them as often as a picture of them needs

  [[nodiscard]] bool whole() const { return parts == 1; }
  [[nodiscard]] std::size_t number(std::size_t k) const { return whole() ? k : numbers[k]; }
};

}  // namespace signorini
