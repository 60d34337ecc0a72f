#include "run/curve_record.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "base/rounding.hpp"
#include "scene/quantities.hpp"

namespace signorini::run {
namespace {

constexpr std::size_t last_node = Chebyshev::count - 1;

using Matrix = std::array<Chebyshev::Values, Chebyshev::count>;

/// Matrix with entries d_ij of p'(x_i) = sum over j of d_ij (r_j - r_i).
Matrix derivative(std::size_t stride) {
  const Chebyshev::Values& x = Chebyshev::nodes();
  Matrix d{};
  for (std::size_t i = 0; i <= last_node; i += stride)
    for (std::size_t j = 0; j <= last_node; j += stride) {
      if (i == j) continue;
      const double ci = i == 0 || i == last_node ? 2.0 : 1.0, cj = j == 0 || j == last_node ? 2.0 : 1.0;
      d[i][j] = ci / cj * ((i + j) / stride % 2 == 0 ? 1.0 : -1.0) / (x[i] - x[j]);
    }
  return d;
}

const Matrix& derivative_of(std::size_t stride) {
  static const std::array<Matrix, 4> all{derivative(1), derivative(2), derivative(4), derivative(8)};
  return all[stride == 1 ? 0 : stride == 2 ? 1 : stride == 4 ? 2 : 3];
}

}  // namespace

const Chebyshev::Values& Chebyshev::nodes() {
  static const Values x = [] {
    Values points{};
    for (std::size_t i = 0; i <= last_node; ++i)
      points[i] = -std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(last_node));
    points[last_node / 2] = 0.0;
    return points;
  }();
  return x;
}

double Chebyshev::interpolate(const Values& values, std::size_t stride, double x) {
  double above = 0.0, below = 0.0, sign = 1.0;
  for (std::size_t i = 0; i <= last_node; i += stride, sign = -sign) {
    if (x == nodes()[i]) return values[i];
    const double w = sign * (i == 0 || i == last_node ? 0.5 : 1.0) / (x - nodes()[i]);
    above += w * values[i];
    below += w;
  }
  return above / below;
}

Chebyshev::Values Chebyshev::slopes(const Values& values, std::size_t stride) {
  const Matrix& d = derivative_of(stride);
  Values result{};
  // With differences of values, the derivative of a constant is exactly zero.
  for (std::size_t i = 0; i <= last_node; i += stride)
    for (std::size_t j = 0; j <= last_node; j += stride) result[i] += d[i][j] * (values[j] - values[i]);
  return result;
}

double Chebyshev::extremum_between(const Values& slope, std::size_t stride, double a, double b) {
  double fa = interpolate(slope, stride, a);
  for (int i = 0; i < 60 && b - a > rounding::few_operations; ++i) {
    const double middle = 0.5 * (a + b), f = interpolate(slope, stride, middle);
    if ((f > 0.0) == (fa > 0.0)) {
      a = middle;
      fa = f;
    } else {
      b = middle;
    }
  }
  return 0.5 * (a + b);
}

namespace {

// Limit of the number of displacement curves of one kind in a picture.
constexpr std::size_t max_of_a_kind = 24;
constexpr std::size_t most_values = 100000, most_points = 8000, min_points = 2500;
// A parabola's vertex is kept only if it exceeds the middle row by more than this fraction of the range so far.
constexpr double least_rise = 1e-3;
constexpr double turn = 1e-3;  // rad; least scale of rotations, so that rotations of 1e-15 rad are rounding

/// Vertex of the parabola through three rows; nullopt: the middle row is no peak, or two of the rows have the same time.
std::optional<CurvePoint> vertex(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
  const double left = b.t - a.t, right = c.t - b.t;
  if (!(left > 0.0 && right > 0.0 && std::isfinite(left))) return std::nullopt;
  const double rise = b.value - a.value, fall = c.value - b.value;
  if (!(rise * fall < 0.0)) return std::nullopt;
  const double curvature = (fall / right - rise / left) / (left + right);
  const double slope = rise / left + curvature * left;  // slope at b
  const double to = -0.5 * slope / curvature;
  return CurvePoint{b.t + to, b.value + 0.5 * slope * to};
}

}  // namespace

std::vector<Column> drawn_columns(const Model& model) {
  std::map<std::string, std::size_t> of_kind;
  std::vector<Column> columns;
  for (const Column& column : model.columns)
    if (!column.velocity && ++of_kind[column.name.substr(column.name.rfind('.') + 1)] <= max_of_a_kind)
      columns.push_back(column);
  return columns;
}

std::vector<int> drawn_entries(const Model& model) {
  std::vector<int> entries;
  for (const Column& column : drawn_columns(model))
    if (column.dof >= 0) entries.push_back(column.dof);
  return entries;
}

std::size_t max_curve_points(std::size_t columns) {
  return std::clamp(most_values / (columns + energy_columns.size() + 1), min_points, most_points);
}

CurveRecord::CurveRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share)
    : model_(model),
      t_end_(t_end),
      last_(recorder.wants_motion() ? 0.0 : std::numeric_limits<double>::infinity()),
      enabled_(recorder.wants_motion()),
      energies_(share.energies) {
  if (!enabled_) return;
  const std::vector<Column> columns = drawn_columns(model);
  const std::size_t most = max_curve_points(share.whole() ? columns.size() : share.columns);
  const base::Downsampled<CurvePoint, 1, ValueOf> none(t_end * model.unit.time, {.max_rows = most});
  for (const Column& column : columns) {
    const bool turns =
        column.dof >= 0 && model.physical_dofs()[static_cast<std::size_t>(column.dof)].rotation;
    curves_.push_back(
        {column.name, turns ? Kind::angle : Kind::length, column.dof, turns ? 1.0 : model.unit.length, none});
  }
  const double unit = scene::factor_of(unit::energy, model.unit);
  for (const EnergyColumn& column : energy_columns)
    curves_.push_back({column.name, Kind::energy, -1, unit, none, share.whole()});
  curves_.push_back({balance_column, Kind::balance, -1, unit, none, share.whole()});
}

bool CurveRecord::needs_row(double t) const { return t - last_ >= min_row_spacing * t_end_ || t >= t_end_; }

void CurveRecord::add(double t, const Vector& u, const Energy& energy) {
  if (!enabled()) return;
  last_ = t;
  if (energies_) energies_(t, energy);
  requested_spacing_ = std::numeric_limits<double>::infinity();
  const bool plain = model_.is_physical();
  const Vector physical = plain ? Vector() : model_.physical(u, t, 0);
  const Vector& shown = plain ? u : physical;
  const double at = t * model_.unit.time;
  auto energies = energy_columns.begin();
  for (Curve& curve : curves_) {
    double value = curve.dof < 0 ? 0.0 : shown[curve.dof];
    if (curve.kind == Kind::energy) value = energy.*(energies++)->value;
    if (curve.kind == Kind::balance) value = energy.balance();
    add(curve, {at, value * curve.factor});
  }
}

void CurveRecord::add(Curve& curve, const CurvePoint& point) {
  auto& [first, second] = curve.before;
  if (!curve.begun) {
    curve.begun = true;
    second = point;
    return;
  }
  requested_spacing_ = std::min(requested_spacing_, spacing_for_curve(curve, point) / model_.unit.time);
  if (!curve.kept) {
    curve.least = std::min(curve.least, second.value);
    curve.greatest = std::max(curve.greatest, second.value);
    first = std::exchange(second, point);
    return;
  }
  // The balance is only rounding error: a parabola through its rows has no meaning.
  const std::optional<CurvePoint> peak =
      curve.kind == Kind::balance ? std::nullopt : vertex(first, second, point);
  const bool higher = peak && std::abs(peak->value - second.value) > least_rise * curve.points.range();
  if (higher && peak->t < second.t) curve.points.add(*peak);
  curve.points.add(second);
  if (higher && peak->t > second.t) curve.points.add(*peak);
  first = second;
  second = point;
}

/// Row spacing that a curve needs, in the scene's unit of time. Infinite for the balance, which is only rounding error,
/// and for a curve whose range is rounding relative to other curves of its kind.
double CurveRecord::spacing_for_curve(const Curve& curve, const CurvePoint& point) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const auto& [first, second] = curve.before;
  double& greatest = greatest_[static_cast<std::size_t>(curve.kind)];
  greatest = std::max(greatest, std::abs(point.value));
  if (curve.kind == Kind::balance || !(point.t > second.t && second.t > first.t) || !std::isfinite(first.t))
    return any;
  const double floor = std::max(greatest, curve.kind == Kind::angle ? turn : 0.0);
  const double range = curve.range();
  if (!(range > rounding::elimination * floor)) return any;
  const double left = second.t - first.t, right = point.t - second.t, part = left / (left + right);
  return row_spacing(left, right, std::abs(second.value - first.value - part * (point.value - first.value)),
                     range);
}

void CurveRecord::write(Recorder& recorder) {
  if (!enabled()) return;
  std::map<Kind, double> greatest{{Kind::angle, turn}};
  for (Curve& curve : curves_) {
    if (curve.begun) curve.points.add(curve.before[1]);
    greatest[curve.kind] = std::max(greatest[curve.kind], curve.points.size(0));
  }
  Curves curves;
  for (Curve& curve : curves_) {
    if (!curve.kept) continue;
    const double rounding = curve.kind == Kind::balance ? 0.0 : rounding::elimination * greatest[curve.kind];
    curve.points.close({rounding});
    curves.names.push_back(curve.name);
    curves.points.push_back(curve.points.take());
  }
  recorder.curves(curves);
}

}  // namespace signorini::run
