// reduction.hpp: a model with the modes up to a cutoff, and the static compliance of all other modes.
//
//   u = Phi q + Psi_h h + Psi r
//   M = diag(1, 1, 0),   K = diag(omega^2, omega_h^2, 1)        up to the scale of each shape
//
// Phi: modes with omega <= cutoff, free motions included (model/reduce/kept_modes.hpp). Psi_h and Psi span the static
// responses G_res f of all other modes to every direction f of a force: normals and tangents of contacts, loads, weight
// and motion of the base. So static displacements and the compliance at contacts and loads equal those of the full model.
//
// Psi has no mass and responds immediately (MacNeal). Psi_h keeps its mass (Rubin). Psi_h is used for directions that need
// mass: along rigid contacts, sliders that stick rigidly, Stribeck friction, and contacts with dashpots.
// Psi is K-orthogonal to G_res f_h, and f_h . Psi = (G_res f_h)^T K Psi = 0: a direction that needs mass is never
// coupled to a massless shape.
//
// The reduced C is R^T C R with R = (Phi, Psi_h, Psi), without the part alpha M on Psi, whose mass is neglected as well.
// Psi is rotated so that the dampers give each shape its own time constant, or none.
//
// beta K acts on Psi only if it overdamps every truncated mode. A truncated mode,
//
//   z'' + beta omega^2 z' + omega^2 z = f,
//
// oscillates if beta omega <= 2. Its response time 1/omega due to inertia, which is neglected, is then longer than beta/2.
// With beta alone a shape would respond to a jump of f with z' = f/(omega^2 beta) and z'' = z'/beta, which grow as the
// damping decreases. So if beta omega <= 2, the shape responds immediately, as without damping. With beta omega > 2, z
// follows f with the time constant beta, and so does the shape.
//
// Each shape is scaled to a largest translation of 1 (rotations by the scene's scales), so that tolerances of
// displacements apply to its amplitude.
//
//   reduce(scene, dampers, model);     // a complete model; before shear elements
#pragma once

#include "signorini/model.hpp"

namespace signorini::reduce {

/// Reduces a model. dampers: C without alpha M + beta K; n x n. dashpots: dampers without the correction of beta K for
/// prestress (run.geometric); used for shapes without beta K. Errors: SceneError if a motion without mass has no stiffness,
/// if K has negative energy, and if no shape with mass moves a direction that needs mass.
void reduce(const Scene& scene, const SparseMatrix& dampers, const SparseMatrix& dashpots, Model& model);

/// True if beta damps the shapes without mass. first_left_out: frequency of the first truncated mode, rad per
/// time; 0: no mode is truncated, and the shapes belong to massless parts of the structure.
[[nodiscard]] bool static_shapes_are_damped(double beta, double first_left_out);

}  // namespace signorini::reduce
