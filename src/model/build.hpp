// build.hpp: build_model() (signorini/model.hpp) for callers that build many models of one scene.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The same model without model warnings (doubts.hpp), which take as long as all other steps together.
[[nodiscard]] Model build_undoubted(const Scene& scene);

/// The structure that a reduction starts from: all degrees of freedom of build_model's M, C and K, whatever [reduction] says. The
/// dashpots of contacts are no part of it, massless motions stay among the others, and there are no outputs.
[[nodiscard]] Model build_structure(const Scene& scene);

}  // namespace signorini
