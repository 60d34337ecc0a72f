// selection.hpp: some rows and columns of a sparse matrix.
//
//   S = [e_i1 e_i2 ...],   S^T A S = A(i, i),   S x scatters x to its original positions
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// Columns are unit vectors; n x m, m being the number of indices.
[[nodiscard]] SparseMatrix selection(const std::vector<int>& indices, int n);

/// Selection of the degrees of freedom with mass > 0, or of the others.
[[nodiscard]] SparseMatrix select_by_mass(const SparseMatrix& mass, bool with_mass);

/// Number of degrees of freedom with mass.
[[nodiscard]] int degrees_with_mass(const SparseMatrix& mass);

}  // namespace signorini
