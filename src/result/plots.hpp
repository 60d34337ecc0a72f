// plots.hpp: gnuplot scripts that draw a run from its tables.
//
//   DIR/plots/displacement.gp         displacements over time
//   DIR/plots/response.gp             response quantities over time, one panel per unit
//   DIR/plots/contact-NAME.gp         N, T against its limits, gap and slip; states as coloured bands
//   DIR/plots/contact-NAME-events.gp  contact-NAME.gp from the first to the last event, if that is a short part of the run
//   DIR/plots/states.gp               the states of all contacts, one bar per contact
//   DIR/plots/raster.gp               the events of all contacts, one row per contact
//   DIR/plots/raster-events.gp        raster.gp from the first to the last event, if that is a short part of the run
//   DIR/plots/cone.gp                 paths of (-N, T) with the friction cones
//   DIR/plots/frame-1.gp              deformed shapes at the times of run.frames (plot_frames.hpp)
//   DIR/plots/loads.gp               loads and the base's acceleration over time
//   DIR/plots/energy.gp               energies and dissipation, and the error of the energy balance
//   DIR/plots/states-NAME.csv         from,to,state: time intervals of each state, between events
//   DIR/plots/marks.csv               row,t,event,N,T: the events of raster and cone
//
// When run in DIR/plots, each script writes an SVG and a PNG with its own name. These functions do not start gnuplot.
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_files.hpp"

namespace signorini::result {

/// Pictures of the run in `directory`; none if there are fewer than two output times. Errors: FileError; UsageError if
/// the time window contains no part of the run.
[[nodiscard]] PictureFiles run_pictures(const std::filesystem::path& directory, const PlotWindow& window = {},
                                        const PictureStyle& look = {});
/// Writes scripts and bands for the run in `directory`; returns the scripts, none if there are fewer than two output
/// times. Errors: FileError; UsageError if the time window contains no part of the run; earlier files then stay.
std::vector<std::filesystem::path> write_plots(const std::filesystem::path& directory,
                                               const PlotWindow& window = {}, const PictureStyle& look = {});

/// Removes from DIR/plots the files of write_plots() and the pictures drawn by its scripts; removes an empty folder.
void remove_plots(const std::filesystem::path& directory);

}  // namespace signorini::result
