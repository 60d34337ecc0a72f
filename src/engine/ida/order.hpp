// order.hpp: the greatest BDF order for a scene, `max_order = "auto"`.
//
//   rtol <= 1e-4   5: the error test resolves the modes, whatever their damping
//   else           the greatest order that is stable for every mode at every step: acos(zeta) <= alpha_q,
//                  alpha_3 = 86.03, alpha_4 = 73.35, alpha_5 = 51.84 degrees; order 2 always is
//
// zeta: least damping ratio of all frequencies up to the highest, for all contact states; contact springs do not
// contribute to the damping beta K. Source of the angles: Hairer, Wanner, Solving Ordinary Differential Equations II,
// V.2.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct Order {
  int greatest = 5;
  std::string reason;
};
[[nodiscard]] Order choose_order(const Model& model, const RunSpec& run);

}  // namespace signorini
