// paraview_bodies.hpp: bodies and seams at the times of run.frames, for ParaView.
//
//   DIR/paraview/bodies.pvd        the frames with their times
//   DIR/paraview/body-0001.vtu     one per time, ASCII:
//
//   points      undeformed nodes of all bodies; `displacement` moves them (Warp By Vector); `stress`: xx, yy, xy; `mises`;
//               `traction`: force per area of a seam on its slave, -p n - tau t at its nodes, zero elsewhere
//   cells       triangles and quadrilaterals, linear or quadratic; one vertex per node of a seam
//   cell data   body: from 0, -1 for vertices; seam: from 0, -1 for elements; state, as in paraview.hpp; pressure,
// opening
//
// Data: frame_bodies.csv and frame_seams.csv (result/body_frames.hpp) on the mesh of the scene.
#pragma once

#include <filesystem>
#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Adds frames to the folder of write_paraview(), and returns bodies.pvd; nullopt if the run has no such frames.
/// Errors: FileError.
std::optional<std::filesystem::path> write_paraview_bodies(const std::filesystem::path& directory,
                                                           const Scene& scene);

}  // namespace signorini
