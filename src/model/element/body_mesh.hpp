// body_mesh.hpp: a body as plane elements, and removal of the mass from nodes of contact surfaces.
//
//   u_b = sum_i w_bi u_i,   sum_i w_bi = 1,   sum_i w_bi x_i = x_b       b: a node without mass, i: nodes near it
//   M' = W^T M W
//
// W reproduces every rigid-body motion, so M' has the total mass, centre and inertia of M, and zero rows at b. The
// weights w_bi minimise sum w^2 over the nodes with mass of the elements at b; if these nodes are collinear, nodes of
// neighbouring elements are added.
#pragma once

#include "model/element/mesh.hpp"
#include "model/element/plane_element.hpp"

namespace signorini::element {

/// The material of a body's elements.
[[nodiscard]] PlaneMaterial material_of(const BodySpec& body);

/// Appends the elements of body `number` of Scene::bodies. Errors: SceneError if the mass of a node cannot be moved.
void mesh_body(Mesh& mesh, const Scene& scene, std::size_t number);

}  // namespace signorini::element
