#include "report/page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/version.hpp"
#include "report/html.hpp"
#include "report/load_cases.hpp"
#include "report/run_data.hpp"
#include "report/svg_figures.hpp"
#include "result/csv.hpp"
#include "result/summary_parts.hpp"
#include "signorini/error.hpp"
#include "signorini/event.hpp"

namespace signorini::report {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t max_rows = 2000;  // limit of the rows of a table on the page

struct Kind {
  const char *marker, *name;
};
// Files that identify the kind of results in a directory. The first file that exists decides.
constexpr Kind kinds[] = {{"compare.json", "comparison"},
                          {"study.json", "study"},
                          {"sweep.json", "sweep"},
                          {"verify.json", "verification"},
                          {"sensitivity.json", "sensitivity"},
                          {"fit.json", "fit"},
                          {"branch.json", "branch"},
                          {"summary.json", "run"}};

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

base::Json read_json(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string(), "cannot be read");
  try {
    return base::parse_json(file);
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not JSON: ") + error.what());
  }
}

std::string part(std::string_view name) {
  for (const base::EmbeddedFile& file : base::page_parts())
    if (file.name == name) return std::string(file.text);
  return {};
}

/// Text of a JSON value for the page: a text without quotes, a number with six digits, "-" for null.
std::string value_text(const base::Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  return value.is_number() ? short_number(base::json_line(value)) : base::json_line(value);
}

/// The member `name` of a JSON object; null if there is none, because summaries of other versions may lack it.
const base::Json& member(const base::Json& json, const char* name) {
  static const base::Json none;
  return json.is_object() && json.contains(name) ? json[name] : none;
}

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(name), html_text(value));
}

std::string preformatted(const std::string& text) {
  return text.empty() ? "" : "<pre>" + html_text(text) + "</pre>\n";
}

std::string page(const std::string& title, const std::string& kind, const std::string& body,
                 const std::string& data) {
  return fill_template(part("page.html"), {{"title", html_text(title)},
                                           {"kind", html_text(kind)},
                                           {"style", part("style.css")},
                                           {"body", body},
                                           {"data", data},
                                           {"script", part("stage.js") + part("player.js") +
                                                          part("charts.js") + part("filters.js")},
                                           {"version", html_text(version)}});
}

std::string outcome_text(const base::Json& summary) {
  const base::Json& outcome = member(summary, "outcome");
  const base::Json& reason = member(outcome, "reason");
  return fmt::format("{} at t = {} of {}{}", value_text(member(outcome, "kind")),
                     value_text(member(outcome, "t")), value_text(member(outcome, "t_end")),
                     reason.is_string() && reason != "" ? ": " + value_text(reason) : "");
}

bool leaves_out_modes(const base::Json& summary) {
  const base::Json& left_out = member(member(summary, "reduction"), "modes_left_out");
  return left_out.is_number() && left_out > 0;
}

/// Fact about the modes that [reduction] leaves out, and their estimated effect at contacts.
std::string reduction_fact(const base::Json& summary) {
  if (!leaves_out_modes(summary)) return "";
  const base::Json &reduction = member(summary, "reduction"), &units = member(summary, "units");
  const base::Json& at_contacts = member(reduction, "left_out_at_contacts");
  std::string text = fmt::format("{} modes kept, {} left out", value_text(member(reduction, "modes_kept")),
                                 value_text(member(reduction, "modes_left_out")));
  if (at_contacts.is_object())
    text += fmt::format(
        "; they would change displacements at contacts by about {} {} in one loading, and slips add up",
        value_text(member(at_contacts, "displacement")), value_text(member(units, "length")));
  return fact("reduced model", text);
}

std::string certified_text(const base::Json& summary) {
  const base::Json& certified = member(summary, "certified");
  const base::Json& reason = member(certified, "reason");
  if (!member(certified, "until").is_number()) return "no";
  const std::string what =
      leaves_out_modes(summary) ? "the sequence of events of the reduced model" : "the sequence of events";
  return what +
         (member(certified, "complete") == true ? ", to the end"
                                                : " until t = " + value_text(certified["until"])) +
         (reason.is_string() && reason != "" ? ": " + value_text(reason) : "");
}

std::string run_facts(const base::Json& summary) {
  std::string text = "<dl>\n" + fact("outcome", outcome_text(summary));
  text += fact("certified", certified_text(summary)) + reduction_fact(summary);
  text += fact("engine", value_text(member(summary, "engine")));
  const base::Json& events = member(summary, "events");
  std::string counts = value_text(member(events, "total"));
  const base::Json& by_type = member(events, "by_type");
  for (const auto& [type, count] : by_type.items()) counts += fmt::format(", {} {}", value_text(count), type);
  text += fact("events", counts);
  text += fact("degrees of freedom", value_text(member(member(summary, "model"), "degrees_of_freedom")));
  const base::Json& units = member(summary, "units");
  text += fact("units", fmt::format("{}, {}, {}, {}", value_text(member(units, "force")),
                                    value_text(member(units, "mass")), value_text(member(units, "length")),
                                    value_text(member(units, "time"))));
  text += fact("computed in", value_text(member(summary, "wall_time")) + " s");
  text += "</dl>\n";
  for (const base::Json& warning : member(summary, "warnings"))
    text += "<p class=warning>" + html_text(value_text(warning)) + "</p>\n";
  return text;
}

/// HTML table of events.csv: the main columns, with units in the header, and at most max_rows rows.
std::string event_table(const fs::path& file, const Units& units) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return "";
  const std::vector<std::string> header = result::CsvReader(file).header();
  std::vector<std::string> columns;
  for (const char* name : {"t", "t_error", "contact", "event", "from", "to", "N", "T"})
    if (std::find(header.begin(), header.end(), name) != header.end()) columns.emplace_back(name);
  std::map<std::string, std::string> of_columns;
  for (const EventColumn& column : event_columns)
    of_columns[column.name] = result::unit_in_words(column.unit, units);
  of_columns["t_error"] = result::unit_in_words("time", units);
  const std::string table = csv_table(file, max_rows, columns, of_columns);
  return table.empty() ? ""
                       : table +
                             "<p class=hint>N and T are the forces just before the event. events.csv also "
                             "has rates, impulses and the forces after the event.</p>\n";
}

/// A condition that the audit checks: key in summary.json, name as on the terminal, and unit.
struct Condition {
  const char *key, *name, *unit;
};
constexpr Condition conditions[] = {{"gap", "gap g < 0", "length"},
                                    {"tension", "tension N > 0", "force"},
                                    {"product", "complementarity |g N|", "force length"},
                                    {"penetration", "penetration", "length"},
                                    {"friction", "friction |T| > T_U", "force"},
                                    {"direction", "friction against slip T p' < 0", "force length/time"},
                                    {"equilibrium", "equilibrium", "force"},
                                    {"at_limit", "at rest at |T| = T_U", "force"},
                                    {"reactions", "sum of reactions", "force"},
                                    {"energy", "energy balance", "force length"}};

std::string audit_table(const base::Json& summary, const Units& units) {
  std::string rows;
  const base::Json& audit = member(summary, "audit");
  for (const auto& [name, entry] : audit.items()) {
    if (!entry.is_object()) continue;
    const base::Json& contact = member(entry, "contact");
    const auto known = std::find_if(std::begin(conditions), std::end(conditions),
                                    [&key = name](const Condition& c) { return key == c.key; });
    const bool is_known = known != std::end(conditions);
    const std::string unit = is_known ? " " + result::unit_in_words(known->unit, units) : "";
    rows += fmt::format(
        "<tr><td>{}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{}</td><td>{}</td></tr>\n",
        html_text(is_known ? known->name : name), html_text(value_text(member(entry, "relative"))),
        html_text(value_text(member(entry, "value")) + unit), html_text(value_text(member(entry, "t"))),
        html_text(contact.is_null() ? "" : value_text(contact)));
  }
  if (rows.empty()) return "";
  return "<p>Greatest errors of the contact conditions, the equations and the energy balance.</p>\n<div "
         "class=wide><table><thead><tr><th>condition</th><th>relative</th><th>value</th><th>at "
         "t</th><th>contact</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

/// HTML list of the numbers and texts at the top level of a JSON object.
std::string json_facts(const base::Json& json) {
  std::string text;
  for (const auto& [name, value] : json.items())
    if (!value.is_object() && !value.is_array()) text += fact(name, value_text(value));
  return text.empty() ? "" : "<dl>\n" + text + "</dl>\n";
}

/// Section for a periodic motion: facts of orbit.json, and the first Floquet multipliers.
std::string orbit_section(const fs::path& directory) {
  constexpr std::size_t most_multipliers = 12;
  std::error_code error;
  if (!fs::is_regular_file(directory / "orbit.json", error)) return "";
  const base::Json orbit = read_json(directory / "orbit.json");
  std::string rows;
  std::size_t count = 0;
  for (const base::Json& mu : member(orbit, "multipliers"))
    if (mu.is_array() && mu.size() == 2 && count++ < most_multipliers)
      rows += fmt::format("<tr><td class=n>{}</td><td class=n>{}</td></tr>\n", html_text(value_text(mu[0])),
                          html_text(value_text(mu[1])));
  std::string families;
  for (const base::Json& family : member(orbit, "families"))
    families += "<p>This orbit is one of a family: " + html_text(value_text(family)) + ".</p>\n";
  const std::string table =
      rows.empty() ? ""
                   : fmt::format(
                         "<p>The greatest of {} Floquet multipliers:</p>\n<div class=wide><table><thead>"
                         "<tr><th>real part</th><th>imaginary part</th></tr></thead><tbody>\n{}"
                         "</tbody></table></div>\n",
                         count, rows);
  return section("orbit", "Periodic motion", json_facts(orbit) + families + table);
}

/// Pictures of a directory, as many as the page has room for. taken: size of the page without pictures, in bytes.
std::string pictures(const fs::path& directory, const std::string& command, std::size_t taken) {
  constexpr std::size_t most = 2'950'000;  // limit of the page: 3 MB
  const std::string all = figures(directory, taken < most ? most - taken : 0);
  return all.empty() ? "<p>There are no pictures; " + html_text(command) + " draws them.</p>\n" : all;
}

/// The sentences of study.md, without its table and picture, which the page shows separately.
std::string sentences(const std::string& markdown) {
  std::string text;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '|' && line[0] != '#' && line[0] != '!')
      text += "<p>" + html_text(line) + "</p>\n";
  return text;
}

std::string title_of(const base::Json& json, const fs::path& directory) {
  const std::string title = json.contains("title") ? value_text(json["title"]) : "";
  return title.empty() ? fs::absolute(directory).lexically_normal().string() : title;
}

}  // namespace

std::string kind_of_results(const fs::path& directory) {
  std::error_code error;
  for (const Kind& kind : kinds) {
    const fs::path marker = directory / kind.marker;
    if (fs::is_regular_file(marker, error)) return kind.name;
    if (const std::string why = base::input_file_error(marker); !why.empty())
      throw FileError(marker.string(), why + ", expected a file");
  }
  throw FileError(
      directory.string(),
      fs::is_directory(directory, error)
          ? "contains no run, comparison, study, sweep, verification, sensitivities, fit or branch"
          : "not a directory");
}

std::string run_page(const fs::path& directory, const Scene& scene, const std::string& check) {
  const base::Json summary = read_json(directory / "summary.json");
  base::Json data = run_data(scene, directory);
  data["response_units"] = base::Json::object();
  for (const base::Json& output : member(summary, "response"))
    data["response_units"][value_text(member(output, "name"))] = value_text(member(output, "unit"));
  std::string body = section("loads", "Support loads", support_loads_html(summary));
  body += section("responses", "Responses", responses_html(summary, false));
  body += section("envelopes", "Member envelopes", responses_html(summary, true));
  body += orbit_section(directory);
  body += section("summary", "Summary", run_facts(summary));
  body += part("player.html");
  body += section("audit", "Audit", audit_table(summary, scene.units));
  const std::string events = event_table(directory / "events.csv", scene.units);
  body += section("events", "Events", events.empty() ? "" : part("events.html") + events);
  std::string end = section("check", "Output of check", preformatted(check));
  end += section("scene", "Scene", preformatted(whole_file(directory / "run.toml")));
  const std::string json = script_json(base::json_line(data));
  constexpr std::size_t style_and_script = 50'000;
  const std::size_t taken = body.size() + end.size() + json.size() + style_and_script;
  body += section("pictures", "Pictures", pictures(directory, "signorini plot " + directory.string(), taken));
  return page(title_of(summary, directory), "run", body + end, json);
}

std::string load_cases_page(const std::vector<LoadCase>& cases) {
  std::string names;
  for (const LoadCase& each : cases) names += (names.empty() ? "" : ", ") + each.name;
  return page("Load cases: " + names, "load cases", load_cases_html(cases), "null");
}

std::string results_page(const fs::path& directory) {
  const std::string kind = kind_of_results(directory);
  std::string marker;
  for (const Kind& each : kinds)
    if (each.name == kind) marker = each.marker;
  const base::Json json = read_json(directory / marker);
  std::string body =
      section("summary", "Summary", json_facts(json) + sentences(whole_file(directory / "study.md")));
  for (const char* table :
       {"runs.csv", "differences.csv", "columns.csv", "figures.csv", "sensitivities.csv", "spread.csv",
        "residuals.csv", "events.csv", "study.csv", "sweep.csv", "branch.csv"})
    body += section(fs::path(table).stem().string(), table, csv_table(directory / table, max_rows));
  body += section("pictures", "Pictures",
                  pictures(directory, "running the command again with gnuplot on PATH", body.size()));
  body += section("facts", marker, preformatted(base::json_text(json)));
  return page(title_of(json, directory), kind, body, "null");
}

}  // namespace signorini::report
