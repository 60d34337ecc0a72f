#include "study/sweep/sweep_plots.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/text.hpp"
#include "result/picture.hpp"
#include "result/picture_files.hpp"
#include "result/table.hpp"
#include "study/optional_values.hpp"
#include "study/sweep/quantiles.hpp"
#include "study/sweep/sweep_map.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini::sweep {
namespace {

/// True if the key is on the axis, or varies together with the key on the axis.
bool moves_with(const SweepSpec& spec, const SweepAxis& axis, std::size_t key) {
  return key == axis.key || (axis.vary->group != 0 && spec.vary[key].group == axis.vary->group);
}

}  // namespace

std::string SweepAxis::x(const SweepRow& row) const {
  if (numbers) return base::format_number(*base::parse_number(row.values[key]));
  const auto& values = vary->values;
  return std::to_string(std::find(values.begin(), values.end(), row.values[key]) - values.begin());
}

SweepAxis axis_of(const SweepSpec& spec, bool last) {
  SweepAxis axis;
  for (std::size_t i = spec.vary.size(); i-- > 0;) {
    if (spec.vary[i].values.size() < 2) continue;
    axis.key = i;
    if (last) break;
  }
  axis.vary = &spec.vary[axis.key];
  axis.numbers = std::all_of(axis.vary->values.begin(), axis.vary->values.end(),
                             [](const std::string& value) { return base::parse_number(value).has_value(); });
  return axis;
}

std::vector<SweepCurve> swept_curves(const SweepSpec& spec, const SweepRows& rows, const SweepAxis& axis) {
  std::vector<SweepCurve> list;
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

std::string other_keys(const SweepSpec& spec, const SweepAxis& axis) {
  std::string text;
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    if (!moves_with(spec, axis, i) && spec.vary[i].values.size() > 1)
      text += (text.empty() ? "; curves: " : ", ") + spec.vary[i].path;
  return text;
}

std::string x_range(const SweepAxis& axis) {
  double first = 0.0, last = static_cast<double>(axis.vary->values.size()) - 1.0;
  if (axis.numbers) {
    first = last = *base::parse_number(axis.vary->values.front());
    for (const std::string& value : axis.vary->values) {
      first = std::min(first, *base::parse_number(value));
      last = std::max(last, *base::parse_number(value));
    }
  }
  const double air = last > first ? 0.03 * (last - first) : 1.0;
  return result::range_of('x', first - air, last + air);
}

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 12> colours = {"#1f77b4", "#d95f02", "#1b9e77", "#7b3294",
                                                 "#e7298a", "#666666", "#a6761d", "#17becf",
                                                 "#c0182b", "#7f7f00", "#5e4fa2", "#1a1a1a"};
constexpr std::size_t max_panels = 6;
constexpr std::size_t max_curves = 24;  // limit for the curves of a panel, whose names are in a legend

/// Columns of curve-N.csv. For a row of the sweep: x, number of events, figures of all contacts.
result::CsvTable<const SweepRow*> curve_table(const SweepSpec& spec, const SweepAxis& axis,
                                              const std::vector<std::string>& contacts) {
  result::CsvTable<const SweepRow*> table = {{"x", [axis](const SweepRow* row) { return axis.x(*row); }},
                                             {"events", [](const SweepRow* row) { return row->changes(); }}};
  for (const std::string& name : contacts)
    for (const SweepFigure& figure : sweep_figures)
      table.add(name + "." + figure.name, [name, &figure](const SweepRow* row) {
        const SweepRow::Contact* contact = contact_of(*row, name);
        return contact ? std::optional(contact->*figure.value) : std::nullopt;
      });
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    table.add(spec.responses[i], [i](const SweepRow* row) { return row->response(i); });
  return table;
}

/// Sorts rows by x, because ranges may decrease and lists may have any order. Lines are drawn from left to right.
std::vector<const SweepRow*> from_left(const SweepCurve& curve, const SweepAxis& axis) {
  std::vector<const SweepRow*> rows = curve.rows;
  std::stable_sort(rows.begin(), rows.end(), [&](const SweepRow* a, const SweepRow* b) {
    return base::parse_number(axis.x(*a)) < base::parse_number(axis.x(*b));
  });
  return rows;
}

/// One panel of a picture.
struct SweepPanel {
  enum class Kind { events, contacts, answer };
  std::string label;
  Kind kind;
  std::string column = "events";  ///< column of curve-N.csv; for contacts: suffix of their names
};

class SweepCurves {
 public:
  SweepCurves(const SweepSpec& spec, const SweepAxis& axis, const std::vector<SweepCurve>& combinations,
              const std::vector<std::string>& contacts)
      : units_(spec.units),
        axis_(axis),
        combinations_(combinations),
        contacts_(contacts),
        table_(curve_table(spec, axis, contacts)) {}

  [[nodiscard]] result::Picture picture(const std::string& name, const std::string& subtitle,
                                        const std::vector<SweepPanel>& panels,
                                        const result::PictureStyle& look) const {
    const std::size_t count = panels.size();
    result::Picture picture{
        name, subtitle, result::canvas_of(look, 148.0 + 320.0 * static_cast<double>(count), false), false};
    picture.space = 26.0;
    picture.setup = "set offsets 0,0,graph 0.05,0\n" + x_range(axis_);
    for (std::size_t i = 0; i < count; ++i) {
      result::Panel panel{panels[i].label, curves(panels[i])};
      panel.axes = panels[i].kind == SweepPanel::Kind::answer ? "set yrange [*:*]\n" : "set yrange [0:*]\n";
      if (!axis_.numbers) panel.axes += tics(i + 1 == count);
      if (i + 1 == count)
        panel.axes += "set xlabel " + result::quoted(study::key_with_unit(axis_.vary->path, units_)) + "\n";
      picture.panels.push_back(panel);
    }
    return picture;
  }

  /// Adds the tables of the pictures.
  void add_tables(result::PictureFiles& files) const {
    for (std::size_t i = 0; i < std::min(combinations_.size(), max_curves); ++i)
      files.add_table(fmt::format("curve-{}", i + 1), table_.text(from_left(combinations_[i], axis_)));
  }

 private:
  [[nodiscard]] std::string tics(bool named) const {
    std::vector<std::pair<std::string, std::size_t>> names;
    for (const std::string& value : axis_.vary->values) names.emplace_back(named ? value : "", names.size());
    return result::named_tics('x', names) + "\n";
  }

  [[nodiscard]] std::vector<result::Curve> curves(const SweepPanel& panel) const {
    std::vector<result::Curve> list;
    const bool of_contacts = panel.kind == SweepPanel::Kind::contacts;
    for (std::size_t k = 0; k < (of_contacts ? contacts_.size() : 1); ++k) {
      for (std::size_t c = 0; c < combinations_.size() && list.size() < max_curves; ++c) {
        const std::size_t column = table_.number((of_contacts ? contacts_[k] + "." : "") + panel.column);
        const bool alone = !of_contacts || (contacts_.size() == 1 && combinations_.size() > 1);
        std::string title = panel.kind == SweepPanel::Kind::events
                                ? (combinations_.size() == 1 ? "events" : "")
                            : alone ? ""
                                    : contacts_[k];
        if (!combinations_[c].name.empty()) title += (title.empty() ? "" : ", ") + combinations_[c].name;
        // The colour distinguishes combinations of the other keys; if there is only one combination, it
        // distinguishes contacts.
        const std::size_t colour = combinations_.size() > 1 ? c : k;
        // Later curves are thinner and dashed, and drawn on top, so that coinciding curves remain visible.
        const std::size_t i = list.size();
        list.push_back(
            {fmt::format("'curve-{}.csv' skip 1", c + 1), fmt::format("{}:{}", table_.number("x"), column),
             fmt::format("with linespoints linewidth {:.1f} pointtype {} pointsize 0.7{} linecolor '{}'",
                         std::max(1.0, 2.6 - 0.5 * static_cast<double>(i)), 5 + 2 * static_cast<int>(i % 5),
                         i == 0 ? "" : fmt::format(" dashtype {}", i % 5 + 1),
                         colours[colour % colours.size()]),
             title});
      }
    }
    return list;
  }

  const Units& units_;
  const SweepAxis& axis_;
  const std::vector<SweepCurve>& combinations_;
  const std::vector<std::string>& contacts_;
  result::CsvTable<const SweepRow*> table_;
};

bool is_picture_of_sweep(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool named = stem == "motion" || stem == "forces" || stem == "losses" || stem == "responses" ||
                     stem == "exceedance" || stem == "strobe";
  return (result::is_picture(file) && named) ||
         (file.extension() == ".csv" && (stem.starts_with("curve-") || stem.starts_with("exceedance-") ||
                                         stem.starts_with("strobe-") || stem == "map" || stem == "borders"));
}

std::string labelled(const SweepSpec& spec, std::size_t query) {
  const std::string& unit = spec.response_units[query];
  return spec.responses[query] + (unit.empty() ? "" : " [" + unit + "]");
}

/// Probability that a result is exceeded, over its value, with confidence interval; one panel per query.
void add_exceedances(const SweepSpec& spec, const SweepRows& rows, const result::PlottedRun& run,
                     result::PictureFiles& files) {
  const std::vector<SampledResults> answers = sampled_results(spec, rows);
  const auto drawn = [](const SampledResults& s) { return s.sorted.size() > 1; };
  if (std::none_of(answers.begin(), answers.end(), drawn)) return;
  const result::CsvTable<Exceedance>& table = exceedance_columns();
  const std::size_t panels = std::min(spec.responses.size(), max_panels);
  result::Picture picture{"exceedance", "Probability of a larger result; " + spec.sampling,
                          result::canvas_of(run.look, 74.0 + 340.0 * static_cast<double>(panels), false),
                          false};
  picture.space = 80.0;
  picture.setup = "set logscale y\n";
  for (std::size_t i = 0; i < panels; ++i) {
    result::Panel panel{
        "P(greater)", {}, "set xlabel " + result::quoted(labelled(spec, i)) + "\nset yrange [*:1]\n"};
    panel.own_axis = true;
    for (std::size_t k = 0; k < answers.size() && panel.curves.size() < max_curves; ++k) {
      if (answers[k].query != i || !drawn(answers[k])) continue;
      const std::string name = fmt::format("exceedance-{}", k + 1);
      files.add_table(name, table.text(exceedance(answers[k].sorted, independent(spec))));
      std::string title;
      for (const std::string& value : answers[k].values) title += (title.empty() ? "" : ", ") + value;
      const std::string data = "'" + name + ".csv' skip 1";
      const std::string colour = fmt::format("linecolor '{}'", colours[panel.curves.size() % colours.size()]);
      if (independent(spec) && answers.size() == spec.responses.size())
        panel.curves.push_back(
            {data, fmt::format("{}:{}:{}", table.number("value"), table.number("low"), table.number("high")),
             "with filledcurves fillstyle solid 0.2 noborder " + colour, "95 % confidence"});
      panel.curves.push_back({data, fmt::format("{}:{}", table.number("value"), table.number("probability")),
                              "with steps linewidth 1.8 " + colour, title});
    }
    picture.panels.push_back(panel);
  }
  files.add(run, picture);
}

struct SweepPicture {
  std::string name, subtitle;
  std::vector<SweepPanel> panels;
};

std::vector<SweepPicture> pictures_of(const SweepSpec& spec, const std::vector<std::string>& contacts) {
  const std::string length = " [" + spec.units.length + "]", force = " [" + spec.units.force + "]";
  const std::string energy = " [" + spec.units.force + " " + spec.units.length + "]";
  std::vector<SweepPicture> list;
  if (!spec.responses.empty()) {
    std::vector<SweepPanel> panels;
    for (std::size_t i = 0; i < std::min(spec.responses.size(), max_panels); ++i)
      panels.push_back({labelled(spec, i), SweepPanel::Kind::answer, spec.responses[i]});
    list.push_back({"responses", "Requested responses", panels});
  }
  if (!contacts.empty()) {
    constexpr SweepPanel::Kind of_contacts = SweepPanel::Kind::contacts;
    list.push_back({"motion",
                    "Greatest displacement of the contacts relative to the start",
                    {{"along the tangent" + length, of_contacts, "peak_t"},
                     {"along the normal" + length, of_contacts, "peak_n"}}});
    list.push_back({"forces",
                    "Greatest forces of the contacts",
                    {{"|N|" + force, of_contacts, "peak_N"}, {"|T|" + force, of_contacts, "peak_T"}}});
    list.push_back(
        {"losses",
         "Work lost by friction, and events",
         {{"friction work" + energy, of_contacts, "friction_work"}, {"events", SweepPanel::Kind::events}}});
  }
  return list;
}

/// Maps with two keys as axes.
void add_maps(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows,
              const std::vector<std::string>& contacts, const result::PlottedRun& run,
              result::PictureFiles& files) {
  files.add_table("map", map_table(spec).text(map_cells(spec, axes, rows)));
  const Borders found = borders_of(spec, axes, rows);
  const bool differ = !found.sides.empty();
  // Borders around most cells would not be informative.
  const bool borders = differ && 2 * found.sides.size() <= found.neighbours;
  if (borders) files.add_table("borders", border_table().text(found.sides));
  const char* parts = !differ   ? ""
                      : borders ? "; lines separate sequences of events"
                                : "; most neighbours have different sequences of events";
  for (const SweepPicture& shown : pictures_of(spec, contacts)) {
    const bool several = contacts.size() > 1 && shown.panels.front().kind != SweepPanel::Kind::answer;
    std::vector<MapPanel> maps;
    for (const SweepPanel& p : shown.panels) maps.push_back({p.label, p.column});
    files.add(run, map_picture(spec, axes, shown.name,
                               shown.subtitle + (several ? ", greatest of all contacts" : "") + parts, maps,
                               borders, run.look));
  }
}

}  // namespace

result::PictureFiles sweep_pictures(const SweepSpec& spec, const SweepRows& rows,
                                    const result::PictureStyle& look) {
  result::PictureFiles files(is_picture_of_sweep);
  const result::PlottedRun run = result::empty_plotted_run(spec.title, spec.units, look);
  if (!spec.sampling.empty()) {
    add_exceedances(spec, rows, run, files);
    return files;
  }
  if (!spec.strobe.text.empty()) add_strobe_picture(spec, rows, run, files);
  if (spec.carry.back) return files;  // each value has two runs, so there is no single curve
  const SweepAxis axis = axis_of(spec);
  const std::vector<SweepCurve> list = swept_curves(spec, rows, axis);
  const std::vector<std::string> contacts = contact_names(rows);
  if (std::none_of(list.begin(), list.end(), [](const auto& c) { return c.rows.size() >= 2; })) return files;
  const SweepCurves curves(spec, axis, list, contacts);
  curves.add_tables(files);
  if (const std::optional<MapAxes> axes = map_axes(spec)) {
    add_maps(spec, *axes, rows, contacts, run, files);
    return files;
  }
  const std::string others = other_keys(spec, axis);
  for (const SweepPicture& shown : pictures_of(spec, contacts))
    files.add(run, curves.picture(shown.name, shown.subtitle + others, shown.panels, look));
  return files;
}

void remove_sweep_plots(const fs::path& directory) {
  result::clear_plot_folder(directory / "plots", is_picture_of_sweep);
}

}  // namespace signorini::sweep
