// study_text.hpp: output of `study`: a table of runs, the cheapest for each accuracy, and failures.
#pragma once

#include <string>

#include "cli/table.hpp"
#include "study/speed/work_study.hpp"

namespace signorini::cli {

[[nodiscard]] std::string study_text(const WorkReport& report);
/// Only the table, for papers.
[[nodiscard]] std::string study_table(const WorkReport& report, TableStyle style);

}  // namespace signorini::cli
