#include "cli/sweep_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cli/terminal.hpp"

namespace signorini::cli {

namespace {

constexpr std::size_t max_contacts = 3, max_responses = 6, max_answers = 12, max_rows = 60, first_rows = 40,
                      last_rows = 10;

std::vector<std::string> cells_of(const sweep::SweepRow& row, std::size_t responses,
                                  const std::vector<std::string>& contacts) {
  std::vector<std::string> cells = row.values;
  cells.push_back(row.outcome);
  cells.push_back(row.ran() ? std::to_string(row.changes()) : "");
  for (std::size_t i = 0; i < std::min(responses, max_responses); ++i)
    cells.push_back(i < row.responses.size() && std::isfinite(row.responses[i]) ? number(row.responses[i])
                                                                                : "");
  if (responses > 0) return cells;
  for (const std::string& name : contacts) {
    const sweep::SweepRow::Contact* contact = sweep::contact_of(row, name);
    for (const double sweep::SweepRow::Contact::*figure :
         {&sweep::SweepRow::Contact::tangential, &sweep::SweepRow::Contact::N,
          &sweep::SweepRow::Contact::friction})
      cells.push_back(contact ? number(contact->*figure) : "");
  }
  return cells;
}

}  // namespace

namespace {

/// The contacts with the largest |N| in any run, in the order of the model.
std::vector<std::string> shown_contacts(const std::vector<std::string>& contacts,
                                        const sweep::SweepRows& rows) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    double greatest = 0.0;
    for (const auto& [index, row] : rows)
      if (const sweep::SweepRow::Contact* contact = sweep::contact_of(row, contacts[k]))
        greatest = std::max(greatest, contact->N);
    order.emplace_back(-greatest, k);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), max_contacts));
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<std::string> shown;
  for (const auto& [force, k] : order) shown.push_back(contacts[k]);
  return shown;
}

}  // namespace

std::string sweep_text(const sweep::SweepSpec& spec, const sweep::SweepRows& rows, TableStyle style) {
  const std::vector<std::string> all = sweep::contact_names(rows), contacts = shown_contacts(all, rows);
  std::vector<std::string> header;
  for (const sweep::ParameterRange& vary : spec.vary) header.push_back(vary.path);
  header.insert(header.end(), {"outcome", "events"});
  for (std::size_t i = 0; i < std::min(spec.responses.size(), max_responses); ++i)
    header.push_back(spec.responses[i] +
                     (spec.response_units[i].empty() ? "" : " [" + spec.response_units[i] + "]"));
  const std::string length = " [" + spec.units.length + "]";
  const bool figures = spec.responses.empty();
  for (std::size_t k = 0; figures && k < contacts.size(); ++k) {
    header.push_back(contacts[k] + ": peak along t" + length);
    header.push_back("|N| [" + spec.units.force + "]");
    header.push_back("friction loss [" + spec.units.force + " " + spec.units.length + "]");
  }
  std::vector<bool> right(header.size(), true);
  right[spec.vary.size()] = false;
  Table table(std::move(header), std::move(right));
  std::size_t i = 0;
  for (const auto& [index, row] : rows) {
    const bool shown = style != TableStyle::plain || rows.size() <= max_rows || i < first_rows ||
                       i + last_rows >= rows.size();
    if (shown) table.row(cells_of(row, spec.responses.size(), contacts));
    if (!shown && i == first_rows)
      table.line(fmt::format("... {} more; all are in sweep.csv", rows.size() - first_rows - last_rows));
    ++i;
  }
  std::string text = table.str(style);
  if (style != TableStyle::plain) return text;
  if (spec.responses.size() > max_responses)
    text +=
        fmt::format("  ... {} more responses; all are in sweep.csv\n", spec.responses.size() - max_responses);
  if (figures && all.size() > contacts.size())
    text += fmt::format("  ... {} more contacts, with smaller forces; all are in sweep.csv\n",
                        all.size() - contacts.size());
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

std::string quantile_text(const sweep::SweepSpec& spec, const std::vector<sweep::SampledResults>& answers,
                          TableStyle style) {
  constexpr double shown[] = {0.05, 0.5, 0.95, 0.99};
  std::vector<std::string> header{fmt::format("quantiles of {}", spec.sampling)};
  for (const sweep::ParameterRange& vary : spec.vary)
    if (!vary.sampled) header.push_back(vary.path);
  header.emplace_back("n");
  for (const double p : shown) header.push_back(fmt::format("{:g} %", 100.0 * p));
  std::vector<bool> right(header.size(), true);
  right[0] = false;
  Table table(std::move(header), std::move(right));
  for (std::size_t i = 0; i < answers.size() && i < max_answers; ++i) {
    const sweep::SampledResults& s = answers[i];
    if (s.sorted.empty()) continue;
    const std::string& unit = spec.response_units[s.query];
    std::vector<std::string> cells{spec.responses[s.query] + (unit.empty() ? "" : " [" + unit + "]")};
    cells.insert(cells.end(), s.values.begin(), s.values.end());
    cells.push_back(std::to_string(s.sorted.size()));
    for (const double p : shown) {
      const sweep::Quantile q = sweep::quantile(s.sorted, p, sweep::independent(spec));
      const auto end = [](const std::optional<double>& x) { return x ? number(*x) : std::string("?"); };
      cells.push_back(number(q.value) +
                      (sweep::independent(spec) ? " (" + end(q.low) + " to " + end(q.high) + ")" : ""));
    }
    table.row(std::move(cells));
  }
  std::string text = table.str(style);
  if (style != TableStyle::plain) return text;
  if (answers.size() > max_answers)
    text += fmt::format("  ... {} more; all are in quantiles.csv\n", answers.size() - max_answers);
  if (sweep::independent(spec))
    text += "  in brackets: 95 % confidence interval, valid for any distribution\n";
  return text;
}

}  // namespace signorini::cli
