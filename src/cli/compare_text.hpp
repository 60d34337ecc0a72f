// compare_text.hpp: output of `compare`: the runs, then the differences of each one from the reference.
#pragma once

#include <string>

#include "cli/table.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini::cli {

[[nodiscard]] std::string compare_text(const ComparisonReport& report);
/// Only the tables, for papers.
[[nodiscard]] std::string compare_tables(const ComparisonReport& report, TableStyle style);

}  // namespace signorini::cli
