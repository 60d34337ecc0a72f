#include "model/assembly/selection.hpp"

namespace signorini {

SparseMatrix selection(const std::vector<int>& indices, int n) {
  SparseMatrix s(n, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t j = 0; j < indices.size(); ++j) s.insert(indices[j], static_cast<int>(j)) = 1.0;
  return s;
}

SparseMatrix select_by_mass(const SparseMatrix& mass, bool with_mass) {
  const auto n = static_cast<int>(mass.rows());
  std::vector<int> indices;
  for (int i = 0; i < n; ++i)
    if ((mass.coeff(i, i) > 0.0) == with_mass) indices.push_back(i);
  return selection(indices, n);
}

int degrees_with_mass(const SparseMatrix& mass) {
  return static_cast<int>((mass.diagonal().array() > 0.0).count());
}

}  // namespace signorini
