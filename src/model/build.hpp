// build.hpp: build_model() (signorini/model.hpp) for those who build many models of one scene.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The same model without what may be doubted of it (doubts.hpp), which costs as much as all else and adds
/// nothing but warnings.
[[nodiscard]] Model build_undoubted(const Scene& scene);

}  // namespace signorini
