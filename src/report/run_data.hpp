// run_data.hpp: data for drawing and playing a run on its page, from the scene and the run's tables.
//
//   nodes   name, x, y, columns of ux, uy, rz in `curve` (-1: fixed, or not recorded)
//   pieces  a, b (indices of nodes), bar, shape (index); springs, supports, loads, contacts with their directions
//   mesh    edges of bodies, pairs of nodes; nodes[k].mesh: node of a body's mesh, without name and columns
//   shapes, magnification: deflection shapes of pieces, and the scale of motions (mesh_motion.hpp)
//   curve   times: lists;   columns: t (index of its list), u;   contacts[k].motion: t, state, N, T, gap
//   events  t, contact (index; -1 for an event without contact), event, from, to
//
// Displacements come from curves.csv if it has all nodes, else from history.csv. In a scene with [matrices]
// the degrees of freedom are drawn as nodes in a row, which move across the row. Each curve has its own
// times, as in the record (base/curves.hpp); rows of history.csv are dropped evenly, but never the two sides of a jump.
// Numbers have six digits, enough for drawing; times of displacements have nine. Times of contacts and events have all
// digits, so that the page finds the row of an event.
#pragma once

#include <filesystem>

#include "base/json.hpp"
#include "signorini/scene.hpp"

namespace signorini::report {

/// The data of the run in `directory` as JSON. Errors: FileError.
[[nodiscard]] base::Json run_data(const Scene& scene, const std::filesystem::path& directory);

}  // namespace signorini::report
