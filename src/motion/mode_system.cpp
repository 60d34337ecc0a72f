#include "motion/mode_system.hpp"

#include <algorithm>

namespace signorini {

void FactorisedMode::solve(double* x, double* y) const {
  if (by_mass) return by_mass->solve(x, y);
  if (!dense()) {
    sparse.solve(x, y);
    return;
  }
  const std::size_t size = unknowns.size();
  const double* column = inverse.data();
  for (std::size_t i = 0; i < size; ++i) y[i] = column[i] * x[0];
  for (std::size_t j = 1; j < size; ++j) {
    column += size;
    const double xj = x[j];
    if (xj == 0.0) continue;
    for (std::size_t i = 0; i < size; ++i) y[i] += column[i] * xj;
  }
  std::copy(y, y + size, x);
}

std::size_t FactorisedMode::bytes() const {
  return sizeof(*this) + kinds.size() * sizeof(DofKind) + pinned.size() * sizeof(Pinned) +
         by_rate.size() * sizeof(std::size_t) + sparse.bytes() + (by_mass ? by_mass->bytes() : 0) +
         (inverse.size() + from_u.size() + from_v.size()) * sizeof(double);
}

}  // namespace signorini
