#include "study/sensitivity/sensitivity_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/number.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_parts.hpp"
#include "result/table.hpp"
#include "study/key_unit.hpp"
#include "study/sensitivity/sensitivity_files.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_figures = 6, most_bars = 16, most_time_pictures = 12;
constexpr std::size_t first_events = 24;  // of a picture of event times; more are one grey
constexpr const char* contact_colours[] = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                           "#e7298a", "#666666", "#a6761d", "#17becf"};
constexpr double widest = 0.1;  // of a parameter, that a picture of event times shows to each side
constexpr const char* rising = "#2166ac";
constexpr const char* falling = "#c0182b";

bool is_picture_of_sensitivities(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool named = stem == "tornado" || stem == "sequence" || stem.starts_with("times-");
  return (is_picture(file) && named) ||
         (file.extension() == ".csv" && (named || stem.starts_with("tornado-")));
}

PlottedRun facts_of(const Sensitivities& s, const PictureLook& look) {
  PlottedRun run;
  run.look = look;
  run.facts.title = s.title;
  run.facts.outcome = "done";
  run.facts.units = s.units;
  return run;
}

struct Bar {
  std::string name;
  double length = 0.0;
};

/// Beside the longest one it has no length in a picture: a thousandth of a pixel of a thousand.
constexpr double no_length = 1e-6;

/// Longest on top; gnuplot's axis goes upwards. Those without length are left out.
void sort_bars(std::vector<Bar>& bars) {
  double longest = 0.0;
  for (const Bar& bar : bars) longest = std::max(longest, std::abs(bar.length));
  bars.erase(std::remove_if(bars.begin(), bars.end(),
                            [&](const Bar& bar) { return !(std::abs(bar.length) > no_length * longest); }),
             bars.end());
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return std::abs(a.length) > std::abs(b.length); });
  if (bars.size() > most_bars) bars.resize(most_bars);
  std::reverse(bars.begin(), bars.end());
}

/// A bar and its place from below, from 1.
struct PlacedBar {
  std::size_t place;
  const Bar& bar;
};

/// `length`: the name of its column.
CsvTable<PlacedBar> bar_table(const char* length) {
  return {{"place", &PlacedBar::place},
          {length, [](const PlacedBar& b) { return b.bar.length; }},
          {"parameter", [](const PlacedBar& b) { return std::string_view(b.bar.name); }}};
}

std::vector<PlacedBar> placed(const std::vector<Bar>& bars) {
  std::vector<PlacedBar> list;
  for (const Bar& bar : bars) list.push_back({list.size() + 1, bar});
  return list;
}

std::string bar_ticks(const std::vector<Bar>& bars) {
  std::string s = "set ytics (";
  for (std::size_t i = 0; i < bars.size(); ++i)
    s += (i > 0 ? ", " : "") + quoted_tick(bars[i].name) + fmt::format(" {}", i + 1);
  return s + fmt::format(")\nset yrange [0.4:{:.1f}]\n", static_cast<double>(bars.size()) + 0.6);
}

/// What a parameter does to a figure: elasticity, or sigma dx/dp.
double reach_of(const Sensitivities& s, const Sigmas& sigmas, const Response& r, std::size_t p) {
  return sigmas.empty() ? elasticity(s.parameters[p].value, r.value, r.rates[p]) : sigmas[p] * r.rates[p];
}

/// The figures that parameters move most, by their elasticities.
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
  constexpr double rounding_of_derivatives = 1e-9;  // chosen: their errors are 1e-10 and less of the greatest
  while (!sizes.empty() && sizes.back().first < rounding_of_derivatives * sizes.front().first)
    sizes.pop_back();
  std::vector<const Response*> list;
  for (std::size_t i = 0; i < std::min(sizes.size(), most_figures); ++i) list.push_back(sizes[i].second);
  return list;
}

/// Room for names of keys at the left of a panel.
std::string wide_margin() { return "set lmargin at screen 0.3\n"; }

std::string bars_plot(const std::string& file) {
  const CsvTable<PlacedBar> table = bar_table("length");
  return plot_command(
      {fmt::format("'{0}' skip 1 using (0.5*{3}):{4}:(0.5*abs({3})):(0.36):({3} < 0 ? {1} : {2}) with "
                   "boxxyerror fillstyle solid 0.75 noborder linecolor rgb variable notitle",
                   file, "0xc0182b", "0x2166ac", table.value("length"), table.number("place"))});
}

std::string tornado(const Sensitivities& s, const Sigmas& sigmas, const fs::path& folder,
                    const PictureLook& look) {
  const std::vector<const Response*> figures = moved_figures(s);
  if (figures.empty()) return {};
  const PlottedRun run = facts_of(s, look);
  const auto bars_each = static_cast<int>(std::min(s.parameters.size(), most_bars));
  const int each = 70 + 26 * bars_each;
  const Canvas canvas = canvas_of(
      run.look, room_above + room_below - 64.0 + (each + 64.0) * static_cast<double>(figures.size()), false,
      true);
  std::string text =
      begin_script(run, {"tornado",
                         sigmas.empty() ? "What one per cent more of each key does: blue more, red less"
                                        : "What one standard deviation more of each key does: blue more, "
                                          "red less",
                         canvas, false});
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Response& r = *figures[i];
    std::vector<Bar> bars;
    for (std::size_t p = 0; p < s.parameters.size(); ++p)
      if (const double x = reach_of(s, sigmas, r, p); std::isfinite(x) && (sigmas.empty() || sigmas[p] > 0.0))
        bars.push_back({s.parameters[p].path, x});
    sort_bars(bars);
    const std::string table = fmt::format("tornado-{}.csv", i + 1);
    write_file(folder / table, bar_table("length").text(placed(bars)));
    text += panel(run, canvas, stacked(i, figures.size(), canvas, 64.0), "", true) + wide_margin();
    text += "set xlabel " +
            quoted(r.name + (r.contact < 0 ? "" : " of '" + contact_of(s, r) + "'") +
                   fmt::format(" = {:.6g} {}", r.value, unit_of(r, s.units)) +
                   (sigmas.empty() ? "; change [%]" : "; change [" + unit_of(r, s.units) + "]")) +
            "\n";
    text +=
        "set xzeroaxis\nset arrow 1 from 0, graph 0 to 0, graph 1 nohead linecolor '#808080'\nset xrange "
        "[*:*]\n";
    text += bar_ticks(bars) + bars_plot(table);
  }
  return text + end_script();
}

/// How far to each side a picture of event times goes: past the first changes of the sequence.
double span_of(const Sensitivities& s, std::size_t p) {
  const double value = std::abs(s.parameters[p].value);
  double least = 0.0;
  for (const Swap& swap : least_swaps(s))
    if (swap.parameter == p) least = std::max(least, std::abs(swap.change));
  const double most = widest * (value > 0.0 ? value : 1.0);
  return least > 0.0 ? std::min(3.0 * least, most) : most;
}

/// An event's time over a parameter: from (p, t) by (dp, dt).
struct Tangent {
  double p, t, dp, dt;
  int contact;  ///< from 1; 0: a load
};

const CsvTable<Tangent>& tangent_table() {
  static const CsvTable<Tangent> table = {{"p", &Tangent::p},
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

std::string times(const Sensitivities& s, std::size_t p, const fs::path& folder, const PictureLook& look) {
  const Parameter& parameter = s.parameters[p];
  const double span = span_of(s, p);
  const std::string name = fmt::format("times-{}", p + 1);
  write_file(folder / (name + ".csv"), tangent_table().text(tangents_of(s, p, span)));
  const PlottedRun run = facts_of(s, look);
  const Canvas canvas = canvas_of(run.look, 760, false);
  std::string text =
      begin_script(run, {name,
                         "Times of " +
                             (s.events.size() > first_events
                                  ? fmt::format("the first {} of {} events", first_events, s.events.size())
                                  : std::string("events")) +
                             " over " + parameter.path + ", to first order",
                         canvas, false});
  text += panel(run, canvas, stacked(0, 1, canvas), "t [" + s.units.time + "]", true);
  text += "set xlabel " + quoted(key_with_unit(parameter.path, s.units)) + "\n";
  text += fmt::format("set xrange [{}:{}]\nset yrange [*:*]\n", shortest(parameter.value - span),
                      shortest(parameter.value + span));
  text += fmt::format("set arrow 1 from {0}, graph 0 to {0}, graph 1 nohead dashtype 3 linecolor '#808080'\n",
                      shortest(parameter.value));
  int arrow = 2;
  for (const Swap& swap : least_swaps(s))
    if (swap.parameter == p && std::max(swap.first, swap.second) < first_events)
      text +=
          fmt::format("set arrow {0} from {1}, graph 0 to {1}, graph 1 nohead dashtype 2 linecolor '{2}'\n",
                      arrow++, shortest(parameter.value + swap.change), falling);
  std::vector<std::string> elements;
  const std::size_t count = std::min<std::size_t>(s.contacts.size(), std::size(contact_colours));
  const CsvTable<Tangent>& table = tangent_table();
  for (std::size_t c = 0; c <= count; ++c) {
    const std::string title = c == 0 ? "" : s.contacts[c - 1];
    elements.push_back(
        fmt::format("'{}.csv' skip 1 using {}:{}:({} == {} ? {} : NaN):{} with vectors nohead linewidth 1.2 "
                    "linecolor '{}' {}",
                    name, table.number("p"), table.number("t"), table.value("contact"), c, table.value("dp"),
                    table.number("dt"), c == 0 ? "#808080" : contact_colours[c - 1],
                    c == 0 ? "notitle" : "title " + quoted(title)));
  }
  elements.push_back(
      fmt::format("NaN with lines dashtype 2 linecolor '{}' title 'two events meet'", falling));
  return text + plot_command(elements) + end_script();
}

std::string sequence(const Sensitivities& s, const fs::path& folder, const PictureLook& look) {
  const std::vector<Swap> swaps = least_swaps(s);
  std::vector<Bar> bars;
  for (const Swap& swap : swaps) {
    const Parameter& parameter = s.parameters[swap.parameter];
    if (parameter.value == 0.0) continue;
    bars.push_back({parameter.path + (swap.change > 0.0 ? " up" : " down"),
                    100.0 * swap.change / std::abs(parameter.value)});
  }
  if (bars.empty()) return {};
  sort_bars(bars);
  std::reverse(bars.begin(), bars.end());  // the least change on top
  const CsvTable<PlacedBar> table = bar_table("per_cent");
  write_file(folder / "sequence.csv", table.text(placed(bars)));
  const PlottedRun run = facts_of(s, look);
  const Canvas canvas = canvas_of(
      run.look, room_above + room_below + 38.0 + 30.0 * static_cast<double>(bars.size()), false, true);
  std::string text = begin_script(
      run, {"sequence", "Least change of each key at which, to first order, two events meet", canvas, false});
  text += panel(run, canvas, stacked(0, 1, canvas), "", true) + wide_margin();
  text += "set xlabel 'change of the key [%]'\nset logscale x\nset format x '%g'\nset xrange [*:*]\n" +
          bar_ticks(bars);
  const auto points = [&](const char* sign, const char* colour, const char* title) {
    return fmt::format(
        "'sequence.csv' skip 1 using ({3} {0} 0 ? abs({3}) : NaN):{4} with points pointtype 7 pointsize 1.4 "
        "linecolor '{1}' title '{2}'",
        sign, colour, title, table.value("per_cent"), table.number("place"));
  };
  return text + plot_command({points(">", rising, "upwards"), points("<", falling, "downwards")}) +
         end_script();
}

}  // namespace

std::vector<fs::path> write_sensitivity_plots(const fs::path& directory, const Sensitivities& s,
                                              const Sigmas& sigmas, const PictureLook& look) {
  if (s.events.empty() && s.responses.empty()) return {};
  const fs::path folder = directory / "plots";
  begin_plot_folder(folder, is_picture_of_sensitivities);
  std::vector<fs::path> scripts;
  const auto add = [&](const std::string& name, const std::string& text) {
    if (text.empty()) return;
    scripts.push_back(folder / (name + ".gp"));
    write_file(scripts.back(), text);
  };
  add("tornado", tornado(s, sigmas, folder, look));
  if (!s.events.empty())
    for (std::size_t p = 0; p < std::min(s.parameters.size(), most_time_pictures); ++p)
      add(fmt::format("times-{}", p + 1), times(s, p, folder, look));
  add("sequence", sequence(s, folder, look));
  return scripts;
}

void remove_sensitivity_plots(const fs::path& directory) {
  clear_plot_folder(directory / "plots", is_picture_of_sensitivities);
}

}  // namespace signorini
