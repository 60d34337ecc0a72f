// make_outputs.hpp: the outputs of a scene as functionals of the computed model.
//
//   displacement   d.u            velocity  d.v          acceleration  d.a + d.r a_b(t)
//   member_force   N, V or M in a section of a member (element/element.hpp)
//   stress         of a member: from N and M in a section (structure_rows.hpp); of a body: a component in
//                  axes along `direction` and across (element/nodal_stress.hpp)
//   envelope       the largest value in all sections of a part of a member
//   contact        N, T, gap = g0 + n.u, slip = t.u - s(t) - T / kt, loss
//   spring         preload + k d.u + c d.v
//   combination    sum_i c_i r_i
//
// All outputs except those of contacts are first formed with the physical degrees of freedom. They are then converted
// to the computed degrees of freedom: S^T x for a reduced model, B^T x if massless motions have a separate
// basis.
#pragma once

#include "model/assembly/dofs.hpp"

namespace signorini::outputs {

/// Sets Model::outputs and Model::reaction_sums; the last step of building a model. Errors: SceneError.
void make_outputs(const Scene& scene, const assembly::DofMap& map, Model& model);

}  // namespace signorini::outputs
