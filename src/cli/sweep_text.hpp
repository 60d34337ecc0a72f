// sweep_text.hpp: what `sweep` prints: one row a run.
#pragma once

#include <string>

#include "study/sweep/sweep_table.hpp"

namespace signorini::cli {

/// Of many rows the first and the last ones, of many contacts the first ones; sweep.csv has all.
[[nodiscard]] std::string sweep_text(const SweepSpec& spec, const SweepRows& rows);

}  // namespace signorini::cli
