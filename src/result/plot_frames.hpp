// plot_frames.hpp: pictures of deformed shapes, from frames.csv and frame_contacts.csv.
//
//   DIR/plots/frame-1.gp          one per frame: undeformed structure (thin, grey), deformed structure,
//                                 contact forces
//   DIR/plots/frame-1-shape.csv   kind,x,y,X,Y    x, y undeformed; X, Y deformed and magnified
//   DIR/plots/frame-1-forces.csv  contact,state,x,y,dx,dy
//
// Frames of a run share magnification, force scale and drawn area (exception: frames.hpp). The subtitle states the
// magnification.
#pragma once

#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"

namespace signorini::result {

/// Adds one picture per frame in the time window; of more than 40 frames, 40 are selected evenly.
void add_frame_pictures(const PlottedRun& run, PictureFiles& pictures);

}  // namespace signorini::result
