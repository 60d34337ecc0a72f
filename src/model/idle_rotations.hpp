// idle_rotations.hpp: rotations without a connection to any element.
//
//   node of elements without rz (bodies, bars, hinged ends), beside springs of rotations or inertia:
//   J phi'' + c phi' + k phi = M       of that node alone; no element is connected to it
//   fix = ["rz"] there                 has no effect; reported where it could be meant to clamp a body of plane
// elements
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// One sentence per table of the scene. map: of this scene.
[[nodiscard]] std::vector<std::string> idle_rotations(const Scene& scene, const DofMap& map);

}  // namespace signorini
