#include "run/output_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contact/contact_states.hpp"
#include "motion/point.hpp"

namespace signorini::run {
namespace {

/// An oscillating piece of a history, with its time interval and its angular frequency.
struct HalfPeriod {
  double from, to, omega;
};

/// Adds the oscillating pieces of a history that are longer than the resolution of the clock.
void add_oscillating_pieces(const History& history, std::vector<HalfPeriod>& all) {
  constexpr double ever = std::numeric_limits<double>::infinity();
  const std::vector<double>& starts = history.starts();
  for (std::size_t i = 0; i < history.pieces().size(); ++i) {
    const Piece& piece = history.pieces()[i];
    if (piece.amplitude == 0.0 || piece.omega == 0.0) continue;
    const double from = i == 0 ? -ever : starts[i - 1], to = i == starts.size() ? ever : starts[i];
    if (std::isinf(to) || to - from > motion::resolution_at(to, 0.0))
      all.push_back({from, to, std::abs(piece.omega)});
  }
}

std::vector<HalfPeriod> oscillating_pieces(const Model& model) {
  std::vector<HalfPeriod> all;
  for (const Load& load : model.loads) add_oscillating_pieces(load.history, all);
  for (const Contact& contact : model.contacts) {
    add_oscillating_pieces(contact.normal_force, all);
    add_oscillating_pieces(contact.surface_motion, all);
  }
  for (const Output& output : model.outputs)
    for_each_linear(output, [&](const Output& o) {
      for (const Output::Given& given : o.given) add_oscillating_pieces(given.history, all);
    });
  return all;
}

}  // namespace

FormNorm form_norm_of(const engine::FastModes& modes, const Output& linear) {
  return {modes.form_norm(linear.u), modes.form_norm(linear.v), modes.form_norm(linear.a)};
}

double fast_mode_contribution(const engine::FastModeBound& fast_bound, const FormNorm& reach,
                              const Output& linear, const ForceLayout& layout) {
  double sum = reach.u * fast_bound.u + reach.v * fast_bound.v + reach.a * fast_bound.a;
  for (const Output::ContactForces& f : linear.forces)
    sum += std::abs(f.N) * fast_bound.forces[static_cast<Eigen::Index>(layout.normal(f.contact))] +
           std::abs(f.T) * fast_bound.forces[static_cast<Eigen::Index>(layout.tangent(f.contact))];
  return sum;
}

FastModeCutoff::FastModeCutoff(const Model& model, double t_end) : model_(model), t_end_(t_end) {
  loads_changed();
}

void FastModeCutoff::loads_changed() {
  struct Change {
    double t, omega;
    bool begins;
  };
  std::vector<Change> ends;
  for (const HalfPeriod& swing : oscillating_pieces(model_)) {
    ends.push_back({swing.from, swing.omega, true});
    ends.push_back({swing.to, swing.omega, false});
  }
  std::sort(ends.begin(), ends.end(), [](const Change& a, const Change& b) { return a.t < b.t; });
  changes_.clear();
  fastest_.assign(1, 0.0);
  std::multiset<double> acting;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].begins)
      acting.insert(ends[i].omega);
    else
      acting.erase(acting.find(ends[i].omega));
    if (i + 1 < ends.size() && ends[i + 1].t == ends[i].t) continue;
    changes_.push_back(ends[i].t);
    fastest_.push_back(acting.empty() ? 0.0 : *acting.rbegin());
  }
}

double FastModeCutoff::max_rate(double radians, double begin, double end) {
  load_rate_ = 1.0 / t_end_;
  auto next = std::upper_bound(changes_.begin(), changes_.end(), begin);
  do load_rate_ = std::max(load_rate_, fastest_[static_cast<std::size_t>(next - changes_.begin())]);
  while (next != changes_.end() && *next++ < end);
  return std::max(load_rate_, std::min(model_.omega_max, radians / (end - begin)));
}

double FastModeCutoff::output_rate(
    const engine::FastModes& modes, double all,
    const std::function<bool(const engine::FastModeBound&)>& is_rounding) const {
  const auto is_rounding_above = [&](double omega) {
    const auto fast_bound = modes.fast_mode_bound(omega);
    return fast_bound && is_rounding(*fast_bound);
  };
  double from = load_rate_, to = all;
  if (is_rounding_above(from)) return from;
  while (to > 2.0 * from) {
    const double middle = std::sqrt(from) * std::sqrt(to);
    (is_rounding_above(middle) ? to : from) = middle;
  }
  return to;
}

namespace {

// Number of bisections between two points: 40 bisections locate a peak to 1e-12 of the part.
constexpr int halvings = 40;

ValueBounds bounds_of(const Chebyshev::Values& values, std::size_t stride, bool between) {
  return between ? between_points(values, stride) : at_points(values, stride);
}

/// Largest value of p over the segment at one time, and its rate of change at this position.
struct PeakPoint {
  double value = 0.0, rate = 0.0;
};

class PeakSearch {
 public:
  PeakSearch(std::span<const Chebyshev::Values> f, std::size_t stride, double sign)
      : f_(f), stride_(stride), sign_(sign) {
    for (const Chebyshev::Values& values : f) rates_.push_back(Chebyshev::slopes(values, stride));
  }

  [[nodiscard]] PeakPoint at(double t) const {
    base::PolynomialInterpolation::Values values = values_along(f_, stride_, t);
    for (double& value : values) value *= sign_;
    const base::PolynomialInterpolation::Extremes e =
        base::PolynomialInterpolation::extremes(values, f_.size());
    const base::PolynomialInterpolation::Values rates = values_along(rates_, stride_, t);
    return {e.greatest, sign_ * base::PolynomialInterpolation::interpolate(rates, f_.size(), e.at_greatest)};
  }

 private:
  std::span<const Chebyshev::Values> f_;
  std::vector<Chebyshev::Values> rates_;
  std::size_t stride_;
  double sign_;
};

/// Upper bound between two points: the value at which both tangents meet, or the larger end value.
double greatest_below_tangents(const PeakPoint& a, const PeakPoint& b, double width) {
  const double to = (b.value - a.value - b.rate * width) / (a.rate - b.rate);
  return std::max({a.value, b.value, a.value + a.rate * std::clamp(to, 0.0, width)});
}

}  // namespace

ValueBounds at_points(const Chebyshev::Values& values, std::size_t stride) {
  ValueBounds b{values[0], values[0]};
  for (std::size_t j = stride; j < Chebyshev::count; j += stride) {
    b.least = std::min(b.least, values[j]);
    b.greatest = std::max(b.greatest, values[j]);
  }
  return b;
}

ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride) {
  const Chebyshev::Values& x = Chebyshev::nodes();
  const Chebyshev::Values slope = Chebyshev::slopes(values, stride);
  ValueBounds b = at_points(values, stride);
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

ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride, bool between) {
  ValueBounds b = bounds_of(f.front(), stride, between);
  const ValueBounds end = bounds_of(f.back(), stride, between);
  b = {std::min(b.least, end.least), std::max(b.greatest, end.greatest)};
  double off = 0.0;
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const double x = base::PolynomialInterpolation::point(f.size(), i);
    Chebyshev::Values bow{};
    for (std::size_t j = 0; j < Chebyshev::count; j += stride)
      bow[j] = f[i][j] - ((1.0 - x) * f.front()[j] + x * f.back()[j]);
    const ValueBounds of = bounds_of(bow, stride, between);
    off = std::max({off, of.greatest, -of.least});
  }
  return {b.least - base::PolynomialInterpolation::lebesgue * off,
          b.greatest + base::PolynomialInterpolation::lebesgue * off};
}

base::PolynomialInterpolation::Values values_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                                   double x) {
  base::PolynomialInterpolation::Values values{};
  for (std::size_t i = 0; i < f.size(); ++i) values[i] = Chebyshev::interpolate(f[i], stride, x);
  return values;
}

std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride, double sign,
                                double known) {
  const PeakSearch peaks_of_form(f, stride, sign);
  const Chebyshev::Values& x = Chebyshev::nodes();
  std::vector<double> peaks;
  PeakPoint before = peaks_of_form.at(x[0]);
  for (std::size_t j = stride; j < Chebyshev::count; j += stride) {
    const PeakPoint after = peaks_of_form.at(x[j]);
    const bool turns = before.rate > 0.0 && after.rate <= 0.0;
    if (turns && greatest_below_tangents(before, after, x[j] - x[j - stride]) > sign * known) {
      double rising = x[j - stride], falling = x[j];
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (rising + falling);
        (peaks_of_form.at(middle).rate > 0.0 ? rising : falling) = middle;
      }
      peaks.push_back(0.5 * (rising + falling));
    }
    before = after;
  }
  return peaks;
}

}  // namespace signorini::run
