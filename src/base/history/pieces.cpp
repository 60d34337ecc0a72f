#include "base/history/pieces.hpp"

#include "base/rounding.hpp"

namespace signorini::history {

std::size_t end_of_instant(const History& f, std::size_t from, double t_end) {
  const std::vector<double>& starts = f.starts();
  // Starts before the beginning of the run are not merged.
  if (starts[from] < 0.0) return from + 1;
  const double first = starts[from] <= rounding::time_resolution * t_end ? 0.0 : starts[from];
  std::size_t to = from + 1;
  while (to < starts.size() && starts[to] - first <= rounding::time_resolution * (first + t_end)) ++to;
  return to;
}

History resolved(const History& f, double t_end) {
  std::vector<double> starts;
  std::vector<Piece> pieces{f.pieces().front()};
  for (std::size_t from = 0, to = 0; from < f.starts().size(); from = to) {
    to = end_of_instant(f, from, t_end);
    const double last = f.starts()[to - 1];
    starts.push_back(last > 0.0 && last <= rounding::time_resolution * t_end ? 0.0 : last);
    pieces.push_back(f.pieces()[to]);
  }
  return {std::move(starts), std::move(pieces)};
}

}  // namespace signorini::history
