// build.hpp: build_model() (signorini/model.hpp) for callers that build many models of one scene.
#pragma once

#include "signorini/model.hpp"

namespace signorini::model {

/// The same model without model warnings (model_warnings.hpp), which take as long as all other steps together.
[[nodiscard]] Model build_without_warnings(const Scene& scene);

/// The structure before a reduction: M, C and K of build_model() with all degrees of freedom, also if the
/// scene has [reduction]. It has neither the dashpots of contacts nor a separate basis of massless motions
/// nor outputs.
[[nodiscard]] Model build_structure(const Scene& scene);

// Comparison of models whose modes may be shared.

/// True if M, C, K, the forms, stiffnesses and dampings of contacts, and the coefficients of friction are
/// equal. The modes of the contact states of one model are then valid for the other. Loads, gaps, surfaces
/// and initial states may differ.
[[nodiscard]] bool same_contact_states(const Model& a, const Model& b);
/// True if loads act along the same directions; histories may differ.
[[nodiscard]] bool same_load_directions(const Model& a, const Model& b);

}  // namespace signorini::model
