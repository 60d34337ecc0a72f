// drawn.hpp: how far a line through the rows of a picture is off the motion.
//
//   off(line, motion) = max over times t of the motion of how far y(t) is outside of what the line reaches in
//                       [t - pixel, t + pixel],  beside the motion's range;     pixel: 1/1250 of the run, as docs/output.md says
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace signorini::tests::drawn {

struct Line {
  std::vector<double> t, y;
  void add(double time, double value) {
    t.push_back(time);
    y.push_back(value);
  }
};

/// On straight lines between the rows, after a jump at t.
inline double at(const Line& line, double t) {
  const auto next = std::upper_bound(line.t.begin(), line.t.end(), t);
  const auto i = static_cast<std::size_t>(next - line.t.begin());
  if (i == 0) return line.y.front();
  if (i == line.t.size()) return line.y.back();
  return line.y[i - 1] + (line.y[i] - line.y[i - 1]) * (t - line.t[i - 1]) / (line.t[i] - line.t[i - 1]);
}

struct Span {
  double least, greatest;
};

/// What a line reaches from a to b.
inline Span span(const Line& line, double a, double b) {
  Span s{at(line, a), at(line, a)};
  const auto see = [&](double y) { s = {std::min(s.least, y), std::max(s.greatest, y)}; };
  see(at(line, b));
  const auto first = std::lower_bound(line.t.begin(), line.t.end(), a);
  for (auto i = static_cast<std::size_t>(first - line.t.begin()); i < line.t.size() && line.t[i] <= b; ++i)
    see(line.y[i]);
  return s;
}

/// At worst, of the motion's range; 0 where that is rounding beside `size`, the greatest of its kind.
inline double off(const Line& line, const Line& motion, double size = 0.0) {
  const double pixel = motion.t.back() / 1250.0;
  const auto [low, high] = std::minmax_element(motion.y.begin(), motion.y.end());
  const double range = *high - *low;
  if (range <= 1e-9 * std::max({std::abs(*low), std::abs(*high), size})) return 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < motion.t.size(); ++i) {
    if (std::abs(at(line, motion.t[i]) - motion.y[i]) <= 0.005 * range) continue;
    const Span s = span(line, motion.t[i] - pixel, motion.t[i] + pixel);
    worst = std::max({worst, s.least - motion.y[i], motion.y[i] - s.greatest});
  }
  return worst / range;
}

}  // namespace signorini::tests::drawn
