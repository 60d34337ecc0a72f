// plot_frames.hpp: pictures of deformed shapes, from frames.csv and frame_contacts.csv.
//
//   DIR/plots/frame-1.gp          one per frame: undeformed structure (thin, grey), deformed structure,
//                                 contact forces
//   DIR/plots/frame-1-shape.csv   kind,x,y,X,Y    x, y undeformed; X, Y deformed and magnified
//   DIR/plots/frame-1-forces.csv  contact,state,x,y,dx,dy
//
// Magnification, force scale and drawn area are the same in all frames of a run, and are printed.
#pragma once

#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"

namespace signorini::result {

/// Adds one picture per frame in the time window, evenly selected if there are many.
void add_frame_pictures(const PlottedRun& run, PictureFiles& pictures);

}  // namespace signorini::result
