#include "model/shear.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "model/assembly/springs.hpp"
#include "scene/saved_state.hpp"

namespace signorini {
namespace {

constexpr double fastest = 1e-6;  // time constant of a dashpot times the highest frequency

SparseMatrix enlarged(const SparseMatrix& matrix, int size) {
  SparseMatrix result = matrix;
  result.conservativeResize(size, size);
  return result;
}

}  // namespace

void add_shear_elements(const Scene& scene, Model& model) {
  std::vector<LineSpring> stiffness, damping;
  std::vector<double> u, v;
  const int before = model.size();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& contact = model.contacts[k];
    const double ct = scene.contacts[k].tangential_damping;
    const bool by_rate = contact.friction.rises() && contact.tangential_stiffness;
    if ((ct == 0.0 && !by_rate) || !contact.has_friction()) continue;
    const double kt = *contact.tangential_stiffness;
    // Below this the element would respond immediately, within rounding.
    if (ct > 0.0 && ct / kt * model.omega_max < fastest)
      throw SceneError(
          scene.contacts[k].place, scene.contacts[k].key("tangential_damping"),
          fmt::format("tangential_damping / tangential_stiffness = {:.3g} is a time constant far "
                      "below the shortest period of the structure, {:.3g}; give 0.0 or more",
                      ct / kt, 2.0 * std::numbers::pi / model.omega_max));
    // On a body without mass the dashpot alone cannot determine the body's motion, only the rate of p relative to it.
    // Then p - ut is the degree of freedom.
    const bool relative = std::any_of(
        contact.tangent.terms.begin(), contact.tangent.terms.end(),
        [&](const auto& term) { return model.dofs[static_cast<std::size_t>(term.first)].massless; });
    const int p = model.size();
    model.dofs.push_back({contact.name + ".slip", contact.name + ".slip_rate", false, true});
    const double body = contact.tangent.dot(model.u0);
    std::optional<double> saved;
    if (scene.initial.saved) saved = saved_motion(*scene.initial.saved, contact.name + ".slip");
    const double element = saved ? body - *saved : contact.initial_shear / kt;  // deformation of the element
    u.push_back((relative ? 0.0 : body) - element);
    v.push_back(contact.surface_motion.piece(0.0).value(0.0, 1));
    Combination between = relative ? Combination{} : contact.tangent;
    between.terms.emplace_back(p, -1.0);
    stiffness.push_back({between, kt});
    damping.push_back({between, ct});
    contact.shear = ShearElement{contact.tangent, kt, ct};
    contact.tangential_stiffness.reset();
    if (!relative) contact.tangent.terms.clear();
    contact.tangent.terms.emplace_back(p, 1.0);
  }
  const int size = model.size();
  if (size == before) return;
  model.mass = enlarged(model.mass, size);
  model.stiffness = with_springs(enlarged(model.stiffness, size), stiffness);
  model.damping = with_springs(enlarged(model.damping, size), damping);
  for (Vector* x : {&model.u0, &model.v0}) x->conservativeResize(size);
  for (int i = before; i < size; ++i) {
    model.u0[i] = u[static_cast<std::size_t>(i - before)];
    model.v0[i] = v[static_cast<std::size_t>(i - before)];
  }
}

}  // namespace signorini
