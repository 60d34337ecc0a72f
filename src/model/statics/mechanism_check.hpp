// mechanism_check.hpp: refuses a static start of a structure that is a mechanism.
//
//   K + sum of all contacts, closed and stuck:    K x = 0  means that nothing restrains the motion x
#pragma once

#include <vector>

#include "model/statics/static_system.hpp"

namespace signorini::statics {

/// Errors: SceneError for a motion that no contact could restrain, even if all contacts were closed and stuck. `all`: the
/// contacts that can be supports.
void refuse_mechanisms(const StaticProblem& problem, const std::vector<bool>& all, const SourcePlace& place,
                       const char* key);

}  // namespace signorini::statics
