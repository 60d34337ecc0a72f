// same_states.hpp: compares two models for equal matrices of their contact states.
//
// Equal are M, C, K, forms, stiffnesses and dampings of contacts, and coefficients of friction; mode shapes of one
// model then are valid for the other. Loads, gaps, surfaces and initial states may differ.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] bool same_contact_states(const Model& a, const Model& b);
/// True if loads act along the same directions; histories may differ.
[[nodiscard]] bool same_load_directions(const Model& a, const Model& b);

}  // namespace signorini
