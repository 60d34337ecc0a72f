#include "run/foot_releases.hpp"

#include <algorithm>

#include "base/rounding.hpp"
#include "motion/point.hpp"

namespace signorini::run {
namespace {

constexpr int parts_of_step = 16;

/// First zero of a condition after `last` that is negative at t and has the value `before` at `last`. If `before` is zero up to
/// rounding, the interval is halved toward `last` until a positive value is found; if there is none, the zero is `last`.
template <class Value>
double release_time(double last, double before, double t, const Value& value) {
  double low = last, high = t;
  while (!(before > 0.0)) {
    const double middle = 0.5 * (last + high);
    if (!(last < middle && middle < high)) return last;
    before = value(middle);
    (before > 0.0 ? low : high) = middle;
  }
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
    (value(middle) > 0.0 ? low : high) = middle;
  return high;
}

}  // namespace

void FootReleases::shorten(engine::Step& step, engine::DenseOutput& motion, const motion::Point& like) const {
  if (conditions_.empty()) return;
  motion::Point point = like;
  const auto value = [&](const Release& release) { return release.weights.dot(point.forces); };
  std::vector<double> before;
  motion.evaluate(step.begin, point);
  for (const Release& release : conditions_) before.push_back(value(release));
  std::vector<std::size_t> negative;
  double last = step.begin, t = step.begin;
  for (int i = 1; i <= parts_of_step && negative.empty(); ++i) {
    last = t;
    t = i == parts_of_step ? step.end : step.begin + (step.end - step.begin) * i / parts_of_step;
    motion.evaluate(t, point);
    for (std::size_t j = 0; j < conditions_.size(); ++j) {
      const double now = value(conditions_[j]);
      const double size = conditions_[j].weights.cwiseAbs().dot(point.forces.cwiseAbs());
      if (now < -rounding::elimination * size)
        negative.push_back(j);
      else
        before[j] = now;
    }
  }
  if (negative.empty()) return;
  std::vector<double> times;
  for (const std::size_t j : negative)
    times.push_back(release_time(last, before[j], t, [&](double at) {
      motion.evaluate(at, point);
      return value(conditions_[j]);
    }));
  step.kind = engine::Step::Kind::event;
  step.end = *std::min_element(times.begin(), times.end());
  step.engine_states.reset();
  step.triggered.clear();
  const double same = motion::resolution_at(step.end, step.end - step.begin);
  for (std::size_t i = 0; i < negative.size(); ++i)
    if (times[i] <= step.end + same) step.triggered.push_back(conditions_[negative[i]].guard);
}

}  // namespace signorini::run
