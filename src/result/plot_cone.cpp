#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "result/plot_parts.hpp"

namespace signorini {

namespace {

constexpr std::size_t most_panels = 20;

struct Grid {
  std::size_t columns = 1, rows = 1;
};

Grid grid_for(std::size_t panels) {
  Grid grid;
  grid.columns = panels <= 3
                     ? panels
                     : static_cast<std::size_t>(std::ceil(std::sqrt(1.25 * static_cast<double>(panels))));
  grid.rows = (panels + grid.columns - 1) / grid.columns;
  return grid;
}

std::string rgb(const std::string& colour) { return "0x" + colour.substr(1); }

/// 1, 2 or 5 times a power of ten, at least a third of the range: so many figures fit below a small panel.
double tic_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 3.0)));
  const double digit = range / 3.0 / power;
  return (digit > 5.0 ? 10.0 : digit > 2.0 ? 5.0 : digit > 1.0 ? 2.0 : 1.0) * power;
}

/// gnuplot functions: the colour of a state, and of an event.
std::string colour_functions() {
  std::string s = "state_colour(s) = ";
  for (const std::string& name : state_names())
    s += "s eq " + quoted(name) + " ? " + rgb(state_colour(name)) + " : ";
  s += "0x999999\nevent_colour(s) = ";
  for (const EventLook& look : event_looks)
    s += std::string("s eq '") + to_string(look.type) + "' ? " + rgb(look.colour) + " : ";
  return s + "0x999999\n";
}

std::string panel_of(const PlottedRun& run, std::size_t k, bool small) {
  const RunFacts::Contact& contact = run.facts.contacts[k];
  const std::string data = contact_rows(run, k);
  const std::string inside = "($1 >= from && $1 <= to ? -$8 : NaN)";
  std::vector<std::string> elements;
  const std::string red = " with lines linecolor '#c0182b' linewidth 1.2";
  const auto cone = [&](double f, const std::string& dash) {
    elements.push_back(fmt::format("{}*x{}{} notitle", f, red, dash));
    elements.push_back(fmt::format("-{}*x{}{} notitle", f, red, dash));
  };
  elements.push_back(
      fmt::format("'+' using 1:({0}*$1):(-{0}*$1) with filledcurves fillstyle solid 0.5 noborder "
                  "linecolor '#fbe9e7' notitle",
                  contact.static_friction));
  cone(contact.static_friction, "");
  if (contact.kinetic_friction != contact.static_friction) cone(contact.kinetic_friction, " dashtype 2");
  // Output times may lie far apart: the thin line only says in which order the points come.
  elements.push_back(data + " using " + inside + ":9 with lines linewidth 0.4 linecolor '#b8b8b8' notitle");
  elements.push_back(data + " using " + inside +
                     ":9:(state_colour(strcol(3))) with points pointtype 7 pointsize " +
                     (small ? "0.2" : "0.35") + " linecolor rgb variable notitle");
  elements.push_back(
      fmt::format("'marks.csv' skip 1 using ($1 == {} ? -$4 : NaN):5:(event_colour(strcol(3))) "
                  "with points pointtype 6 pointsize {} linecolor rgb variable notitle",
                  k, small ? 0.4 : 0.7));
  return plot_command(elements);
}

/// The legend in a panel of its own without axes.
std::string legend(const PlottedRun& run, double top) {
  std::string s = "set lmargin at screen 0.86\nset rmargin at screen 0.99\n";
  s += fmt::format("set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n", top - 0.3, top);
  s += "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset label\nunset grid\n";
  s += "set xrange [0:1]\nset yrange [0:1]\n";
  s += fmt::format(
      "set key at screen 0.85,{:.4f} left top vertical maxrows 30 Left reverse samplen 1.6 "
      "spacing 1.15 font ',11' noautotitle noenhanced\n",
      top);
  std::vector<std::string> elements = {"2 notitle",  // entries of a legend alone are no plot to gnuplot
                                       "keyentry with lines linecolor '#c0182b' linewidth 1.2 title '±f|N|'"};
  for (const auto& contact : run.facts.contacts) {
    if (contact.kinetic_friction == contact.static_friction) continue;
    elements.push_back("keyentry with lines linecolor '#c0182b' linewidth 1.2 dashtype 2 title " +
                       quoted(say(run, "kinetic limit") + " ±f|N|"));
    break;
  }
  for (const std::string& state : state_names()) {
    const bool occurs = std::any_of(run.bands.begin(), run.bands.end(), [&](const auto& bands) {
      return std::any_of(bands.begin(), bands.end(), [&](const auto& b) { return b.state == state; });
    });
    if (occurs && state != "open" && state != "closed")
      elements.push_back("keyentry with points pointtype 7 pointsize 0.7 linecolor '" + state_colour(state) +
                         "' title " + quoted(say(run, state)));
  }
  for (const std::string& event : run.event_types)
    for (const EventLook& look : event_looks)
      if (event == to_string(look.type))
        elements.push_back(
            fmt::format("keyentry with points pointtype 6 pointsize 0.9 linecolor '{}' title {}", look.colour,
                        quoted(say(run, "event") + ": " + say(run, event))));
  return s + plot_command(elements);
}

}  // namespace

std::string cone_script(const PlottedRun& run) {
  std::vector<std::size_t> shown;
  std::size_t rubbing = 0;
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
    if (run.facts.contacts[k].static_friction == 0.0) continue;
    if (++rubbing <= most_panels) shown.push_back(k);
  }
  if (shown.empty()) return "";
  const Grid grid = grid_for(shown.size());
  const bool small = grid.columns > 2;
  const int panel_height = grid.columns == 1 ? 560 : grid.columns == 2 ? 400 : grid.columns == 3 ? 300 : 200;
  const int height = 90 + static_cast<int>(grid.rows) * (panel_height + 70);
  const std::string part =
      rubbing > shown.size() ? " (" + say(run, "first {} of {}", shown.size(), rubbing) + ")" : "";
  std::string s = begin_script(run, {"cone",
                                     say(run, "Contact forces and friction cones") + part + ": " +
                                         say(run, "inside sticks, on its edge slips"),
                                     height});
  s += colour_functions() + "set samples 2\nset grid back\nset offsets 0,0,0,0\n";
  if (small) s += "set tics font ',10'\n";
  const double line = 1.0 / height, left = 0.09, right = 0.845;
  const double width = (right - left) / static_cast<double>(grid.columns);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t column = i % grid.columns, row = i / grid.columns;
    const double top = 1.0 - line * (92.0 + static_cast<double>(row) * (panel_height + 70));
    const double from = left + width * static_cast<double>(column);
    s += fmt::format("\nset lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", from,
                     from + width - (grid.columns > 1 ? 0.055 : 0.0));
    s += fmt::format("set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
                     top - panel_height * line, top);
    const auto& contact = run.facts.contacts[shown[i]];
    const std::string f =
        contact.static_friction == contact.kinetic_friction
            ? fmt::format(", f = {:.4g}", contact.static_friction)
            : fmt::format(", f = {:.4g} and {:.4g}", contact.static_friction, contact.kinetic_friction);
    s += "set label 3 " + quoted(contact.name + f) +
         fmt::format(" at graph 0,1 left offset character 0,0.8 font ',{}'\n", small ? 10 : 13);
    const double greatest = run.greatest_compression[shown[i]];
    const double most = greatest > 0.0 ? 1.08 * greatest : 1.0;
    s += fmt::format("set xrange [0:{0}]\nset yrange [-{1}:{1}]\n", shortest(most),
                     shortest(1.05 * most * contact.static_friction));
    if (small) s += "set xtics " + shortest(tic_step(most)) + "\n";
    // Labels on the outer panels only.
    const bool lowest = i + grid.columns >= shown.size();
    s +=
        lowest
            ? "set xlabel " +
                  quoted((small ? "-N [" : say(run, "compression") + " -N [") + run.facts.units.force + "]") +
                  "\n"
            : "unset xlabel\n";
    s += column == 0 ? "set ylabel " + quoted(say(run, "shear") + " T [" + run.facts.units.force + "]") +
                           " offset character 0.5,0\n"
                     : "unset ylabel\n";
    s += panel_of(run, shown[i], small);
  }
  s += "\n" + legend(run, 1.0 - 92.0 * line);
  s += "set border 3\nset tics\nset grid\n";
  return s + end_script();
}

}  // namespace signorini
