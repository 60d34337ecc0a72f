#include "result/csv_read.hpp"

#include <algorithm>
#include <cerrno>

#include "base/csv_row.hpp"
#include "base/input_file.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

CsvReader::CsvReader(const std::filesystem::path& path) : path_(path) {
  if (const std::string why = why_no_input_file(path); !why.empty())
    throw FileError(path.string(), why + ", expected a file");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_) throw FileError(path.string(), "cannot be read" + because(errno));
  if (!read_csv_row(file_, header_)) throw FileError(path.string(), "is empty; expected a header row");
  const auto time = std::find(header_.begin(), header_.end(), "t");
  if (time != header_.end()) time_ = static_cast<std::size_t>(time - header_.begin());
}

std::size_t CsvReader::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) refuse("has no column '" + name + "'");
  return static_cast<std::size_t>(found - header_.begin());
}

bool CsvReader::next() {
  if (!read_csv_row(file_, cells_)) return false;
  if (cells_.size() != header_.size()) refuse("has a row of another length");
  return true;
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
