// csv_row.hpp: reads one row of a CSV table.
//
//   t,"a, quoted",1.5      cells separated by commas; quoted ones may contain commas, line breaks and "" for "
//
// A last line without its line break (a run in progress, or killed) is not a row: its cells are returned, so that the
// caller can report or use it.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace signorini {

/// Returns false at the end, with the cells of a last line without line break in `cells`, and for a row of more than
/// 100 MB (a million degrees of freedom need 40), which is invalid.
[[nodiscard]] bool read_csv_row(std::istream& in, std::vector<std::string>& cells);

}  // namespace signorini
