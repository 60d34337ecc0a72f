#include "model/outputs/cut.hpp"

#include <cmath>

namespace signorini {
namespace {

/// Integrals from 0 to x of the shapes of one direction: displacements and rotations of both ends.
struct Shapes {
  double a = 0.0, turn_a = 0.0, b = 0.0, turn_b = 0.0;
};

Shapes linear_once(double l, double s) { return {l * (s - s * s / 2.0), 0.0, l * s * s / 2.0, 0.0}; }
Shapes linear_twice(double l, double s) {
  return {l * l * (s * s / 2.0 - s * s * s / 6.0), 0.0, l * l * s * s * s / 6.0, 0.0};
}
Shapes cubic_once(double l, double s) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  return {l * (s - s3 + s4 / 2.0), l * l * (s2 / 2.0 - 2.0 * s3 / 3.0 + s4 / 4.0), l * (s3 - s4 / 2.0),
          l * l * (s4 / 4.0 - s3 / 3.0)};
}
Shapes cubic_twice(double l, double s) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  return {l * l * (s2 / 2.0 - s4 / 4.0 + s5 / 10.0), l * l * l * (s3 / 6.0 - s4 / 6.0 + s5 / 20.0),
          l * l * (s4 / 4.0 - s5 / 10.0), l * l * l * (s5 / 20.0 - s4 / 12.0)};
}

/// v' at a part of the length, by ux, uy, rz at both ends.
Eigen::Matrix<double, 6, 1> slope(const Axis& axis, bool bar, double s) {
  const double rise = bar ? 1.0 / axis.length : 6.0 * (s - s * s) / axis.length;
  Eigen::Matrix<double, 6, 1> row;
  row << rise * axis.s, -rise * axis.c, bar ? 0.0 : 1.0 - 4.0 * s + 3.0 * s * s, -rise * axis.s,
      rise * axis.c, bar ? 0.0 : 3.0 * s * s - 2.0 * s;
  return row;
}

Eigen::Matrix<double, 6, 1> deflection_at(const MeshElement& element, const Axis& axis,
                                          OutputQuantity quantity, double part) {
  const auto pull = [&](double s) -> Eigen::Matrix<double, 6, 1> {
    const double force = element.force_a + s * (element.force_b - element.force_a);
    return force * slope(axis, element.type == MemberType::bar, s);
  };
  if (quantity == OutputQuantity::V) return pull(part);
  const double half = 0.5 * part, gauss = half / std::sqrt(3.0);  // cubic: two places are exact
  return half * axis.length * (pull(half - gauss) + pull(half + gauss));
}

}  // namespace

Cut cut_at(const MeshElement& element, const Axis& axis, double mass_per_length, OutputQuantity quantity,
           double x) {
  const double l = axis.length, c = axis.c, s = axis.s;
  const double part = x / l;
  const bool bar = element.type == MemberType::bar;
  Cut cut{Eigen::Matrix<double, 6, 1>::Zero(), Eigen::Matrix<double, 6, 1>::Zero()};
  Shapes shapes;
  double dx = -s, dy = c,
         sign = -1.0;  // the direction that counts, and the sign of rho times its acceleration
  if (quantity == OutputQuantity::N) {
    cut.forces << -c, -s, 0.0, 0.0, 0.0, 0.0;
    cut.load = {-x * c, -x * s};
    shapes = linear_once(l, part);
    dx = c;
    dy = s;
    sign = 1.0;
  } else if (quantity == OutputQuantity::V) {
    cut.forces << -s, c, 0.0, 0.0, 0.0, 0.0;
    cut.load = {-x * s, x * c};
    shapes = bar ? linear_once(l, part) : cubic_once(l, part);
  } else {
    cut.forces << -x * s, x * c, -1.0, 0.0, 0.0, 0.0;
    cut.load = {-0.5 * x * x * s, 0.5 * x * x * c};
    shapes = bar ? linear_twice(l, part) : cubic_twice(l, part);
  }
  if (quantity != OutputQuantity::N && (element.force_a != 0.0 || element.force_b != 0.0))
    cut.deflection = deflection_at(element, axis, quantity, part);
  if (element.mass == MassKind::lumped) {  // the half at a lies before the cut
    cut.acceleration = -0.5 * mass_per_length * l * cut.forces;
    cut.acceleration[2] = 0.0;
  } else {
    const double rho = sign * mass_per_length;
    cut.acceleration << rho * shapes.a * dx, rho * shapes.a * dy, rho * shapes.turn_a, rho * shapes.b * dx,
        rho * shapes.b * dy, rho * shapes.turn_b;
  }
  return cut;
}

}  // namespace signorini
