#include "model/element/beam.hpp"

#include <cmath>

namespace signorini {
namespace {

/// T^T A T with T from the scene's axes to the beam's.
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
  return 0.5 * (a + a.transpose());  // the two triangles agree to the last bit
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

BeamMatrix beam_geometric(double dx, double dy, double force_a, double force_b) {
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

ElementMatrix BeamElement::geometric(const AxialForces& forces) const {
  return beam_geometric(axis().dx, axis().dy, forces.a, forces.b);
}

LineShapes BeamElement::across_once(double s) const {
  const double l = axis().length, s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  return {l * (s - s3 + s4 / 2.0), l * l * (s2 / 2.0 - 2.0 * s3 / 3.0 + s4 / 4.0), l * (s3 - s4 / 2.0),
          l * l * (s4 / 4.0 - s3 / 3.0)};
}

LineShapes BeamElement::across_twice(double s) const {
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

}  // namespace signorini
