#include "linear/unknowns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/constants.hpp"

namespace signorini::linear {

std::vector<DofKind> dof_kinds(const Model& model, const SystemMatrices& structure) {
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

namespace {

/// A model with the scales, frequencies and damping factors of the whole model, so that decisions that depend on these numbers
/// agree in all parts.
Model with_common_data(const Model& whole) {
  Model model;
  model.units = whole.units;
  model.unit = whole.unit;
  model.internal_units = whole.internal_units;
  model.static_start = whole.static_start;
  model.scales = whole.scales;
  model.alpha = whole.alpha;
  model.beta = whole.beta;
  model.omega1 = whole.omega1;
  model.omega_max = whole.omega_max;
  return model;
}

/// Block of a matrix for the degrees of freedom `dofs`. place: index in the part for each degree of freedom of the whole; -1:
/// not in the part.
SparseMatrix block_of(const SparseMatrix& a, const std::vector<int>& dofs, const std::vector<int>& place) {
  const auto n = static_cast<int>(dofs.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator it(a, dofs[static_cast<std::size_t>(column)]); it; ++it)
      if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0 && it.value() != 0.0)
        entries.emplace_back(row, column, it.value());
  SparseMatrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

Load without_direction(const Load& load) {
  return {load.name, {}, load.history, load.is_static, load.kind, load.direction_unit, load.history_unit};
}

Model restricted(const Model& whole, const std::vector<int>& dofs, const std::vector<std::size_t>& contacts) {
  Model model = with_common_data(whole);
  model.layout = whole.layout.part(contacts);
  std::vector<int> place(whole.dofs.size(), -1);
  const auto n = static_cast<Eigen::Index>(dofs.size());
  model.u0.resize(n);
  model.v0.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int from = dofs[static_cast<std::size_t>(i)];
    place[static_cast<std::size_t>(from)] = static_cast<int>(i);
    model.dofs.push_back(whole.dofs[static_cast<std::size_t>(from)]);
    model.u0[i] = whole.u0[from];
    model.v0[i] = whole.v0[from];
  }
  model.mass = block_of(whole.mass, dofs, place);
  model.damping = block_of(whole.damping, dofs, place);
  model.stiffness = block_of(whole.stiffness, dofs, place);
  const auto renumber = [&](Combination& form) {
    for (auto& [dof, factor] : form.terms) dof = place[static_cast<std::size_t>(dof)];
  };
  for (const std::size_t k : contacts) {
    Contact contact = whole.contacts[k];
    contact::visit_forms(contact, renumber);
    model.contacts.push_back(std::move(contact));
    if (!whole.saved_contacts.empty()) model.saved_contacts.push_back(whole.saved_contacts[k]);
  }
  model.saved_time = whole.saved_time;
  return model;
}

}  // namespace signorini::linear
