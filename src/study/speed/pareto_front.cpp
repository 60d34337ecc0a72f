#include "study/speed/pareto_front.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

namespace signorini::speed {
namespace {

/// Two times or errors with a ratio above this value are regarded as equal: times vary by up to a tenth from
/// run to run.
constexpr double noise = 0.9;

double ranked(const WorkRow& row, const std::string& quantity, const ErrorRange& range) {
  return std::max(row.error(quantity)->value, range.floor);
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<WorkRow>& rows, const std::string& quantity,
                                      const ErrorRange& range) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WorkError* error = rows[i].error(quantity);
    if (rows[i].complete() && rows[i].wall_time() && error && error->value <= range.most) list.push_back(i);
  }
  const auto value = [&](std::size_t i) { return ranked(rows[i], quantity, range); };
  const auto time = [&](std::size_t i) { return *rows[i].wall_time(); };
  std::stable_sort(list.begin(), list.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
  std::vector<std::size_t> best;
  for (const std::size_t i : list) {
    if (!best.empty() && time(i) >= noise * time(best.back())) continue;
    if (!best.empty() && value(best.back()) >= noise * value(i)) best.pop_back();
    best.push_back(i);
  }
  std::reverse(best.begin(), best.end());
  return best;
}

std::string pareto_sentence(const std::vector<WorkRow>& rows, const std::string& quantity,
                            const ErrorRange& range) {
  std::string what = quantity;
  std::replace(what.begin(), what.end(), '_', ' ');
  const std::vector<std::size_t> best = pareto_front(rows, quantity, range);
  if (best.empty()) {
    const bool complete =
        std::any_of(rows.begin(), rows.end(), [](const WorkRow& r) { return r.complete(); });
    const bool timed =
        std::any_of(rows.begin(), rows.end(), [](const WorkRow& r) { return r.complete() && r.wall_time(); });
    const char* why = !complete ? "no run reached the end with the reference's events"
                      : !timed  ? "no run was timed"
                                : "no complete run has a meaningful error";
    return fmt::format("For errors of {}, no cheapest run can be named: {}.", what, why);
  }
  // If successive runs of the front belong to one line, only the last of these runs, the most accurate, is named.
  std::vector<std::size_t> last;
  for (const std::size_t i : best) {
    if (!last.empty() && rows[last.back()].point.line() == rows[i].point.line()) last.pop_back();
    last.push_back(i);
  }
  std::string sentence;
  for (const std::size_t i : last) {
    const WorkRow& row = rows[i];
    sentence += sentence.empty() ? fmt::format("For errors of {} ", what) : ", below that error, ";
    sentence += fmt::format("down to {:.1e} {}, {} is cheapest (", ranked(row, quantity, range),
                            row.error(quantity)->unit, row.point.line());
    if (row.point.accuracy) sentence += row.point.setting() + ": ";
    sentence += fmt::format("{:.2g} s)", *row.wall_time());
  }
  return sentence + ".";
}

}  // namespace signorini::speed
