#include "model/carried.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/bowl.hpp"
#include "model/assembly/springs.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

// Forces that an equilibrium reproduces within this number of roundings of their inputs are converged. Chosen value;
// each round is one solve with K.
constexpr double settled = rounding::of_many;
constexpr int rounds = 50;

bool is_pressed_pendulum(const ContactSpec& contact) {
  return contact.bowl && contact.capabilities().normal_spring;
}

/// Initial guess: the given forces, or the sum of the loads shared evenly. Its size affects only the number of rounds;
/// it is not zero, because a structure that stands on pendulums alone would then be a mechanism.
std::vector<double> first_guess(const Scene& scene, const Model& model) {
  double pushed = 0.0, bearings = 0.0;
  for (const Load& load : model.loads)
    if (load.is_static)
      for (const auto& [dof, factor] : load.direction.terms)
        pushed += std::abs(factor * load.history.value(0.0));
  for (const ContactSpec& contact : scene.contacts) bearings += is_pressed_pendulum(contact) ? 1.0 : 0.0;
  std::vector<double> forces;
  for (const ContactSpec& contact : scene.contacts)
    forces.push_back(!contact.bowl                                                  ? 0.0
                     : !is_pressed_pendulum(contact) || contact.bowl->carried > 0.0 ? contact.bowl->carried
                                                                                    : pushed / bearings);
  return forces;
}

/// Magnitude to which the rounding of N = kn (g0 + n . u) is relative: N itself; its terms, which are much larger if
/// the structure lies far along an inclined surface; and the forces K u that balance it. Unit: force.
std::vector<double> summed(const Scene& scene, const Model& model) {
  const Vector forces = model.stiffness.cwiseAbs() * model.u0.cwiseAbs();
  double greatest = 0.0;
  for (int i = 0; i < model.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation) greatest = std::max(greatest, forces[i]);
  std::vector<double> sizes;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const double terms = c.normal_stiffness * (std::abs(c.gap) + c.normal.magnitude(model.u0));
    sizes.push_back(std::max(0.0, model.statics.reactions[k]) + terms + greatest);
  }
  return sizes;
}

}  // namespace

bool has_pressed_pendulums(const Scene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), is_pressed_pendulum);
}

void carry(const Scene& scene, const std::vector<double>& forces, Model& model) {
  std::vector<LineSpring> springs;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    if (!scene.contacts[k].bowl) continue;
    Contact& contact = model.contacts[k];
    contact.bowl->carried = forces[k];
    if (const double more = beyond_spring(scene.contacts[k], contact); more != 0.0)
      springs.push_back({contact.tangent, more});
  }
  if (!springs.empty()) model.stiffness = with_springs(model.stiffness, springs);
}

void start_on_pendulums(const Scene& scene, Model& model, const std::function<Model(Model)>& start) {
  std::vector<double> forces = first_guess(scene, model);
  for (int round = 0; round < rounds; ++round) {
    Model begun = model;
    carry(scene, forces, begun);
    begun = start(std::move(begun));
    const std::vector<double> sizes = summed(scene, begun);
    bool same = true;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      if (!is_pressed_pendulum(scene.contacts[k])) continue;
      const double bears = std::max(0.0, begun.statics.reactions[k]);
      same = same && std::abs(bears - forces[k]) <= settled * sizes[k];
      forces[k] = bears;
    }
    if (!same) continue;
    model = std::move(begun);
    return;
  }
  throw SceneError(scene.initial.place, "run.initial",
                   "what pendulums bear does not settle: with each force that they bear the structure "
                   "stands elsewhere, and presses them otherwise");
}

std::vector<double> carried_before(const Scene& scene) {
  std::vector<double> forces;
  for (const ContactSpec& contact : scene.contacts) {
    forces.push_back(contact.bowl ? contact.bowl->carried : 0.0);
    if (scene.initial.saved)
      for (const auto& [name, force] : scene.initial.saved->carried)
        if (name == contact.name) forces.back() = force;
  }
  return forces;
}

}  // namespace signorini
