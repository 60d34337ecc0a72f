// selection.hpp: some rows and columns of a sparse matrix.
//
//   S = [e_i1 e_i2 ...],   S^T A S = A(i, i),   S x puts x back to where it was
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// Columns are unit vectors; n x m, m the number of indices.
[[nodiscard]] SparseMatrix selection(const std::vector<int>& indices, int n);

/// Degrees of freedom whose mass is > 0, or the others.
[[nodiscard]] SparseMatrix select_by_mass(const SparseMatrix& mass, bool with_mass);

/// How many degrees of freedom have mass.
[[nodiscard]] int degrees_with_mass(const SparseMatrix& mass);

}  // namespace signorini
