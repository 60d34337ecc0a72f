#include "result/plot_parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/number.hpp"
#include "result/picture_words.hpp"
#include "result/run_tables.hpp"

namespace signorini {

namespace {

constexpr std::size_t most_points = 20000;  // a curve; beyond that an SVG is slow to open and shows no more

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '\'') {
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
      continue;
    }
    // Within a block, gnuplot takes three quotes at the start for an empty string, and does not read four in a row:
    // apostrophes side by side become a string of their own.
    const std::size_t count = std::min(text.find_first_not_of('\'', i), text.size()) - i;
    if (count > 1) {
      result += "'.\"";
      for (std::size_t k = 0; k < count; ++k) result += "\\047";
      result += "\".'";
      i += count - 1;
    } else {
      result += i == 0 ? "\u2019" : "''";
    }
  }
  return result + "'";
}

std::string quoted_tick(const std::string& text) {
  std::string formatted;
  for (const char c : text) formatted += c == '%' ? "%%" : std::string(1, c);
  return signorini::quoted(formatted);
}

std::string every(const PlottedRun& run, std::size_t group, std::size_t index) {
  const std::size_t stride = (run.times + most_points - 1) / most_points;
  // Up to the last whole row: behind it may stand one that a kill has cut.
  return fmt::format(" every {}::{}::{}", std::max<std::size_t>(stride, 1) * group, index,
                     run.times * group - 1);
}

std::string contact_rows(const PlottedRun& run, std::size_t k, const std::string& run_directory) {
  if (k < run.motion.size() && run.motion[k].count > 1)
    return fmt::format("{} skip 1 every ::{}::{}", quoted(run_directory + "/motion.csv"), run.motion[k].first,
                       run.motion[k].first + run.motion[k].count - 1);
  return quoted(run_directory + "/contacts.csv") + " skip 1" + every(run, run.facts.contacts.size(), k);
}

TableColumn curve_of(const PlottedRun& run, const std::string& table, const std::string& name,
                     std::size_t number) {
  const auto found = run.curves.find(name);
  if (found != run.curves.end() && found->second.count > 1)
    return {fmt::format("'../curves.csv' skip 1 every ::{}::{}", found->second.first,
                        found->second.first + found->second.count - 1),
            curve_table().number("t"), curve_table().number("value")};
  return {quoted("../" + table) + " skip 1" + every(run, 1, 0), 1, number};
}

std::vector<PanelEdges> stacked(const std::vector<double>& weights, const Canvas& canvas, double space) {
  const double all =
      canvas.height - room_above - room_below - space * static_cast<double>(weights.size() - 1);
  const double each = all / std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<PanelEdges> panels;
  double top = canvas.height - room_above;
  for (const double weight : weights) {
    panels.push_back({(top - each * weight) / canvas.height, top / canvas.height});
    top -= each * weight + space;
  }
  return panels;
}

PanelEdges stacked(std::size_t i, std::size_t count, const Canvas& canvas, double space) {
  return stacked(std::vector<double>(count, 1.0), canvas, space)[i];
}

double row_height(double usual, std::size_t count, const PictureLook& look) {
  const double around = room_above + room_below + 24.0;
  return std::min(usual, (tallest(look) - around) / static_cast<double>(count));
}

std::string row_ticks(const std::vector<RunFacts::Contact>& contacts, double height) {
  constexpr double line = 14.0;  // pixels that a label needs
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(line / height)));
  std::string s = "set ytics (";
  for (std::size_t k = 0; k < contacts.size(); k += stride)
    s += (k > 0 ? ", " : "") + quoted_tick(contacts[k].name) + fmt::format(" {}", k);
  return s + ") scale 0\n";
}

namespace {

// Letters of legends are some 8.8 pixels wide, in front of them a line of 55.
constexpr double letter = 8.8, line_of_legend = 55.0;
constexpr std::size_t longest_name = 44;

}  // namespace

std::string legend_name(const std::string& name) {
  if (name.size() <= longest_name) return name;
  constexpr std::size_t half = (longest_name - 3) / 2;
  std::size_t end = half, begin = name.size() - half;
  const auto inside = [&](std::size_t i) { return (static_cast<unsigned char>(name[i]) & 0xC0) == 0x80; };
  while (inside(end)) --end;  // of a letter of several bytes
  while (inside(begin)) ++begin;
  return name.substr(0, end) + "..." + name.substr(begin);
}

double room_for(const std::vector<std::string>& names) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, legend_name(name).size());
  return std::max(Canvas::usual_legend, line_of_legend + letter * static_cast<double>(longest));
}

std::string say(const PlottedRun& run, std::string_view english) { return say(run.look.language, english); }

namespace {

/// A line's letters, smaller where it would not fit: some 0.62 of their height wide.
double heading(const Canvas& canvas, const std::string& text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  const double text_width = 0.62 * size * static_cast<double>(letters),
               room = canvas.width * (1.0 - canvas.left());
  return canvas.font(size) * std::clamp(room / std::max(text_width, 1.0), 0.6, 1.0);
}

}  // namespace

std::string begin_script(const PlottedRun& run, const Picture& picture) {
  const std::string title = run.facts.title.empty() ? "Signorini" : run.facts.title;
  std::string note = run.facts.outcome == "done" ? "" : say(run, " (run {})", say(run, run.facts.outcome));
  const bool shaded = picture.over_time && run.facts.certain_until && *run.facts.certain_until < run.to;
  if (shaded)
    note += " (" +
            say(run, "shaded: not certain, from t = {} on", fmt::format("{:.6g}", *run.facts.certain_until)) +
            ")";
  std::string s = "# Draws " + picture.name +
                  ".svg and the like from the tables of the run. In this folder: gnuplot " + picture.name +
                  ".gp\n";
  if (picture.over_time) {
    s += fmt::format("from = {}; to = {}   # the time shown\n", shortest(run.from), shortest(run.to));
  }
  s += "reset\nset datafile separator ','\nset encoding utf8\n";
  std::string formats;
  for (const std::string& format : run.look.formats) formats += (formats.empty() ? "" : " ") + format;
  s += "do for [format in '" + formats + "'] {\n";
  const Canvas& canvas = picture.canvas;
  s += terminals(canvas, run.look.width > 0.0);
  s += "set output " + quoted(picture.name + ".") + ".format\n";
  s += "set multiplot\n";
  if (run.look.title) {
    s += fmt::format("set label 1 {} at screen {:.4f},{:.4f} left font ',{:.4g}'\n", quoted(title + note),
                     canvas.left(), 1.0 - 24.0 / canvas.height, heading(canvas, title + note, 15.0));
    s += fmt::format("set label 2 {} at screen {:.4f},{:.4f} left textcolor '#666666' font ',{:.4g}'\n",
                     quoted(picture.subtitle), canvas.left(), 1.0 - 46.0 / canvas.height,
                     heading(canvas, picture.subtitle, 13.0));
  }
  s += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", canvas.left(),
                   canvas.right(run.legend));
  s += "set border 3 linecolor '#555555'\nset tics nomirror out scale 0.6\n";
  s += "set grid front linetype 1 linewidth 0.5 linecolor '#c8909090'\n";
  if (picture.over_time) s += "set xrange [from:to]\nset offsets 0,0,graph 0.03,graph 0.03\n";
  if (shaded)
    s += fmt::format(
        "set object 1 rectangle from {},graph 0 to {},graph 1 front fillstyle "
        "transparent solid 0.25 noborder fillcolor '#505050'\n",
        shortest(std::max(*run.facts.certain_until, run.from)), shortest(run.to));
  s += "set y2range [0:1]\nunset y2tics\n";
  return s;
}

std::string end_script() { return "unset multiplot\nunset output\n}\n"; }

std::string panel(const PlottedRun& run, const Canvas& canvas, const PanelEdges& edges,
                  const std::string& label, bool last) {
  std::string s =
      fmt::format("\nset bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n", edges.bottom, edges.top);
  s += fmt::format(
      "set ylabel {} offset character 0.5,0\nset yrange [*:*] noextend\nset ytics nomirror out scale 0.6 "
      "autofreq\nset format y '%g'\n",
      quoted(label));
  s += fmt::format(
      "set key at screen {:.4f},{:.4f} left top vertical maxrows 30 Left reverse samplen 1.6 spacing 1.15 "
      "noautotitle noenhanced font ',{:.4g}'\n",
      canvas.right(run.legend) + 13.0 / canvas.width, edges.top + 8.0 / canvas.height, canvas.legend_font());
  if (last) {
    s += "set format x '%g'\nset xlabel " + quoted(say(run, "time t") + " [" + run.facts.units.time + "]") +
         "\n";
  } else {
    s += "set format x ''\nunset xlabel\n";
  }
  return s;
}

std::string state_colour(const std::string& state) {
  if (state == "open") return "#bcd3e6";
  if (state == "stick") return "#5aae61";
  if (state == "closed") return "#35978f";
  if (state == "slip+") return "#f1a340";
  if (state == "slip-") return "#8e6bbf";
  return "#999999";
}

const std::vector<std::string>& state_names() {
  static const std::vector<std::string> names = {"stick", "slip+", "slip-", "closed", "open"};
  return names;
}

const CsvTable<PlottedRun::Band>& band_table() {
  using Band = PlottedRun::Band;
  static const CsvTable<Band> table = {{"from", &Band::from}, {"to", &Band::to}, {"state", &Band::state}};
  return table;
}

std::string band_at(const std::string& state) {
  return "(" + band_table().word("state") + " eq " + quoted(state) + " ? " + band_table().value("from") +
         " : NaN)";
}

std::vector<std::string> band_elements(const PlottedRun& run, std::size_t k, double opacity) {
  std::vector<std::string> elements;
  for (const std::string& state : state_names()) {
    const auto& bands = run.bands[k];
    if (std::none_of(bands.begin(), bands.end(), [&](const auto& b) { return b.state == state; })) continue;
    std::string e = quoted("states-" + run.slugs[k] + ".csv") + " skip 1 using ";
    e += band_at(state) + ":(0.5):1:2:(0):(1) axes x1y2 with boxxy ";
    e += fmt::format("fillstyle solid {} noborder linecolor '{}' notitle", opacity, state_colour(state));
    elements.push_back(e);
  }
  return elements;
}

std::vector<std::string> band_legend(const PlottedRun& run, std::size_t k) {
  std::vector<std::string> elements;
  for (const std::string& state : state_names()) {
    const auto& bands = run.bands[k];
    if (std::none_of(bands.begin(), bands.end(), [&](const auto& b) { return b.state == state; })) continue;
    elements.push_back(fmt::format("keyentry with boxes fillstyle solid 1.0 noborder linecolor '{}' title {}",
                                   state_colour(state), quoted(say(run, state))));
  }
  return elements;
}

std::string plot_command(const std::vector<std::string>& elements) {
  std::string s = "plot ";
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i > 0) s += ", \\\n     ";
    s += elements[i];
  }
  return s + "\nunset label 1\nunset label 2\n";
}

}  // namespace signorini
