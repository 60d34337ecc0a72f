#include "linear/dof_kinds.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

std::vector<DofKind> dof_kinds(const Model& model, const Structure& structure) {
  const auto n = static_cast<std::size_t>(structure.size);
  std::vector<double> damping(n, 0.0);
  for (std::size_t p = 0; p < structure.row.size(); ++p)
    damping[static_cast<std::size_t>(structure.row[p])] += std::abs(structure.c[p]);
  std::vector<DofKind> kinds(n, DofKind::massive);
  for (std::size_t i = 0; i < n; ++i)
    if (model.dofs[i].massless) kinds[i] = damping[i] > 0.0 ? DofKind::damped : DofKind::algebraic;
  return kinds;
}

bool has_massless(const Model& model) {
  return std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; });
}

}  // namespace signorini
