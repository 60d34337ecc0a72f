// frozen_forces.hpp: writes geometric.csv (scene/frozen_file.hpp).
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] std::string frozen_text(const FrozenForces& forces);

}  // namespace signorini
