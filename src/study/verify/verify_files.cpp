#include "study/verify/verify_files.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/json.hpp"
#include "result/csv.hpp"
#include "result/picture_files.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"
#include "study/optional_values.hpp"

namespace signorini::verify {
namespace {

namespace fs = std::filesystem;

base::Json observation_json(const Observation& o, const std::string& where) {
  base::Json json = {{"t", o.t}};
  if (!where.empty()) json["where"] = where;
  json.update(base::Json{{"ida", o.ida},
                         {"ida_error", o.ida_error},
                         {"richardson", o.richardson},
                         {"bar", o.bar},
                         {"exact", study::json_of(o.exact)},
                         {"agrees", o.agrees()}});
  return json;
}

base::Json kind_json(const VerifiedKind& kind) {
  base::Json json = {{"unit", kind.unit},
                     {"order", study::json_of(kind.order)},
                     {"compared", kind.compared},
                     {"disagreeing", kind.disagreeing},
                     {"witnessed", kind.exact_agreements}};
  if (kind.compared > 0) json["worst"] = observation_json(kind.worst, kind.where);
  if (kind.first) json["first"] = observation_json(*kind.first, kind.first_where);
  return json;
}

const std::string& contact_of(const Model& model, const VerifiedEvent& event) {
  return model.contacts[static_cast<std::size_t>(event.contact)].name;
}

/// The difference for a logarithmic axis, which cannot show zero.
double shown(double difference) { return std::max(difference, 1e-18); }

/// Columns of the picture's table of event times.
const result::CsvTable<VerifiedEvent>& plot_table() {
  using E = VerifiedEvent;
  static const result::CsvTable<E> table = {
      {"t", [](const E& e) { return e.time.t; }},
      {"difference", [](const E& e) { return shown(e.time.difference()); }},
      {"allowed", [](const E& e) { return shown(e.time.allowed()); }},
      {"bar", [](const E& e) { return shown(e.time.bar); }},
      {"exact", [](const E& e) {
         return e.time.exact ? std::optional(shown(std::abs(e.time.ida - *e.time.exact))) : std::nullopt;
       }}};
  return table;
}

/// Columns of events.csv.
result::CsvTable<VerifiedEvent> verified_table(const Model& model) {
  using E = VerifiedEvent;
  return {{"contact", [&model](const E& e) { return std::string_view(contact_of(model, e)); }},
          {"event", [](const E& e) { return signorini::to_string(e.type); }},
          {"from", [](const E& e) { return signorini::to_string(e.from); }},
          {"to", [](const E& e) { return signorini::to_string(e.to); }},
          {"t_ida", [](const E& e) { return e.time.ida; }},
          {"t_error", [](const E& e) { return e.time.ida_error; }},
          {"t_richardson", [](const E& e) { return e.time.richardson; }},
          {"bar", [](const E& e) { return e.time.bar; }},
          {"t_exact", [](const E& e) { return e.time.exact; }},
          {"agrees", [](const E& e) { return e.time.agrees() ? "1" : "0"; }}};
}

bool is_picture_of_verification(const fs::path& file) {
  return file.stem() == "verify" && (result::is_picture(file) || file.extension() == ".csv");
}

}  // namespace

std::string verify_json(const Model& model, const Verification& result) {
  base::Json json = {
      {"verdict", to_string(result.verdict)},     {"sentence", result.sentence}, {"title", model.title},
      {"units", result::units_json(model.units)}, {"until", result.until},       {"dt", result.dt}};
  json["orders"] = json["bars"] = json["richardson"] = json["kinds"] = base::Json::object();
  for (const VerifiedKind& kind : result.kinds) {
    json["orders"][kind.name] = study::json_of(kind.order);
    json["bars"][kind.name] = kind.greatest_bar;
    json["kinds"][kind.name] = kind_json(kind);
    if (kind.compared > 0) json["richardson"][kind.name] = kind.worst.richardson;
  }
  json["richardson"]["events"] = base::Json::array();
  for (const VerifiedEvent& event : result.events) {
    base::Json row = {{"contact", contact_of(model, event)},
                      {"event", signorini::to_string(event.type)},
                      {"from", signorini::to_string(event.from)},
                      {"to", signorini::to_string(event.to)}};
    row.update(observation_json(event.time, ""));
    json["richardson"]["events"].push_back(std::move(row));
  }
  json["witness"] = result.exact_result;
  json["step_test"] = {
      {"tolerance", paper_change}, {"dt", study::json_of(result.paper_dt)}, {"steps", base::Json::array()}};
  for (const StepTest& test : result.step_tests)
    json["step_test"]["steps"].push_back(
        {{"dt", test.dt},
         {"change", std::isfinite(test.change) ? base::Json(test.change) : base::Json(nullptr)}});
  if (result.ida.certificate)
    json["ida"] = {{"certain_until", result.ida.certificate->until},
                   {"companion", result.ida.certificate->companion},
                   {"rows_of_events", result.ida.certificate->t_errors.size()}};
  return base::json_text(json);
}

void write_verification(const fs::path& directory, const Model& model, const Verification& result) {
  result::write_file(directory / "events.csv", verified_table(model).text(result.events));
  result::write_file(directory / "verify.json", verify_json(model, result));
}

void begin_verify_plot(const fs::path& directory) {
  result::begin_plot_folder(directory / "plots", is_picture_of_verification);
}

std::vector<fs::path> write_verify_plot(const fs::path& directory, const Model& model,
                                        const Verification& result) {
  if (result.events.size() < 2) return {};
  result::PictureFiles files(is_picture_of_verification);
  files.add_table("verify", plot_table().text(result.events));
  result::PlottedRun run = result::empty_plotted_run(model.title, model.units);
  run.to = result.events.back().time.t * 1.02;
  if (result.until < run.to) run.facts.certain_until = result.until;
  const auto curve = [](const char* column, const char* look, const char* name) -> result::Curve {
    return {"'verify.csv' skip 1",
            fmt::format("{}:{}", plot_table().number("t"), plot_table().number(column)), look, name};
  };
  result::Panel panel{
      "difference [" + model.units.time + "]",
      {curve("allowed", "with lines linewidth 1.2 linecolor '#c0182b'", "allowed"),
       curve("bar", "with lines linewidth 1 dashtype 2 linecolor '#777777'", "bar of newmark"),
       curve("difference", "with points pointtype 7 pointsize 0.4 linecolor '#1a1a1a'", "ida - limit"),
       curve("exact", "with points pointtype 6 pointsize 0.4 linecolor '#1f77b4'", "ida - exact")},
      "set logscale y\nset format y '%.0e'\n"};
  panel.after = "unset logscale y\n";
  files.add(run, {"verify",
                  fmt::format("Times of events: ida against newmark at dt = {:g}, {:g}, {:g}", result.dt[0],
                              result.dt[1], result.dt[2]),
                  result::canvas_of(run.look, 620, true),
                  true,
                  {panel}});
  return files.write(directory);
}

}  // namespace signorini::verify
