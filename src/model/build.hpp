// build.hpp: build_model() (signorini/model.hpp) for callers that build many models of one scene.
#pragma once

#include "signorini/model.hpp"

namespace signorini::model {

/// The same model without model warnings (model_warnings.hpp), which take as long as all other steps together.
[[nodiscard]] Model build_without_warnings(const Scene& scene);

/// The structure that a reduction starts from: all degrees of freedom of build_model's M, C and K, whatever [reduction] says. The
/// dashpots of contacts are no part of it, massless motions stay among the others, and there are no outputs.
[[nodiscard]] Model build_structure(const Scene& scene);

// Compares two models for equal matrices of their contact states.
//
// Equal are M, C, K, forms, stiffnesses and dampings of contacts, and coefficients of friction; mode shapes of one
// model then are valid for the other. Loads, gaps, surfaces and initial states may differ.

[[nodiscard]] bool same_contact_states(const Model& a, const Model& b);
/// True if loads act along the same directions; histories may differ.
[[nodiscard]] bool same_load_directions(const Model& a, const Model& b);

}  // namespace signorini::model
