// drawing.hpp: data for drawings of deformed shapes.
//
//   position on a beam = x + u,  u between the ends: linear along it, cubic across (as its stiffness assumes)
#pragma once

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Fills drawing, drawn_nodes and drawn_contacts of a node scene; the contacts must exist already.
void add_drawing(const Scene& scene, const DofMap& map, Model& model);

}  // namespace signorini
