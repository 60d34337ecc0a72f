// same_states.hpp: models whose contact states have the same matrices.
//
// The same M, C, K, forms, stiffnesses and dampings of contacts, and coefficients of friction: then mode shapes of one serve the
// other. Loads, gaps, surfaces and starts may differ.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] bool same_contact_states(const Model& a, const Model& b);
/// Loads act along the same directions; histories may differ.
[[nodiscard]] bool same_load_directions(const Model& a, const Model& b);

}  // namespace signorini
