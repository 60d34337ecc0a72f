// contacts.hpp: contacts of a scene as forms on the degrees of freedom.
//
//   g = gap + n . u,    ut = t . u - int_0^t surface_velocity
#pragma once

#include <vector>

#include "model/assembly/assembly.hpp"
#include "signorini/model.hpp"

namespace signorini::assembly {

/// Errors: SceneError for a contact that can never act, for friction without tangential stiffness under `compliant`,
/// and for a prescribed normal force that becomes tensile before t_end.
[[nodiscard]] std::vector<Contact> make_contacts(const Scene& scene, const DofMap& map);

}  // namespace signorini::assembly
