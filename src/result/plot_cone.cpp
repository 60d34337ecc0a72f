#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "result/plot_parts.hpp"
#include "result/run_tables.hpp"

namespace signorini {

namespace {

constexpr std::size_t most_panels = 20;
constexpr double least_panel = 130.0, small_panel = 300.0;  // pixels, including text beside the panel

struct Grid {
  std::size_t columns = 1, rows = 1;
};

/// Arrangement of panels, with at most `most` side by side.
Grid grid_for(std::size_t panels, std::size_t most) {
  Grid grid;
  grid.columns = panels <= 3
                     ? panels
                     : static_cast<std::size_t>(std::ceil(std::sqrt(1.25 * static_cast<double>(panels))));
  grid.columns = std::clamp<std::size_t>(grid.columns, 1, most);
  grid.rows = (panels + grid.columns - 1) / grid.columns;
  return grid;
}

std::string rgb(const std::string& colour) { return "0x" + colour.substr(1); }

/// 1, 2 or 5 times a power of ten, at least a third of the range: the numbers then fit below a small panel.
double tic_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 3.0)));
  const double digit = range / 3.0 / power;
  return (digit > 5.0 ? 10.0 : digit > 2.0 ? 5.0 : digit > 1.0 ? 2.0 : 1.0) * power;
}

/// The colour of a state, as a gnuplot function.
std::string colour_function() {
  std::string s = "state_colour(s) = ";
  for (const std::string& name : state_names())
    s += "s eq " + quoted(name) + " ? " + rgb(state_colour(name)) + " : ";
  return s + "0x999999\n";
}

std::vector<Curve> curves_of(const PlottedRun& run, std::size_t k, bool small) {
  const RunFacts::Contact& contact = run.facts.contacts[k];
  const std::string data = contact_rows(run, k);
  const CsvTable<ContactRow>& rows = contact_table();
  const std::string inside = fmt::format("({0} >= from && {0} <= to ? -{1} : NaN):{2}", rows.value("t"),
                                         rows.value("N"), rows.number("T"));
  const CsvTable<Mark>& marks = mark_table();
  std::vector<Curve> curves;
  const auto cone = [&](double f, const std::string& dash) {
    for (const char* sign : {"", "-"})
      curves.push_back(
          {fmt::format("{}{}*x", sign, f), "", "with lines linecolor '#c0182b' linewidth 1.2" + dash});
  };
  curves.push_back({"'+'", fmt::format("1:({0}*$1):(-{0}*$1)", contact.static_friction),
                    "with filledcurves fillstyle solid 0.5 noborder linecolor '#fbe9e7'"});
  cone(contact.static_friction, "");
  if (contact.kinetic_friction != contact.static_friction) cone(contact.kinetic_friction, " dashtype 2");
  // Output times may be far apart: the thin line only shows the order of the points.
  curves.push_back({data, inside, "with lines linewidth 0.4 linecolor '#b8b8b8'"});
  curves.push_back({data, inside + ":(state_colour(" + rows.word("state") + "))",
                    std::string("with points pointtype 7 pointsize ") + (small ? "0.2" : "0.35") +
                        " linecolor rgb variable"});
  for (const EventLook& look : event_looks) {
    const PlottedRun::Rows events = marks_of(run, to_string(look.type), static_cast<int>(k));
    if (events.count == 0) continue;
    curves.push_back(
        {recorded("'marks.csv'", events), fmt::format("(-{}):{}", marks.value("N"), marks.number("T")),
         fmt::format("with points pointtype 6 pointsize {} linecolor '{}'", small ? 0.4 : 0.7, look.colour)});
  }
  return curves;
}

bool rubs(const PlottedRun& run, std::size_t k) { return run.facts.contacts[k].static_friction != 0.0; }

/// The legend, in a panel of its own without axes.
Panel legend(const PlottedRun& run, const Canvas& canvas, double top) {
  const double left = canvas.right() + 10.0 / canvas.width;
  Panel panel;
  std::string& s = panel.margins;
  s = fmt::format("\nset lmargin at screen {:.4f}\nset rmargin at screen 0.99\n", std::min(left, 0.95));
  s += fmt::format("set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n", 0.5 * top, top);
  s += "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset label\nunset grid\n";
  s += "set xrange [0:1]\nset yrange [0:1]\n";
  s += fmt::format(
      "set key at screen {:.4f},{:.4f} left top vertical maxrows 30 Left reverse samplen 1.6 "
      "spacing 1.15 font ',{:.4g}' noautotitle noenhanced\n",
      left, top, canvas.font(11.0));
  std::vector<Curve>& curves = panel.curves;
  const auto entry = [&](const std::string& look, const std::string& name) {
    curves.push_back({"keyentry", "", "with " + look, name});
  };
  curves.push_back({"2", "", ""});  // gnuplot draws no plot that consists of legend entries only
  entry("lines linecolor '#c0182b' linewidth 1.2", "±f|N|");
  const auto two = [](const auto& c) { return c.kinetic_friction != c.static_friction; };
  if (std::any_of(run.facts.contacts.begin(), run.facts.contacts.end(), two))
    entry("lines linecolor '#c0182b' linewidth 1.2 dashtype 2", say(run, "kinetic limit") + " ±f|N|");
  for (const std::string& state : state_names()) {
    bool occurs = false;
    for (std::size_t k = 0; k < run.bands.size(); ++k)
      occurs = occurs || (rubs(run, k) && std::any_of(run.bands[k].begin(), run.bands[k].end(),
                                                      [&](const auto& b) { return b.state == state; }));
    if (occurs && state != "open" && state != "closed")
      entry("points pointtype 7 pointsize 0.7 linecolor '" + state_colour(state) + "'", say(run, state));
  }
  for (const EventLook& look : event_looks) {
    const auto drawn = [&](const auto& e) { return e.second == to_string(look.type) && rubs(run, e.first); };
    if (std::any_of(run.occurring.begin(), run.occurring.end(), drawn))
      entry(fmt::format("points pointtype 6 pointsize 0.9 linecolor '{}'", look.colour),
            say(run, "event") + ": " + say(run, to_string(look.type)));
  }
  panel.after = "set border 3\nset tics\nset grid\n";
  return panel;
}

/// Name and friction coefficients above a panel, and its ranges.
std::string heading_and_ranges(const PlottedRun& run, std::size_t k, const Canvas& canvas, bool small) {
  const auto& contact = run.facts.contacts[k];
  const std::string f =
      contact.static_friction == contact.kinetic_friction
          ? fmt::format(", f = {:.4g}", contact.static_friction)
          : fmt::format(", f = {:.4g} and {:.4g}", contact.static_friction, contact.kinetic_friction);
  std::string s = "set label 3 " + quoted(contact.name + f) +
                  fmt::format(" at graph 0,1 left offset character 0,0.8 font ',{:.4g}'\n",
                              canvas.font(small ? 10.0 : 13.0));
  const double greatest = run.greatest_compression[k];
  const double most = greatest > 0.0 ? 1.08 * greatest : 1.0;
  s += fmt::format("set xrange [0:{0}]\nset yrange [-{1}:{1}]\n", shortest(most),
                   shortest(1.05 * most * contact.static_friction));
  return small ? s + "set xtics " + shortest(tic_step(most)) + "\n" : s;
}

}  // namespace

Picture cone_picture(const PlottedRun& run) {
  std::vector<std::size_t> shown;
  std::size_t rubbing = 0;
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
    if (!rubs(run, k)) continue;
    if (++rubbing <= most_panels) shown.push_back(k);
  }
  if (shown.empty()) return {};
  Canvas canvas = canvas_of(run.look, 0.0, false);
  const double room = canvas.width * (canvas.right() - canvas.left());
  const Grid grid =
      grid_for(shown.size(), std::max<std::size_t>(1, static_cast<std::size_t>(room / least_panel)));
  const bool small = grid.columns > 2 || room / static_cast<double>(grid.columns) < small_panel;
  const double panel_height = std::min(grid.columns == 1   ? 560.0
                                       : grid.columns == 2 ? 400.0
                                       : grid.columns == 3 ? 300.0
                                                           : 200.0,
                                       1.3 * room / static_cast<double>(grid.columns));
  constexpr double between = 70.0, above = 92.0;
  canvas.height = std::round(above - 2.0 + static_cast<double>(grid.rows) * (panel_height + between));
  const std::string part =
      rubbing > shown.size() ? " (" + say(run, "first {} of {}", shown.size(), rubbing) + ")" : "";
  Picture picture{"cone",
                  say(run, "Contact forces and friction cones") + part + ": " +
                      say(run, "inside sticks, on its edge slips"),
                  canvas};
  picture.setup = colour_function() + "set samples 2\nset grid back\nset offsets 0,0,0,0\n";
  if (small) picture.setup += fmt::format("set tics font ',{:.4g}'\n", canvas.font(10.0));
  const double line = 1.0 / canvas.height, left = canvas.left(), right = canvas.right();
  const double width = (right - left) / static_cast<double>(grid.columns);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t column = i % grid.columns, row = i / grid.columns;
    const double top = 1.0 - line * (above + static_cast<double>(row) * (panel_height + between));
    const double from = left + width * static_cast<double>(column);
    Panel panel{"", curves_of(run, shown[i], small)};
    std::string& s = panel.margins;
    s = fmt::format("\nset lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", from,
                    from + width - (grid.columns > 1 ? 60.0 / canvas.width : 0.0));
    s += fmt::format("set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
                     top - panel_height * line, top);
    s += heading_and_ranges(run, shown[i], canvas, small);
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
    picture.panels.push_back(panel);
  }
  picture.panels.push_back(legend(run, canvas, 1.0 - above * line));
  return picture;
}

}  // namespace signorini
