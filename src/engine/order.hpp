// order.hpp: the greatest BDF order for a scene, `max_order = "auto"`.
#pragma once

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Fills settings.max_order and settings.max_order_reason.
void choose_order(const RunSpec& run, Settings& settings);

}  // namespace signorini
