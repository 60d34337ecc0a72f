#include "run/summed_curves.hpp"

#include <algorithm>
#include <array>

#include "base/thinned.hpp"

namespace signorini {
namespace {

/// Where one line changes: by `jump` at once, and its slope by `bend`.
struct Bend {
  double t = 0.0, jump = 0.0, bend = 0.0;
};

void add_turns(const std::vector<CurvePoint>& line, std::vector<Bend>& turns) {
  double slope = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool ends = i + 1 == line.size();
    const double h = ends ? 0.0 : line[i + 1].t - line[i].t,
                 rise = ends ? 0.0 : line[i + 1].value - line[i].value;
    const double next = h > 0.0 ? rise / h : 0.0;
    turns.push_back({line[i].t, ends || h > 0.0 ? 0.0 : rise, next - slope});
    slope = next;
  }
}

std::vector<CurvePoint> sum_of(const std::vector<const std::vector<CurvePoint>*>& lines) {
  std::vector<Bend> turns;
  double value = 0.0, slope = 0.0;
  for (const std::vector<CurvePoint>* line : lines) {
    if (line->empty()) continue;
    value += line->front().value;
    add_turns(*line, turns);
  }
  std::stable_sort(turns.begin(), turns.end(), [](const Bend& a, const Bend& b) { return a.t < b.t; });
  std::vector<CurvePoint> sum;
  double t = turns.empty() ? 0.0 : turns.front().t;
  for (auto first = turns.cbegin(); first != turns.cend();) {
    value += slope * (first->t - t);
    t = first->t;
    sum.push_back({t, value});
    double jump = 0.0;
    for (; first != turns.cend() && first->t == t; ++first) {
      jump += first->jump;
      slope += first->bend;
    }
    if (jump != 0.0) sum.push_back({t, value += jump});
  }
  return sum;
}

struct ValueOfSum {
  std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
};

}  // namespace

std::vector<CurvePoint> summed(const std::vector<const std::vector<CurvePoint>*>& lines, std::size_t most) {
  const std::vector<CurvePoint> sum = sum_of(lines);
  if (sum.empty()) return sum;
  Thinned<CurvePoint, 1, ValueOfSum> rows(sum.back().t, {.most = most});
  for (const CurvePoint& point : sum) rows.add(point);
  rows.close({0.0});
  return rows.take();
}

}  // namespace signorini
