// build.hpp: build_model() (signorini/model.hpp) for those who build many models of one scene.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The same model without what may be doubted of it (doubts.hpp), which costs as much as all else and adds
/// nothing but warnings.
[[nodiscard]] Model build_undoubted(const Scene& scene);

/// The structure that a reduction starts from: all degrees of freedom of build_model's M, C and K, whatever [reduction] says. The
/// dashpots of contacts are no part of it, massless motions stay among the others, and there are no outputs.
[[nodiscard]] Model build_structure(const Scene& scene);

}  // namespace signorini
