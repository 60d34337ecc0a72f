#include "sensitivity/stencils.hpp"

namespace signorini {

const Stencil& two_points() {
  static const Stencil s{{1, -1}, {0.5, -0.5}, {0.5, -0.5}};
  return s;
}
const Stencil& six_points() {
  static const Stencil s{{1, -1, 2, -2, 3, -3},
                         {0.75, -0.75, -0.15, 0.15, 1.0 / 60.0, -1.0 / 60.0},
                         {2.0 / 3.0, -2.0 / 3.0, -1.0 / 12.0, 1.0 / 12.0, 0.0, 0.0}};
  return s;
}
const Stencil& one_side() {
  static const Stencil s{{0, 1, 2, 3, 4, 5},
                         {-137.0 / 60.0, 5.0, -5.0, 10.0 / 3.0, -1.25, 0.2},
                         {-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25, 0.0}};
  return s;
}

}  // namespace signorini
