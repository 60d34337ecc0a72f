// sweep_text.hpp: output of `sweep`: one row per run.
#pragma once

#include <string>

#include "cli/terminal.hpp"
#include "study/sweep/quantiles.hpp"

namespace signorini::cli {

/// Table of the rows. Of many rows it has the first and the last, of many contacts the first; sweep.csv has
/// all. Styles for papers have all rows, without the reasons of failed ones.
[[nodiscard]] std::string sweep_text(const sweep::SweepSpec& spec, const sweep::SweepRows& rows,
                                     TableStyle style = TableStyle::plain);

/// Quantiles of the results with their intervals; if there are many combinations of keys, the first ones.
[[nodiscard]] std::string quantile_text(const sweep::SweepSpec& spec,
                                        const std::vector<sweep::SampledResults>& answers,
                                        TableStyle style = TableStyle::plain);

}  // namespace signorini::cli
