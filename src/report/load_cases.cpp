#include "report/load_cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <tuple>

#include "base/rounding.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "report/html.hpp"
#include "result/summary_parts.hpp"
#include "signorini/error.hpp"

namespace signorini::report {

namespace fs = std::filesystem;

namespace {

enum class Sheet { support, response, envelope };

/// Criterion by which the governing case of a figure is selected.
enum class Governs { least, greatest, magnitude };

struct Figure {
  Sheet sheet = Sheet::support;
  std::string item, quantity, unit;
  Governs governs = Governs::greatest;
  std::optional<double> value, t;
  std::string place;  ///< for an envelope: piece, station and fibre of the extreme
};

/// The member `name` of a JSON object; null if there is none.
const base::Json& entry_of(const base::Json& json, const char* name) {
  static const base::Json none;
  return json.is_object() && json.contains(name) ? json[name] : none;
}

std::optional<double> number_in(const base::Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::string text_in(const base::Json& json) { return json.is_string() ? json.get<std::string>() : ""; }

/// Sets figures with this unit to 0 if they are rounding errors compared with the largest of them.
void clear_rounding(std::vector<Figure>& figures, const std::string& unit) {
  double greatest = 0.0;
  for (const Figure& f : figures)
    if (f.unit == unit && f.value) greatest = std::max(greatest, std::abs(*f.value));
  for (Figure& f : figures)
    if (f.unit == unit && f.value && std::abs(*f.value) <= rounding::many_operations * greatest)
      f.value = 0.0;
}

std::vector<Figure> support_figures(const base::Json& summary) {
  std::vector<Figure> figures;
  const base::Json& units = entry_of(summary, "units");
  const std::string force = text_in(entry_of(units, "force")), length = text_in(entry_of(units, "length"));
  for (const base::Json& contact : entry_of(summary, "contacts")) {
    const std::string name = text_in(entry_of(contact, "name"));
    const base::Json& load = entry_of(contact, "load");
    if (!load.is_object()) continue;
    const auto add = [&](const char* quantity, const std::string& unit, Governs governs,
                         std::optional<double> value, std::optional<double> t = {}) {
      figures.push_back({Sheet::support, name, quantity, unit, governs, value, t, ""});
    };
    const auto turn = [&](const char* quantity, const char* of, const char* which, Governs governs) {
      const base::Json& found = entry_of(entry_of(load, of), which);
      add(quantity, force, governs, number_in(entry_of(found, "value")), number_in(entry_of(found, "t")));
    };
    auto rest = number_in(entry_of(contact, "static_reaction"));
    if (rest) rest = *rest == 0.0 ? 0.0 : -*rest;
    add("N at rest", force, Governs::least, rest);
    turn("N min", "N", "least", Governs::least);
    turn("N max", "N", "greatest", Governs::greatest);
    turn("T min", "T", "least", Governs::least);
    turn("T max", "T", "greatest", Governs::greatest);
    add("residual slip", length, Governs::magnitude, number_in(entry_of(load, "residual_slip")));
    add("friction loss", force + " " + length, Governs::greatest,
        number_in(entry_of(contact, "friction_work")));
  }
  clear_rounding(figures, force);
  clear_rounding(figures, length);
  return figures;
}

std::string place_of(const base::Json& extreme) {
  const base::Json& at = entry_of(extreme, "at");
  if (!at.is_array() || at.size() != 2) return "";
  const std::string fibre = text_in(entry_of(extreme, "fibre"));
  const auto station = number_in(entry_of(extreme, "station"));
  return fmt::format("{}-{}{}{}", text_in(at[0]), text_in(at[1]),
                     station ? fmt::format(" {:.3g}", *station) : "", fibre.empty() ? "" : " " + fibre);
}

std::vector<Figure> response_figures(const base::Json& summary) {
  std::vector<Figure> figures;
  for (const base::Json& output : entry_of(summary, "response")) {
    const Sheet sheet = text_in(entry_of(output, "kind")) == "envelope" ? Sheet::envelope : Sheet::response;
    const std::string name = text_in(entry_of(output, "name")), unit = text_in(entry_of(output, "unit"));
    for (const auto& [quantity, key, governs] : {std::tuple("maximum", "maximum", Governs::greatest),
                                                 std::tuple("minimum", "minimum", Governs::least)}) {
      const base::Json& found = entry_of(output, key);
      figures.push_back({sheet, name, quantity, unit, governs, number_in(entry_of(found, "value")),
                         number_in(entry_of(found, "t")), place_of(found)});
    }
    figures.push_back({sheet, name, "at the end", unit, Governs::magnitude,
                       number_in(entry_of(output, "last")), std::nullopt, ""});
  }
  return figures;
}

std::vector<Figure> figures_of(const base::Json& summary) {
  std::vector<Figure> figures = support_figures(summary);
  for (Figure& figure : response_figures(summary)) figures.push_back(std::move(figure));
  return figures;
}

std::string shown(double value) { return fmt::format("{:.5g}", value); }

std::string cell(const std::optional<double>& value) {
  return fmt::format("<td class=n>{}</td>", value ? shown(*value) : "");
}

/// Table cell with a time; a click on the cell moves the player of the page to this time.
std::string time_cell(const std::optional<double>& t) {
  return t ? fmt::format("<td class=n data-t=\"{}\">{:.5g}</td>", base::format_number(*t), *t) : "<td></td>";
}

std::string table(const std::string& head, const std::string& rows) {
  return rows.empty() ? ""
                      : fmt::format(
                            "<div class=\"wide "
                            "all\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n",
                            head, rows);
}

/// Heading of a table column, with the unit in a second line.
std::string heading(const std::string& text, const std::string& unit = "") {
  return "<th>" + html_text(text) + (unit.empty() ? "" : "<br>[" + html_text(unit) + "]") + "</th>";
}

}  // namespace

namespace {

/// Paragraph with the sign conventions of a table of support loads; more: an additional sentence.
std::string signs(const std::string& more = "") {
  return "<p class=signs>N &lt; 0 is compression; T has the sign of the slip rate. N at rest is the reaction "
         "at the start "
         "of the run." +
         (more.empty() ? "" : " " + more) + "</p>\n";
}

}  // namespace

std::string support_loads_html(const base::Json& summary) {
  const std::vector<Figure> figures = support_figures(summary);
  if (figures.empty()) return "";
  const std::string time = text_in(entry_of(entry_of(summary, "units"), "time"));
  std::string head = heading("contact"), rows;
  const std::string& first = figures.front().item;
  for (const Figure& f : figures) {
    if (f.item != first) break;
    head += heading(f.quantity, f.unit);
    if (f.t) head += heading("at t", time);
  }
  for (std::size_t i = 0; i < figures.size();) {
    const std::string& item = figures[i].item;
    rows += "<tr><td>" + html_text(item) + "</td>";
    for (; i < figures.size() && figures[i].item == item; ++i)
      rows += cell(figures[i].value) + (figures[i].t ? time_cell(figures[i].t) : "");
    rows += "</tr>\n";
  }
  return table(head, rows) + signs();
}

std::string responses_html(const base::Json& summary, bool envelopes) {
  const std::string time = text_in(entry_of(entry_of(summary, "units"), "time"));
  std::string head = heading("name") + heading("unit"), rows;
  for (const char* which : {"maximum", "minimum"})
    head += heading(which) + heading("at t", time) + (envelopes ? heading("where") : "");
  head += heading("at the end");
  std::string item;
  for (const Figure& f : response_figures(summary)) {
    if ((f.sheet == Sheet::envelope) != envelopes) continue;
    if (f.item != item)
      rows += (rows.empty() ? "" : "</tr>\n") +
              fmt::format("<tr><td>{}</td><td>{}</td>", html_text(f.item), html_text(f.unit));
    item = f.item;
    rows += cell(f.value);
    if (f.quantity == "at the end") continue;
    rows += time_cell(f.t);
    if (envelopes) rows += "<td>" + html_text(f.place) + "</td>";
  }
  return table(head, rows.empty() ? "" : rows + "</tr>\n");
}

namespace {

/// One row for all cases: a figure and its values.
struct CaseRow {
  Figure of;
  std::vector<std::optional<Figure>> values;  ///< one per case
};

/// All figures of all cases, in the order of their first occurrence.
std::vector<CaseRow> case_rows(const std::vector<LoadCase>& cases) {
  std::vector<CaseRow> rows;
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (const Figure& figure : figures_of(cases[c].summary)) {
      auto row = std::find_if(rows.begin(), rows.end(), [&](const CaseRow& r) {
        return r.of.sheet == figure.sheet && r.of.item == figure.item && r.of.quantity == figure.quantity &&
               r.of.unit == figure.unit;
      });
      if (row == rows.end()) {
        rows.push_back({figure, std::vector<std::optional<Figure>>(cases.size())});
        row = rows.end() - 1;
      }
      row->values[c] = figure;
    }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const CaseRow& a, const CaseRow& b) { return a.of.sheet < b.of.sheet; });
  return rows;
}

bool is_done(const LoadCase& c) {
  return text_in(entry_of(entry_of(c.summary, "outcome"), "kind")) == "done";
}

/// Index of the governing case; only completed cases can govern. -1 if none of them has a value, or if all values are 0.
int governing(const std::vector<LoadCase>& cases, const CaseRow& row) {
  int best = -1;
  double most = 0.0;
  bool any = false;
  for (std::size_t c = 0; c < row.values.size(); ++c) {
    if (!row.values[c] || !row.values[c]->value || !is_done(cases[c])) continue;
    any = any || *row.values[c]->value != 0.0;
    const double value = *row.values[c]->value;
    const double weight = row.of.governs == Governs::least      ? -value
                          : row.of.governs == Governs::greatest ? value
                                                                : std::abs(value);
    if (best >= 0 && !(weight > most)) continue;
    best = static_cast<int>(c);
    most = weight;
  }
  return any ? best : -1;
}

/// Line of a CSV file; quotes cells if necessary, because names of directories may contain commas and quotes.
std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (cells[i].find_first_of(",\"\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

base::Json read_summary(const fs::path& directory) {
  const fs::path path = directory / "summary.json";
  base::check_run_files(directory, {"summary.json"});
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw FileError(directory.string(),
                    fs::is_directory(directory)
                        ? "contains no run; load cases are directories that `signorini run` wrote"
                        : "not a directory");
  try {
    return base::parse_json(file);
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not JSON: ") + error.what());
  }
}

/// Names of the units for messages: "kN, t, m, s".
std::string unit_list(const base::Json& units) {
  std::string text;
  for (const char* of : {"force", "mass", "length", "time"})
    if (const std::string unit = text_in(entry_of(units, of)); !unit.empty())
      text += (text.empty() ? "" : ", ") + unit;
  return text;
}

std::string rows_html(const std::vector<LoadCase>& cases, const std::vector<CaseRow>& rows, Sheet sheet) {
  std::string head = heading("item") + heading("quantity") + heading("unit"), text;
  for (const LoadCase& c : cases) head += heading(c.name) + heading("at t");
  head += heading("governs");
  for (const CaseRow& row : rows) {
    if (row.of.sheet != sheet) continue;
    const int best = governing(cases, row);
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", html_text(row.of.item),
                        html_text(row.of.quantity), html_text(row.of.unit));
    for (std::size_t c = 0; c < row.values.size(); ++c) {
      const auto& figure = row.values[c];
      const bool governs = static_cast<int>(c) == best;
      text += fmt::format("<td class=\"n{}\">{}</td>", governs ? " most" : "",
                          figure && figure->value ? shown(*figure->value) : "");
      text += fmt::format("<td class=\"n pale\">{}</td>", figure && figure->t ? shown(*figure->t) : "");
    }
    text += fmt::format("<td>{}</td></tr>\n",
                        best < 0 ? "" : html_text(cases[static_cast<std::size_t>(best)].name));
  }
  return table(head, text);
}

}  // namespace

std::vector<LoadCase> read_load_cases(const std::vector<fs::path>& directories) {
  std::vector<LoadCase> cases;
  for (const fs::path& directory : directories) {
    const fs::path whole = fs::absolute(directory).lexically_normal();
    const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    for (const LoadCase& other : cases)
      if (other.name == name)
        throw FileError(directory.string(), "has the name \"" + name +
                                                "\" of another load case; rename one of the two directories");
    cases.push_back({name, read_summary(directory)});
    const base::Json &units = entry_of(cases.back().summary, "units"),
                     &first = entry_of(cases.front().summary, "units");
    if (units != first)
      throw FileError(directory.string(),
                      fmt::format("has the units {}, but {} has {}; load cases need the same units",
                                  unit_list(units), directories.front().string(), unit_list(first)));
  }
  return cases;
}

std::string load_cases_csv(const std::vector<LoadCase>& cases) {
  std::vector<std::string> header{"item", "quantity", "unit"};
  for (const LoadCase& c : cases) {
    header.push_back(c.name);
    header.push_back(c.name + " t");
  }
  header.emplace_back("governing");
  std::string text = csv_line(header);
  for (const CaseRow& row : case_rows(cases)) {
    std::vector<std::string> cells{row.of.item, row.of.quantity, row.of.unit};
    for (const auto& figure : row.values) {
      cells.push_back(figure && figure->value ? base::format_number(*figure->value) : "");
      cells.push_back(figure && figure->t ? base::format_number(*figure->t) : "");
    }
    const int best = governing(cases, row);
    cells.push_back(best < 0 ? "" : cases[static_cast<std::size_t>(best)].name);
    text += csv_line(cells);
  }
  return text;
}

namespace {

/// Description of a case by the overrides on the command line of its run: "a=b, c=d" for --set a=b --set=c=d.
std::string overrides_of(const base::Json& summary) {
  const base::Json& line = entry_of(summary, "command_line");
  std::string text;
  if (!line.is_array()) return text;
  constexpr std::string_view option = "--set", joined = "--set=";
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string word = text_in(line[i]);
    if (word == option && i + 1 < line.size())
      word = text_in(line[++i]);
    else if (word.starts_with(joined))
      word.erase(0, joined.size());
    else
      continue;
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string method_of(const base::Json& summary) {
  std::string text = text_in(entry_of(summary, "engine"));
  const auto cutoff = number_in(entry_of(entry_of(summary, "reduction"), "cutoff_omega"));
  if (cutoff)
    text += fmt::format(", modes up to {} rad/{}", shown(*cutoff),
                        text_in(entry_of(entry_of(summary, "units"), "time")));
  return text;
}

std::vector<std::string> names_in(const base::Json& list) {
  std::vector<std::string> names;
  if (list.is_array())
    for (const base::Json& item : list) names.push_back(text_in(entry_of(item, "name")));
  return names;
}

std::string warnings_html(const std::vector<LoadCase>& cases) {
  std::string text;
  for (const LoadCase& c : cases) {
    const base::Json& warnings = entry_of(c.summary, "warnings");
    if (!warnings.is_array()) continue;
    for (const base::Json& warning : warnings)
      text += fmt::format("<li>{}: {}</li>\n", html_text(c.name), html_text(text_in(warning)));
  }
  return text.empty() ? "" : "<p>Warnings of the runs:</p><ul class=warnings>" + text + "</ul>\n";
}

}  // namespace

std::vector<std::string> load_case_warnings(const std::vector<LoadCase>& cases) {
  std::vector<std::string> warnings;
  for (const LoadCase& c : cases) {
    const base::Json& outcome = entry_of(c.summary, "outcome");
    if (!is_done(c))
      warnings.push_back(fmt::format(
          "case {0} ended at t = {1} of {2} ({3}); values of case {0} are not used as governing values",
          c.name, shown(number_in(entry_of(outcome, "t")).value_or(0.0)),
          shown(number_in(entry_of(outcome, "t_end")).value_or(0.0)), text_in(entry_of(outcome, "kind"))));
    if (names_in(entry_of(c.summary, "contacts")) != names_in(entry_of(cases.front().summary, "contacts")))
      warnings.push_back(
          fmt::format("cases {} and {} have different contacts; check that they describe the same structure",
                      cases.front().name, c.name));
  }
  return warnings;
}

std::string load_cases_html(const std::vector<LoadCase>& cases) {
  std::string facts, text;
  for (const LoadCase& c : cases) {
    const base::Json& outcome = entry_of(c.summary, "outcome");
    const base::Json& events = entry_of(c.summary, "events");
    const auto t = number_in(entry_of(outcome, "t"));
    const std::string kind = text_in(entry_of(outcome, "kind"));
    facts += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=n>{}</td><td "
        "class=n>{}</td></tr>\n",
        html_text(c.name), html_text(text_in(entry_of(c.summary, "title"))),
        html_text(overrides_of(c.summary)), html_text(method_of(c.summary)),
        is_done(c) ? "done" : "<b>" + html_text(kind) + "</b>", t ? shown(*t) : "",
        html_text(base::json_line(entry_of(events, "total"))));
  }
  std::string warnings;
  for (const std::string& warning : load_case_warnings(cases))
    warnings += "<p><b>" + html_text(warning) + "</b></p>\n";
  text +=
      section("cases", "Load cases",
              table("<th>case</th><th>title</th><th>changed in the scene</th><th>engine</th><th>outcome</th>"
                    "<th>reached t</th><th>events</th>",
                    facts) +
                  warnings + signs("Bold: the governing case, by minimum, maximum or greatest magnitude.") +
                  warnings_html(cases));
  const std::vector<CaseRow> rows = case_rows(cases);
  text += section("loads", "Support loads", rows_html(cases, rows, Sheet::support));
  text += section("responses", "Responses", rows_html(cases, rows, Sheet::response));
  text += section("envelopes", "Member envelopes", rows_html(cases, rows, Sheet::envelope));
  return text;
}

}  // namespace signorini::report
