#include "engine/order.hpp"

#include <fmt/core.h>

namespace signorini {
namespace {

// Orders 3 to 5 are unstable near the imaginary axis. At loose tolerances the error test does not see
// undamped modes grow (case 01b at rtol 1e-3: 142 events instead of 10), and order 2 takes twice the steps at
// most; at tighter ones order 5 resolves those modes and needs a third to a ninth (benchmarks/README.md).
constexpr double loose = 1e-4;

}  // namespace

void choose_order(const RunSpec& run, Settings& settings) {
  if (run.max_order) {
    settings.max_order = *run.max_order;
    settings.max_order_reason = "as given";
  } else if (run.rtol > loose) {
    settings.max_order = 2;
    settings.max_order_reason =
        fmt::format("auto: above rtol {} orders above 2 may let undamped modes grow", loose);
  } else {
    settings.max_order = 5;
    settings.max_order_reason = "auto: the tolerance resolves the modes; orders 3 and 4 are passed quickly";
  }
}

}  // namespace signorini
