#include "sensitivity/known_laws.hpp"

#include <fmt/core.h>

#include "contact/friction.hpp"
#include "signorini/error.hpp"

namespace signorini {
void check_tangent_laws(const Scene& scene, const Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const bool rises = c.friction.rises();
    const bool remembers = c.law->has_memory();
    const bool multiplies = !c.law->capabilities.linear_guards;
    const char* what = remembers                    ? "a law of contact with a memory"
                       : multiplies                 ? "a law of contact whose guards hold products"
                       : c.curved_surface()         ? "a pendulum whose normal force varies"
                       : rises && c.sliding_point() ? "friction that rises with the slip rate beside a "
                                                      "tangential_stiffness"
                       : c.friction.by_force()      ? named_friction(c)
                       : c.compliance_split()       ? "a rigid contact on parts without mass"
                       : rises && c.takes_impulses()
                           ? "friction that rises with the slip rate at a rigid contact"
                           : nullptr;
    if (what != nullptr)
      throw SceneError(scene.contacts[k].place,
                       scene.contacts[k].key(remembers || multiplies || c.compliance_split() ? "law"
                                             : c.curved_surface()                            ? "radius"
                                                                                             : "friction"),
                       fmt::format("sensitivities do not know {}; take differences of runs (sweep)", what));
  }
}

}  // namespace signorini
