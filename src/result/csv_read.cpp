#include "result/csv_read.hpp"

#include <algorithm>

#include "base/input_file.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

CsvReader::CsvReader(const std::filesystem::path& path) : path_(path) {
  if (const std::string why = why_no_input_file(path); !why.empty())
    throw FileError(path.string(), why + ", expected a file");
  file_.open(path, std::ios::binary);
  if (!file_) throw FileError(path.string(), "cannot be read");
  if (!read_row(header_)) throw FileError(path.string(), "is empty; expected a header row");
}

std::size_t CsvReader::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) throw FileError(path_.string(), "has no column '" + name + "'");
  return static_cast<std::size_t>(found - header_.begin());
}

bool CsvReader::next() {
  if (!read_row(cells_)) return false;
  if (cells_.size() != header_.size()) throw FileError(path_.string(), "has a row of another length");
  return true;
}

double CsvReader::number(std::size_t index) const {
  const std::string& text = cells_[index];
  const std::optional<double> value = parse_number(text);
  if (!value) throw FileError(path_.string(), "has '" + text + "' where a number is expected");
  return *value;
}

bool CsvReader::read_row(std::vector<std::string>& cells) {
  cells.clear();
  std::string cell;
  bool quoted = false;
  while (std::getline(file_, line_)) {
    if (file_.eof()) return false;
    for (std::size_t i = 0; i < line_.size(); ++i) {
      const char c = line_[i];
      if (c == '"') {
        const bool doubled = quoted && i + 1 < line_.size() && line_[i + 1] == '"';
        if (doubled) {
          cell += line_[++i];
        } else {
          quoted = !quoted;
        }
      } else if (c == ',' && !quoted) {
        cells.push_back(std::move(cell));
        cell.clear();
      } else {
        cell += c;
      }
    }
    if (!quoted) {
      cells.push_back(std::move(cell));
      return true;
    }
    cell += '\n';
  }
  return false;
}

}  // namespace signorini
