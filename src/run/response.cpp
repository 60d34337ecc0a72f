#include "run/response.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini {
namespace {

// Values this close are equal: the earlier one keeps its time.
constexpr double tie = rounding::of_few;
// Of |r|: how far off p may be where its turning points are taken. A time that is off by d there costs r d^2.
constexpr double located = 1e-12;
// Radians of the fastest motion in a part: five points see where it swings at all. Chosen; what is narrower
// than a fifth of that and nowhere else in the part would be missed.
constexpr double longest = 32.0;

/// What e, of half the degree, may be for that: errors of degree n go with the power n + 1 of the part.
double resolved(std::size_t stride) {
  static const double of[] = {std::pow(located, 9.0 / 17.0), std::pow(located, 5.0 / 9.0),
                              std::pow(located, 3.0 / 5.0)};
  return stride == 1 ? of[0] : stride == 2 ? of[1] : of[2];
}

struct Bounds {
  double least = 0.0, greatest = 0.0;
};

Bounds at_points(const Chebyshev::Values& values, std::size_t stride) {
  Bounds b{values[0], values[0]};
  for (std::size_t j = stride; j < Chebyshev::count; j += stride) {
    b.least = std::min(b.least, values[j]);
    b.greatest = std::max(b.greatest, values[j]);
  }
  return b;
}

/// With what lies between the points: where p rises from one and falls to the next, it stays below both tangents.
Bounds between_points(const Chebyshev::Values& values, std::size_t stride) {
  const Chebyshev::Values& x = Chebyshev::nodes();
  const Chebyshev::Values slope = Chebyshev::slopes(values, stride);
  Bounds b = at_points(values, stride);
  for (std::size_t j = 0; j + stride < Chebyshev::count; j += stride) {
    const double sa = slope[j], sb = slope[j + stride], width = x[j + stride] - x[j];
    if ((sa > 0.0) == (sb > 0.0)) continue;
    const double to = (values[j + stride] - values[j] - sb * width) / (sa - sb);
    const double peak = values[j] + sa * std::clamp(to, 0.0, width);
    b.least = std::min(b.least, peak);
    b.greatest = std::max(b.greatest, peak);
  }
  return b;
}

/// Sum of the magnitudes of its terms: what rounding is relative to.
double magnitude_of(const Output& output, double t, Side side, const Point& point) {
  double sum = std::abs(output.constant) + output.u.magnitude(point.u) + output.v.magnitude(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.magnitude(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += std::abs(f.N * point.N(f.contact)) + std::abs(f.T * point.T(f.contact));
  for (const Output::Given& g : output.given)
    sum += std::abs((side == Side::after ? g.history.piece(t) : g.history.piece_before(t)).value(t));
  return sum;
}

/// Of displacements and velocities alone.
bool is_of_motion(const Output& output) { return output.a.terms.empty() && output.forces.empty(); }

double fastest_of(const History& history) {
  double omega = 0.0;
  for (const Piece& piece : history.pieces())
    if (piece.amplitude != 0.0) omega = std::max(omega, std::abs(piece.omega));
  return omega;
}

/// rad per time.
double fastest_of(const Model& model) {
  double omega = model.omega_max;
  for (const Load& load : model.loads) omega = std::max(omega, fastest_of(load.history));
  for (const Contact& contact : model.contacts)
    omega = std::max({omega, fastest_of(contact.normal_force), fastest_of(contact.surface_motion)});
  for (const Output& output : model.outputs)
    for (const Output::Given& given : output.given) omega = std::max(omega, fastest_of(given.history));
  return omega;
}

}  // namespace

double value_of(const Output& output, double t, Side side, const Point& point,
                const std::vector<double>& losses) {
  if (output.loss) return *output.loss < losses.size() ? losses[*output.loss] : 0.0;
  double sum = output.constant + output.u.dot(point.u) + output.v.dot(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.dot(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += f.N * point.N(f.contact) + f.T * point.T(f.contact);
  for (const Output::Given& g : output.given)
    sum += (side == Side::after ? g.history.piece(t) : g.history.piece_before(t)).value(t);
  return sum;
}

ResponseWatch::ResponseWatch(const Model& model, double t_end, Recorder& recorder, bool dense)
    : model_(model),
      recorder_(recorder),
      t_end_(t_end),
      dense_(dense),
      extremes_(model.outputs.size()),
      magnitudes_(model.outputs.size()),
      samples_(model.outputs.size()) {
  loads_changed();
}

void ResponseWatch::loads_changed() { radian_ = 1.0 / std::max(fastest_of(model_), 1.0 / t_end_); }

void ResponseWatch::evaluate(double t, Side side, const Point& point, const std::vector<double>& losses,
                             std::vector<double>& values) const {
  values.clear();
  for (const Output& output : model_.outputs) values.push_back(value_of(output, t, side, point, losses));
}

void ResponseWatch::see(std::size_t i, double t, double value) {
  OutputExtremes& e = extremes_[i];
  const double equal_to_most = tie * std::abs(e.maximum), equal_to_least = tie * std::abs(e.minimum);
  if (value > e.maximum + equal_to_most || (t < e.t_maximum && value >= e.maximum - equal_to_most)) {
    e.maximum = std::max(value, e.maximum);
    e.t_maximum = t;
  }
  if (value < e.minimum - equal_to_least || (t < e.t_minimum && value <= e.minimum + equal_to_least)) {
    e.minimum = std::min(value, e.minimum);
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
  std::vector<char> open;
  bool at_end = false;
  for (const Output& output : model_.outputs) {
    const bool between = !output.loss && (dense_ || is_of_motion(output));
    open.push_back(between ? 1 : 0);
    at_end = at_end || (!output.loss && !between);
  }
  if (at_end) {
    engine.evaluate(end, point_);
    engine.accelerate(end, point_);
    for (std::size_t i = 0; i < open.size(); ++i)
      if (open[i] == 0 && !model_.outputs[i].loss)
        see(i, end, value_of(model_.outputs[i], end, Side::before, point_, none_));
  }
  const double pieces = std::max(1.0, std::ceil((end - begin) / (longest * radian_)));
  double from = begin;
  for (double k = 1.0; k <= pieces; ++k) {
    const double to = k == pieces ? end : begin + k / pieces * (end - begin);
    std::vector<Part> parts{{from, to, open}};
    from = to;
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      if (!look(engine, part, begin)) continue;
      const double middle = 0.5 * (part.begin + part.end);
      // The earlier half first: the first of equal extremes counts.
      parts.push_back({middle, part.end, part.open});
      parts.push_back({part.begin, middle, std::move(part.open)});
    }
  }
}

void ResponseWatch::sample(Stepper& engine, const Part& part, double begin, std::size_t point) {
  const double x = Chebyshev::nodes()[point];
  const double t =
      point + 1 == Chebyshev::count ? part.end : part.begin + 0.5 * (x + 1.0) * (part.end - part.begin);
  engine.interpolate(t, point_);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (part.open[i] == 0) continue;
    const Side side = t == begin ? Side::after : Side::before;
    samples_[i][point] = value_of(model_.outputs[i], t, side, point_, none_);
    magnitudes_[i] = std::max(magnitudes_[i], magnitude_of(model_.outputs[i], t, side, point_));
    see(i, t, samples_[i][point]);
  }
}

bool ResponseWatch::look(Stepper& engine, Part& part, double begin) {
  for (const std::size_t point : {0U, 8U, 16U}) sample(engine, part, begin, point);
  for (const std::size_t stride : {4U, 2U, 1U}) {
    for (std::size_t j = stride; j < Chebyshev::count; j += 2 * stride) sample(engine, part, begin, j);
    bool left = false;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (part.open[i] == 0) continue;
      if (settled(i, engine, part, stride)) part.open[i] = 0;
      left = left || part.open[i] != 0;
    }
    if (!left) return false;
  }
  if (part.end - part.begin > radian_) return true;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (part.open[i] != 0) sharpen(i, engine, part, 1);
  return false;
}

bool ResponseWatch::settled(std::size_t i, Stepper& engine, const Part& part, std::size_t stride) {
  const Chebyshev::Values& values = samples_[i];
  double error = 0.0;
  for (std::size_t j = stride; j < Chebyshev::count; j += 2 * stride)
    error =
        std::max(error, std::abs(Chebyshev::through(values, 2 * stride, Chebyshev::nodes()[j]) - values[j]));
  const OutputExtremes& known = extremes_[i];
  const auto within = [&](const Bounds& b, double rest) {
    return b.greatest + rest <= known.maximum && b.least - rest >= known.minimum;
  };
  const Bounds at = at_points(values, stride);
  if (within(at, 2.0 * error + (at.greatest - at.least))) return true;
  if (stride < 4 && within(between_points(values, stride), 2.0 * error)) return true;
  const double size = std::max(std::abs(known.maximum), std::abs(known.minimum));  // samples are known
  if (error > std::max(resolved(stride) * size, rounding::of_elimination * magnitudes_[i])) return false;
  sharpen(i, engine, part, stride);
  return true;
}

void ResponseWatch::sharpen(std::size_t i, Stepper& engine, const Part& part, std::size_t stride) {
  const Chebyshev::Values& nodes = Chebyshev::nodes();
  const Chebyshev::Values slope = Chebyshev::slopes(samples_[i], stride);
  const double half = 0.5 * (part.end - part.begin);
  for (std::size_t j = 0; j + stride < Chebyshev::count; j += stride) {
    if ((slope[j] > 0.0) == (slope[j + stride] > 0.0)) continue;
    const double x = Chebyshev::turn_between(slope, stride, nodes[j], nodes[j + stride]);
    const double p = Chebyshev::through(samples_[i], stride, x);
    const OutputExtremes& known = extremes_[i];
    const double rest = located * std::max(std::abs(known.maximum), std::abs(known.minimum));
    if (p + rest <= known.maximum && p - rest >= known.minimum) continue;
    const double at = part.begin + half * (x + 1.0);
    engine.interpolate(at, point_);
    see(i, at, value_of(model_.outputs[i], at, Side::before, point_, none_));
  }
}

}  // namespace signorini
