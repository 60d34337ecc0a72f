#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "result/plot_parts.hpp"
#include "result/run_tables.hpp"

namespace signorini::result {
namespace {

std::string friction_text(const PlottedRun& run, const RunFacts::Contact& contact) {
  if (contact.static_friction == 0.0) return translate(run, "no friction");
  if (contact.static_friction == contact.kinetic_friction) {
    return translate(run, "friction {}", contact.static_friction);
  }
  return translate(run, "friction {} static, {} kinetic", contact.static_friction, contact.kinetic_friction);
}

/// Picture of one contact, panel by panel.
class ContactPicture {
 public:
  ContactPicture(const PlottedRun& run, std::size_t k)
      : run_(run),
        k_(k),
        contact_(run.facts.contacts[k]),
        rows_(contact_rows(run, k)),
        ranges_(run.ranges[k]),
        scales_(scales_of(run.ranges)) {}

  /// From the top: states, N, T (only with friction), gap (not for sliders), tangential motion.
  [[nodiscard]] Picture picture() const {
    Picture p{"contact-" + run_.slugs[k_] + run_.suffix,
              translate(run_, "Contact '{}'", contact_.name) + ", " + friction_text(run_, contact_),
              {}};
    p.space = 21.0;
    const bool rubs = contact_.static_friction > 0.0;
    p.panels = {states(), normal_force()};
    if (rubs) p.panels.push_back(friction_force());
    // The gap has its own scale, because a lift-off is small compared with sliding.
    if (!contact_.slider)
      p.panels.push_back(panel(192.0, "g " + length(), {curve("gap", "#2166ac", translate(run_, "gap g"))},
                               constant_axis(ranges_.gap, scales_.length)));
    // A contact without friction (a wheel, a guide) may move along its tangent too. Rounding errors are not drawn.
    if (rubs || !is_rounding(ranges_.ut, scales_.length)) p.panels.push_back(sliding());
    double height = margin_above + margin_below - p.space;
    for (const Panel& panel : p.panels) height += panel.weight + p.space;
    p.canvas = canvas_of(run_.look, height, true);
    return p;
  }

 private:
  [[nodiscard]] std::string length() const { return "[" + run_.facts.units.length + "]"; }
  [[nodiscard]] std::string force() const { return " [" + run_.facts.units.force + "]"; }

  /// A panel with curves in front of coloured bands for the states.
  [[nodiscard]] Panel panel(double weight, const std::string& label, const std::vector<Curve>& curves,
                            const std::string& axes) const {
    Panel p{label, bands_of(run_, k_, 0.28), axes, weight};
    p.curves.insert(p.curves.end(), curves.begin(), curves.end());
    return p;
  }

  [[nodiscard]] Panel states() const {
    return {"", bands_of(run_, k_, 1.0), "unset ytics\nset grid noxtics noytics\nset yrange [0:1]\n", 26.0,
            "set grid xtics ytics\n"};
  }

  [[nodiscard]] Panel normal_force() const {
    std::vector<Curve> curves = band_legend(run_, k_);
    curves.insert(curves.begin(), curve("N", "#1a1a1a", "N"));
    // N <= 0, so the axis ends at zero; but not if N is zero throughout.
    const bool none = is_rounding(ranges_.N, scales_.force);
    return panel(177.0, "N" + force(), curves,
                 none ? constant_axis(ranges_.N, scales_.force) : "set yrange [*:0] noextend\n");
  }

  [[nodiscard]] Panel friction_force() const {
    std::vector<Curve> curves;
    const auto limits = [&](double f, const std::string& name, const std::string& dash) {
      const std::string at = fmt::format("{}:", contact_table().number("t"));
      const std::string limit = fmt::format("{}*abs({})", f, contact_table().value("N"));
      const std::string look = "with lines linecolor '#c0182b' linewidth 1.0" + dash;
      curves.push_back({rows_, at + "(" + limit + ")", look, name + " ±f|N|"});
      curves.push_back({rows_, at + "(-" + limit + ")", look});
    };
    const bool one = contact_.static_friction == contact_.kinetic_friction;
    limits(contact_.static_friction, translate(run_, one ? "limits" : "static"), "");
    if (!one) limits(contact_.kinetic_friction, translate(run_, "kinetic limit"), " dashtype 2");
    curves.push_back(curve("T", "#1a1a1a", "T"));
    Range range = ranges_.T;
    const double limit = contact_.static_friction * ranges_.N.size();
    range.take(limit);
    range.take(-limit);
    return panel(213.0, "T" + force(), curves, constant_axis(range, scales_.force));
  }

  [[nodiscard]] Panel sliding() const {
    std::vector<Curve> curves = {curve("ut", "#1a1a1a", translate(run_, "motion ut"))};
    Range range = ranges_.ut;
    if (contact_.static_friction > 0.0) {
      curves.push_back(curve("slip", "#b35806", translate(run_, "slip p"), " dashtype 2"));
      range.take(ranges_.slip);
    }
    return panel(208.0, length(), curves, constant_axis(range, scales_.length));
  }

  /// Curve over time of a column of the contact's table.
  [[nodiscard]] Curve curve(std::string_view column, const char* colour, const std::string& title,
                            const char* look = "") const {
    return {rows_, fmt::format("{}:{}", contact_table().number("t"), contact_table().number(column)),
            fmt::format("with lines linewidth 1.4 linecolor '{}'{}", colour, look), title};
  }

  const PlottedRun& run_;
  std::size_t k_;
  const RunFacts::Contact& contact_;
  std::string rows_;
  const ContactRanges& ranges_;
  ContactScales scales_;
};

}  // namespace

Picture contact_picture(const PlottedRun& run, std::size_t k) { return ContactPicture(run, k).picture(); }

Picture states_picture(const PlottedRun& run) {
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(34.0, count, run.look);
  Panel panel{"", {}};
  panel.axes = fmt::format("set yrange [{0}.5:-0.5]\nset y2range [{0}.5:-0.5]\nset grid noxtics noytics\n",
                           count - 1) +
               row_tics(run.facts.contacts, row);
  for (const std::string& state : state_names()) {
    std::optional<std::string> name = translate(run, state);
    for (std::size_t k = 0; k < count; ++k) {
      const double y = static_cast<double>(k);
      std::optional<Curve> curve = band_curve(run, k, state, y - 0.38, y + 0.38, 1.0);
      if (!curve) continue;
      curve->name = std::exchange(name, std::nullopt);
      panel.curves.push_back(*curve);
    }
  }
  return {
      "states",
      translate(run, "States of the contacts"),
      canvas_of(run.look, margin_above + margin_below + 24.0 + row * static_cast<double>(count), true, true),
      true,
      {panel}};
}

namespace {

constexpr std::size_t max_panels = 20;
constexpr double least_panel = 130.0, small_panel = 300.0;  // pixels, including labels to the left and right

struct Grid {
  std::size_t columns = 1, rows = 1;
};

/// Arrangement of panels in rows, with at most `most` panels in a row.
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

/// Distance of tics: 1, 2 or 5 times a power of ten, at least a third of the range, so that labels of a small panel fit.
double tic_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 3.0)));
  const double digit = range / 3.0 / power;
  return (digit > 5.0 ? 10.0 : digit > 2.0 ? 5.0 : digit > 1.0 ? 2.0 : 1.0) * power;
}

/// Definition of the gnuplot function state_colour(s), the colour of a state.
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
  for (const EventStyle& look : event_styles) {
    const PlottedRun::Rows events = marks_of(run, signorini::to_string(look.type), static_cast<int>(k));
    if (events.count == 0) continue;
    curves.push_back(
        {table_rows("'marks.csv'", events), fmt::format("(-{}):{}", marks.value("N"), marks.number("T")),
         fmt::format("with points pointtype 6 pointsize {} linecolor '{}'", small ? 0.4 : 0.7, look.colour)});
  }
  return curves;
}

bool rubs(const PlottedRun& run, std::size_t k) { return run.facts.contacts[k].static_friction != 0.0; }

/// A panel without axes that contains the legend. top: upper edge, as a fraction of the height.
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
  curves.push_back({"2", "", ""});  // gnuplot needs a plot in addition to legend entries
  entry("lines linecolor '#c0182b' linewidth 1.2", "±f|N|");
  const auto two = [](const auto& c) { return c.kinetic_friction != c.static_friction; };
  if (std::any_of(run.facts.contacts.begin(), run.facts.contacts.end(), two))
    entry("lines linecolor '#c0182b' linewidth 1.2 dashtype 2", translate(run, "kinetic limit") + " ±f|N|");
  for (const std::string& state : state_names()) {
    bool occurs = false;
    for (std::size_t k = 0; k < run.bands.size(); ++k)
      occurs = occurs || (rubs(run, k) && std::any_of(run.bands[k].begin(), run.bands[k].end(),
                                                      [&](const auto& b) { return b.state == state; }));
    if (occurs && state != "open" && state != "closed")
      entry("points pointtype 7 pointsize 0.7 linecolor '" + state_colour(state) + "'",
            translate(run, state));
  }
  for (const EventStyle& look : event_styles) {
    const auto drawn = [&](const auto& e) {
      return e.second == signorini::to_string(look.type) && rubs(run, e.first);
    };
    if (std::any_of(run.occurring.begin(), run.occurring.end(), drawn))
      entry(fmt::format("points pointtype 6 pointsize 0.9 linecolor '{}'", look.colour),
            translate(run, "event") + ": " + translate(run, signorini::to_string(look.type)));
  }
  panel.after = "set border 3\nset tics\nset grid\n";
  return panel;
}

/// gnuplot lines for the heading of a panel (name and friction coefficients) and for its axis ranges.
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
  s += fmt::format("set xrange [0:{0}]\nset yrange [-{1}:{1}]\n", base::format_number(most),
                   base::format_number(1.05 * most * contact.static_friction));
  return small ? s + "set xtics " + base::format_number(tic_step(most)) + "\n" : s;
}

}  // namespace

Picture cone_picture(const PlottedRun& run) {
  std::vector<std::size_t> shown;
  std::size_t rubbing = 0;
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
    if (!rubs(run, k)) continue;
    if (++rubbing <= max_panels) shown.push_back(k);
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
      rubbing > shown.size() ? " (" + translate(run, "first {} of {}", shown.size(), rubbing) + ")" : "";
  Picture picture{"cone",
                  translate(run, "Contact forces and friction cones") + part + ": " +
                      translate(run, "stick inside, slip on the edge"),
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
    // Only outer panels have axis labels.
    const bool lowest = i + grid.columns >= shown.size();
    s += lowest ? "set xlabel " +
                      quoted((small ? "-N [" : translate(run, "compression") + " -N [") +
                             run.facts.units.force + "]") +
                      "\n"
                : "unset xlabel\n";
    s += column == 0
             ? "set ylabel " + quoted(translate(run, "shear") + " T [" + run.facts.units.force + "]") +
                   " offset character 0.5,0\n"
             : "unset ylabel\n";
    picture.panels.push_back(panel);
  }
  picture.panels.push_back(legend(run, canvas, 1.0 - above * line));
  return picture;
}

namespace {

bool occurs(const PlottedRun& run, EventType type) {
  return std::find(run.event_types.begin(), run.event_types.end(), signorini::to_string(type)) !=
         run.event_types.end();
}

/// Event types that occur in the run. Each has a line within the row of a contact, in this order from the top.
std::vector<EventStyle> lanes_of(const PlottedRun& run) {
  std::vector<EventStyle> lanes;
  for (const EventStyle& look : event_styles)
    if (occurs(run, look.type)) lanes.push_back(look);
  return lanes;
}

}  // namespace

const CsvTable<Mark>& mark_table() {
  static const CsvTable<Mark> table = {
      {"row", &Mark::row}, {"t", &Mark::t}, {"event", &Mark::event}, {"N", &Mark::N}, {"T", &Mark::T}};
  return table;
}

Picture raster_picture(const PlottedRun& run) {
  const std::vector<EventStyle> lanes = lanes_of(run);
  if (lanes.empty()) return {};
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(count <= 2    ? 120.0
                                : count <= 6  ? 70.0
                                : count <= 40 ? 38.0
                                              : 12.0,
                                count, run.look);
  Panel panel{"", {}};
  panel.axes = fmt::format("set yrange [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1) +
               row_tics(run.facts.contacts, row);
  for (std::size_t k = 1; k < count; ++k)
    panel.axes += fmt::format(
        "set arrow from graph 0, first {0}.5 to graph 1, first {0}.5 nohead linecolor '#bbbbbb'\n", k - 1);
  const std::size_t at = mark_table().number("t");
  const auto add = [&](EventType type, const std::string& columns, const std::string& look,
                       const std::optional<std::string>& name) {
    const PlottedRun::Rows rows = marks_of(run, signorini::to_string(type));
    if (rows.count > 0)
      panel.curves.push_back({table_rows("'marks" + run.suffix + ".csv'", rows), columns, look, name});
  };
  add(EventType::time, fmt::format("{}:(-0.5):(0):({})", at, count),
      "with vectors nohead linecolor '#aaaaaa' dashtype 3", translate(run, "load changes"));
  const double lane = 0.84 / static_cast<double>(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    add(lanes[i].type,
        fmt::format("{}:({} + {:.4f}):(0):({:.4f})", at, mark_table().value("row"),
                    -0.42 + lane * static_cast<double>(i), 0.86 * lane),
        fmt::format("with vectors nohead linewidth 1.6 linecolor '{}'", lanes[i].colour), std::nullopt);
  if (panel.curves.empty()) panel.curves.push_back({"NaN", "", "with lines"});  // gnuplot rejects empty plots
  for (const EventStyle& look : lanes)
    panel.curves.push_back({"keyentry", "", fmt::format("with lines linewidth 4 linecolor '{}'", look.colour),
                            translate(run, signorini::to_string(look.type))});
  panel.after = "unset arrow\n";
  return {
      "raster" + run.suffix,
      translate(run, "Events of the contacts, one mark per event"),
      canvas_of(run.look, margin_above + margin_below + 16.0 + row * static_cast<double>(count), true, true),
      true,
      {panel}};
}

}  // namespace signorini::result
