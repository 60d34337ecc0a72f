#include "model/shear.hpp"

#include <fmt/core.h>

#include <numbers>

namespace signorini {
namespace {

constexpr double fastest = 1e-6;  // time constant of a dashpot times the highest frequency

/// Adds value * form form^T.
void add_square(const Combination& form, double value, std::vector<Eigen::Triplet<double>>& entries) {
  for (const auto& [i, a] : form.terms)
    for (const auto& [j, b] : form.terms) entries.emplace_back(i, j, value * a * b);
}

SparseMatrix enlarged(const SparseMatrix& matrix, int size,
                      const std::vector<Eigen::Triplet<double>>& added) {
  std::vector<Eigen::Triplet<double>> entries = added;
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), j, it.value());
  SparseMatrix result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

void add_shear_elements(const Scene& scene, Model& model) {
  std::vector<Eigen::Triplet<double>> stiffness, damping;
  std::vector<double> u, v;
  const int before = model.size();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& contact = model.contacts[k];
    const double ct = scene.contacts[k].tangential_damping;
    if (ct == 0.0 || !contact.has_friction()) continue;
    const double kt = *contact.tangential_stiffness;
    // Below this the element would follow at once, within the rounding of everything else.
    if (ct / kt * model.omega_max < fastest)
      throw SceneError(
          scene.contacts[k].place, "contacts." + contact.name + ".tangential_damping",
          fmt::format("tangential_damping / tangential_stiffness = {:.3g} is a time constant far "
                      "below the shortest period of the structure, {:.3g}; give 0.0 or more",
                      ct / kt, 2.0 * std::numbers::pi / model.omega_max));
    const int p = model.size();
    model.dofs.push_back({contact.name + ".slip", contact.name + ".slip_rate", false, true});
    u.push_back(contact.tangent.dot(model.u0) - contact.initial_shear / kt);
    v.push_back(contact.surface_motion.piece(0.0).value(0.0, 1));
    Combination element = contact.tangent;
    element.terms.emplace_back(p, -1.0);
    add_square(element, kt, stiffness);
    add_square(element, ct, damping);
    contact.shear = ShearElement{contact.tangent, kt, ct};
    contact.tangential_stiffness.reset();
    contact.tangent.terms = {{p, 1.0}};
  }
  const int size = model.size();
  if (size == before) return;
  model.mass = enlarged(model.mass, size, {});
  model.stiffness = enlarged(model.stiffness, size, stiffness);
  model.damping = enlarged(model.damping, size, damping);
  for (Vector* x : {&model.u0, &model.v0}) x->conservativeResize(size);
  for (int i = before; i < size; ++i) {
    model.u0[i] = u[static_cast<std::size_t>(i - before)];
    model.v0[i] = v[static_cast<std::size_t>(i - before)];
  }
}

}  // namespace signorini
