// initial_state.hpp: u(0), v(0) as the scene gives them.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct InitialState {
  Vector u, v;  ///< n
};

/// Node components or the vectors of a matrix scene; not for initial = "static". Errors: SceneError for
/// a component that does not exist, or one other than zero that a support fixes.
[[nodiscard]] InitialState given_state(const Scene& scene, const DofMap& map);

}  // namespace signorini
