// reduction.hpp: a model with the modes up to a cutoff, and the static compliance of all others.
//
//   u = Phi q + Psi_h h + Psi r
//   M = diag(1, 1, 0),   K = diag(omega^2, omega_h^2, 1)        but for the scale of each shape
//
// Phi: modes with omega <= cutoff, free motions included (model/reduce/kept_modes.hpp). Psi_h and Psi span
// the static answers G_res f of all other modes to every direction f along which something acts: normals and
// tangents of contacts, loads, weight and motion of the base. So static displacements and the compliance at
// contacts and loads are those of the full model.
//
// Psi has no mass, and follows at once (MacNeal). Psi_h keeps its mass (Rubin): directions that need it,
// which are those of rigid contacts, of sliders that stick rigidly, of Stribeck's friction, and of contacts
// with dashpots. Psi is K-orthogonal to G_res f_h, and f_h . Psi = (G_res f_h)^T K Psi = 0: what needs mass
// never meets a shape without.
//
// C is R^T C R, without the part alpha M on Psi, whose mass is left out, too. Psi is turned so that the
// dampers give each shape a time constant of its own, or none.
//
// beta K acts on Psi only where it over-damps every mode left out. A mode left out,
//
//   z'' + beta omega^2 z' + omega^2 z = f,
//
// swings where beta omega <= 2. Its inertia, which is left out, then holds z back longer than beta does, 1/omega >=
// beta/2. By beta alone a shape would go after a jump of f with z' = f/(omega^2 beta) and z'' = z'/beta: the more, the
// less is damped. So it follows at once, as without damping. With beta omega > 2 z creeps behind f with the time constant
// beta, and so does the shape.
//
// Each shape is scaled to a greatest translation of 1 (rotations count with the scales of the scene), so that
// tolerances of displacements mean for its amplitude what they say.
//
//   reduce(scene, dampers, model);     // a complete model; before shear elements
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// dampers: C without alpha M + beta K; n x n. dashpots: the same without what it takes from beta K for frozen forces
/// (run.geometric), which is left out with beta K. Errors: SceneError where a motion without mass has no
/// stiffness, where K has negative energy, and where what needs mass would have none.
void reduce(const Scene& scene, const SparseMatrix& dampers, const SparseMatrix& dashpots, Model& model);

/// Whether shapes without mass are damped by beta; first_left_out: Reduction's (0: no mode is left out, so that they are
/// what has no mass in the structure itself).
[[nodiscard]] bool static_shapes_creep(double beta, double first_left_out);

}  // namespace signorini
