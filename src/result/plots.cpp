#include "result/plots.hpp"

#include <string>

#include "result/plot_folder.hpp"
#include "result/plot_frames.hpp"
#include "result/plot_parts.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

bool is_picture_of_run(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool named = stem == "displacement" || stem == "energy" || stem == "response" || stem == "loads" ||
                     stem == "states" || stem == "cone" || stem.starts_with("raster") ||
                     stem.starts_with("contact-") || stem.starts_with("frame-");
  const bool table =
      stem.starts_with("states-") || stem.starts_with("frame-") || stem == "marks" || stem == "marks-events";
  return (is_picture(file) && named) || (file.extension() == ".csv" && table);
}

}  // namespace

PictureFiles run_pictures(const fs::path& directory, const PlotWindow& window, const PictureLook& look) {
  PictureFiles pictures(is_picture_of_run);
  const TableFolder tables(directory);
  PlottedRun run = read_plotted_run(tables, read_run_facts(directory), window);
  run.look = look;
  if (run.times < 2) return pictures;
  const std::optional<PlottedRun> zoomed = window.from || window.to ? std::nullopt : closer(tables, run);
  pictures.add(run, displacement_picture(run));
  pictures.add(run, response_picture(run));
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
    pictures.add_table("states-" + run.slugs[k], band_table(run.bands[k]));
    pictures.add(run, contact_picture(run, k));
    if (zoomed) pictures.add(*zoomed, contact_picture(*zoomed, k));
  }
  if (!run.facts.contacts.empty()) {
    pictures.add_table("marks", mark_table().text(run.marks));
    pictures.add(run, states_picture(run));
    pictures.add(run, raster_picture(run));
    if (zoomed) {
      pictures.add_table("marks-events", mark_table().text(zoomed->marks));
      pictures.add(*zoomed, raster_picture(*zoomed));
    }
    pictures.add(run, cone_picture(run));
  }
  add_frame_pictures(run, pictures);
  pictures.add(run, energy_picture(run));
  pictures.add(run, loads_picture(run));
  return pictures;
}

std::vector<fs::path> write_plots(const fs::path& directory, const PlotWindow& window,
                                  const PictureLook& look) {
  return run_pictures(directory, window, look).write(directory);
}

void remove_plots(const fs::path& directory) { clear_plot_folder(directory / "plots", is_picture_of_run); }

}  // namespace signorini
