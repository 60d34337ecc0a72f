// bar.hpp: the bar of a truss, hinged at both ends.
//
//   K = EA/L [ e e^T  -e e^T; -e e^T  e e^T ],   M = rho L/6 [2 I  I; I  2 I],   e = (dx, dy)/L
//
// in the scene's axes. The mass acts in both directions; otherwise a bar would have no rotational inertia. A lumped
// mass is rho L/2 at each end. The matrices have the unknowns of beam.hpp, with zero rows and columns of the rotations;
// the element itself has only ux and uy of both ends.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), sections 5.4 and 11.2.
#pragma once

#include "model/element/beam.hpp"

namespace signorini {

/// Stiffness of a bar that spans (dx, dy); force per length.
[[nodiscard]] BeamMatrix bar_stiffness(double dx, double dy, double ea);

/// Geometric stiffness of a bar that spans (dx, dy) under an axial force, tension positive: that of a string, N/L
/// across it. For a force that varies linearly from a to b the mean is used.
[[nodiscard]] BeamMatrix bar_geometric(double dx, double dy, double force_a, double force_b);

/// Mass matrix of a bar that spans (dx, dy).
[[nodiscard]] BeamMatrix bar_mass(double dx, double dy, double mass_per_length, MassKind kind);

class BarElement final : public LineElement {
 public:
  using LineElement::LineElement;

  [[nodiscard]] std::vector<ElementUnknown> unknowns() const override;
  [[nodiscard]] ElementMatrix mass() const override;
  [[nodiscard]] ElementMatrix stiffness() const override;
  [[nodiscard]] ElementMatrix geometric(const AxialForces& forces) const override;
  [[nodiscard]] std::vector<ElementLine> lines() const override { return {{0, 1, false}}; }

 private:
  [[nodiscard]] LineShapes across_once(double part) const override;
  [[nodiscard]] LineShapes across_twice(double part) const override;
  [[nodiscard]] Ends slope(double part) const override;
};

}  // namespace signorini
