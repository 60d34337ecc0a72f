// mixed_shapes.hpp: perturbation of a reduced model's shapes by roundings of K.
//
//   x_i' = x_i + sum_j C_ij x_j,   C_ij = d_ij / (lambda_i m_j - K_jj),   lambda_i = K_ii/m_i, i with mass
//   d_ij = delta r_ij |x_i|^T |K| |x_j|,   r_ij = r_ji,   1/2 <= |r_ij| <= 1
//
// A rounding of each entry of K couples two shapes by d, which leaves K_ii unchanged and rotates the shapes. So the
// forms of contacts, loads and the initial state change; the structure is the same. If a soft motion consists of stiff
// members, its shape is off by ten thousand roundings. Shapes with nearly equal frequencies are unchanged: any two
// shapes of their plane are equivalent.
#pragma once

#include <functional>

#include "signorini/model.hpp"

namespace signorini {

/// The model must be reduced; coupling: delta r_ij of a pair, the same for (i, j) and (j, i).
void mix_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model);

}  // namespace signorini
