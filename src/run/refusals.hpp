// refusals.hpp: what of a scene its engine cannot compute.
//
//   exact                 linear laws, forcing of a degree that a series reaches
//   newmark               linear laws
//   friction-iteration    linear laws, contact elements
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// As in scene files.
[[nodiscard]] const char* to_string(Engine engine);

/// Errors: SceneError at run.engine, naming the contact or the load.
void refuse_what_engine_cannot(const Model& model, const RunSpec& run);

}  // namespace signorini
