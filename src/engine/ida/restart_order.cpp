#include "engine/ida/restart_order.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/slip_growth.hpp"

namespace signorini::ida {
namespace {

// rtol above which choose_order() may lower the order. Orders 3 to 5 are unstable near the imaginary axis. At larger rtol, the
// error test does not detect growing undamped modes (case 01b at rtol 1e-3: 142 events instead of 10), and order 2 takes at
// most twice as many steps. At smaller rtol, order 5 resolves these modes and takes a third to a ninth of the steps of order 2
// (benchmarks/README.md).
constexpr double loose = 1e-4;

/// Order of a BDF formula, and the half angle, in degrees, of the sector around the negative real axis in which it is stable.
struct Stability {
  int order;
  double angle;
};
constexpr Stability stability[] = {{5, 51.84}, {4, 73.35}, {3, 86.03}};

}  // namespace

OrderChoice choose_order(const Model& model, const RunSpec& run) {
  if (run.max_order) return {*run.max_order, "as given"};
  if (run.rtol <= loose) return {5, "auto: at this tolerance the steps resolve the highest modes"};
  const double ratio = model::min_damping_ratio(model);
  int greatest = 2;
  for (const Stability& s : stability) {
    if (ratio < std::cos(s.angle * std::numbers::pi / 180.0)) continue;
    greatest = s.order;
    break;
  }
  return {greatest,
          fmt::format("auto: the greatest order that is stable for every mode, because rtol is above "
                      "{} (least damping ratio {:.2g})",
                      loose, ratio)};
}

}  // namespace signorini::ida
