#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/number.hpp"
#include "result/plot_parts.hpp"

namespace signorini {

namespace {

constexpr std::size_t most_curves = 24;  // as many as a legend beside the panel can name; curves.csv has them

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

struct Panel {
  std::string suffix, label;
  std::vector<std::size_t> columns;
};

std::vector<Panel> displacement_panels(const PlottedRun& run) {
  const std::string& length = run.facts.units.length;
  std::vector<Panel> panels = {{".ux", "horizontal ux [" + length + "]", {}},
                               {".uy", "vertical uy [" + length + "]", {}},
                               {".rz", "rotation rz [rad]", {}},
                               {".u", "displacement u", {}}};
  for (Panel& p : panels) {
    for (std::size_t i = 1; i < run.columns.size(); ++i) {
      if (ends_with(run.columns[i], p.suffix)) p.columns.push_back(i);
    }
  }
  panels.erase(std::remove_if(panels.begin(), panels.end(), [](const Panel& p) { return p.columns.empty(); }),
               panels.end());
  return panels;
}

}  // namespace

std::string displacement_script(const PlottedRun& run) {
  const std::vector<Panel> panels = displacement_panels(run);
  if (panels.empty()) return "";
  const int count = static_cast<int>(panels.size());
  const int height = 120 + (count == 1 ? 480 : 290 * count);
  std::string s = begin_script(run, {"displacement", "Displacements from the undeformed state", height});
  s += "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21908c', 0.75 '#5dc863', 1 '#fde725')\n";
  s += "unset colorbox\n";
  const double line = 1.0 / height;
  const double bottom = 58.0 * line, top = 1.0 - 62.0 * line, space = 22.0 * line;
  const double panel_height = (top - bottom - space * (count - 1)) / count;
  for (int i = 0; i < count; ++i) {
    const Panel& p = panels[static_cast<std::size_t>(i)];
    const double upper = top - i * (panel_height + space);
    s += panel(run, upper - panel_height, upper, p.label, i + 1 == count);
    const std::size_t shown = std::min(p.columns.size(), most_curves);
    if (shown > 12) s += "set key spacing 0.9 font ',10'\n";
    std::vector<std::string> elements;
    for (std::size_t j = 0; j < shown; ++j) {
      const std::string& name = run.columns[p.columns[j]];
      const TableColumn curve = curve_of(run, "history.csv", name, p.columns[j] + 1);
      elements.push_back(fmt::format(
          "{} using 1:{} with lines linewidth {} {} title {}", curve.data,
          // Curves that coincide show through: every other one is thinner and dashed, on top.
          curve.number, j % 2 == 0 ? "1.9" : "1.2", colour(j, shown) + (j % 2 == 0 ? "" : " dashtype 2"),
          quoted(name.substr(0, name.size() - p.suffix.size()))));
    }
    if (shown < p.columns.size()) {
      elements.push_back("NaN with lines linecolor '#ffffff' title " +
                         quoted(fmt::format("(first {} of {})", shown, p.columns.size())));
    }
    s += plot_command(elements);
  }
  return s + end_script();
}

std::string response_script(const PlottedRun& run) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < run.facts.response.size(); ++i) {
    const std::string& unit = run.facts.response[i].unit;
    const auto same =
        std::find_if(panels.begin(), panels.end(), [&](const Panel& p) { return p.suffix == unit; });
    Panel& p = same == panels.end() ? panels.emplace_back(Panel{unit, "[" + unit + "]", {}}) : *same;
    p.columns.push_back(i);
  }
  if (panels.empty()) return "";
  for (Panel& p : panels)
    if (p.columns.size() == 1) p.label = run.facts.response[p.columns[0]].name + " " + p.label;
  const int count = static_cast<int>(panels.size());
  const int height = 120 + (count == 1 ? 480 : 290 * count);
  std::string s = begin_script(run, {"response", "Response quantities", height});
  s += "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21908c', 0.75 '#5dc863', 1 '#fde725')\n";
  s += "unset colorbox\n";
  const double bottom = 58.0 / height, top = 1.0 - 62.0 / height, space = 22.0 / height;
  const double panel_height = (top - bottom - space * (count - 1)) / count;
  for (int i = 0; i < count; ++i) {
    const Panel& p = panels[static_cast<std::size_t>(i)];
    const double upper = top - i * (panel_height + space);
    s += panel(run, upper - panel_height, upper, p.label, i + 1 == count);
    const std::size_t shown = std::min(p.columns.size(), most_curves);
    std::vector<std::string> elements;
    for (std::size_t j = 0; j < shown; ++j)
      elements.push_back(fmt::format("'../response.csv' using 1:{} with lines linewidth {} {} title {}",
                                     p.columns[j] + 2, j % 2 == 0 ? "1.9" : "1.2",
                                     colour(j, shown) + (j % 2 == 0 ? "" : " dashtype 2"),
                                     quoted(run.facts.response[p.columns[j]].name)));
    if (shown < p.columns.size())
      elements.push_back("NaN with lines linecolor '#ffffff' title " +
                         quoted(fmt::format("(first {} of {})", shown, p.columns.size())));
    s += plot_command(elements);
  }
  return s + end_script();
}

std::string energy_script(const PlottedRun& run, const std::vector<bool>& used, double start) {
  static const std::array<std::pair<const char*, const char*>, 8> parts = {{
      {"kinetic", "linewidth 1.2 linecolor '#1f77b4'"},
      {"elastic", "linewidth 1.2 linecolor '#17a2a2'"},
      {"contact springs", "linewidth 1.2 linecolor '#7b3294'"},
      {"lost by damping", "linewidth 1.6 linecolor '#8c6d31'"},
      {"lost by friction", "linewidth 1.6 linecolor '#d95f02'"},
      {"lost by impacts", "linewidth 1.6 linecolor '#c0182b'"},
      {"work of loads", "linewidth 1.8 linecolor '#1a1a1a'"},
      {"work of surfaces", "linewidth 1.8 linecolor '#1a1a1a' dashtype 2"},
  }};
  const std::string unit = run.facts.units.force + " " + run.facts.units.length;
  std::string s = begin_script(run, {"energy", "Where the energy is, where it went, and the balance", 760});
  s += panel(run, 0.34, 0.915, "energy [" + unit + "]", false);
  std::vector<std::string> elements;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!used[i + 1]) continue;
    const TableColumn curve = curve_of(run, "energy.csv", energy_columns[i].name, i + 2);
    elements.push_back(fmt::format("{} using 1:{} with lines {} title {}", curve.data, curve.number,
                                   parts[i].second, quoted(parts[i].first)));
  }
  const TableColumn balance = curve_of(run, "energy.csv", balance_column, 10);
  if (elements.empty()) elements.push_back(balance.data + " using 1:(0) with lines title 'kinetic'");
  s += plot_command(elements);
  s += panel(run, 0.08, 0.305, "balance off by [" + unit + "]", true);
  s += "set format y '%.1e'\n";
  s +=
      plot_command({fmt::format("{} using 1:(${}-({})) with lines linewidth 1.2 linecolor '#1a1a1a' title {}",
                                balance.data, balance.number, shortest(start), quoted("drift"))});
  s += "set format y '%g'\n";
  return s + end_script();
}

}  // namespace signorini
