#include "result/picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.hpp"
#include "result/picture_style.hpp"

namespace signorini::result {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '\'') {
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
      continue;
    }
    // Within a block, gnuplot reads three quotes at the start as an empty string, and fails at four in a row:
    // consecutive apostrophes are written as a separate string in double quotes.
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

std::string named_tics(char axis, const std::vector<std::pair<std::string, std::size_t>>& names) {
  std::string s = fmt::format("set {}tics (", axis);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string formatted;
    for (const char c : names[i].first) formatted += c == '%' ? "%%" : std::string(1, c);
    s += (i > 0 ? ", " : "") + signorini::result::quoted(formatted) + fmt::format(" {}", names[i].second);
  }
  return s + ")";
}

std::string range_of(char axis, double from, double to) {
  return fmt::format("set {}range [{}:{}]\n", axis, base::format_number(from), base::format_number(to));
}

std::string vertical_line(std::size_t number, double x, const std::string& look) {
  return fmt::format("set arrow {0} from first {1}, graph 0 to first {1}, graph 1 nohead {2}\n", number,
                     base::format_number(x), look);
}

std::vector<PanelEdges> panel_edges(const std::vector<double>& weights, const Canvas& canvas, double space) {
  const double all =
      canvas.height - margin_above - margin_below - space * static_cast<double>(weights.size() - 1);
  const double each = all / std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<PanelEdges> panels;
  double top = canvas.height - margin_above;
  for (const double weight : weights) {
    panels.push_back({(top - each * weight) / canvas.height, top / canvas.height});
    top -= each * weight + space;
  }
  return panels;
}

namespace {

// Letters of legends are about 8.8 pixels wide, after a line sample of 55 pixels.
constexpr double letter = 8.8, line_of_legend = 55.0;
constexpr std::size_t longest_name = 44;

}  // namespace

std::string legend_name(const std::string& name) {
  if (name.size() <= longest_name) return name;
  constexpr std::size_t half = (longest_name - 3) / 2;
  std::size_t end = half, begin = name.size() - half;
  const auto inside = [&](std::size_t i) { return (static_cast<unsigned char>(name[i]) & 0xC0) == 0x80; };
  while (inside(end)) --end;  // do not split a multi-byte letter
  while (inside(begin)) ++begin;
  return name.substr(0, end) + "..." + name.substr(begin);
}

double legend_width(const std::vector<std::string>& names) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, legend_name(name).size());
  return std::max(Canvas::usual_legend, line_of_legend + letter * static_cast<double>(longest));
}

namespace {

/// Font size of a heading line, reduced if it would not fit: a letter is about 0.62 of its height wide.
double heading(const Canvas& canvas, const std::string& text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  const double text_width = 0.62 * size * static_cast<double>(letters),
               room = canvas.width * (1.0 - canvas.left());
  return canvas.font(size) * std::clamp(room / std::max(text_width, 1.0), 0.6, 1.0);
}

std::string beginning(const PlottedRun& run, const Picture& picture) {
  const std::string title = run.facts.title.empty() ? "Signorini" : run.facts.title;
  std::string note =
      run.facts.outcome == "done" ? "" : translate(run, " (run {})", translate(run, run.facts.outcome));
  const bool shaded = picture.over_time && run.facts.certain_until && *run.facts.certain_until < run.to;
  if (shaded)
    note += " (" +
            translate(run, "shaded: not certified, from t = {} on",
                      fmt::format("{:.6g}", *run.facts.certain_until)) +
            ")";
  std::string s = "# Draws " + picture.name +
                  ".svg and the like from the tables of the run. In this folder: gnuplot " + picture.name +
                  ".gp\n";
  if (picture.over_time) {
    s += fmt::format("from = {}; to = {}   # the time shown\n", base::format_number(run.from),
                     base::format_number(run.to));
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
        base::format_number(std::max(*run.facts.certain_until, run.from)), base::format_number(run.to));
  s += "set y2range [0:1]\nunset y2tics\n";
  return s + picture.setup;
}

std::string axes_of(const PlottedRun& run, const Canvas& canvas, const PanelEdges& edges,
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
    s += "set format x '%g'\nset xlabel " +
         quoted(translate(run, "time t") + " [" + run.facts.units.time + "]") + "\n";
  } else {
    s += "set format x ''\nunset xlabel\n";
  }
  return s;
}

std::string text_of(const Curve& curve) {
  std::string s = curve.rows;
  if (!curve.columns.empty()) s += " using " + curve.columns;
  if (!curve.look.empty()) s += " " + curve.look;
  return s + (curve.name ? " title " + quoted(*curve.name) : " notitle");
}

std::string plot_command(const std::vector<Curve>& curves) {
  std::string s = "plot ";
  for (const Curve& curve : curves) s += (&curve == curves.data() ? "" : ", \\\n     ") + text_of(curve);
  return s + "\nunset label 1\nunset label 2\n";
}

}  // namespace

std::string script_of(const PlottedRun& run, const Picture& picture) {
  std::vector<double> weights;
  for (const Panel& panel : picture.panels) weights.push_back(panel.weight);
  const std::vector<PanelEdges> edges = panel_edges(weights, picture.canvas, picture.space);
  std::string s = beginning(run, picture);
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    const Panel& panel = picture.panels[i];
    const bool last = panel.own_axis || i + 1 == picture.panels.size();
    s += panel.margins.empty() ? axes_of(run, picture.canvas, edges[i], panel.label, last) : panel.margins;
    s += panel.axes + plot_command(panel.curves) + panel.after;
  }
  return s + "unset multiplot\nunset output\n}\n";
}

}  // namespace signorini::result
