// gauss_rule.hpp: Gauss-Legendre quadrature on [0, 1].
//
//   int_0^1 f = sum_i w_i f(x_i), exact for polynomials of degree 2 count - 1
//
// The remainder is (count!)^4 / ( (2 count + 1) (2 count)!^3 ) f^(2 count): 2e-16 with six nodes for powers of motions
// that turn by half a radian, whose rates are up to 1 rad.
#pragma once

#include <array>
#include <cstddef>

namespace signorini {

struct GaussRule {
  static constexpr std::size_t nodes = 12;
  std::size_t count = nodes;
  std::array<double, nodes> x{}, w{};
};
[[nodiscard]] const GaussRule& gauss_rule();
/// Rule with six nodes, for stretches on which the motion turns by `short_turn` at most. Unit: rad.
[[nodiscard]] const GaussRule& short_gauss_rule();
inline constexpr double short_turn = 0.5;

}  // namespace signorini
