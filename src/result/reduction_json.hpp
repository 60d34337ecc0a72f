// reduction_json.hpp: what summary.json and check --json say about a reduced model.
#pragma once

#include "base/json.hpp"

#include "signorini/result.hpp"

namespace signorini {

/// `report`: of the run, or null. With it every direction of a contact has `followed`, its compliance left
/// out times the greatest force: how far the modes left out moved the contact, as if they had no inertia.
[[nodiscard]] Json reduction_json(const Reduction& reduction, const Report* report);

}  // namespace signorini
