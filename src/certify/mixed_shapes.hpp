// mixed_shapes.hpp: shapes of a reduced model, off by what roundings of K make of them.
//
//   x_i' = x_i + sum_j C_ij x_j,   C_ij = d_ij / (lambda_i m_j - K_jj),   lambda_i = K_ii/m_i, i with mass
//   d_ij = delta r_ij |x_i|^T |K| |x_j|,   r_ij = r_ji,   1/2 <= |r_ij| <= 1
//
// A rounding of each entry of K couples two shapes by d, which leaves K_ii as it is and turns the shapes. So contacts, loads
// and the initial state see other forms; the structure is the same. Where a soft motion is made of stiff members its shape
// is off by ten thousand roundings. Shapes of nearly one frequency are left: any two of their plane are as good.
#pragma once

#include <functional>

#include "signorini/model.hpp"

namespace signorini {

/// The model is reduced; coupling: delta r_ij of a pair, the same for (i, j) and (j, i).
void mix_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model);

}  // namespace signorini
