// sweep_text.hpp: text output of `sweep`: a table with one row per run, and quantiles.
#pragma once

#include <string>

#include "cli/terminal.hpp"
#include "study/sweep/quantiles.hpp"

namespace signorini::cli {

/// Table with one row per run. Of many rows only the first and the last are shown, of many contacts those with the largest
/// forces; sweep.csv has all. Styles for papers have all rows, but not the reasons of failed runs.
[[nodiscard]] std::string sweep_text(const sweep::SweepSpec& spec, const sweep::SweepRows& rows,
                                     TableStyle style = TableStyle::plain);

/// Table of the quantiles of the results with confidence intervals; of many combinations of keys only the first.
[[nodiscard]] std::string quantile_text(const sweep::SweepSpec& spec,
                                        const std::vector<sweep::SampledResults>& answers,
                                        TableStyle style = TableStyle::plain);

}  // namespace signorini::cli
