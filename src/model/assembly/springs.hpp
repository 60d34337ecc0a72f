// springs.hpp: stiffness matrix plus line springs, and the range of stiffnesses that a scene may have.
//
//   K + sum_k s_k a_k a_k^T
//
// Shapes: K n x n, symmetric, both triangles stored; a_k sparse forms on n degrees of freedom.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

struct LineSpring {
  Combination form;
  double stiffness = 0.0;
};

/// K plus the stiffness of the springs.
[[nodiscard]] SparseMatrix with_springs(const SparseMatrix& k, const std::vector<LineSpring>& springs);

/// Normal and tangential springs of all contacts, also of open or sliding ones.
[[nodiscard]] std::vector<LineSpring> contact_springs(const std::vector<Contact>& contacts);

/// The form as a full vector of length n.
[[nodiscard]] Vector dense_vector(const Combination& form, int n);

/// |x|^T |K| |x|: magnitude of the terms of x^T K x. The rounding error of x^T K x is this magnitude times eps.
[[nodiscard]] double term_magnitude(const SparseMatrix& k, const Vector& x);

// Refuses scenes whose stiffness ratio overflows when squared.
//
//   k_max / k_min <= sqrt(greatest double) = 1.34e154,   k: EA/L, EI/L^3, springs, contacts [force/length]
//
// Energies and Rayleigh quotients contain ratios k^2 / k'^2, which beyond this limit overflow or underflow in
// any units. Such a stiffness is a typing error, or is meant as a rigid body or as a missing member.

/// Errors: SceneError at the stiffest or the softest part, whichever stiffness is farther from 1 on a logarithmic scale.
void check_stiffness_range(const Scene& scene, const DofMap& map);

}  // namespace signorini::assembly
