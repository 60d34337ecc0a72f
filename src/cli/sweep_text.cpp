#include "cli/sweep_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "cli/table.hpp"

namespace signorini::cli {

namespace {

constexpr std::size_t most_contacts = 3, most_rows = 60, first_rows = 40, last_rows = 10;

std::vector<std::string> cells_of(const SweepRow& row, const std::vector<std::string>& contacts) {
  std::vector<std::string> cells = row.values;
  cells.push_back(row.outcome);
  cells.push_back(row.ran() ? std::to_string(row.changes()) : "");
  for (std::size_t k = 0; k < std::min(contacts.size(), most_contacts); ++k) {
    const SweepRow::Contact* contact = contact_of(row, contacts[k]);
    for (const double SweepRow::Contact::*figure :
         {&SweepRow::Contact::tangential, &SweepRow::Contact::normal, &SweepRow::Contact::friction})
      cells.push_back(contact ? number(contact->*figure) : "");
  }
  return cells;
}

}  // namespace

std::string sweep_text(const SweepSpec& spec, const SweepRows& rows) {
  const std::vector<std::string> contacts = contact_names(rows);
  std::vector<std::string> header;
  for (const Vary& vary : spec.vary) header.push_back(vary.path);
  header.insert(header.end(), {"outcome", "events"});
  const std::string length = " [" + spec.units.length + "]";
  for (std::size_t k = 0; k < std::min(contacts.size(), most_contacts); ++k) {
    header.push_back(contacts[k] + ": peak along t" + length);
    header.push_back("along n" + length);
    header.push_back("friction loss [" + spec.units.force + " " + spec.units.length + "]");
  }
  std::vector<bool> right(header.size(), true);
  right[spec.vary.size()] = false;
  Table table(std::move(header), std::move(right));
  std::size_t i = 0;
  for (const auto& [index, row] : rows) {
    const bool shown = rows.size() <= most_rows || i < first_rows || i + last_rows >= rows.size();
    if (shown) table.row(cells_of(row, contacts));
    if (!shown && i == first_rows)
      table.line(fmt::format("... {} more; all are in sweep.csv", rows.size() - first_rows - last_rows));
    ++i;
  }
  std::string text = table.str();
  if (contacts.size() > most_contacts)
    text += fmt::format("  ... {} more contacts; all are in sweep.csv\n", contacts.size() - most_contacts);
  constexpr std::size_t most_reasons = 10;
  std::size_t reasons = 0;
  for (const auto& [index, row] : rows) {
    if (row.reason.empty()) continue;
    if (++reasons > most_reasons) continue;
    const std::string when = row.ran() ? fmt::format(" at t = {:.9g}", row.t) : "";
    text += fmt::format("  row {}: {}{}: {}\n", index + 1, row.outcome, when, row.reason);
  }
  if (reasons > most_reasons)
    text += fmt::format("  ... {} more reasons; all are in sweep.csv\n", reasons - most_reasons);
  return text;
}

}  // namespace signorini::cli
