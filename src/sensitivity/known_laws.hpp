// known_laws.hpp: contact laws for which tangents are implemented.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Errors: SceneError at a law without tangents.
void check_tangent_laws(const Scene& scene, const Model& model);

}  // namespace signorini
