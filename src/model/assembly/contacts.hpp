// contacts.hpp: contacts and loads of a scene as forms on the degrees of freedom.
//
//   g = gap + n . u,    ut = t . u - int_0^t surface_velocity,    P(t) = sum_i d_i f_i(t)
#pragma once

#include <vector>

#include "model/assembly/assembly.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Errors: SceneError for a contact that can never act, for friction without tangential stiffness under
/// `compliant`, and for a compression that is known to become negative before t_end.
[[nodiscard]] std::vector<Contact> make_contacts(const Scene& scene, const DofMap& map);

/// Gravity first (when it acts), then the loads in the order of the file, then the motion of the base.
[[nodiscard]] std::vector<Load> make_loads(const Scene& scene, const DofMap& map, const Assembly& assembly);

/// Sum of the static loads; n.
[[nodiscard]] Vector static_load(const std::vector<Load>& loads, int n);

}  // namespace signorini
