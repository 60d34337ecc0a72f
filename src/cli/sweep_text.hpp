// sweep_text.hpp: what `sweep` prints: one row a run.
#pragma once

#include <string>

#include "cli/table.hpp"
#include "study/sweep/quantiles.hpp"

namespace signorini::cli {

/// Of many rows the first and the last ones, of many contacts the first ones; sweep.csv has all. For papers
/// all rows, and none of the reasons behind them.
[[nodiscard]] std::string sweep_text(const SweepSpec& spec, const SweepRows& rows,
                                     TableStyle style = TableStyle::plain);

/// Quantiles of the answers with their intervals; of many combinations of keys the first ones.
[[nodiscard]] std::string quantile_text(const SweepSpec& spec, const std::vector<Sampled>& answers,
                                        TableStyle style = TableStyle::plain);

}  // namespace signorini::cli
