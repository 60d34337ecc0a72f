// gauss_rule.hpp: Gauss-Legendre quadrature on [0, 1].
//
//   int_0^1 f = sum_i w_i f(x_i), exact for polynomials of degree 23
#pragma once

#include <array>
#include <cstddef>

namespace signorini {

struct GaussRule {
  static constexpr std::size_t nodes = 12;
  std::array<double, nodes> x{}, w{};
};
[[nodiscard]] const GaussRule& gauss_rule();

}  // namespace signorini
