// row_file.hpp: the finished rows of a sweep on disk, a line of JSON each, in the order in which they came.
//
//   {"row":3,"values":["1.5"],"outcome":"done",...,"checksum":"9d0c5f1e2a7b4c38"}
//
// A line is there whole or not at all: half a line at the end, which a kill has left, is no row. A line that somebody has
// altered is told by its checksum. Where a row stands twice, the later one is right: a row that crashed is tried again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "study/sweep/sweep_row.hpp"

namespace signorini {

/// A row and the number of its line, from 1.
struct NumberedRow {
  SweepRow row;
  std::size_t line = 0;
};

/// The rows of a file by index; none if the file does not exist. Errors: FileError, with the number of the line.
[[nodiscard]] std::map<std::size_t, NumberedRow> read_rows(const std::filesystem::path& file);

/// Appends lines. Errors of all members: FileError.
class RowFile {
 public:
  /// Cuts off half a line at the end. Refuses a link: it would lead to somebody else's file.
  explicit RowFile(std::filesystem::path path);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// lines: one or more of row_line(). Lines that cannot be written whole are cut off again.
  void append(const std::string& lines);

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uintmax_t good_ = 0;  // bytes of whole lines
};

}  // namespace signorini
