#include "study/sensitivity/sensitivity_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text.hpp"
#include "result/picture_files.hpp"
#include "result/table.hpp"
#include "study/optional_values.hpp"
#include "study/sensitivity/sensitivity_files.hpp"

namespace signorini::sensitivity_study {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t max_figures = 6, max_bars = 16, max_time_pictures = 12;
// Limit for the number of events in a picture of event times.
constexpr std::size_t first_events = 24;
constexpr const char* contact_colours[] = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                           "#e7298a", "#666666", "#a6761d", "#17becf"};
// Largest relative change of a parameter, to each side, that a picture of event times shows.
constexpr double widest = 0.1;
constexpr const char* rising = "#2166ac";
constexpr const char* falling = "#c0182b";

bool is_picture_of_sensitivities(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool named = stem == "tornado" || stem == "sequence" || stem.starts_with("times-");
  return (result::is_picture(file) && named) ||
         (file.extension() == ".csv" && (named || stem.starts_with("tornado-")));
}

struct Bar {
  std::string name;
  double length = 0.0;
};

/// Fraction of the longest bar below which bars are invisible: a thousandth of a pixel in a thousand pixels.
constexpr double no_length = 1e-6;

/// Sorts bars so that the longest is on top: gnuplot's axis points upwards. Invisible bars are dropped.
void sort_bars(std::vector<Bar>& bars) {
  double longest = 0.0;
  for (const Bar& bar : bars) longest = std::max(longest, std::abs(bar.length));
  bars.erase(std::remove_if(bars.begin(), bars.end(),
                            [&](const Bar& bar) { return !(std::abs(bar.length) > no_length * longest); }),
             bars.end());
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return std::abs(a.length) > std::abs(b.length); });
  if (bars.size() > max_bars) bars.resize(max_bars);
  std::reverse(bars.begin(), bars.end());
}

/// A bar and its position, counted from 1 at the bottom.
struct PlacedBar {
  std::size_t place;
  const Bar& bar;
};

/// Table of bars. length: name of the column of lengths.
result::CsvTable<PlacedBar> bar_table(const char* length) {
  return {{"place", &PlacedBar::place},
          {length, [](const PlacedBar& b) { return b.bar.length; }},
          {"parameter", [](const PlacedBar& b) { return std::string_view(b.bar.name); }}};
}

std::vector<PlacedBar> placed(const std::vector<Bar>& bars) {
  std::vector<PlacedBar> list;
  for (const Bar& bar : bars) list.push_back({list.size() + 1, bar});
  return list;
}

std::string bar_tics(const std::vector<Bar>& bars) {
  std::vector<std::pair<std::string, std::size_t>> names;
  for (const Bar& bar : bars) names.emplace_back(bar.name, names.size() + 1);
  return result::named_tics('y', names) +
         fmt::format("\nset yrange [0.4:{:.1f}]\n", static_cast<double>(bars.size()) + 0.6);
}

/// Effect of a parameter on a figure: elasticity, or sigma dx/dp.
double reach_of(const Sensitivities& s, const Sigmas& sigmas, const Response& r, std::size_t p) {
  return sigmas.empty() ? elasticity(s.parameters[p].value, r.value, r.rates[p]) : sigmas[p] * r.rates[p];
}

/// The figures with the largest elasticities, at most max_figures; figures whose elasticities are rounding are left out.
std::vector<const Response*> moved_figures(const Sensitivities& s) {
  std::vector<std::pair<double, const Response*>> sizes;
  for (const Response& r : s.responses) {
    double size = 0.0;
    for (std::size_t p = 0; p < s.parameters.size(); ++p) {
      const double e = elasticity(s.parameters[p].value, r.value, r.rates[p]);
      if (std::isfinite(e)) size = std::max(size, std::abs(e));
    }
    if (size > 0.0) sizes.emplace_back(size, &r);
  }
  std::stable_sort(sizes.begin(), sizes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  // Smaller elasticities, relative to the largest, are rounding. Chosen value: errors of derivatives are at most 1e-10.
  constexpr double rounding_of_derivatives = 1e-9;
  while (!sizes.empty() && sizes.back().first < rounding_of_derivatives * sizes.front().first)
    sizes.pop_back();
  std::vector<const Response*> list;
  for (std::size_t i = 0; i < std::min(sizes.size(), max_figures); ++i) list.push_back(sizes[i].second);
  return list;
}

constexpr const char* wide_margin = "set lmargin at screen 0.3\n";  // room for names of keys

std::string axis_of(const Sensitivities& s, const Response& r, bool sigmas) {
  return r.name + (r.contact < 0 ? "" : " of '" + contact_of(s, r) + "'") +
         fmt::format(" = {:.6g} {}", r.value, unit_of(r, s.units)) +
         (sigmas ? "; change [" + unit_of(r, s.units) + "]" : "; change [%]");
}

void add_tornado(const Sensitivities& s, const Sigmas& sigmas, const result::PlottedRun& run,
                 result::PictureFiles& files) {
  const std::vector<const Response*> figures = moved_figures(s);
  const double each = 70.0 + 26.0 * static_cast<double>(std::min(s.parameters.size(), max_bars));
  result::Picture picture{"tornado",
                          sigmas.empty() ? "Change of each result if a key grows by one per cent; blue: the "
                                           "result increases, red: it decreases"
                                         : "Change of each result if a key grows by one standard deviation; "
                                           "blue: the result increases, red: it decreases",
                          result::canvas_of(run.look,
                                            result::margin_above + result::margin_below - 64.0 +
                                                (each + 64.0) * static_cast<double>(figures.size()),
                                            false, true),
                          false,
                          {},
                          64.0};
  for (const Response* r : figures) {
    std::vector<Bar> bars;
    for (std::size_t p = 0; p < s.parameters.size(); ++p)
      if (const double x = reach_of(s, sigmas, *r, p);
          std::isfinite(x) && (sigmas.empty() || sigmas[p] > 0.0))
        bars.push_back({s.parameters[p].path, x});
    sort_bars(bars);
    const std::string name = fmt::format("tornado-{}", picture.panels.size() + 1);
    const result::CsvTable<PlacedBar> table = bar_table("length");
    files.add_table(name, table.text(placed(bars)));
    result::Panel panel{"",
                        {{"'" + name + ".csv' skip 1",
                          fmt::format("(0.5*{0}):{1}:(0.5*abs({0})):(0.36):({0} < 0 ? 0xc0182b : 0x2166ac)",
                                      table.value("length"), table.number("place")),
                          "with boxxyerror fillstyle solid 0.75 noborder linecolor rgb variable"}}};
    panel.axes = wide_margin + ("set xlabel " + result::quoted(axis_of(s, *r, !sigmas.empty()))) +
                 "\nset xzeroaxis\nset arrow 1 from 0, graph 0 to 0, graph 1 nohead linecolor '#808080'\n"
                 "set xrange [*:*]\n" +
                 bar_tics(bars);
    panel.own_axis = true;
    picture.panels.push_back(panel);
  }
  files.add(run, picture);
}

/// Half the range of the parameter in a picture of event times. The range includes the smallest changes of
/// the sequence unless they are larger than `widest`.
double span_of(const Sensitivities& s, std::size_t p) {
  const double value = std::abs(s.parameters[p].value);
  double least = 0.0;
  for (const SequenceChange& swap : smallest_sequence_changes(s))
    if (swap.parameter == p) least = std::max(least, std::abs(swap.change));
  const double most = widest * (value > 0.0 ? value : 1.0);
  return least > 0.0 ? std::min(3.0 * least, most) : most;
}

/// Tangent of an event's time over a parameter, from (p, t) to (p + dp, t + dt).
struct Tangent {
  double p, t, dp, dt;
  int contact;  ///< number of the contact, from 1; 0: event of a load
};

const result::CsvTable<Tangent>& tangent_table() {
  static const result::CsvTable<Tangent> table = {{"p", &Tangent::p},
                                                  {"t", &Tangent::t},
                                                  {"dp", &Tangent::dp},
                                                  {"dt", &Tangent::dt},
                                                  {"contact", &Tangent::contact}};
  return table;
}

std::vector<Tangent> tangents_of(const Sensitivities& s, std::size_t p, double span) {
  std::vector<Tangent> list;
  for (std::size_t i = 0; i < std::min(s.events.size(), first_events); ++i) {
    const double rate = s.event_rates[i][p].t;
    if (!std::isfinite(rate)) continue;
    list.push_back({s.parameters[p].value - span, s.events[i].t - span * rate, 2.0 * span, 2.0 * span * rate,
                    s.events[i].contact + 1});
  }
  return list;
}

void add_times(const Sensitivities& s, std::size_t p, const result::PlottedRun& run,
               result::PictureFiles& files) {
  const Parameter& parameter = s.parameters[p];
  const double span = span_of(s, p);
  const std::string name = fmt::format("times-{}", p + 1);
  const result::CsvTable<Tangent>& table = tangent_table();
  files.add_table(name, table.text(tangents_of(s, p, span)));
  result::Panel panel{"t [" + s.units.time + "]", {}};
  panel.axes = "set xlabel " + result::quoted(study::key_with_unit(parameter.path, s.units)) + "\n" +
               result::range_of('x', parameter.value - span, parameter.value + span) + "set yrange [*:*]\n" +
               result::vertical_line(1, parameter.value, "dashtype 3 linecolor '#808080'");
  std::size_t arrow = 2;
  const std::string meets = fmt::format("dashtype 2 linecolor '{}'", falling);
  for (const SequenceChange& swap : smallest_sequence_changes(s))
    if (swap.parameter == p && std::max(swap.first, swap.second) < first_events)
      panel.axes += result::vertical_line(arrow++, parameter.value + swap.change, meets);
  const std::size_t count = std::min<std::size_t>(s.contacts.size(), std::size(contact_colours));
  for (std::size_t c = 0; c <= count; ++c)
    panel.curves.push_back(
        {"'" + name + ".csv' skip 1",
         fmt::format("{}:{}:({} == {} ? {} : NaN):{}", table.number("p"), table.number("t"),
                     table.value("contact"), c, table.value("dp"), table.number("dt")),
         fmt::format("with vectors nohead linewidth 1.2 linecolor '{}'",
                     c == 0 ? "#808080" : contact_colours[c - 1]),
         c == 0 ? std::nullopt : std::optional(s.contacts[c - 1])});
  panel.curves.push_back({"NaN", "", "with lines " + meets, "two events meet"});
  const std::string events = s.events.size() > first_events
                                 ? fmt::format("the first {} of {} events", first_events, s.events.size())
                                 : "events";
  files.add(run, {name,
                  "Times of " + events + " over " + parameter.path + ", to first order",
                  result::canvas_of(run.look, 760, false),
                  false,
                  {panel}});
}

void add_sequence(const Sensitivities& s, const result::PlottedRun& run, result::PictureFiles& files) {
  std::vector<Bar> bars;
  for (const SequenceChange& swap : smallest_sequence_changes(s)) {
    const Parameter& parameter = s.parameters[swap.parameter];
    if (parameter.value == 0.0) continue;
    bars.push_back({parameter.path + (swap.change > 0.0 ? " up" : " down"),
                    100.0 * swap.change / std::abs(parameter.value)});
  }
  if (bars.empty()) return;
  sort_bars(bars);
  std::reverse(bars.begin(), bars.end());  // the smallest change on top
  const result::CsvTable<PlacedBar> table = bar_table("per_cent");
  files.add_table("sequence", table.text(placed(bars)));
  const auto points = [&](const char* sign, const char* colour, const char* title) -> result::Curve {
    return {
        "'sequence.csv' skip 1",
        fmt::format("({0} {1} 0 ? abs({0}) : NaN):{2}", table.value("per_cent"), sign, table.number("place")),
        fmt::format("with points pointtype 7 pointsize 1.4 linecolor '{}'", colour), title};
  };
  result::Panel panel{"", {points(">", rising, "upwards"), points("<", falling, "downwards")}};
  panel.axes = wide_margin +
               std::string("set xlabel 'change of the key [%]'\nset logscale x\nset format x '%g'\n") +
               "set xrange [*:*]\n" + bar_tics(bars);
  const double height =
      result::margin_above + result::margin_below + 38.0 + 30.0 * static_cast<double>(bars.size());
  files.add(run, {"sequence",
                  "Least change of each key at which, to first order, two events meet",
                  result::canvas_of(run.look, height, false, true),
                  false,
                  {panel}});
}

}  // namespace

result::PictureFiles sensitivity_pictures(const Sensitivities& s, const Sigmas& sigmas,
                                          const result::PictureStyle& look) {
  result::PictureFiles files(is_picture_of_sensitivities);
  const result::PlottedRun run = result::empty_plotted_run(s.title, s.units, look);
  if (s.events.empty() && s.responses.empty()) return files;
  add_tornado(s, sigmas, run, files);
  if (!s.events.empty())
    for (std::size_t p = 0; p < std::min(s.parameters.size(), max_time_pictures); ++p)
      add_times(s, p, run, files);
  add_sequence(s, run, files);
  return files;
}

void remove_sensitivity_plots(const fs::path& directory) {
  result::clear_plot_folder(directory / "plots", is_picture_of_sensitivities);
}

}  // namespace signorini::sensitivity_study
