#include "model/element/line_element.hpp"

#include <cmath>

namespace signorini {

Axis axis_between(double dx, double dy) {
  const double length = std::hypot(dx, dy);
  return {length, dx / length, dy / length, dx, dy};
}

LineShapes cubic_at(double s, bool hinged_a, bool hinged_b) {
  const double s2 = s * s, s3 = s2 * s;
  LineShapes h{1.0 - 3.0 * s2 + 2.0 * s3, s - 2.0 * s2 + s3, 3.0 * s2 - 2.0 * s3, s3 - s2};
  // Hinge at a (no moment): turn_a = 3/2 (b - a) - turn_b / 2; hinges at both ends: turn_a = turn_b = b - a.
  if (hinged_a && hinged_b) return {1.0 - s, 0.0, s, 0.0};
  if (hinged_a) return {h.a - 1.5 * h.turn_a, 0.0, h.b + 1.5 * h.turn_a, h.turn_b - 0.5 * h.turn_a};
  if (hinged_b) return {h.a - 1.5 * h.turn_b, h.turn_a - 0.5 * h.turn_b, h.b + 1.5 * h.turn_b, 0.0};
  return h;
}

LineShapes linear_once(double l, double s) { return {l * (s - s * s / 2.0), 0.0, l * s * s / 2.0, 0.0}; }

LineShapes linear_twice(double l, double s) {
  return {l * l * (s * s / 2.0 - s * s * s / 6.0), 0.0, l * l * s * s * s / 6.0, 0.0};
}

ElementVector LineElement::of_unknowns(const Ends& ends) const {
  const std::vector<ElementUnknown> all = unknowns();
  ElementVector x(static_cast<Eigen::Index>(all.size()));
  for (std::size_t j = 0; j < all.size(); ++j)
    x[static_cast<Eigen::Index>(j)] = ends[static_cast<Eigen::Index>(3 * all[j].place + all[j].component)];
  return x;
}

double LineElement::stretch(const ElementVector& motion) const {
  const Eigen::Index b = motion.size() / 2;
  return axis().c * (motion[b] - motion[0]) + axis().s * (motion[b + 1] - motion[1]);
}

AxialForces LineElement::axial_forces(const ElementVector& u, double strain, const PlaneVector& load,
                                      const PlaneVector& pull) const {
  const double l = axis().length;
  PlaneVector along = load;  // between the ends; a lumped weight acts at the ends
  for (std::size_t c = 0; c < 2; ++c)
    if (data_.mass == MassKind::consistent) along[c] += density() * pull[c];
  const double mean = data_.EA * (stretch(u) / l - strain);
  const double falls = 0.5 * l * (along[0] * axis().c + along[1] * axis().s);
  return {mean + falls, mean - falls};
}

ElementVector LineElement::spread(const PlaneVector& q) const {
  const double l = axis().length, across = -q[0] * axis().s + q[1] * axis().c;
  const double moment = across * l * l / 12.0;
  Ends ends;
  ends << 0.5 * q[0] * l, 0.5 * q[1] * l, moment, 0.5 * q[0] * l, 0.5 * q[1] * l, -moment;
  return of_unknowns(ends);
}

double LineElement::strain_work(const ElementVector& motion) const { return data_.EA * stretch(motion); }

LineElement::Ends LineElement::deflection(OutputQuantity quantity, double part,
                                          const AxialForces& forces) const {
  const auto pull = [&](double s) -> Ends {
    const double force = forces.a + s * (forces.b - forces.a);
    return force * slope(s);
  };
  if (quantity == OutputQuantity::V) return pull(part);
  const double half = 0.5 * part, gauss = half / std::sqrt(3.0);  // cubic integrand: two Gauss points are
                                                                  // exact
  return half * axis().length * (pull(half - gauss) + pull(half + gauss));
}

Cut LineElement::cut(OutputQuantity quantity, const PlaneVector& at, const AxialForces& frozen) const {
  const double l = axis().length, c = axis().c, s = axis().s, x = at[0] * l, part = x / l;
  Ends forces, acceleration;
  PlaneVector load;
  LineShapes shapes;
  double dx = -s, dy = c,
         sign = -1.0;  // direction of the section force, and the sign of rho times its acceleration
  if (quantity == OutputQuantity::N) {
    forces << -c, -s, 0.0, 0.0, 0.0, 0.0;
    load = {-x * c, -x * s};
    shapes = linear_once(l, part);
    dx = c;
    dy = s;
    sign = 1.0;
  } else if (quantity == OutputQuantity::V) {
    forces << -s, c, 0.0, 0.0, 0.0, 0.0;
    load = {-x * s, x * c};
    shapes = across_once(part);
  } else {
    forces << -x * s, x * c, -1.0, 0.0, 0.0, 0.0;
    load = {-0.5 * x * x * s, 0.5 * x * x * c};
    shapes = across_twice(part);
  }
  if (data_.mass == MassKind::lumped) {  // the half at a lies before the cut
    acceleration = -0.5 * density() * l * forces;
    acceleration[2] = 0.0;
  } else {
    const double rho = sign * density();
    acceleration << rho * shapes.a * dx, rho * shapes.a * dy, rho * shapes.turn_a, rho * shapes.b * dx,
        rho * shapes.b * dy, rho * shapes.turn_b;
  }
  Cut cut(unknowns().size());
  cut.forces = of_unknowns(forces);
  cut.acceleration = of_unknowns(acceleration);
  cut.load = load;
  if (quantity != OutputQuantity::N && !frozen.none())
    cut.deflection = of_unknowns(deflection(quantity, part, frozen));
  return cut;
}

}  // namespace signorini
