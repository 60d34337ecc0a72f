// paraview.hpp: a run as frames in VTK's XML format, for ParaView and other programs.
//
//   DIR/paraview/run.pvd          the frames with their real times
//   DIR/paraview/frame-0001.vtu   one per time, ASCII:
//
//   points      undeformed; `displacement` moves them (Warp By Vector), `force` is the force on the structure at the
// point
//   cells       members as polylines of ten parts, springs as lines; nodes, contacts and loads as vertices
//   cell data   kind: 0 beam, 1 bar, 2 spring, 3 node, 4 contact, 5 load, 6 rigid body; state: 0 stick, 1 slip+, 2 slip-, 3 closed, 4 open,
//               -1 if there is none; item: number of the contact or load, from 0
//
// Displacements and forces are those of the page (run_data.hpp): six digits, members cubic between named nodes. The force of a
// contact is -N n - T t, in the scene's units.
#pragma once

#include <filesystem>
#include <vector>

#include "base/json.hpp"

namespace signorini {

/// `count` equidistant times over the record; with `events`, also the times of events.
[[nodiscard]] std::vector<double> frame_times(const Json& data, std::size_t count, bool events);

/// The text of a frame. `data`: run_data().
[[nodiscard]] std::string vtu_frame(const Json& data, double t);

/// Replaces the folder, and returns run.pvd. Errors: FileError.
std::filesystem::path write_paraview(const std::filesystem::path& directory, const Json& data,
                                     const std::vector<double>& times);

}  // namespace signorini
