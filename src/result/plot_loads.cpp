#include <fmt/core.h>

#include <iterator>

#include "result/plot_parts.hpp"

namespace signorini {

std::string loads_script(const PlottedRun& run, const std::vector<std::string>& columns) {
  static const char* const colours[] = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                        "#e7298a", "#666666", "#a6761d", "#17becf"};
  constexpr std::size_t most_curves = 24;
  std::vector<std::string> forces, base;
  for (std::size_t i = 1; i < columns.size() && i <= most_curves; ++i) {
    const bool moves = columns[i].starts_with("base motion");
    (moves ? base : forces)
        .push_back(fmt::format(
            "'../loads.csv' skip 1 using 1:{} with lines linewidth 1.6 linecolor '{}' title {}", i + 1,
            moves ? "#1a1a1a" : colours[forces.size() % std::size(colours)], quoted(columns[i])));
  }
  if (forces.empty() && base.empty()) return "";
  const Units& units = run.facts.units;
  const Canvas canvas = canvas_of(run.look, 568, true);
  std::string s = begin_script(run, {"loads", say(run, "Loads and motion of the base"), canvas});
  const bool both = !forces.empty() && !base.empty();
  if (!forces.empty()) {
    s += panel(run, canvas, stacked(0, both ? 2 : 1, canvas), "[" + units.force + "]", !both);
    s += plot_command(forces);
  }
  if (!base.empty()) {
    s += panel(run, canvas, stacked(both ? 1 : 0, both ? 2 : 1, canvas),
               say(run, "acceleration") + " [" + units.length + "/" + units.time + "²]", true);
    s += plot_command(base);
  }
  return s + end_script();
}

}  // namespace signorini
