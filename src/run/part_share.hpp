// part_share.hpp: data that a run of a part has in common with the runs of the other parts.
//
//   rows per contact, points per curve:   as if all parts were one
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace signorini {

struct Energy;

/// Share of a part; the default is the whole model.
struct PartShare {
  std::size_t parts = 1;
  std::size_t contacts = 0, columns = 0;  ///< counts in the whole model; columns: drawn ones
  std::vector<std::size_t> numbers = {};  ///< numbers of its contacts in the whole model
  std::shared_ptr<const std::vector<double>> grid = nullptr;  ///< output times; null: its own
  std::function<void(double t, const Energy&)> energies =
      {};  ///< receives energies as often as a picture needs them

  [[nodiscard]] bool whole() const { return parts == 1; }
  [[nodiscard]] std::size_t number(std::size_t k) const { return whole() ? k : numbers[k]; }
};

}  // namespace signorini
