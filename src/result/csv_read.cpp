#include "result/csv_read.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

#include "base/csv_row.hpp"
#include "base/input_file.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

CsvReader::CsvReader(const std::filesystem::path& path, LastLine last) : path_(path), last_(last) {
  if (const std::string why = why_no_input_file(path); !why.empty())
    throw FileError(path.string(), why + ", expected a file");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_) throw FileError(path.string(), "cannot be read" + because(errno));
  if (!read_csv_row(file_, header_) && (header_.empty() || last_ == LastLine::cut))
    throw FileError(path.string(), header_.empty() ? "is empty; expected a header row"
                                                   : "line 1: found no line break, expected a header row");
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (last_ == LastLine::counts && header_[0].starts_with(mark)) header_[0].erase(0, mark.size());
  const auto time = std::find(header_.begin(), header_.end(), "t");
  if (time != header_.end()) time_ = static_cast<std::size_t>(time - header_.begin());
}

std::size_t CsvReader::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) refuse("has no column '" + name + "'");
  return static_cast<std::size_t>(found - header_.begin());
}

bool CsvReader::next() {
  if (!next_of_any_length()) return false;
  if (const std::string why = misfit(); !why.empty()) refuse(fmt::format("line {}: {}", line_, why));
  return true;
}

bool CsvReader::next_of_any_length() {
  ++line_;
  if (read_csv_row(file_, cells_) || (!cells_.empty() && last_ == LastLine::counts)) return true;
  cut_ = !cells_.empty();
  return false;
}

std::string CsvReader::misfit() const {
  if (cells_.size() == header_.size()) return {};
  const bool blank = cells_.size() == 1 && cells_[0].empty();
  return fmt::format("found {}, expected {} as in the header",
                     blank ? "a blank line" : fmt::format("{} cells", cells_.size()), header_.size());
}

double CsvReader::number(std::size_t index) const {
  const std::string& text = cells_[index];
  const std::optional<double> value = parse_number(text);
  if (!value) refuse("has '" + text + "' where a number is expected");
  return *value;
}

void CsvReader::refuse(const std::string& why) const { throw FileError(path_.string(), why); }

bool TableFolder::has(const char* table) const {
  std::error_code error;
  return std::filesystem::is_regular_file(directory_ / table, error);
}

}  // namespace signorini
