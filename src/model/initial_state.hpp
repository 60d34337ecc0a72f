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

/// One sentence for each value other than zero that has no part in the motion. Without mass a velocity follows from
/// equilibrium, and so does a displacement, but where a damper, or the dashpot or friction of a contact, begins
/// from it. The model: damping set, neither reduced nor with shear elements.
[[nodiscard]] std::vector<std::string> unused_values(const Scene& scene, const DofMap& map,
                                                     const Model& model);

}  // namespace signorini
