// check.hpp: output of `signorini check`, as text for a terminal.
#pragma once

#include <string>

#include "study/check/check.hpp"

namespace signorini::cli {

/// The report of `check` as text.
[[nodiscard]] std::string check_text(const Scene& scene, const Model& model,
                                     const check::CheckReport& report);

/// The columns of history.csv with their units, one per line.
[[nodiscard]] std::string column_text(const Model& model);

}  // namespace signorini::cli
