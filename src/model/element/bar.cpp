#include "model/element/bar.hpp"

#include <cmath>

namespace signorini {
namespace {

/// The matrix without rows and columns of the rotations.
ElementMatrix of_translations(const BeamMatrix& a) {
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

BeamMatrix bar_geometric(double dx, double dy, double force_a, double force_b) {
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
  return of_translations(bar_mass(axis().dx, axis().dy, density(), data().mass));
}

ElementMatrix BarElement::stiffness() const {
  return of_translations(bar_stiffness(axis().dx, axis().dy, data().EA));
}

ElementMatrix BarElement::geometric(const AxialForces& forces) const {
  return of_translations(bar_geometric(axis().dx, axis().dy, forces.a, forces.b));
}

LineShapes BarElement::across_once(double part) const { return linear_once(axis().length, part); }

LineShapes BarElement::across_twice(double part) const { return linear_twice(axis().length, part); }

BarElement::Ends BarElement::slope(double /*part*/) const {
  const double rise = 1.0 / axis().length;
  Ends row;
  row << rise * axis().s, -rise * axis().c, 0.0, -rise * axis().s, rise * axis().c, 0.0;
  return row;
}

}  // namespace signorini
