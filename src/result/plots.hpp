// plots.hpp: gnuplot scripts that draw a run from its own tables.
//
//   DIR/plots/displacement.gp         displacements over time
//   DIR/plots/response.gp             response quantities over time, a panel a unit
//   DIR/plots/contact-NAME.gp         N, T against its limits, gap and slip; states as coloured bands
//   DIR/plots/contact-NAME-events.gp  the same from the first to the last event, where that is a short part
//   DIR/plots/states.gp               the states of all contacts, one bar a contact
//   DIR/plots/raster.gp               the events of all contacts, a row a contact; raster-events.gp as above
//   DIR/plots/cone.gp                 paths of (-N, T) with the friction cones
//   DIR/plots/frame-1.gp              deformed shapes at the times of run.frames (plot_frames.hpp)
//   DIR/plots/loads.gp               loads and the base's acceleration over time
//   DIR/plots/energy.gp               where the energy is and went, and what the balance is off by
//   DIR/plots/states-NAME.csv         from,to,state: the bands of each state, exact to the event
//   DIR/plots/marks.csv               row,t,event,N,T: the events of raster and cone
//
// Run in DIR/plots, each script writes an SVG and a PNG of its own name. Nothing here starts gnuplot.
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_files.hpp"

namespace signorini {

/// What is to be written for the run in `directory`; nothing when there are fewer than two output times to draw. Errors:
/// FileError; UsageError when the window shows nothing of the run.
[[nodiscard]] PictureFiles run_pictures(const std::filesystem::path& directory, const PlotWindow& window = {},
                                        const PictureLook& look = {});
/// Writes scripts and bands for the run in `directory`; returns the scripts, none when there are fewer
/// than two output times to draw. Errors: FileError; UsageError when the window
/// shows nothing of the run, before anything is removed.
std::vector<std::filesystem::path> write_plots(const std::filesystem::path& directory,
                                               const PlotWindow& window = {}, const PictureLook& look = {});

/// Removes from DIR/plots what write_plots and its scripts put there, and the folder if that empties it.
void remove_plots(const std::filesystem::path& directory);

}  // namespace signorini
