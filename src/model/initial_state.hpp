// initial_state.hpp: u(0), v(0) as given by the scene.
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct InitialState {
  Vector u, v;  ///< n
};

/// Values by node, or vectors of a matrix scene; not for initial = "static". Errors: SceneError for a component that
/// does not exist, or a nonzero value of a fixed one.
[[nodiscard]] InitialState given_state(const Scene& scene, const DofMap& map);

/// One sentence for each nonzero value without effect on the motion. Without mass a velocity follows from equilibrium,
/// and so does a displacement, unless a damper, or the dashpot or friction of a contact, needs it. The model: damping
/// set, neither reduced nor with shear elements.
[[nodiscard]] std::vector<std::string> unused_values(const Scene& scene, const DofMap& map,
                                                     const Model& model);

}  // namespace signorini
