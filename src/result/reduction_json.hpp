// reduction_json.hpp: a reduced model in summary.json and check --json.
#pragma once

#include "base/json.hpp"

#include "signorini/result.hpp"

namespace signorini {

/// `report`: report of the run, or null. With it every direction of a contact has `followed`, its omitted compliance
/// times the largest force: the displacement of the contact by the modes left out, without their inertia.
[[nodiscard]] Json reduction_json(const Reduction& reduction, const Report* report);

}  // namespace signorini
