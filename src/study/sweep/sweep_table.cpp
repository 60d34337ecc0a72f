#include "study/sweep/sweep_table.hpp"

#include <cmath>
#include <set>
#include "base/json.hpp"

#include "result/csv.hpp"
#include "result/units_json.hpp"
#include "signorini/event.hpp"

namespace signorini {

namespace {

constexpr const char* figures[] = {"peak_t", "peak_n", "peak_N", "peak_T", "friction_work"};

void row_csv(CsvBlock& block, const SweepRow& row, std::size_t responses,
             const std::vector<std::string>& contacts) {
  const auto if_ran = [&](double value) { return row.ran() ? std::optional<double>(value) : std::nullopt; };
  block.number(static_cast<double>(row.index + 1));
  for (const std::string& value : row.values) block.text(value);
  block.text(row.outcome).number(if_ran(row.t)).text(row.reason);
  block.number(if_ran(static_cast<double>(row.changes())));
  for (const EventTypeName& type : all_event_types) {
    const auto found = row.events.find(type.name);
    block.number(if_ran(found == row.events.end() ? 0.0 : static_cast<double>(found->second)));
  }
  for (std::size_t i = 0; i < responses; ++i) {
    const bool known = i < row.responses.size() && std::isfinite(row.responses[i]);
    block.number(known ? std::optional<double>(row.responses[i]) : std::nullopt);
  }
  for (const std::string& name : contacts) {
    const SweepRow::Contact* contact = contact_of(row, name);
    if (contact == nullptr) {
      for (std::size_t i = 0; i < std::size(figures); ++i) block.empty();
    } else {
      block.number(contact->tangential).number(contact->normal).number(contact->N).number(contact->T);
      block.number(contact->friction);
    }
  }
  block.number(if_ran(row.wall_time)).number(if_ran(static_cast<double>(row.steps)));
  block.number(if_ran(row.balance)).number(if_ran(static_cast<double>(row.warnings))).end_row();
}

}  // namespace

std::vector<std::string> contact_names(const SweepRows& rows) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const auto& [index, row] : rows)
    for (const auto& contact : row.contacts)
      if (known.insert(contact.name).second) names.push_back(contact.name);
  return names;
}

const SweepRow::Contact* contact_of(const SweepRow& row, const std::string& name) {
  for (const auto& contact : row.contacts)
    if (contact.name == name) return &contact;
  return nullptr;
}

std::string sweep_csv(const SweepSpec& spec, const SweepRows& rows) {
  const std::vector<std::string> contacts = contact_names(rows);
  CsvBlock block;
  block.text("row");
  for (const Vary& vary : spec.vary) block.text(vary.path);
  for (const char* name : {"outcome", "t", "reason", "events"}) block.text(name);
  for (const EventTypeName& type : all_event_types) block.text(type.name);
  for (const std::string& response : spec.responses) block.text(response);
  for (const std::string& contact : contacts)
    for (const char* figure : figures) block.text(contact + "." + figure);
  for (const char* name : {"wall_time", "steps", "energy_balance", "warnings"}) block.text(name);
  block.end_row();
  for (const auto& [index, row] : rows) row_csv(block, row, spec.responses.size(), contacts);
  return block.str();
}

std::string sweep_json(const SweepSpec& spec, const SweepRows& rows) {
  Json json = {
      {"title", spec.title},       {"scene", spec.scene},        {"units", units_json(spec.units)},
      {"settings", spec.settings}, {"share", spec.share.text()}, {"rows_in_all", points(spec.vary).size()}};
  json["vary"] = Json::array();
  for (const Vary& vary : spec.vary) {
    json["vary"].push_back({{"path", vary.path}});
    if (vary.sampled)  // the values stand in the rows
      json["vary"].back()["distribution"] = vary.text;
    else
      json["vary"].back()["values"] = vary.values;
  }
  if (!spec.sampling.empty()) json["sampling"] = spec.sampling;
  json["responses"] = Json::array();
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    json["responses"].push_back({{"name", spec.responses[i]}, {"unit", spec.response_units[i]}});
  json["rows"] = Json::array();
  for (const auto& [index, row] : rows) json["rows"].push_back(parse_json(row_json(row)));
  return json_text(json);
}

}  // namespace signorini
