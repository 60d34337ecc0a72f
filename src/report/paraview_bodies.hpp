// paraview_bodies.hpp: bodies and seams at the times of run.frames, for ParaView.
//
//   DIR/paraview/bodies.pvd        the frames with their times
//   DIR/paraview/body-0001.vtu     one a time, ASCII:
//
//   points      undeformed nodes of all bodies; `displacement` moves them (Warp By Vector); `stress`: xx, yy, xy; `mises`;
//               `traction`: force per area of a seam on its slave, -p n - tau t at its nodes, zero elsewhere
//   cells       triangles and quadrilaterals, linear or quadratic; a vertex a node of a seam
//   cell data   body: from 0, -1 of vertices; seam: from 0, -1 of elements; state, as in paraview.hpp; pressure, opening
//
// What is written are frame_bodies.csv and frame_seams.csv (result/body_frames.hpp) on the mesh of the scene.
#pragma once

#include <filesystem>
#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Adds to the folder that write_paraview() has begun, and returns bodies.pvd; nothing where the run has no such frames. Errors:
/// FileError.
std::optional<std::filesystem::path> write_paraview_bodies(const std::filesystem::path& directory,
                                                           const Scene& scene);

}  // namespace signorini
