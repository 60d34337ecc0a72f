#include "result/plot_parts.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "result/run_tables.hpp"

namespace signorini::result {
namespace {

constexpr std::size_t most_points = 20000;  // limit per curve, because more points make an SVG slow

/// gnuplot option " every ..." for the row `index` of each time, in a table with `group` rows per time.
std::string every(std::size_t times, std::size_t group, std::size_t index) {
  const std::size_t stride = (times + most_points - 1) / most_points;
  // Ends at the last complete time; in a killed run the row after it may be incomplete.
  return fmt::format(" every {}::{}::{}", std::max<std::size_t>(stride, 1) * group, index, times * group - 1);
}

/// Rows of a state in the table of bands of contact k, which is sorted by state.
PlottedRun::Rows bands_in(const PlottedRun& run, std::size_t k, const std::string& state) {
  PlottedRun::Rows rows;
  for (const PlottedRun::Band& band : run.bands[k]) {
    rows.first += band.state < state ? 1 : 0;
    rows.count += band.state == state ? 1 : 0;
  }
  return rows;
}

}  // namespace

std::string table_rows(const std::string& table, const PlottedRun::Rows& rows) {
  return fmt::format("{} skip 1 every ::{}::{}", table, rows.first, rows.first + rows.count - 1);
}

std::string rows_over_time(const std::string& table, std::size_t times) {
  return quoted(table) + " skip 1" + every(times, 1, 0);
}

std::string contact_rows(const PlottedRun& run, std::size_t k, const std::string& run_directory) {
  if (k < run.motion.size() && run.motion[k].count > 1)
    return table_rows(quoted(run_directory + "/motion.csv"), run.motion[k]);
  return quoted(run_directory + "/contacts.csv") + " skip 1" + every(run.times, run.facts.contacts.size(), k);
}

TableColumn curve_of(const PlottedRun& run, const std::string& name, const TableColumn& otherwise) {
  const auto found = run.curves.find(name);
  if (found == run.curves.end() || found->second.count < 2) return otherwise;
  return {table_rows("'../curves.csv'", found->second), curve_table().number("t"),
          curve_table().number("value")};
}

double row_height(double usual, std::size_t count, const PictureStyle& look) {
  const double around = margin_above + margin_below + 24.0;
  return std::min(usual, (max_canvas_height(look) - around) / static_cast<double>(count));
}

std::string row_tics(const std::vector<RunFacts::Contact>& contacts, double height) {
  constexpr double line = 14.0;  // pixels per label
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(line / height)));
  std::vector<std::pair<std::string, std::size_t>> names;
  for (std::size_t k = 0; k < contacts.size(); k += stride) names.emplace_back(contacts[k].name, k);
  return named_tics('y', names) + " scale 0\n";
}

std::string state_colour(const std::string& state) {
  if (state == "open") return "#bcd3e6";
  if (state == "stick") return "#5aae61";
  if (state == "closed") return "#35978f";
  if (state == "slip+") return "#f1a340";
  if (state == "slip-") return "#8e6bbf";
  return "#999999";
}

const std::vector<std::string>& state_names() {
  static const std::vector<std::string> names = {"stick", "slip+", "slip-", "closed", "open"};
  return names;
}

namespace {

const CsvTable<PlottedRun::Band>& band_columns() {
  using Band = PlottedRun::Band;
  static const CsvTable<Band> table = {{"from", &Band::from}, {"to", &Band::to}, {"state", &Band::state}};
  return table;
}

}  // namespace

std::string band_table(std::vector<PlottedRun::Band> bands) {
  std::stable_sort(bands.begin(), bands.end(),
                   [](const auto& a, const auto& b) { return a.state < b.state; });
  return band_columns().text(bands);
}

std::optional<Curve> band_curve(const PlottedRun& run, std::size_t k, const std::string& state, double low,
                                double high, double opacity) {
  const PlottedRun::Rows rows = bands_in(run, k, state);
  if (rows.count == 0) return std::nullopt;
  const std::size_t from = band_columns().number("from");
  return Curve{
      table_rows("'states-" + run.slugs[k] + ".csv'", rows),
      fmt::format("{0}:({1}):{0}:{2}:({3}):({4})", from, base::format_number(0.5 * (low + high)),
                  band_columns().number("to"), base::format_number(low), base::format_number(high)),
      fmt::format("with boxxy fillstyle solid {} noborder linecolor '{}'", opacity, state_colour(state))};
}

std::vector<Curve> bands_of(const PlottedRun& run, std::size_t k, double opacity) {
  std::vector<Curve> curves;
  for (const std::string& state : state_names())
    if (std::optional<Curve> curve = band_curve(run, k, state, 0.0, 1.0, opacity)) {
      curve->look = "axes x1y2 " + curve->look;
      curves.push_back(*curve);
    }
  return curves;
}

std::vector<Curve> band_legend(const PlottedRun& run, std::size_t k) {
  std::vector<Curve> curves;
  for (const std::string& state : state_names())
    if (bands_in(run, k, state).count > 0)
      curves.push_back(
          {"keyentry", "",
           fmt::format("with boxes fillstyle solid 1.0 noborder linecolor '{}'", state_colour(state)),
           translate(run, state)});
  return curves;
}

namespace {

constexpr double least_range = 2e-4, around_middle = 0.01, around_zero = 1e-3;

}  // namespace

ContactScales scales_of(const std::vector<ContactRanges>& ranges) {
  ContactScales scales;
  for (const ContactRanges& r : ranges) {
    scales.length = std::max({scales.length, r.gap.size(), r.ut.size(), r.slip.size()});
    scales.force = std::max({scales.force, r.N.size(), r.T.size()});
  }
  return scales;
}

bool is_rounding(const Range& range, double scale) { return range.size() <= rounding::elimination * scale; }

std::string constant_axis(const Range& range, double scale) {
  if (range.empty()) return "";
  const auto axis = [](double middle, double half) {
    return fmt::format("set yrange [{:.8g}:{:.8g}]\n", middle - half, middle + half);
  };
  if (is_rounding(range, scale)) return scale > 0.0 ? axis(0.0, around_zero * scale) : "";
  const double middle = 0.5 * (range.least + range.greatest);
  if (range.greatest - range.least >= least_range * std::abs(middle)) return "";
  return axis(middle, around_middle * std::abs(middle));
}

}  // namespace signorini::result
