#include "study/frontier.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini {

namespace {

/// A gain in time by less than a tenth is the machine's.
constexpr double noise = 0.9;

}  // namespace

std::vector<std::size_t> frontier(const std::vector<WorkRow>& rows, const std::string& quantity) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WorkError* error = rows[i].error(quantity);
    if (rows[i].complete() && rows[i].wall_time() && error && std::isfinite(error->value)) list.push_back(i);
  }
  const auto value = [&](std::size_t i) { return rows[i].error(quantity)->value; };
  const auto time = [&](std::size_t i) { return *rows[i].wall_time(); };
  std::sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) {
    return value(a) != value(b) ? value(a) < value(b) : time(a) < time(b);
  });
  std::vector<std::size_t> best;
  for (const std::size_t i : list)
    if (best.empty() || time(i) < noise * time(best.back())) best.push_back(i);
  std::reverse(best.begin(), best.end());
  return best;
}

std::string frontier_sentence(const std::vector<WorkRow>& rows, const std::string& quantity) {
  std::string what = quantity;
  std::replace(what.begin(), what.end(), '_', ' ');
  const std::vector<std::size_t> best = frontier(rows, quantity);
  if (best.empty())
    return "No run reached the end with the reference's events, so none can be named cheapest.";
  // The last of neighbours on one line stands for them: it is the most accurate.
  std::vector<std::size_t> last;
  for (const std::size_t i : best) {
    if (!last.empty() && rows[last.back()].point.line() == rows[i].point.line()) last.pop_back();
    last.push_back(i);
  }
  std::string sentence;
  for (const std::size_t i : last) {
    const WorkRow& row = rows[i];
    const WorkError& error = *row.error(quantity);
    sentence += sentence.empty() ? fmt::format("For errors of {} ", what) : ", below that ";
    sentence += fmt::format("down to {:.1e} {} {} is cheapest (", error.value, error.unit, row.point.line());
    if (row.point.accuracy) sentence += row.point.setting() + ": ";
    sentence += fmt::format("{:.2g} s)", *row.wall_time());
  }
  return sentence + ".";
}

}  // namespace signorini
