// csv_row.hpp: a row of a table of a run.
//
//   t,"a, quoted",1.5      cells between commas; in quotes they may hold commas, line breaks and "" for "
//
// A last line without its line break (a run that is being written, or was killed) is no row: its cells are left, so that
// whoever reads what was written to its end can tell that it is cut, or take it.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace signorini {

/// False at the end, where `cells` has what a last line without its line break has, and for a row of more than 100 MB
/// (a million degrees of freedom have 40), which is none.
[[nodiscard]] bool read_csv_row(std::istream& in, std::vector<std::string>& cells);

}  // namespace signorini
