// force_layout.hpp: places of a contact's forces among those of all contacts.
//
//   N_1, T_1,  N_2, T_2, ...          one normal force for each contact, then one force for each tangent
//
// It gives the place of a force, the number of all forces and the contact of a row. Residual rows of contacts have the
// same order as the forces. All contacts of a model have places for equally many tangents.
#pragma once

#include <cstddef>

namespace signorini {

struct ForceLayout {
  std::size_t tangents = 1;  ///< tangents of each contact
  std::size_t unused = 0;    ///< places after the tangents of each contact; their force is zero

  /// Distance from a place of one contact to the same place of the next.
  [[nodiscard]] constexpr std::size_t stride() const { return 1 + tangents + unused; }
  /// Number of all forces.
  [[nodiscard]] constexpr std::size_t size(std::size_t contacts) const { return stride() * contacts; }
  [[nodiscard]] constexpr std::size_t normal(std::size_t contact) const { return stride() * contact; }
  [[nodiscard]] constexpr std::size_t tangent(std::size_t contact, std::size_t i = 0) const {
    return stride() * contact + 1 + i;
  }
  [[nodiscard]] constexpr std::size_t contact_of(std::size_t place) const { return place / stride(); }
  [[nodiscard]] constexpr bool is_normal(std::size_t place) const { return place % stride() == 0; }
};

}  // namespace signorini
