// orbit_pictures.hpp: pictures of one orbit, in addition to those of its run.
//
//   plots/multipliers.gp   Floquet multipliers and the unit circle
//   plots/phase.gp         v over u of the degrees of freedom with the largest motion, from history.csv; three at most
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

/// directory: contains the run of a period. Errors: FileError.
[[nodiscard]] PictureFiles orbit_pictures(const std::filesystem::path& directory, const std::string& title,
                                          const Units& units, const Orbit& orbit,
                                          const PictureLook& look = {});

[[nodiscard]] bool is_picture_of_orbit(const std::filesystem::path& file);

}  // namespace signorini
