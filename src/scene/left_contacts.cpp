#include "scene/left_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/csv_row.hpp"
#include "base/number.hpp"
#include "base/rounding.hpp"

namespace signorini {
namespace {

const std::vector<std::string> heading = {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T"};

/// nullopt: a cell is not a number.
std::optional<SavedState::Left> row_of(const std::vector<std::string>& cells) {
  SavedState::Left left;
  left.contact = cells[1];
  left.state = cells[2];
  if (!cells[3].empty() && !(left.gap = parse_number(cells[3]))) return std::nullopt;
  double* const numbers[] = {&left.ut, &left.vt, &left.slip, &left.N, &left.T};
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    const std::optional<double> value = parse_number(cells[4 + i]);
    if (!value) return std::nullopt;
    *numbers[i] = *value;
  }
  return left;
}

}  // namespace

std::vector<SavedState::Left> read_left_contacts(const std::filesystem::path& path, double t) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::string> cells;
  std::vector<SavedState::Left> rows;
  if (!in || !read_csv_row(in, cells)) return {};
  if (cells.size() < heading.size() || !std::equal(heading.begin(), heading.end(), cells.begin())) return {};
  const std::size_t width = cells.size();
  while (read_csv_row(in, cells)) {
    const std::optional<double> time = parse_number(cells[0]);
    if (cells.size() != width || !time || std::abs(*time - t) > rounding::of_few * std::abs(t)) continue;
    std::optional<SavedState::Left> row = row_of(cells);
    if (!row) return {};
    rows.push_back(std::move(*row));
  }
  return rows;
}

}  // namespace signorini
