#include "cli/compare_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/number.hpp"
#include "cli/table.hpp"

namespace signorini::cli {

namespace {

std::string count(const std::optional<long>& value) { return value ? std::to_string(*value) : ""; }

std::string relative(const RunFigures& run, const char* name) {
  const auto found = run.audit.find(name);
  return found == run.audit.end() ? "" : fmt::format("{:.1e}", found->second);
}

std::string run_table(const ComparisonReport& report, TableStyle style = TableStyle::plain) {
  const RunFacts& facts = report.runs.front().figures.facts;
  const std::string energy = " [" + facts.units.force + " " + facts.units.length + "]";
  Table table({"run", "outcome", "events", "wall [s]", "steps", "factorisations", "friction loss" + energy,
               "balance", "|T| > T_U", "equilibrium"},
              {false, false, true, true, true, true, true, true, true, true});
  for (const ComparedRun& compared : report.runs) {
    const RunFigures& run = compared.figures;
    table.row({run.name, run.facts.outcome, std::to_string(changes_in(run.events_by_type)),
               run.wall_time ? fmt::format("{:.3f}", *run.wall_time) : "", count(run.steps),
               count(run.factorisations), run.friction ? fmt::format("{:.9g}", *run.friction) : "",
               relative(run, "energy"), relative(run, "friction"), relative(run, "equilibrium")});
  }
  for (const auto& [name, reason] : report.refused)
    table.row({name, "refused", "", "", "", "", "", "", "", ""});
  std::string text = table.str(style);
  if (style != TableStyle::plain) return text;
  for (const ComparedRun& compared : report.runs)
    if (!compared.figures.reason.empty())
      text += fmt::format("  {}: {} at t = {:.9g}: {}\n", compared.figures.name,
                          compared.figures.facts.outcome, compared.figures.t, compared.figures.reason);
  for (const auto& [name, reason] : report.refused) text += fmt::format("  {}: refused: {}\n", name, reason);
  return text;
}

/// Note if one of the two runs did not reach its end, or has a different end.
std::string up_to(const ComparisonReport& report, std::size_t i) {
  const RunFigures &a = report.runs.front().figures, &b = report.runs[i + 1].figures;
  if (a.done() && b.done() && a.t == b.t) return "";
  return fmt::format(" up to t = {:.9g}", report.comparisons[i].t_end);
}

std::string sequence(const ComparisonReport& report, std::size_t i) {
  const Alignment& alignment = report.comparisons[i].alignment;
  const std::size_t pairs = alignment.pairs.size();
  std::string text = alignment.split
                         ? fmt::format("{} alike, then they part at t = {:.9g}: {}; {} from there on",
                                       count_of(pairs, "event"), alignment.split->t,
                                       split_text(report.runs.front(), report.runs[i + 1], *alignment.split),
                                       count_of(alignment.split->unaligned, "event"))
                         : fmt::format("the same, {}", count_of(pairs, "event")) + up_to(report, i);
  if (alignment.swapped > 0)
    text += fmt::format("; {} swapped with events of other contacts closer than their uncertainties",
                        alignment.swapped);
  return text;
}

std::string place(const Greatest& greatest, std::vector<std::string>& cells) {
  cells.push_back(fmt::format("{:.3g}", greatest.value));
  cells.push_back(greatest.value == 0.0 ? "" : fmt::format("{:.9g}", greatest.t));
  return greatest.where;
}

std::string difference_table(const ComparisonReport& report, std::size_t i,
                             TableStyle style = TableStyle::plain) {
  const Comparison& c = report.comparisons[i];
  const Units& units = report.runs.front().figures.facts.units;
  const bool split = c.alignment.split.has_value();
  const std::string at = "at t [" + units.time + "]";
  std::vector<std::string> header = {"greatest difference", "unit", "value", at, "where"};
  std::vector<bool> right = {false, false, true, true, false};
  if (split) {
    header.insert(header.end(), {"before they part", at});
    right.insert(right.end(), {true, true});
  }
  if (c.common_times == 0 && c.event_time.count == 0) return "";
  Table table(std::move(header), std::move(right));
  for (const Quantity& q : quantities(c, units)) {
    if (q.deviation->count == 0) continue;
    std::string name = q.name;
    if (!name.starts_with("response:")) std::replace(name.begin(), name.end(), '_', ' ');
    if (q.name == "force_away") name = "force away from events";
    std::vector<std::string> cells = {name, q.unit};
    const std::string where = place(q.deviation->whole, cells);
    cells.push_back(q.deviation->whole.value == 0.0 ? "" : where);
    if (split) place(q.deviation->until_split, cells);
    table.row(std::move(cells));
  }
  return table.str(style);
}

}  // namespace

std::string compare_tables(const ComparisonReport& report, TableStyle style) {
  std::string text = run_table(report, style);
  for (std::size_t i = 0; i < report.comparisons.size(); ++i)
    text += "\n" + difference_table(report, i, style);
  return text;
}

std::string compare_text(const ComparisonReport& report) {
  const RunFigures& reference = report.runs.front().figures;
  std::string text = reference.facts.title.empty() ? "" : reference.facts.title + "\n\n";
  text += run_table(report);
  for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
    text += fmt::format("\n{} against {}\n", report.comparisons[i].name, reference.name);
    text += "  sequence: " + sequence(report, i) + "\n";
    if (const std::string rows = rows_compared(report.comparisons[i]); !rows.empty())
      text += "  rows compared: " + rows + "\n";
    for (const std::string& note : report.comparisons[i].notes) text += "  note: " + note + "\n";
    text += difference_table(report, i);
  }
  return text;
}

}  // namespace signorini::cli
