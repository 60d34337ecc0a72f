#include "study/speed/work_row.hpp"

#include <algorithm>

namespace signorini {

const WorkError* WorkRow::error(const std::string& quantity) const {
  const auto found =
      std::find_if(errors.begin(), errors.end(), [&](const WorkError& e) { return e.quantity == quantity; });
  return found == errors.end() ? nullptr : &*found;
}

std::optional<double> WorkRow::wall_time() const {
  if (wall_times.empty()) return std::nullopt;
  return *std::min_element(wall_times.begin(), wall_times.end());
}

void take_comparison(WorkRow& row, const ComparedRun& reference, const ComparedRun& run,
                     const Comparison& comparison) {
  const auto& split = comparison.alignment.split;
  row.alike = comparison.alignment.pairs.size();
  row.split = split ? split_text(reference, run, *split) : "";
  row.t_split = split ? std::optional(split->t) : std::nullopt;
  row.errors.clear();
  for (const Quantity& quantity : quantities(comparison, reference.figures.facts.units)) {
    const Deviation& deviation = *quantity.deviation;
    const bool times = quantity.name == "event_time";  // aligned events are before the split
    const bool part = split && !times;
    if ((part ? deviation.count_until_split : deviation.count) == 0) continue;
    if (part && comparison.alignment.pairs.empty()) continue;  // before the first event: insignificant
    const Greatest& greatest = part ? deviation.until_split : deviation.whole;
    row.errors.push_back(
        {quantity.name, quantity.unit, greatest.value, greatest.t, greatest.where, deviation.whole.value});
  }
}

}  // namespace signorini
