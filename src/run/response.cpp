#include "run/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rounding.hpp"

namespace signorini {
namespace {

constexpr double resolved = 1e-8;  // of |r|: then degree 8 is good to rounding
// Values this close are equal: the earlier one keeps its time.
constexpr double tie = rounding::of_few;

/// Chebyshev points on [-1, 1], ascending; every other one makes the coarser set.
std::array<double, 9> chebyshev() {
  std::array<double, 9> x{};
  for (std::size_t i = 0; i < 9; ++i) x[i] = -std::cos(std::numbers::pi * static_cast<double>(i) / 8.0);
  x[4] = 0.0;
  return x;
}

/// p(x) through values at every `stride`-th of the points: barycentric, weights +-1, half at the ends.
double through(const std::array<double, 9>& values, std::size_t stride, double x) {
  static const std::array<double, 9> nodes = chebyshev();
  double above = 0.0, below = 0.0, sign = 1.0;
  for (std::size_t i = 0; i < 9; i += stride, sign = -sign) {
    if (x == nodes[i]) return values[i];
    const double w = sign * (i == 0 || i == 8 ? 0.5 : 1.0) / (x - nodes[i]);
    above += w * values[i];
    below += w;
  }
  return above / below;
}

/// Values of p' at the points.
std::array<double, 9> slopes(const std::array<double, 9>& values) {
  static const std::array<double, 9> nodes = chebyshev();
  std::array<double, 9> result{};
  for (std::size_t i = 0; i < 9; ++i) {
    const double ci = i == 0 || i == 8 ? 2.0 : 1.0;
    for (std::size_t j = 0; j < 9; ++j) {
      if (i == j) continue;
      const double cj = j == 0 || j == 8 ? 2.0 : 1.0, sign = (i + j) % 2 == 0 ? 1.0 : -1.0;
      // Of differences, so that a constant has none: the diagonal is minus the sum of its row.
      result[i] += ci / cj * sign / (nodes[i] - nodes[j]) * (values[j] - values[i]);
    }
  }
  return result;
}

/// Where p' is zero between two points at which its signs differ.
double turn_between(const std::array<double, 9>& slope, double a, double b) {
  double fa = through(slope, 1, a);
  for (int i = 0; i < 60 && b - a > rounding::of_few; ++i) {
    const double middle = 0.5 * (a + b), f = through(slope, 1, middle);
    if ((f > 0.0) == (fa > 0.0)) {
      a = middle;
      fa = f;
    } else {
      b = middle;
    }
  }
  return 0.5 * (a + b);
}

}  // namespace

double value_of(const Output& output, double t, Side side, const Point& point,
                const std::vector<double>& losses) {
  if (output.loss) return *output.loss < losses.size() ? losses[*output.loss] : 0.0;
  double sum = output.constant + output.u.dot(point.u) + output.v.dot(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.dot(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += f.N * point.N(f.contact) + f.T * point.T(f.contact);
  for (const History& h : output.given)
    sum += (side == Side::after ? h.piece(t) : h.piece_before(t)).value(t);
  return sum;
}

ResponseWatch::ResponseWatch(const Model& model, double t_end, Recorder& recorder)
    : model_(model),
      recorder_(recorder),
      shortest_(model.omega_max > 0.0 ? 1.0 / model.omega_max : t_end),
      extremes_(model.outputs.size()),
      samples_(model.outputs.size()) {}

void ResponseWatch::evaluate(double t, Side side, const Point& point, const std::vector<double>& losses,
                             std::vector<double>& values) const {
  values.clear();
  for (const Output& output : model_.outputs) values.push_back(value_of(output, t, side, point, losses));
}

void ResponseWatch::see(std::size_t i, double t, double value) {
  OutputExtremes& e = extremes_[i];
  if (value > e.maximum + tie * std::abs(e.maximum)) {
    e.maximum = value;
    e.t_maximum = t;
  }
  if (value < e.minimum - tie * std::abs(e.minimum)) {
    e.minimum = value;
    e.t_minimum = t;
  }
}

void ResponseWatch::write(double t, const std::vector<double>& values) {
  if (began_ && t == last_t_ && values == last_) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!began_) extremes_[i] = {values[i], values[i], values[i], t, t};
    see(i, t, values[i]);
    extremes_[i].last = values[i];
  }
  began_ = true;
  last_t_ = t;
  last_ = values;
  recorder_.response(t, values);
}

void ResponseWatch::before(double t, const Point& point, const std::vector<double>& losses) {
  if (!any()) return;
  evaluate(t, Side::before, point, losses, before_);
  before_t_ = t;
}

void ResponseWatch::row(double t, Side side, const Point& point, const std::vector<double>& losses) {
  if (!any()) return;
  evaluate(t, side, point, losses, values_);
  if (before_t_ == t) write(t, before_);
  before_t_ = -1.0;
  write(t, values_);
  for (const Output& sum : model_.reaction_sums) {
    const double off = std::abs(value_of(sum, t, side, point, none_));
    if (off > reactions_.value) reactions_ = {off, t, -1};
  }
}

void ResponseWatch::inside(Stepper& engine, double begin, double end) {
  if (!any() || !(end > begin)) return;
  std::vector<Part> parts{{begin, end}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (!look(engine, part, begin)) continue;
    const double middle = 0.5 * (part.begin + part.end);
    parts.push_back({middle, part.end});  // the earlier half first: the first of equal extremes counts
    parts.push_back({part.begin, middle});
  }
}

bool ResponseWatch::look(Stepper& engine, const Part& part, double begin) {
  static const std::array<double, points> nodes = chebyshev();
  for (std::size_t j = 0; j < points; ++j) {
    const double t =
        j + 1 == points ? part.end : part.begin + 0.5 * (nodes[j] + 1.0) * (part.end - part.begin);
    engine.interpolate(t, point_);
    evaluate(t, t == begin ? Side::after : Side::before, point_, none_, values_);
    for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i][j] = values_[i];
  }
  bool halve = false;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (!model_.outputs[i].loss) halve = look_at(i, engine, part, samples_[i]) || halve;
  return halve;
}

bool ResponseWatch::look_at(std::size_t i, Stepper& engine, const Part& part, const Values& values) {
  static const std::array<double, points> nodes = chebyshev();
  double error = 0.0;
  for (std::size_t j = 1; j < points; j += 2)
    error = std::max(error, std::abs(through(values, 2, nodes[j]) - values[j]));
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const OutputExtremes& known = extremes_[i];
  const double rest = 2.0 * error;
  if (*greatest + rest <= known.maximum && *least - rest >= known.minimum) return false;
  const double size = std::max({std::abs(known.maximum), std::abs(known.minimum), *greatest, -*least});
  if (error > resolved * size && part.end - part.begin > shortest_) return true;
  sharpen(i, engine, part, values);
  return false;
}

void ResponseWatch::sharpen(std::size_t i, Stepper& engine, const Part& part, const Values& values) {
  static const std::array<double, points> nodes = chebyshev();
  const Values slope = slopes(values);
  const double half = 0.5 * (part.end - part.begin);
  for (std::size_t j = 0; j < points; ++j) {
    const double t = j + 1 == points ? part.end : part.begin + half * (nodes[j] + 1.0);
    see(i, t, values[j]);
    if (j + 1 == points || (slope[j] > 0.0) == (slope[j + 1] > 0.0)) continue;
    const double x = turn_between(slope, nodes[j], nodes[j + 1]);
    const double p = through(values, 1, x);
    if (p <= extremes_[i].maximum && p >= extremes_[i].minimum) continue;
    const double at = part.begin + half * (x + 1.0);
    engine.interpolate(at, point_);
    see(i, at, value_of(model_.outputs[i], at, Side::before, point_, none_));
  }
}

}  // namespace signorini
