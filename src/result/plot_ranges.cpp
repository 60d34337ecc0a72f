#include "result/plot_ranges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini {

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

}  // namespace signorini
