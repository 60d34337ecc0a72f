// idle_rotations.hpp: rotations that a scene asks for where nothing turns.
//
//   node of elements without rz (bodies, bars, hinged ends), beside springs of rotations or inertia:
//   J phi'' + c phi' + k phi = M       of that node alone; no element feels it
//   fix = ["rz"] there                 holds nothing; said where a body of plane elements could be meant to be clamped by it
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// One sentence a table of the scene. map: of this scene.
[[nodiscard]] std::vector<std::string> idle_rotations(const Scene& scene, const DofMap& map);

}  // namespace signorini
