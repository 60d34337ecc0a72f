// model_warnings.hpp: warnings about valid input that probably is a mistake; the scene is computed as given.
//
//   load without effect                 direction . u = 0 for all u
//   unconnected rotations               massless.hpp
//   a part leaves its contacts          n . a >= 0 at all of them; a = Z (Z^T M Z)^-1 Z^T P: acceleration of a part in
//                                       free fall (Z: motions without stiffness) under the static loads
//   weight applied suddenly at t = 0    contacts with zero gap, without a static start
//   drag                                alpha M acts on rigid-body motions: v ~ exp(-alpha t)
//   friction above 2                    probably an angle or a percentage
//   initial_shear in a static start     a static start has no friction that could carry it
//   initial values without mass         equilibrium determines these values (initial_state.hpp)
//   different structure                 the continued run had another structure
//   a pulse too short for doubles       shorter than 100 eps (t + t_end)
//   a support that jumps at t = 0       or whose velocity jumps: the run starts after the jump
//   flutter after a frictional start    contacts slip at their limits (slip_growth.hpp); divergence is an error
#pragma once

#include <string>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/modes/modes.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::model {

/// Returns the warnings, one sentence each. The model must be complete (damping and initial state set), but not yet reduced,
/// and without shear elements. Errors: SceneError for divergence of slip at the friction limits.
[[nodiscard]] std::vector<std::string> model_warnings(const Scene& scene, const assembly::DofMap& map,
                                                      const Model& model);

// Effective amplitude of a load or a compression that acts only for a short time.
//
//   effective amplitude = min( A, c w J ),   A = max |f|,   J = max_t int_t^(t + 1/w) |f| dt,   c = 16
//
// An oscillator of frequency w at rest responds with |u| <= min( 2 A, w int |f| dt ) / k. A load that acts for more
// than 1/(c w) (a hundredth of the period) therefore has its full amplitude; the effective amplitude of a shorter load
// follows from its impulse. In J each piece of f enters with its largest |f|. w: frequency along the static response
// u = K^-1 p to the load, w^2 = u.p / u.M u, with initially closed contacts fixed; without such a response, the lowest
// frequency. A motion whose phase angle in the run stays below 1 rad is a free motion: w = 64 / t_end, so that a load
// that acts for a thousandth of the run has its full amplitude.

/// Effective amplitude of a load, relative to its largest amplitude.
struct EffectiveLoad {
  double share = 1.0;       ///< effective / full amplitude; exactly 1 for loads that act long enough
  double free_share = 1.0;  ///< effective / full amplitude for a free motion: J over the whole run
};

struct EffectiveAmplitudes {
  std::vector<EffectiveLoad> loads;
  std::vector<double> compressions;  ///< effective / full normal_force of each slider; w: lowest frequency
};

/// omega: lowest frequency of the constrained structure; 0 if there is none.
[[nodiscard]] EffectiveAmplitudes effective_amplitudes(const Model& model,
                                                       const modes::ContactConstraints& holding, double omega,
                                                       double t_end);

}  // namespace signorini::model
