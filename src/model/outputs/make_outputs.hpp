// make_outputs.hpp: the outputs of a scene as functionals of the model that is computed.
//
//   displacement   d.u            velocity  d.v          acceleration  d.a + d.r a_b(t)
//   member_force   a cut of a finite element (element/element.hpp); stress: of its N and M (member_cuts.hpp)
//   stress         of a body: a component in axes along `direction` and across (element/nodal_stress.hpp)
//   envelope       cuts at the points of each element: the greatest along it
//   contact        N, T, gap = g0 + n.u, slip = t.u - s(t) - T / kt, loss
//   spring         preload + k d.u + c d.v
//   combination    sum_i c_i r_i
//
// All but contacts are made of the physical degrees of freedom, and then led to those that are computed:
// S^T x of a reduced model, B^T x where massless motions have a basis of their own.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini {

/// Model::outputs, and Model::reaction_sums; comes last in the making of a model. Errors: SceneError.
void make_outputs(const Scene& scene, const DofMap& map, Model& model);

}  // namespace signorini
