#include <algorithm>
#include <stdexcept>

#include "model/assembly/loads.hpp"
#include "scene/saved_state.hpp"
#include "signorini/simulate.hpp"

namespace signorini {

SavedState last_state(const Model& model, const Result& result) {
  if (result.rows.empty()) throw std::invalid_argument("last_state: the run has no row");
  const Result::Row& last = result.rows.back();
  SavedState state;
  const std::vector<Dof>& dofs = model.physical_dofs();
  // Sliding points are the last degrees of freedom; "c.slip" represents them.
  const auto sliding = std::count_if(model.contacts.begin(), model.contacts.end(),
                                     [](const Contact& c) { return c.sliding_point() != nullptr; });
  const std::size_t structural = dofs.size() - (model.reduction ? 0 : static_cast<std::size_t>(sliding));
  for (std::size_t i = 0; i < structural; ++i) {
    state.motions.emplace_back(dofs[i].displacement, last.u[static_cast<Eigen::Index>(i)]);
    state.motions.emplace_back(dofs[i].velocity, last.v[static_cast<Eigen::Index>(i)]);
  }
  for (const Load& load : model.loads)
    if (load.kind == LoadKind::support) {
      const Piece& motion = load.history.piece(last.t);
      state.motions.emplace_back(load.name, motion.value(last.t));
      state.motions.emplace_back(rate_of(load.name), motion.value(last.t, 1));
    }
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const ContactSample& contact = last.contacts[k];
    const History& surface = model.contacts[k].surface_motion;
    if (model.contacts[k].sliding_point())
      state.motions.emplace_back(model.contacts[k].name + ".slip", contact.slip + surface.value(last.t));
    if (!surface.is_constant())
      state.motions.emplace_back(model.contacts[k].name + ".surface", surface.value(last.t));
    if (!model.contacts[k].obeys_coulomb())
      state.own.push_back({model.contacts[k].name, number_of(contact.state), contact.memory});
    if (!model.contacts[k].has_friction()) continue;
    state.shears.emplace_back(model.contacts[k].name, last.contacts[k].T);
    state.slips.emplace_back(model.contacts[k].name, slip_sign(last.contacts[k].state));
  }
  const Scales& s = model.scales;
  state.scales = {s.displacement, s.rotation, s.velocity, s.angular_velocity, s.force};
  state.motions.emplace_back(saved_alpha, model.alpha);
  for (const Contact& contact : model.contacts)
    if (const Bowl* surface = contact.curved_surface())
      state.carried.emplace_back(contact.name, surface->carried);
  if (model.geometric) state.frozen = model.geometric->forces;
  return state;
}

}  // namespace signorini
