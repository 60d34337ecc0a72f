// places.hpp: where a contact of a list stands in vectors that have l, k or rn, rt of each in turn.
//
//   (n_1, t_1, n_2, t_2, ...)         the list: those that touch, those that are undecided, those that turn
#pragma once

#include <Eigen/Core>

namespace signorini {

template <class Integer>
[[nodiscard]] constexpr Eigen::Index normal_place(Integer i) {
  return 2 * static_cast<Eigen::Index>(i);
}
template <class Integer>
[[nodiscard]] constexpr Eigen::Index tangent_place(Integer i) {
  return normal_place(i) + 1;
}

}  // namespace signorini
