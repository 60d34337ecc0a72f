#include "result/plot_ranges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "result/csv_read.hpp"
#include "result/plot_parts.hpp"
#include "result/plot_rows.hpp"
#include "scene/components.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr double least_range = 2e-4, around_middle = 0.01, around_zero = 1e-3;

bool is_table(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

void read_contacts(const fs::path& directory, PlottedRun& run) {
  run.ranges.assign(run.facts.contacts.size(), {});
  if (run.ranges.empty()) return;
  const ContactNumbers numbers = contact_numbers(run.facts);
  const bool record = is_table(directory / "motion.csv");
  const fs::path file = directory / (record ? "motion.csv" : "contacts.csv");
  CsvReader reader(file);
  const std::size_t name = reader.column("contact"), gap = reader.column("gap"), ut = reader.column("ut"),
                    slip = reader.column("slip"), n = reader.column("N"), t = reader.column("T");
  while (reader.next()) {
    if (const double at = reader.t(); at < run.from || at > run.to) continue;
    ContactRanges& ranges = run.ranges[number_of(numbers, reader.cell(name), file)];
    if (!reader.cell(gap).empty()) ranges.gap.take(reader.number(gap));
    ranges.ut.take(reader.number(ut));
    ranges.slip.take(reader.number(slip));
    ranges.N.take(reader.number(n));
    ranges.T.take(reader.number(t));
  }
}

void read_displacements(const fs::path& file, PlottedRun& run) {
  CsvReader reader(file);
  std::vector<std::pair<std::size_t, Range*>> columns;
  for (std::size_t i = 1; i < reader.header().size(); ++i)
    if (is_displacement(reader.header()[i])) columns.emplace_back(i, &run.moves[reader.header()[i]]);
  while (reader.next()) {
    if (const double at = reader.t(); at < run.from || at > run.to) continue;
    for (const auto& [i, range] : columns) range->take(reader.number(i));
  }
}

void read_moves(const fs::path& file, PlottedRun& run) {
  CsvReader reader(file);
  const std::size_t name = reader.column("curve"), t = reader.column("t"), value = reader.column("value");
  while (reader.next()) {
    if (!is_displacement(reader.cell(name))) continue;
    if (const double at = reader.number(t); at < run.from || at > run.to) continue;
    run.moves[reader.cell(name)].take(reader.number(value));
  }
}

}  // namespace

void Range::take(double value) {
  if (!std::isfinite(value)) return;
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void Range::take(const Range& other) {
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
}

double Range::size() const { return empty() ? 0.0 : std::max(std::abs(least), std::abs(greatest)); }

ContactScales scales_of(const std::vector<ContactRanges>& ranges) {
  ContactScales scales;
  for (const ContactRanges& r : ranges) {
    scales.length = std::max({scales.length, r.gap.size(), r.ut.size(), r.slip.size()});
    scales.force = std::max({scales.force, r.N.size(), r.T.size()});
  }
  return scales;
}

bool is_rounding(const Range& range, double scale) {
  return range.size() <= rounding::of_elimination * scale;
}

std::string steady(const Range& range, double scale) {
  if (range.empty()) return "";
  const auto axis = [](double middle, double half) {
    return fmt::format("set yrange [{:.8g}:{:.8g}]\n", middle - half, middle + half);
  };
  if (is_rounding(range, scale)) return scale > 0.0 ? axis(0.0, around_zero * scale) : "";
  const double middle = 0.5 * (range.least + range.greatest);
  if (range.greatest - range.least >= least_range * std::abs(middle)) return "";
  return axis(middle, around_middle * std::abs(middle));
}

void read_ranges(const fs::path& directory, PlottedRun& run) {
  read_contacts(directory, run);
  run.moves.clear();
  // What is drawn of displacements stands in curves.csv, where there is such a table.
  if (is_table(directory / "curves.csv"))
    read_moves(directory / "curves.csv", run);
  else
    read_displacements(directory / "history.csv", run);
}

}  // namespace signorini
