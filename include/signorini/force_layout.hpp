// force_layout.hpp: where the forces of a contact stand among those of all contacts.
//
//   N_1, T_1,  N_2, T_2, ...          one normal force a contact, then one force a tangent
//
// Whoever needs the place of a force, the number of all forces or the contact of a row asks here. Residual rows of
// contacts stand in the same order as the forces. All contacts of a model have places for equally many tangents.
#pragma once

#include <cstddef>

namespace signorini {

struct ForceLayout {
  std::size_t tangents = 1;  ///< of each contact
  std::size_t unused = 0;    ///< places that follow the tangents of each contact; their force is zero

  /// From a place of one contact to the same place of the next.
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
