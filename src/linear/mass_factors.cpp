#include "linear/mass_factors.hpp"

#include <cstdint>

#include "linear/klu.hpp"

namespace signorini {

std::shared_ptr<const TriangularFactors> mass_factors(const Structure& structure) {
  std::vector<std::int64_t> start(1, 0), row;
  std::vector<double> value;
  for (std::size_t j = 0; j < static_cast<std::size_t>(structure.size); ++j) {
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p) {
      if (structure.m[p] == 0.0) continue;
      row.push_back(structure.row[p]);
      value.push_back(structure.m[p]);
    }
    start.push_back(static_cast<std::int64_t>(row.size()));
  }
  Klu klu(start, row);
  if (!klu.factor(value)) return nullptr;
  return std::make_shared<const TriangularFactors>(klu.factors());
}

std::vector<OwnForces> own_forces(const std::vector<Rows>& rows) {
  std::vector<OwnForces> result;
  result.reserve(rows.size());
  for (const Rows& r : rows) {
    const OwnForces b{r.normal.N, r.normal.T, r.tangent.N, r.tangent.T};
    const bool accelerates =
        r.normal.an != 0.0 || r.normal.at != 0.0 || r.tangent.an != 0.0 || r.tangent.at != 0.0;
    // N from its own row, then T: no elimination that could lose digits.
    if (accelerates || b.normal_T != 0.0 || b.normal_N == 0.0 || b.tangent_T == 0.0) return {};
    result.push_back(b);
  }
  return result;
}

void MassSolver::solve(double* x, double* work) const {
  double* const forces = x + mass_->size();
  const ForceLayout& layout = model_->layout;
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    const OwnForces& b = forces_[c];
    double &in_N = forces[layout.normal(c)], &in_T = forces[layout.tangent(c)];
    const double N = in_N / b.normal_N, T = (in_T - b.tangent_N * N) / b.tangent_T;
    in_N = N;
    in_T = T;
    const Contact& contact = model_->contacts[c];
    if (N != 0.0)
      for (const auto& [dof, factor] : contact.normal.terms) x[dof] -= factor * N;
    if (T != 0.0)
      for (const auto& [dof, factor] : contact.tangent.terms) x[dof] -= factor * T;
  }
  mass_->solve(x, work);
}

}  // namespace signorini
