// study_text.hpp: what `study` prints: the runs in a table, which is cheapest for what, how runs fail.
#pragma once

#include <string>

#include "cli/table.hpp"
#include "study/speed/work_study.hpp"

namespace signorini::cli {

[[nodiscard]] std::string study_text(const WorkReport& report);
/// The table alone, for papers.
[[nodiscard]] std::string study_table(const WorkReport& report, TableStyle style);

}  // namespace signorini::cli
