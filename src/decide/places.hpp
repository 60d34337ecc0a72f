// places.hpp: index of a listed contact in vectors that contain l, k or rn, rt of each contact in turn.
//
//   (n_1, t_1, n_2, t_2, ...)         the list: touching, undecided, or reversing contacts
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace signorini {

/// Entries per listed contact: n, and one tangent.
inline constexpr Eigen::Index places_per_contact = 2;

template <class Integer>
[[nodiscard]] constexpr Eigen::Index normal_place(Integer i) {
  return places_per_contact * static_cast<Eigen::Index>(i);
}
template <class Integer>
[[nodiscard]] constexpr Eigen::Index tangent_place(Integer i) {
  return normal_place(i) + 1;
}
/// Length of such a vector.
template <class Integer>
[[nodiscard]] constexpr Eigen::Index place_count(Integer contacts) {
  return places_per_contact * static_cast<Eigen::Index>(contacts);
}
[[nodiscard]] constexpr std::size_t contact_of_place(Eigen::Index place) {
  return static_cast<std::size_t>(place / places_per_contact);
}
[[nodiscard]] constexpr bool is_normal_place(Eigen::Index place) { return place % places_per_contact == 0; }

}  // namespace signorini
