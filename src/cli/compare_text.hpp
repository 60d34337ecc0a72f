// compare_text.hpp: what `compare` prints: the runs, then each one's differences from the reference.
#pragma once

#include <string>

#include "cli/table.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini::cli {

[[nodiscard]] std::string compare_text(const ComparisonReport& report);
/// Its tables alone, for papers.
[[nodiscard]] std::string compare_tables(const ComparisonReport& report, TableStyle style);

}  // namespace signorini::cli
