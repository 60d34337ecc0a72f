// beam.hpp: the plane Euler-Bernoulli beam element.
//
//   axial    EA/L [1 -1; -1 1]                  rho L/6 [2 1; 1 2]
//   bending  EI/L^3 [12 6L -12 6L; ...]         rho L/420 [156 22L 54 -13L; ...]
//
//   force N  N/30L [36 3L -36 3L; ...]  for v, rz: the integral of N v'^2, N linear from a to b
//
// in its own axes (x from a to b, y to the left), rotated into the scene's axes. Unknowns of an element: ux, uy, rz at
// a, then at b; rz counter-clockwise. rho: mass per length. A lumped mass puts rho L/2 on ux and uy of both ends and
// none on the rotations.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), sections 5.6, 11.3 and 15.2.
#pragma once

#include "model/element/line_element.hpp"

namespace signorini {

using BeamMatrix = Eigen::Matrix<double, 6, 6>;

/// Stiffness in the scene's axes of a beam that spans (dx, dy); force per length, moments per radian.
[[nodiscard]] BeamMatrix beam_stiffness(double dx, double dy, double ea, double ei);

/// Geometric stiffness in the scene's axes of a beam that spans (dx, dy) under an axial force, tension positive, that
/// varies linearly from a to b.
[[nodiscard]] BeamMatrix beam_geometric(double dx, double dy, double force_a, double force_b);

/// Mass matrix in the scene's axes of a beam that spans (dx, dy).
[[nodiscard]] BeamMatrix beam_mass(double dx, double dy, double mass_per_length, MassKind kind);

/// The flexibility of its bend is included in EI.
class BeamElement final : public LineElement {
 public:
  using LineElement::LineElement;

  [[nodiscard]] std::vector<ElementUnknown> unknowns() const override;
  [[nodiscard]] bool has_own() const override { return data().hinged_a || data().hinged_b; }
  [[nodiscard]] ElementMatrix mass() const override;
  [[nodiscard]] ElementMatrix stiffness() const override;
  [[nodiscard]] ElementMatrix geometric(const AxialForces& forces) const override;
  [[nodiscard]] std::vector<ElementLine> lines() const override { return {{0, 1, true}}; }

 private:
  [[nodiscard]] LineShapes across_once(double part) const override;
  [[nodiscard]] LineShapes across_twice(double part) const override;
  [[nodiscard]] Ends slope(double part) const override;
};

}  // namespace signorini
