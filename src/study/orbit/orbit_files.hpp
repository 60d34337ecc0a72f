// orbit_files.hpp: files of `orbit` in addition to the run of one period (docs/command-line.md).
//
//   orbit.json         period, residual, multipliers, stability, loss, families, energy of a cycle, sequence
//   start/states.csv   the state at the orbit's time 0: initial = { run = ".../start" } in run.toml
//   start/run.toml, start/summary.json    the scene's structure, its scales and damping, in the format of a run
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "signorini/orbit.hpp"

namespace signorini::orbit_study {

/// Text of orbit.json.
[[nodiscard]] std::string orbit_json(const Model& model, const Orbit& orbit);

/// Changes the scene of orbit_scene() so that its run.toml starts from DIR/start.
[[nodiscard]] Scene scene_starting_from(Scene scene, const std::filesystem::path& directory);

/// Writes DIR/orbit.json and DIR/start. model: model of `scene`. Errors: FileError.
void write_orbit(const std::filesystem::path& directory, const Scene& scene, const Model& model,
                 const Orbit& orbit);

// Pictures of one orbit, in addition to those of its run.
//
//   plots/multipliers.gp   Floquet multipliers and the unit circle
//   plots/phase.gp         v over u of the degrees of freedom with the largest motion, from history.csv; three at most

/// Pictures of the orbit. directory: folder with the run of one period. Errors: FileError.
[[nodiscard]] result::PictureFiles orbit_pictures(const std::filesystem::path& directory,
                                                  const std::string& title, const Units& units,
                                                  const Orbit& orbit, const result::PictureStyle& look = {});

/// True for a file that orbit_pictures() or its scripts write.
[[nodiscard]] bool is_picture_of_orbit(const std::filesystem::path& file);

}  // namespace signorini::orbit_study
