#include "result/plots.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "result/picture_files.hpp"
#include "result/plot_frames.hpp"
#include "result/plot_parts.hpp"
#include "result/run_tables.hpp"

namespace signorini::result {

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

PictureFiles run_pictures(const fs::path& directory, const PlotWindow& window, const PictureStyle& look) {
  PictureFiles pictures(is_picture_of_run);
  const TableFolder tables(directory);
  PlottedRun run = read_plotted_run(tables, read_run_facts(directory), window);
  run.look = look;
  if (run.times < 2) return pictures;
  const std::optional<PlottedRun> zoomed =
      window.from || window.to ? std::nullopt : event_window(tables, run);
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
                                  const PictureStyle& look) {
  return run_pictures(directory, window, look).write(directory);
}

void remove_plots(const fs::path& directory) { clear_plot_folder(directory / "plots", is_picture_of_run); }

namespace {

// Largest number of curves in a panel, because its legend has no room for more; curves.csv has all curves.
constexpr std::size_t max_curves = 24;

constexpr double unit_rotation = 1e-3;  // scale of rotations in rad, to recognise rounding errors

constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                                "#e7298a", "#666666", "#a6761d", "#17becf"};

std::string colour(std::size_t curve, std::size_t count) {
  if (count <= colours.size()) return fmt::format("linecolor '{}'", colours[curve]);
  return fmt::format("linecolor palette fraction {:.3f}",
                     static_cast<double>(curve) / static_cast<double>(count - 1));
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

struct PlottedLine {
  std::string title;
  TableColumn curve;
};

/// In a panel with more than eight curves, only the six with the largest motion are drawn.
constexpr std::size_t max_displacements = 8, chosen_displacements = 6;

struct PanelOfLines {
  std::string key, label;  ///< key: common end of the column names, or common unit
  std::vector<PlottedLine> lines;
  std::string axis = "";  ///< gnuplot lines for a nearly constant curve; else empty
  /// If above 0: number of lines from which those with the largest motion were selected.
  std::size_t candidate_count = 0;
};

/// Keeps the lines with the largest motion, in the order of the nodes: twenty curves would be illegible.
void choose_lines(const PlottedRun& run, PanelOfLines& p) {
  if (p.lines.size() <= max_displacements) return;
  const auto size_of = [&](const PlottedLine& line) {
    const auto found = run.moves.find(line.title + p.key);
    return found == run.moves.end() ? 0.0 : found->second.size();
  };
  std::vector<double> sizes;
  for (const PlottedLine& line : p.lines) sizes.push_back(size_of(line));
  std::nth_element(sizes.begin(), sizes.begin() + (chosen_displacements - 1), sizes.end(), std::greater<>());
  const double least = sizes[chosen_displacements - 1];
  p.candidate_count = p.lines.size();
  std::vector<PlottedLine> chosen;
  for (const PlottedLine& line : p.lines)
    if (size_of(line) >= least && chosen.size() < chosen_displacements) chosen.push_back(line);
  p.lines = std::move(chosen);
}

std::vector<PanelOfLines> displacement_panels(const PlottedRun& run) {
  const std::string& length = run.facts.units.length;
  std::vector<PanelOfLines> panels = {{".ux", translate(run, "horizontal ux") + " [" + length + "]", {}},
                                      {".uy", translate(run, "vertical uy") + " [" + length + "]", {}},
                                      {".rz", translate(run, "rotation rz") + " [rad]", {}},
                                      {".u", translate(run, "displacement u"), {}}};
  for (PanelOfLines& p : panels)
    for (std::size_t i = 1; i < run.columns.size(); ++i) {
      const std::string& name = run.columns[i];
      if (!ends_with(name, p.key)) continue;
      p.lines.push_back({name.substr(0, name.size() - p.key.size()),
                         curve_of(run, name, {rows_over_time("../history.csv", run.times), 1, i + 1})});
    }
  double greatest = 0.0;
  for (const auto& [name, range] : run.moves)
    if (!ends_with(name, ".rz")) greatest = std::max(greatest, range.size());
  for (PanelOfLines& p : panels) {
    Range all;
    for (const PlottedLine& line : p.lines)
      if (const auto found = run.moves.find(line.title + p.key); found != run.moves.end())
        all.take(found->second);
    p.axis = constant_axis(all, p.key == ".rz" ? unit_rotation : greatest);
  }
  for (PanelOfLines& p : panels) choose_lines(run, p);
  panels.erase(
      std::remove_if(panels.begin(), panels.end(), [](const PanelOfLines& p) { return p.lines.empty(); }),
      panels.end());
  return panels;
}

/// Panels of the response quantities, one panel per unit.
std::vector<PanelOfLines> response_panels(const PlottedRun& run) {
  std::vector<PanelOfLines> panels;
  for (std::size_t i = 0; i + 1 < run.responses.size(); ++i) {
    const RunFacts::Response& column = run.facts.response[i];
    const auto same = std::find_if(panels.begin(), panels.end(),
                                   [&](const PanelOfLines& p) { return p.key == column.unit; });
    PanelOfLines& p = same == panels.end()
                          ? panels.emplace_back(PanelOfLines{column.unit, "[" + column.unit + "]", {}})
                          : *same;
    p.lines.push_back({column.name, {"'../response.csv'", run.responses[0], run.responses[i + 1]}});
  }
  for (PanelOfLines& p : panels)
    if (p.lines.size() == 1) p.label = p.lines[0].title + " " + p.label;
  return panels;
}

Panel panel_of(const PlottedRun& run, const PanelOfLines& p, const Canvas& canvas) {
  Panel panel{p.label, {}, p.axis};
  const std::size_t shown = std::min(p.lines.size(), max_curves);
  if (shown > 12) panel.axes += fmt::format("set key spacing 0.9 font ',{:.4g}'\n", canvas.font(10.0));
  for (std::size_t j = 0; j < shown; ++j)
    // Every second curve is thinner and dashed, so that curves which coincide stay visible.
    panel.curves.push_back({p.lines[j].curve.rows, p.lines[j].curve.columns(),
                            std::string("with lines linewidth ") + (j % 2 == 0 ? "1.9 " : "1.2 ") +
                                colour(j, shown) + (j % 2 == 0 ? "" : " dashtype 2"),
                            p.lines[j].title});
  if (shown < p.lines.size())
    panel.curves.push_back({"NaN", "", "with lines linecolor '#ffffff'",
                            "(" + translate(run, "first {} of {}", shown, p.lines.size()) + ")"});
  if (p.candidate_count > 0)
    panel.curves.push_back(
        {"NaN", "", "with lines linecolor '#ffffff'",
         "(" + translate(run, "the {} of {} with the largest motion", shown, p.candidate_count) + ")"});
  return panel;
}

Picture picture_of_lines(const PlottedRun& run, const char* name, const std::string& subtitle,
                         const std::vector<PanelOfLines>& panels) {
  const auto count = static_cast<double>(panels.size());
  Picture picture{name, subtitle, canvas_of(run.look, 132 + (count == 1 ? 480 : 290 * count), true)};
  picture.setup =
      "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21908c', 0.75 '#5dc863', 1 '#fde725')\n"
      "unset colorbox\n";
  for (const PanelOfLines& p : panels) picture.panels.push_back(panel_of(run, p, picture.canvas));
  return picture;
}

}  // namespace

Picture displacement_picture(const PlottedRun& run) {
  return picture_of_lines(run, "displacement", translate(run, "Displacements from the undeformed state"),
                          displacement_panels(run));
}

Picture response_picture(const PlottedRun& run) {
  return picture_of_lines(run, "response", translate(run, "Response quantities"), response_panels(run));
}

Picture energy_picture(const PlottedRun& run) {
  struct Look {
    const char *column, *words, *line;
  };
  static constexpr std::array<Look, energy_columns.size()> parts = {{
      {"kinetic", "kinetic", "linewidth 1.2 linecolor '#1f77b4'"},
      {"elastic", "elastic", "linewidth 1.2 linecolor '#17a2a2'"},
      {"contact", "contact springs", "linewidth 1.2 linecolor '#7b3294'"},
      {"damping", "lost by damping", "linewidth 1.6 linecolor '#8c6d31'"},
      {"friction", "lost by friction", "linewidth 1.6 linecolor '#d95f02'"},
      {"impact", "lost by impacts", "linewidth 1.6 linecolor '#c0182b'"},
      {"loads", "work of loads", "linewidth 1.8 linecolor '#1a1a1a'"},
      {"surface", "work of surfaces", "linewidth 1.8 linecolor '#1a1a1a' dashtype 2"},
  }};
  const std::string unit = " [" + run.facts.units.force + " " + run.facts.units.length + "]";
  const auto curve_in = [&](const char* column) {
    return curve_of(run, column,
                    {rows_over_time("../energy.csv", run.energies.times), energy_table().number("t"),
                     energy_table().number(column)});
  };
  const TableColumn balance = curve_in(balance_column);
  Panel energies{translate(run, "energy") + unit, {}, "", 0.72};
  for (const Look& part : parts) {
    if (!run.energies.used.contains(part.column)) continue;
    const TableColumn curve = curve_in(part.column);
    energies.curves.push_back(
        {curve.rows, curve.columns(), std::string("with lines ") + part.line, translate(run, part.words)});
  }
  if (energies.curves.empty())
    energies.curves.push_back(
        {balance.rows, fmt::format("{}:(0)", balance.time), "with lines", translate(run, "kinetic")});
  Panel off{
      translate(run, "error of the balance") + unit,
      {{balance.rows,
        fmt::format("{}:(${}-({}))", balance.time, balance.number, base::format_number(run.energies.start)),
        "with lines linewidth 1.2 linecolor '#1a1a1a'", translate(run, "drift")}},
      "set format y '%.1e'\n",
      0.28,
      "set format y '%g'\n"};
  return {"energy",
          translate(run, "Stored energy, work, losses and balance"),
          canvas_of(run.look, 768, true),
          true,
          {energies, off},
          27.0};
}

Picture loads_picture(const PlottedRun& run) {
  static constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                                         "#e7298a", "#666666", "#a6761d", "#17becf"};
  constexpr std::size_t max_curves = 24;
  const Units& units = run.facts.units;
  Panel forces{"[" + units.force + "]", {}};
  Panel base{translate(run, "acceleration") + " [" + units.length + "/" + units.time + "²]", {}};
  for (std::size_t i = 1; i < run.loads.size() && i <= max_curves; ++i) {
    const bool moves = run.loads[i].starts_with("base motion");
    std::vector<Curve>& curves = (moves ? base : forces).curves;
    const char* colour = moves ? "#1a1a1a" : colours[curves.size() % colours.size()];
    curves.push_back({"'../loads.csv' skip 1", fmt::format("1:{}", i + 1),
                      fmt::format("with lines linewidth 1.6 linecolor '{}'", colour), run.loads[i]});
  }
  Picture picture{"loads", translate(run, "Loads and motion of the base"), canvas_of(run.look, 568, true)};
  for (const Panel& panel : {forces, base})
    if (!panel.curves.empty()) picture.panels.push_back(panel);
  return picture;
}

}  // namespace signorini::result
