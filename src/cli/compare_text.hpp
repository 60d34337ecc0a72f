// compare_text.hpp: what `compare` prints: the runs, then each one's differences from the reference.
#pragma once

#include <string>

#include "study/compare/comparison_files.hpp"

namespace signorini::cli {

[[nodiscard]] std::string compare_text(const ComparisonReport& report);

}  // namespace signorini::cli
