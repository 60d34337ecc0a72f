// shooting.hpp: Newton's method on the state at a section.
//
//   (Phi - I) B x = -(z(T) - z)                                   forced
//   [ B^T Phi B - I   z'(T) ] [ x  ]   [ -B^T (z(T) - z) ]
//   [ z'(0)^T B         0   ] [ dT ] = [        0         ]        driven by itself
//
// and of a conservative motion a row more: dE/dz B x = E* - E, E: what is stored, dE/dz = (-M a, M v, T/kt).
//
// x is the shortest solution: directions with a multiplier of 1 are left as they are. A step is halved until the
// residual falls. The residual is relative to the amplitude of the motion: that of u, v and T each by its own.
#pragma once

#include <optional>

#include "orbit/period_map.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

struct ShootingStart {
  OrbitState state;
  double duration;
  bool free_period = false;
  double closed = 0.0;  ///< residual with which an orbit is closed whose residual no longer falls; 0: 1e-9
  std::optional<double> energy = {};  ///< E* of a conservative motion; the scene's units
};

/// Where the iteration ended.
struct Shot {
  bool closed = false;
  std::string reason;  ///< why not
  bool interrupted = false;
  OrbitState state;  ///< at the section
  double duration = 0.0;
  double residual = 0.0;
  OrbitPass pass;  ///< from that state
  std::vector<OrbitStep> steps;
};

/// max |z(T) - z| over the amplitude of its kind. Where nothing moves: over the scales.
[[nodiscard]] double orbit_residual(const Model& model, const OrbitPass& pass);

/// The same of another difference of states at the pass's section, in coordinates.
[[nodiscard]] double residual_of(const OrbitSection& section, const OrbitPass& pass, const Vector& gap);

/// The noise of the map: |z2 - z1 - Phi (z1 - z0)| over the amplitude, where z1, z2 are the images of z0, z1. Nothing where
/// it is not known, or the two passes have other events.
[[nodiscard]] std::optional<double> map_noise(const Model& model, const OrbitPass& first,
                                              const OrbitPass& second);
/// An orbit is closed whose residual is no more than so many times the noise: a residual is a difference of two states. No
/// greater noise is accepted. Chosen, both.
inline constexpr double of_noise_at_last = 10.0, greatest_noise = 1e-6;

/// dE/dz B, in the scene's units.
[[nodiscard]] Vector energy_slope(const Model& model, const OrbitPass& pass, const OrbitSection& section);

/// B^T Phi B of a pass that has tangents.
[[nodiscard]] Eigen::MatrixXd monodromy(const Model& model, const OrbitPass& pass);

[[nodiscard]] Shot shoot(const PeriodMap& map, const ShootingStart& start, double tolerance);

}  // namespace signorini
