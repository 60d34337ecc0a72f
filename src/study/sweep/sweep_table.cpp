#include "study/sweep/sweep_table.hpp"

#include <cmath>
#include <set>
#include "base/json.hpp"

#include "result/table.hpp"
#include "result/units_json.hpp"
#include "signorini/event.hpp"

namespace signorini {

namespace {

/// Columns of sweep.csv; figures of a row without a run are empty.
CsvTable<SweepRow> sweep_table(const SweepSpec& spec, const std::vector<std::string>& contacts) {
  using R = SweepRow;
  const auto if_ran = [](auto figure) {
    return [figure](const R& row) {
      return row.ran() ? std::optional(static_cast<double>(std::invoke(figure, row))) : std::nullopt;
    };
  };
  CsvTable<R> table = {{"row", [](const R& row) { return row.index + 1; }}};
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    table.add(spec.vary[i].path, [i](const R& row) { return std::string_view(row.values[i]); });
  table.add("outcome", &R::outcome);
  table.add("t", if_ran(&R::t));
  table.add("reason", &R::reason);
  table.add("events", if_ran(&R::changes));
  for (const EventTypeName& type : all_event_types)
    table.add(type.name, if_ran([&type](const R& row) {
                const auto found = row.events.find(type.name);
                return found == row.events.end() ? 0L : found->second;
              }));
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    table.add(spec.responses[i], [i](const R& row) { return row.response(i); });
  for (const std::string& name : contacts)
    for (const SweepFigure& figure : sweep_figures)
      table.add(name + "." + figure.name, [name, &figure](const R& row) {
        const SweepRow::Contact* contact = contact_of(row, name);
        return contact ? std::optional(contact->*figure.value) : std::nullopt;
      });
  table.add("wall_time", if_ran(&R::wall_time));
  table.add("steps", if_ran(&R::steps));
  table.add("energy_balance", if_ran(&R::balance));
  table.add("warnings", if_ran(&R::warnings));
  return table;
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
  const CsvTable<SweepRow> table = sweep_table(spec, contact_names(rows));
  CsvBlock block;
  table.put_header(block);
  for (const auto& [index, row] : rows) table.put_row(block, row);
  return block.str();
}

std::string sweep_json(const SweepSpec& spec, const SweepRows& rows) {
  Json json = {
      {"title", spec.title},       {"scene", spec.scene},        {"units", units_json(spec.units)},
      {"settings", spec.settings}, {"share", spec.share.text()}, {"rows_in_all", points(spec.vary).size()}};
  json["vary"] = Json::array();
  for (const Vary& vary : spec.vary) {
    json["vary"].push_back({{"path", vary.path}});
    if (vary.sampled)  // the values are in the rows
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
