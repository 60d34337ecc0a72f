#include "model/element/line_elements.hpp"

#include <cmath>

namespace signorini::element {

Axis axis_between(double dx, double dy) {
  const double length = std::hypot(dx, dy);
  return {length, dx / length, dy / length, dx, dy};
}

LineShapes hermite_shapes(double s, bool hinged_a, bool hinged_b) {
  const double s2 = s * s, s3 = s2 * s;
  LineShapes h{1.0 - 3.0 * s2 + 2.0 * s3, s - 2.0 * s2 + s3, 3.0 * s2 - 2.0 * s3, s3 - s2};
  // Hinge at a (no moment): rotation_a = 3/2 (b - a) - rotation_b / 2. Hinges at both ends:
  // rotation_a = rotation_b = b - a.
  if (hinged_a && hinged_b) return {1.0 - s, 0.0, s, 0.0};
  if (hinged_a)
    return {h.a - 1.5 * h.rotation_a, 0.0, h.b + 1.5 * h.rotation_a, h.rotation_b - 0.5 * h.rotation_a};
  if (hinged_b)
    return {h.a - 1.5 * h.rotation_b, h.rotation_a - 0.5 * h.rotation_b, h.b + 1.5 * h.rotation_b, 0.0};
  return h;
}

LineShapes linear_integral(double l, double s) { return {l * (s - s * s / 2.0), 0.0, l * s * s / 2.0, 0.0}; }

LineShapes linear_double_integral(double l, double s) {
  return {l * l * (s * s / 2.0 - s * s * s / 6.0), 0.0, l * l * s * s * s / 6.0, 0.0};
}

ElementVector LineElement::restrict_to_unknowns(const Ends& ends) const {
  const std::vector<ElementUnknown> all = unknowns();
  ElementVector x(static_cast<Eigen::Index>(all.size()));
  for (std::size_t j = 0; j < all.size(); ++j)
    x[static_cast<Eigen::Index>(j)] =
        ends[static_cast<Eigen::Index>(3 * all[j].local_node + all[j].component)];
  return x;
}

double LineElement::elongation(const ElementVector& motion) const {
  const Eigen::Index b = motion.size() / 2;
  return axis().c * (motion[b] - motion[0]) + axis().s * (motion[b + 1] - motion[1]);
}

AxialForces LineElement::axial_forces(const ElementVector& u, double strain, const PlaneVector& load,
                                      const PlaneVector& pull) const {
  const double l = axis().length;
  PlaneVector along = load;  // load between the ends, without a lumped weight, which acts at the ends
  for (std::size_t c = 0; c < 2; ++c)
    if (data_.mass == MassKind::consistent) along[c] += density() * pull[c];
  const double mean = data_.EA * (elongation(u) / l - strain);
  const double falls = 0.5 * l * (along[0] * axis().c + along[1] * axis().s);
  return {mean + falls, mean - falls};
}

ElementVector LineElement::load_vector(const PlaneVector& q) const {
  const double l = axis().length, across = -q[0] * axis().s + q[1] * axis().c;
  const double moment = across * l * l / 12.0;
  Ends ends;
  ends << 0.5 * q[0] * l, 0.5 * q[1] * l, moment, 0.5 * q[0] * l, 0.5 * q[1] * l, -moment;
  return restrict_to_unknowns(ends);
}

double LineElement::strain_work(const ElementVector& motion) const { return data_.EA * elongation(motion); }

LineElement::Ends LineElement::deflection(OutputQuantity quantity, double part,
                                          const AxialForces& forces) const {
  const auto pull = [&](double s) -> Ends {
    const double force = forces.a + s * (forces.b - forces.a);
    return force * slope(s);
  };
  if (quantity == OutputQuantity::V) return pull(part);
  // Cubic integrand: two Gauss points are exact.
  const double half = 0.5 * part, gauss = half / std::sqrt(3.0);
  return half * axis().length * (pull(half - gauss) + pull(half + gauss));
}

SectionForce LineElement::section_force(OutputQuantity quantity, const PlaneVector& at,
                                        const AxialForces& frozen) const {
  const double l = axis().length, c = axis().c, s = axis().s, x = at[0] * l, part = x / l;
  Ends forces, acceleration;
  PlaneVector load;
  LineShapes shapes;
  double dx = -s, dy = c,
         sign = -1.0;  // (dx, dy): direction of the section force; sign: sign of rho a
  if (quantity == OutputQuantity::N) {
    forces << -c, -s, 0.0, 0.0, 0.0, 0.0;
    load = {-x * c, -x * s};
    shapes = linear_integral(l, part);
    dx = c;
    dy = s;
    sign = 1.0;
  } else if (quantity == OutputQuantity::V) {
    forces << -s, c, 0.0, 0.0, 0.0, 0.0;
    load = {-x * s, x * c};
    shapes = deflection_integral(part);
  } else {
    forces << -x * s, x * c, -1.0, 0.0, 0.0, 0.0;
    load = {-0.5 * x * x * s, 0.5 * x * x * c};
    shapes = deflection_double_integral(part);
  }
  if (data_.mass == MassKind::lumped) {  // the mass rho L/2 at a lies between a and the section
    acceleration = -0.5 * density() * l * forces;
    acceleration[2] = 0.0;
  } else {
    const double rho = sign * density();
    acceleration << rho * shapes.a * dx, rho * shapes.a * dy, rho * shapes.rotation_a, rho * shapes.b * dx,
        rho * shapes.b * dy, rho * shapes.rotation_b;
  }
  SectionForce cut(unknowns().size());
  cut.forces = restrict_to_unknowns(forces);
  cut.acceleration = restrict_to_unknowns(acceleration);
  cut.load = load;
  if (quantity != OutputQuantity::N && !frozen.is_zero())
    cut.deflection = restrict_to_unknowns(deflection(quantity, part, frozen));
  return cut;
}

namespace {

/// The matrix without rows and columns of the rotations.
ElementMatrix without_rotations(const BeamMatrix& a) {
  constexpr std::array<int, 4> kept{0, 1, 3, 4};
  return a(kept, kept);
}

}  // namespace

BeamMatrix bar_stiffness(double dx, double dy, double ea) {
  const double l = std::hypot(dx, dy);
  Eigen::Matrix<double, 6, 1> a;
  a << -dx / l, -dy / l, 0.0, dx / l, dy / l, 0.0;
  return (ea / l) * a * a.transpose();
}

BeamMatrix bar_geometric_stiffness(double dx, double dy, double force_a, double force_b) {
  const double l = std::hypot(dx, dy);
  Eigen::Matrix<double, 6, 1> a;
  a << dy / l, -dx / l, 0.0, -dy / l, dx / l, 0.0;
  return (0.5 * (force_a + force_b) / l) * a * a.transpose();
}

BeamMatrix bar_mass(double dx, double dy, double mass_per_length, MassKind kind) {
  const double mass = mass_per_length * std::hypot(dx, dy);
  const bool lumped = kind == MassKind::lumped;
  BeamMatrix m = BeamMatrix::Zero();
  for (int i : {0, 1}) {
    m(i, i) = m(i + 3, i + 3) = lumped ? mass / 2.0 : mass / 3.0;
    m(i, i + 3) = m(i + 3, i) = lumped ? 0.0 : mass / 6.0;
  }
  return m;
}

std::vector<ElementUnknown> BarElement::unknowns() const { return {{0, 0}, {0, 1}, {1, 0}, {1, 1}}; }

ElementMatrix BarElement::mass() const {
  return without_rotations(bar_mass(axis().dx, axis().dy, density(), data().mass));
}

ElementMatrix BarElement::stiffness() const {
  return without_rotations(bar_stiffness(axis().dx, axis().dy, data().EA));
}

ElementMatrix BarElement::geometric_stiffness(const AxialForces& forces) const {
  return without_rotations(bar_geometric_stiffness(axis().dx, axis().dy, forces.a, forces.b));
}

LineShapes BarElement::deflection_integral(double part) const { return linear_integral(axis().length, part); }

LineShapes BarElement::deflection_double_integral(double part) const {
  return linear_double_integral(axis().length, part);
}

BarElement::Ends BarElement::slope(double /*part*/) const {
  const double rise = 1.0 / axis().length;
  Ends row;
  row << rise * axis().s, -rise * axis().c, 0.0, -rise * axis().s, rise * axis().c, 0.0;
  return row;
}

namespace {

/// Returns T^T A T, where T transforms from the scene's axes to the beam's axes.
BeamMatrix turned(const BeamMatrix& local, double c, double s) {
  BeamMatrix t = BeamMatrix::Zero();
  for (int end = 0; end < 6; end += 3) {
    t(end, end) = c;
    t(end, end + 1) = s;
    t(end + 1, end) = -s;
    t(end + 1, end + 1) = c;
    t(end + 2, end + 2) = 1.0;
  }
  const BeamMatrix a = t.transpose() * local * t;
  return 0.5 * (a + a.transpose());  // bitwise symmetric
}

}  // namespace

BeamMatrix beam_stiffness(double dx, double dy, double ea, double ei) {
  const double l = std::hypot(dx, dy);
  const double axial = ea / l, b = ei / (l * l * l);
  BeamMatrix k;
  // clang-format off
  k <<  axial, 0.0,        0.0,           -axial,  0.0,        0.0,
        0.0,   12.0 * b,   6.0 * b * l,    0.0,   -12.0 * b,   6.0 * b * l,
        0.0,   6.0 * b * l, 4.0 * b * l * l, 0.0, -6.0 * b * l, 2.0 * b * l * l,
       -axial, 0.0,        0.0,            axial,  0.0,        0.0,
        0.0,  -12.0 * b,  -6.0 * b * l,    0.0,    12.0 * b,  -6.0 * b * l,
        0.0,   6.0 * b * l, 2.0 * b * l * l, 0.0, -6.0 * b * l, 4.0 * b * l * l;
  // clang-format on
  return turned(k, dx / l, dy / l);
}

BeamMatrix beam_geometric_stiffness(double dx, double dy, double force_a, double force_b) {
  const double l = std::hypot(dx, dy);
  const double n = 0.5 * (force_a + force_b) / (30.0 * l), d = 0.5 * (force_b - force_a);
  const double diagonal = 36.0 * n, slant = 3.0 * l * n, odd = d / 10.0, turn = d * l / 15.0;
  BeamMatrix k;
  // clang-format off
  k << 0.0,  0.0,         0.0,                    0.0,  0.0,         0.0,
       0.0,  diagonal,    slant + odd,            0.0, -diagonal,    slant - odd,
       0.0,  slant + odd, 4.0 * l * l * n - turn, 0.0, -slant - odd, -l * l * n,
       0.0,  0.0,         0.0,                    0.0,  0.0,         0.0,
       0.0, -diagonal,   -slant - odd,            0.0,  diagonal,   -slant + odd,
       0.0,  slant - odd, -l * l * n,             0.0, -slant + odd,  4.0 * l * l * n + turn;
  // clang-format on
  return turned(k, dx / l, dy / l);
}

BeamMatrix beam_mass(double dx, double dy, double mass_per_length, MassKind kind) {
  const double l = std::hypot(dx, dy), mass = mass_per_length * l;
  BeamMatrix m = BeamMatrix::Zero();
  if (kind == MassKind::lumped) {
    for (int i : {0, 1, 3, 4}) m(i, i) = 0.5 * mass;  // the same in all axes
    return m;
  }
  // clang-format off
  m << 140.0,  0.0,       0.0,          70.0,  0.0,       0.0,
       0.0,    156.0,     22.0 * l,     0.0,   54.0,     -13.0 * l,
       0.0,    22.0 * l,  4.0 * l * l,  0.0,   13.0 * l, -3.0 * l * l,
       70.0,   0.0,       0.0,          140.0, 0.0,       0.0,
       0.0,    54.0,      13.0 * l,     0.0,   156.0,    -22.0 * l,
       0.0,   -13.0 * l, -3.0 * l * l,  0.0,  -22.0 * l,  4.0 * l * l;
  // clang-format on
  return turned(m * (mass / 420.0), dx / l, dy / l);
}

std::vector<ElementUnknown> BeamElement::unknowns() const {
  return {{0, 0}, {0, 1}, {0, 2, data().hinged_a}, {1, 0}, {1, 1}, {1, 2, data().hinged_b}};
}

ElementMatrix BeamElement::mass() const { return beam_mass(axis().dx, axis().dy, density(), data().mass); }

ElementMatrix BeamElement::stiffness() const {
  return beam_stiffness(axis().dx, axis().dy, data().EA, data().EI);
}

ElementMatrix BeamElement::geometric_stiffness(const AxialForces& forces) const {
  return beam_geometric_stiffness(axis().dx, axis().dy, forces.a, forces.b);
}

LineShapes BeamElement::deflection_integral(double s) const {
  const double l = axis().length, s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  return {l * (s - s3 + s4 / 2.0), l * l * (s2 / 2.0 - 2.0 * s3 / 3.0 + s4 / 4.0), l * (s3 - s4 / 2.0),
          l * l * (s4 / 4.0 - s3 / 3.0)};
}

LineShapes BeamElement::deflection_double_integral(double s) const {
  const double l = axis().length, s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  return {l * l * (s2 / 2.0 - s4 / 4.0 + s5 / 10.0), l * l * l * (s3 / 6.0 - s4 / 6.0 + s5 / 20.0),
          l * l * (s4 / 4.0 - s5 / 10.0), l * l * l * (s5 / 20.0 - s4 / 12.0)};
}

BeamElement::Ends BeamElement::slope(double s) const {
  const double rise = 6.0 * (s - s * s) / axis().length;
  Ends row;
  row << rise * axis().s, -rise * axis().c, 1.0 - 4.0 * s + 3.0 * s * s, -rise * axis().s, rise * axis().c,
      3.0 * s * s - 2.0 * s;
  return row;
}

}  // namespace signorini::element
