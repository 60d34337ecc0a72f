// bar.hpp: the bar of a truss, hinged at both ends.
//
//   K = EA/L [ e e^T  -e e^T; -e e^T  e e^T ],   M = rho L/6 [2 I  I; I  2 I],   e = (dx, dy)/L
//
// in the scene's axes; its mass resists in both directions, or a bar could be turned for nothing. A lumped
// mass is rho L/2 at each end. Unknowns as in beam.hpp; rows and columns of the rotations are zero.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), sections 5.4 and 11.2.
#pragma once

#include "model/assembly/beam.hpp"

namespace signorini {

/// Stiffness of a bar that spans (dx, dy); force per length.
[[nodiscard]] BeamMatrix bar_stiffness(double dx, double dy, double ea);

/// Geometric stiffness of a bar that spans (dx, dy) under an axial force, tension positive: that of a string, N/L
/// across it. Where the force goes linearly from a to b its mean counts.
[[nodiscard]] BeamMatrix bar_geometric(double dx, double dy, double force_a, double force_b);

/// Mass matrix of a bar that spans (dx, dy).
[[nodiscard]] BeamMatrix bar_mass(double dx, double dy, double mass_per_length, MassKind kind);

}  // namespace signorini
