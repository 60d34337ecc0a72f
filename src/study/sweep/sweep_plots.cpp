#include "study/sweep/sweep_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <system_error>

#include "base/number.hpp"
#include "result/csv.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_parts.hpp"
#include "study/key_unit.hpp"
#include "study/sweep/quantiles.hpp"
#include "study/sweep/sweep_map.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 12> colours = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                                 "#e7298a", "#666666", "#a6761d", "#17becf",
                                                 "#c0182b", "#7f7f00", "#5e4fa2", "#1a1a1a"};
constexpr std::size_t most_panels = 6;
constexpr std::size_t most_curves = 24;  // as many as a legend beside the panel can name

/// Rows that have all values in common but that on the axis.
struct Curve {
  std::string name;
  std::vector<const SweepRow*> rows;
};

struct Axis {
  std::size_t key = 0;
  bool numbers = true;
  const Vary* vary = nullptr;

  [[nodiscard]] std::string x(const SweepRow& row) const {
    if (numbers) return shortest(*parse_number(row.values[key]));
    const auto& values = vary->values;
    return std::to_string(std::find(values.begin(), values.end(), row.values[key]) - values.begin());
  }
};

Axis axis_of(const SweepSpec& spec) {
  Axis axis;
  const auto several = std::find_if(spec.vary.begin(), spec.vary.end(),
                                    [](const Vary& vary) { return vary.values.size() > 1; });
  if (several != spec.vary.end()) axis.key = static_cast<std::size_t>(several - spec.vary.begin());
  axis.vary = &spec.vary[axis.key];
  axis.numbers = std::all_of(axis.vary->values.begin(), axis.vary->values.end(),
                             [](const std::string& value) { return parse_number(value).has_value(); });
  return axis;
}

/// The key of the axis, or one in step with it.
bool moves_with(const SweepSpec& spec, const Axis& axis, std::size_t key) {
  return key == axis.key || (axis.vary->group != 0 && spec.vary[key].group == axis.vary->group);
}

std::vector<Curve> group(const SweepSpec& spec, const SweepRows& rows, const Axis& axis) {
  std::vector<Curve> list;
  std::map<std::vector<std::string>, std::size_t> known;
  for (const auto& [index, row] : rows) {
    if (!row.ran()) continue;
    std::vector<std::string> others = row.values;
    for (std::size_t i = spec.vary.size(); i-- > 0;)
      if (moves_with(spec, axis, i)) others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto [found, fresh] = known.emplace(others, list.size());
    if (fresh) {
      std::string name;
      for (std::size_t i = 0; i < row.values.size(); ++i) {
        if (moves_with(spec, axis, i) || spec.vary[i].values.size() < 2) continue;
        name += (name.empty() ? "" : ", ") + row.values[i];
      }
      list.push_back({name, {}});
    }
    list[found->second].rows.push_back(&row);
  }
  return list;
}

/// What the numbers in the legend are.
std::string other_keys(const SweepSpec& spec, const Axis& axis) {
  std::string text;
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    if (!moves_with(spec, axis, i) && spec.vary[i].values.size() > 1)
      text += (text.empty() ? "; curves: " : ", ") + spec.vary[i].path;
  return text;
}

std::string curve_table(const SweepSpec& spec, const Curve& curve, const Axis& axis,
                        const std::vector<std::string>& contacts) {
  CsvBlock block;
  block.text("x").text("events");
  for (const std::string& name : contacts)
    for (const char* figure : {".peak_t", ".peak_n", ".peak_N", ".peak_T", ".friction_work"})
      block.text(name + figure);
  for (const std::string& response : spec.responses) block.text(response);
  block.end_row();
  // A range may fall, a list has any order; lines run from left to right.
  std::vector<const SweepRow*> rows = curve.rows;
  std::stable_sort(rows.begin(), rows.end(), [&](const SweepRow* a, const SweepRow* b) {
    return parse_number(axis.x(*a)) < parse_number(axis.x(*b));
  });
  for (const SweepRow* row : rows) {
    block.text(axis.x(*row)).number(static_cast<double>(row->changes()));
    for (const std::string& name : contacts) {
      const SweepRow::Contact* c = contact_of(*row, name);
      const auto figure = [&](double value) { return c ? std::optional<double>(value) : std::nullopt; };
      const SweepRow::Contact none, &from = c ? *c : none;
      for (const double value : {from.tangential, from.normal, from.N, from.T, from.friction})
        block.number(figure(value));
    }
    for (const double value : row->responses)
      block.number(std::isfinite(value) ? std::optional<double>(value) : std::nullopt);
    block.end_row();
  }
  return block.str();
}

struct Panel {
  std::string label;
  int figure;  ///< 0: events; 1 to 5: of each contact; below 0: the answer -figure, counted from 1
};

class Script {
 public:
  Script(const SweepSpec& spec, const Axis& axis, const std::vector<Curve>& combinations,
         const std::vector<std::string>& contacts, const PictureLook& look)
      : axis_(axis), curves_(combinations), contacts_(contacts) {
    run_.look = look;
    run_.facts.title = spec.title;
    run_.facts.outcome = "done";
    run_.facts.units = spec.units;
  }

  [[nodiscard]] std::string str(const std::string& name, const std::string& subtitle,
                                const std::vector<Panel>& panels) const {
    const std::size_t count = panels.size();
    const Canvas canvas = canvas_of(run_.look, 148.0 + 320.0 * static_cast<double>(count), false);
    std::string s = begin_script(run_, {name, subtitle, canvas, false});
    s += "set offsets 0,0,graph 0.05,0\n" + x_range();
    for (std::size_t i = 0; i < count; ++i) {
      s += panel(run_, canvas, stacked(i, count, canvas, 26.0), panels[i].label, i + 1 == count);
      s += panels[i].figure < 0 ? "set yrange [*:*]\n" : "set yrange [0:*]\n";
      if (!axis_.numbers) s += ticks(i + 1 == count);
      if (i + 1 == count)
        s += "set xlabel " + quoted(key_with_unit(axis_.vary->path, run_.facts.units)) + "\n";
      s += plot_command(elements(panels[i]));
    }
    return s + end_script();
  }

 private:
  /// Of all values, also where no run began: a hole at an end is seen.
  [[nodiscard]] std::string x_range() const {
    double first = 0.0, last = static_cast<double>(axis_.vary->values.size()) - 1.0;
    if (axis_.numbers) {
      first = last = *parse_number(axis_.vary->values.front());
      for (const std::string& value : axis_.vary->values) {
        first = std::min(first, *parse_number(value));
        last = std::max(last, *parse_number(value));
      }
    }
    const double air = last > first ? 0.03 * (last - first) : 1.0;
    return "set xrange [" + shortest(first - air) + ":" + shortest(last + air) + "]\n";
  }

  [[nodiscard]] std::string ticks(bool named) const {
    std::string s = "set xtics (";
    for (std::size_t i = 0; i < axis_.vary->values.size(); ++i)
      s += (i > 0 ? ", " : "") + quoted_tick(named ? axis_.vary->values[i] : "") + fmt::format(" {}", i);
    return s + ")\n";
  }

  [[nodiscard]] std::vector<std::string> elements(const Panel& panel) const {
    std::vector<std::string> list;
    const std::size_t curves = panel.figure <= 0 ? 1 : contacts_.size();
    for (std::size_t k = 0; k < curves; ++k) {
      for (std::size_t c = 0; c < curves_.size() && list.size() < most_curves; ++c) {
        const int column = panel.figure == 0  ? 2
                           : panel.figure < 0 ? 2 + static_cast<int>(5 * contacts_.size()) - panel.figure
                                              : 2 + static_cast<int>(5 * k) + panel.figure;
        const bool alone = panel.figure <= 0 || (contacts_.size() == 1 && curves_.size() > 1);
        std::string title = panel.figure == 0 ? (curves_.size() == 1 ? "events" : "")
                            : alone           ? ""
                                              : contacts_[k];
        if (!curves_[c].name.empty()) title += (title.empty() ? "" : ", ") + curves_[c].name;
        // Colour says which contact, or which values of the other keys where there are several.
        const std::size_t colour = curves_.size() > 1 ? c : k;
        // Curves that coincide show through: later ones are thinner and dashed, on top.
        const std::size_t i = list.size();
        list.push_back(fmt::format(
            "'curve-{}.csv' skip 1 using 1:{} with linespoints linewidth {:.1f} pointtype {} pointsize 0.7{} "
            "linecolor '{}' title {}",
            c + 1, column, std::max(1.0, 2.6 - 0.5 * static_cast<double>(i)), 5 + 2 * static_cast<int>(i % 5),
            i == 0 ? "" : fmt::format(" dashtype {}", i % 5 + 1), colours[colour % colours.size()],
            signorini::quoted(title)));
      }
    }
    return list;
  }

  const Axis& axis_;
  const std::vector<Curve>& curves_;
  const std::vector<std::string>& contacts_;
  PlottedRun run_;
};

bool is_picture_of_sweep(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool named =
      stem == "motion" || stem == "forces" || stem == "losses" || stem == "responses" || stem == "exceedance";
  return (is_picture(file) && named) ||
         (file.extension() == ".csv" && (stem.starts_with("curve-") || stem.starts_with("exceedance-") ||
                                         stem == "map" || stem == "borders"));
}

std::string labelled(const SweepSpec& spec, std::size_t query) {
  const std::string& unit = spec.response_units[query];
  return spec.responses[query] + (unit.empty() ? "" : " [" + unit + "]");
}

/// Probability that an answer is greater, over it, with its interval; a panel a query.
std::vector<fs::path> write_sample_plots(const fs::path& directory, const SweepSpec& spec,
                                         const SweepRows& rows, const PictureLook& look) {
  const std::vector<Sampled> answers = sampled_answers(spec, rows);
  const auto drawn = [](const Sampled& s) { return s.sorted.size() > 1; };
  if (std::none_of(answers.begin(), answers.end(), drawn)) return {};
  const fs::path folder = directory / "plots";
  begin_plot_folder(folder, is_picture_of_sweep);
  PlottedRun run;
  run.look = look;
  run.facts.title = spec.title;
  run.facts.outcome = "done";
  run.facts.units = spec.units;
  const std::size_t panels = std::min(spec.responses.size(), most_panels);
  const Canvas canvas = canvas_of(run.look, 74.0 + 340.0 * static_cast<double>(panels), false);
  std::string s = begin_script(run, {"exceedance", "Probability of more; " + spec.sampling, canvas, false});
  s += "set logscale y\n";
  for (std::size_t i = 0; i < panels; ++i) {
    s += panel(run, canvas, stacked(i, panels, canvas, 80.0), "P(greater)", true);
    s += "set xlabel " + quoted(labelled(spec, i)) + "\nset yrange [*:1]\n";
    std::vector<std::string> elements;
    for (std::size_t k = 0; k < answers.size() && elements.size() < most_curves; ++k) {
      if (answers[k].query != i || !drawn(answers[k])) continue;
      CsvBlock block;
      block.text("value").text("probability").text("low").text("high").end_row();
      for (const Exceedance& e : exceedance(answers[k].sorted, independent(spec)))
        block.number(e.value).number(e.probability).number(e.low).number(e.high).end_row();
      const std::string name = fmt::format("exceedance-{}.csv", k + 1);
      write_file(folder / name, block.str());
      std::string title;
      for (const std::string& value : answers[k].values) title += (title.empty() ? "" : ", ") + value;
      const char* colour = colours[elements.size() % colours.size()];
      if (independent(spec) && answers.size() == spec.responses.size())
        elements.push_back(
            fmt::format("'{}' skip 1 using 1:3:4 with filledcurves fillstyle solid 0.2 noborder "
                        "linecolor '{}' title '95 % confidence'",
                        name, colour));
      elements.push_back(fmt::format("'{}' skip 1 using 1:2 with steps linewidth 1.8 linecolor '{}' title {}",
                                     name, colour, signorini::quoted(title)));
    }
    s += plot_command(elements);
  }
  const fs::path script = folder / "exceedance.gp";
  write_file(script, s + end_script());
  return {script};
}

}  // namespace

std::vector<fs::path> write_sweep_plots(const fs::path& directory, const SweepSpec& spec,
                                        const SweepRows& rows, const PictureLook& look) {
  if (!spec.sampling.empty()) return write_sample_plots(directory, spec, rows, look);
  const Axis axis = axis_of(spec);
  const std::vector<Curve> list = group(spec, rows, axis);
  const std::vector<std::string> contacts = contact_names(rows);
  if (std::none_of(list.begin(), list.end(), [](const auto& c) { return c.rows.size() >= 2; })) return {};
  const fs::path folder = directory / "plots";
  begin_plot_folder(folder, is_picture_of_sweep);
  for (std::size_t i = 0; i < std::min(list.size(), most_curves); ++i)
    write_file(folder / fmt::format("curve-{}.csv", i + 1), curve_table(spec, list[i], axis, contacts));

  const std::optional<MapAxes> axes = map_axes(spec);
  bool borders = false, differ = false;
  if (axes) {
    write_file(folder / "map.csv", map_table(spec, *axes, rows));
    const Borders sides = border_table(spec, *axes, rows);
    differ = sides.count > 0;
    borders = differ && 2 * sides.count <= sides.neighbours;  // lines around most cells would say nothing
    if (borders) write_file(folder / "borders.csv", sides.table);
  }
  const std::string length = " [" + spec.units.length + "]", force = " [" + spec.units.force + "]";
  const std::string energy = " [" + spec.units.force + " " + spec.units.length + "]";
  const Script script(spec, axis, list, contacts, look);
  std::vector<fs::path> scripts;
  const std::string others = other_keys(spec, axis);
  const auto add = [&](const std::string& name, const std::string& subtitle,
                       const std::vector<Panel>& panels) {
    scripts.push_back(folder / (name + ".gp"));
    if (!axes) {
      write_file(scripts.back(), script.str(name, subtitle + others, panels));
      return;
    }
    std::vector<MapPanel> maps;
    for (const Panel& p : panels) maps.push_back({p.label, p.figure < 0 ? 10 - p.figure : 5 + p.figure});
    const std::string parts = !differ   ? ""
                              : borders ? "; lines part sequences of events"
                                        : "; most neighbours have other sequences of events";
    const char* of = contacts.size() > 1 && panels.front().figure >= 0 ? ", greatest of all contacts" : "";
    write_file(scripts.back(), map_script(spec, *axes, name, subtitle + of + parts, maps, borders, look));
  };
  if (!spec.responses.empty()) {
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < std::min(spec.responses.size(), most_panels); ++i)
      panels.push_back({labelled(spec, i), -static_cast<int>(i) - 1});
    add("responses", "What was asked for", panels);
  }
  if (!contacts.empty()) {
    add("motion", "Greatest motion of the contacts from the start",
        {{"along the tangent" + length, 1}, {"along the normal" + length, 2}});
    add("forces", "Greatest forces of the contacts", {{"|N|" + force, 3}, {"|T|" + force, 4}});
    add("losses", "Work lost by friction, and events", {{"friction work" + energy, 5}, {"events", 0}});
  }
  return scripts;
}

void remove_sweep_plots(const fs::path& directory) {
  clear_plot_folder(directory / "plots", is_picture_of_sweep);
}

}  // namespace signorini
