#include "result/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <system_error>

#include "base/file_name.hpp"
#include "base/number.hpp"
#include "result/csv.hpp"
#include "result/csv_read.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_frames.hpp"
#include "result/plot_parts.hpp"
#include "result/plot_rows.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bands = 5000;  // a contact; shorter ones are narrower than any picture resolves

std::vector<std::string> make_slugs(const std::vector<RunFacts::Contact>& contacts) {
  std::vector<std::string> slugs;
  std::set<std::string> taken;
  for (const auto& contact : contacts) {
    const std::string slug = file_name(contact.name, 80, "-_", '_');
    std::string unique = slug;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = slug + "-" + std::to_string(n);
    slugs.push_back(unique);
  }
  return slugs;
}

/// Returns how many output times the window shows.
std::size_t read_times(const fs::path& directory, const PlotWindow& window, PlottedRun& run) {
  std::size_t shown = 0;
  CsvReader history(directory / "history.csv");
  run.columns = history.header();
  while (history.next()) {
    run.t_last = history.t();
    if (run.times++ == 0) run.t_first = run.t_last;
    shown += run.t_last >= window.from.value_or(run.t_last) && run.t_last <= window.to.value_or(run.t_last);
  }
  return shown;
}

// States at the first output time, then the events: the bands are exact, not sampled.
void read_bands(const fs::path& directory, PlottedRun& run) {
  const ContactNumbers index = contact_numbers(run.facts);
  run.bands.resize(index.size());

  CsvReader contacts(directory / "contacts.csv");
  const std::size_t name = contacts.column("contact"), state = contacts.column("state");
  const std::size_t force = contacts.column("N");
  run.greatest_compression.assign(index.size(), 0.0);
  const auto compressed = [&](std::size_t k, double by) {
    run.greatest_compression[k] = std::max(run.greatest_compression[k], by);
  };
  std::size_t rows = 0;
  for (; contacts.next(); ++rows) {
    const std::size_t k = number_of(index, contacts.cell(name), directory / "contacts.csv");
    if (rows < index.size()) run.bands[k].push_back({run.t_first, run.t_first, contacts.cell(state)});
    compressed(k, -contacts.number(force));
  }
  // Less than in history.csv where a kill came between them.
  if (!index.empty()) run.times = std::min(run.times, rows / index.size());

  read_motion(directory, index, run);

  CsvReader events(directory / "events.csv");
  const std::size_t who = events.column("contact"), to = events.column("to");
  const std::size_t normal = events.column("N");
  const double shortest_band = (run.t_last - run.t_first) / static_cast<double>(most_bands);
  const std::size_t type = events.column("event");
  while (events.next()) {
    const double t = events.t();
    if (std::find(run.event_types.begin(), run.event_types.end(), events.cell(type)) == run.event_types.end())
      run.event_types.push_back(events.cell(type));
    if (events.cell(who).empty()) continue;
    const std::size_t k = number_of(index, events.cell(who), directory / "events.csv");
    if (t <= run.t_first || t > run.t_last) continue;
    run.occurring.emplace(k, events.cell(type));
    compressed(k, -events.number(normal));
    auto& bands = run.bands[k];
    if (bands.empty() || bands.back().state == events.cell(to)) continue;
    bands.back().to = t;
    if (bands.size() >= most_bands && t - bands.back().from < shortest_band) {
      bands.back().state = events.cell(to);
    } else {
      bands.push_back({t, t, events.cell(to)});
    }
  }
  for (auto& bands : run.bands) {
    if (!bands.empty()) bands.back().to = run.t_last;
  }
}

std::string energy_script_of(const fs::path& directory, PlottedRun run) {
  CsvReader energy(directory / "energy.csv");
  std::set<std::string> used;
  double start = 0.0;
  run.times = 0;
  for (; energy.next(); ++run.times) {
    for (const EnergyColumn& column : energy_columns)
      if (energy.number(energy.column(column.name)) != 0.0) used.insert(column.name);
    if (run.times == 0) start = energy.number(energy.column(balance_column));
  }
  if (!run.curves.empty()) {
    CsvReader curves(directory / "curves.csv");
    const std::size_t name = curves.column("curve"), value = curves.column("value");
    while (curves.next())
      if (curves.number(value) != 0.0)
        used.insert(curves.cell(name));  // those of displacements are not asked for
  }
  return energy_script(run, used, start);
}

// From the first event of any contact to the last one, with some air; without the ranges of what it shows.
PlottedRun zoom(PlottedRun run) {
  double first = run.t_last, last = run.t_first;
  for (const auto& bands : run.bands) {
    if (bands.size() < 2) continue;
    first = std::min(first, bands[1].from);
    last = std::max(last, bands.back().from);
  }
  const double air = 0.05 * std::max(last - first, 0.0);
  run.from = std::max(first - air, run.t_first);
  run.to = std::min(last + air, run.t_last);
  run.suffix = "-events";
  return run;
}

bool zoom_helps(const PlottedRun& run) {
  constexpr std::size_t most_contacts = 6;  // more would bury the folder in pictures
  std::size_t changes = 0;
  for (const auto& bands : run.bands) changes += bands.empty() ? 0 : bands.size() - 1;
  const PlottedRun zoomed = zoom(run);
  const double part = (zoomed.to - zoomed.from) / (run.t_last - run.t_first);
  return changes >= 4 && part > 0.0 && part < 0.6 && run.bands.size() <= most_contacts;
}

/// Before anything is removed: gnuplot draws nothing of a window without data, and fails.
void check_window(const PlotWindow& window, const PlottedRun& run) {
  const auto check = [&](const char* option, const std::optional<double>& t, bool shows) {
    if (!t || (std::isfinite(*t) && shows)) return;
    throw UsageError(fmt::format("{} {}: nothing to draw, the run covers t = {} to {}", option, shortest(*t),
                                 shortest(run.t_first), shortest(run.t_last)));
  };
  check("--from", window.from, window.from < run.t_last);
  check("--to", window.to, window.to > run.t_first);
}

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

std::vector<fs::path> write_plots(const fs::path& directory, const PlotWindow& window,
                                  const PictureLook& look) {
  PlottedRun run;
  run.look = look;
  run.facts = read_run_facts(directory);
  const std::size_t shown = read_times(directory, window, run);
  if (run.times < 2) return {};
  check_window(window, run);
  if (shown == 0)
    throw UsageError(fmt::format("--from {} --to {}: nothing to draw, no output time lies between",
                                 shortest(window.from.value_or(run.t_first)),
                                 shortest(window.to.value_or(run.t_last))));
  run.slugs = make_slugs(run.facts.contacts);
  read_bands(directory, run);
  std::error_code missing;
  read_curves(directory, run);
  run.from = window.from.value_or(run.t_first);
  run.to = window.to.value_or(run.t_last);
  const bool closer = !window.from && !window.to && zoom_helps(run);
  read_ranges(directory, run);
  PlottedRun zoomed = closer ? zoom(run) : PlottedRun{};
  if (closer) read_ranges(directory, zoomed);

  const fs::path folder = directory / "plots";
  begin_plot_folder(folder, is_picture_of_run);

  std::vector<fs::path> scripts;
  const auto add = [&](const std::string& name, const std::string& text) {
    if (text.empty()) return;
    scripts.push_back(folder / (name + ".gp"));
    write_file(scripts.back(), text);
  };
  add("displacement", displacement_script(run));
  if (fs::is_regular_file(directory / "response.csv", missing))
    add("response", response_script(run, CsvReader(directory / "response.csv")));
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
    write_file(folder / ("states-" + run.slugs[k] + ".csv"), band_table().text(run.bands[k]));
    add("contact-" + run.slugs[k], contact_script(run, k));
    if (closer) add("contact-" + run.slugs[k] + zoomed.suffix, contact_script(zoomed, k));
  }
  if (!run.facts.contacts.empty()) {
    write_file(folder / "marks.csv", mark_table().text(marks_of(directory, run)));
    add("states", states_script(run));
    add("raster", raster_script(run));
    if (closer) {
      write_file(folder / "marks-events.csv", mark_table().text(marks_of(directory, zoomed)));
      add("raster-events", raster_script(zoomed));
    }
    add("cone", cone_script(run));
  }
  for (const FramePicture& picture : frame_pictures(directory, run)) add(picture.name, picture.script);
  add("energy", energy_script_of(directory, run));
  std::error_code error;
  if (fs::is_regular_file(directory / "loads.csv", error))
    add("loads", loads_script(run, CsvReader(directory / "loads.csv").header()));
  return scripts;
}

void remove_plots(const fs::path& directory) { clear_plot_folder(directory / "plots", is_picture_of_run); }

}  // namespace signorini
