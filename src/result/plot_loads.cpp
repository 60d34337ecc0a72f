#include <fmt/core.h>

#include <array>

#include "result/plot_parts.hpp"

namespace signorini {

Picture loads_picture(const PlottedRun& run) {
  static constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                                         "#e7298a", "#666666", "#a6761d", "#17becf"};
  constexpr std::size_t most_curves = 24;
  const Units& units = run.facts.units;
  Panel forces{"[" + units.force + "]", {}};
  Panel base{say(run, "acceleration") + " [" + units.length + "/" + units.time + "²]", {}};
  for (std::size_t i = 1; i < run.loads.size() && i <= most_curves; ++i) {
    const bool moves = run.loads[i].starts_with("base motion");
    std::vector<Curve>& curves = (moves ? base : forces).curves;
    const char* colour = moves ? "#1a1a1a" : colours[curves.size() % colours.size()];
    curves.push_back({"'../loads.csv' skip 1", fmt::format("1:{}", i + 1),
                      fmt::format("with lines linewidth 1.6 linecolor '{}'", colour), run.loads[i]});
  }
  Picture picture{"loads", say(run, "Loads and motion of the base"), canvas_of(run.look, 568, true)};
  for (const Panel& panel : {forces, base})
    if (!panel.curves.empty()) picture.panels.push_back(panel);
  return picture;
}

}  // namespace signorini
