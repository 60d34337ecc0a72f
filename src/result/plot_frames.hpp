// plot_frames.hpp: pictures of deformed shapes, from frames.csv and frame_contacts.csv.
//
//   DIR/plots/frame-1.gp          one a frame: the structure at rest thin and grey, deformed, contact forces
//   DIR/plots/frame-1-shape.csv   kind,x,y,X,Y    x, y at rest; X, Y deformed and magnified
//   DIR/plots/frame-1-forces.csv  contact,state,x,y,dx,dy
//
// Magnification, scale of the forces and section are the same in all frames of a run, and stated.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/plot_parts.hpp"

namespace signorini {

struct FramePicture {
  std::string name;    ///< "frame-1"
  std::string script;  ///< text
};

/// Writes the tables into DIR/plots and returns the scripts; none without frames. Errors: FileError.
[[nodiscard]] std::vector<FramePicture> frame_pictures(const std::filesystem::path& directory,
                                                       const PlottedRun& run);

}  // namespace signorini
