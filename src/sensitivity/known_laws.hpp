// known_laws.hpp: which laws of contact have tangents.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Errors: SceneError at a law that has none.
void check_tangent_laws(const Scene& scene, const Model& model);

}  // namespace signorini
