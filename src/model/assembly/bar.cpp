#include "model/assembly/bar.hpp"

#include <cmath>

namespace signorini {

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

}  // namespace signorini
