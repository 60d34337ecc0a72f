// unknowns.hpp: places in a vector of unknowns, and in one of rows.
//
//   (x_1 ... x_n,  N_1, T_1,  N_2, T_2, ...)      forces in the order of signorini/force_layout.hpp
#pragma once

#include "signorini/force_layout.hpp"

namespace signorini {

struct Unknowns {
  std::size_t dofs = 0, contacts = 0;
  ForceLayout layout = {};

  /// N of a contact, and its normal row.
  [[nodiscard]] std::size_t normal(std::size_t contact) const { return dofs + layout.normal(contact); }
  /// T of a contact, and its tangent row.
  [[nodiscard]] std::size_t tangent(std::size_t contact) const { return dofs + layout.tangent(contact); }
  [[nodiscard]] std::size_t size() const { return dofs + layout.size(contacts); }
};

}  // namespace signorini
