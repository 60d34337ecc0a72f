// shooting.hpp: Newton's method for the state of a periodic orbit at a section.
//
//   (Phi - I) B x = -(z(T) - z)                                   forced
//   [ B^T Phi B - I   z'(T) ] [ x  ]   [ -B^T (z(T) - z) ]
//   [ z'(0)^T B         0   ] [ dT ] = [        0         ]        self-excited
//
// A conservative motion has one more row: dE/dz B x = E* - E, E: stored energy, dE/dz = (-M a, M v, T/kt).
//
// x: change of the coordinates at the section. As least-norm solution, x has no part along directions with a
// multiplier of 1. A step is halved until the residual decreases. The residual is relative to the amplitude of the
// motion, separately for u, v and T.
#pragma once

#include <optional>

#include "orbit/period_map.hpp"
#include "signorini/orbit.hpp"

namespace signorini::orbit {

struct ShootingStart {
  OrbitState state;
  double duration;
  bool free_period = false;
  /// Residual up to which an orbit is accepted although Newton's method stagnates; 0: default 1e-9.
  double closed = 0.0;
  std::optional<double> energy = {};  ///< E* of a conservative motion, in the scene's unit
};

/// Result of the iteration.
struct ShootingResult {
  bool closed = false;
  std::string reason;  ///< reason for a failure
  bool interrupted = false;
  OrbitState state;  ///< state at the section
  double duration = 0.0;
  double residual = 0.0;
  OrbitPass pass;  ///< pass that begins at `state`
  std::vector<OrbitStep> steps;
};

/// max |z(T) - z| / amplitude of each kind (u, v, T); at rest the scales replace the amplitudes.
[[nodiscard]] double orbit_residual(const Model& model, const OrbitPass& pass);

/// max |gap| / amplitude of each kind (u, v, T). gap: any difference of two states, in coordinates at the section of the
/// pass, which determines the amplitudes.
[[nodiscard]] double gap_residual(const OrbitSection& section, const OrbitPass& pass, const Vector& gap);

/// Noise of the map: |z2 - z1 - Phi (z1 - z0)| / amplitude, where z1 and z2 are the images of z0 and z1.
/// nullopt if Phi is unknown, or if the two passes have different events.
[[nodiscard]] std::optional<double> map_noise(const Model& model, const OrbitPass& first,
                                              const OrbitPass& second);
/// An orbit is accepted if its residual is at most accepted_noise_factor times the noise, since a residual is
/// a difference of two states. A noise above max_noise is not accepted. Chosen values.
inline constexpr double accepted_noise_factor = 10.0, max_noise = 1e-6;

/// dE/dz B: derivative of the stored energy, in the scene's unit, with respect to the coordinates at the section.
[[nodiscard]] Vector energy_slope(const Model& model, const OrbitPass& pass, const OrbitSection& section);

/// B^T Phi B of a pass with tangents.
[[nodiscard]] Eigen::MatrixXd monodromy(const Model& model, const OrbitPass& pass);

/// Newton's method from `start`, until the residual is below the tolerance.
[[nodiscard]] ShootingResult shoot(const PeriodMap& map, const ShootingStart& start, double tolerance);

}  // namespace signorini::orbit
