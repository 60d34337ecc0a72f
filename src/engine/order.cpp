#include "engine/order.hpp"

#include <fmt/core.h>

namespace signorini {
namespace {

// Measured on the pipeline scene (validation/README.md): with order 5 a step is bounded by stability to
// about a twelfth of the shortest period whatever the tolerance, order 2 is free of that bound but needs
// more steps for accuracy; the two cross between these tolerances.
constexpr double loose = 5e-4;
constexpr double many_modes =
    50.0;  // omega_max / omega1 above which the high modes are not the scene's subject

}  // namespace

void choose_order(const Model& model, const RunSpec& run, Settings& settings) {
  if (run.max_order) {
    settings.max_order = *run.max_order;
    settings.max_order_reason = "as given";
    return;
  }
  const bool stiff = model.omega1 > 0.0 && model.omega_max > many_modes * model.omega1;
  if (run.rtol >= loose && stiff) {
    settings.max_order = 2;
    settings.max_order_reason =
        fmt::format("auto: rtol >= {} and modes up to {:.3g} times the lowest need not be resolved", loose,
                    model.omega_max / model.omega1);
  } else {
    settings.max_order = 5;
    settings.max_order_reason =
        stiff ? "auto: the tolerance resolves the high modes, orders 3 and 4 pass quickly"
              : "auto: few modes, all resolved";
  }
}

}  // namespace signorini
