// row_file.hpp: the finished rows of a sweep on disk, one JSON line each, in the order of completion.
//
//   {"row":3,"values":["1.5"],"outcome":"done",...,"checksum":"9d0c5f1e2a7b4c38"}
//
// A line is complete or absent: a partial line at the end, left by a kill, is not a row. The checksum detects altered
// lines. If a row occurs twice, the later one is valid: a row that crashed is tried again.
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

/// The rows of a file by index; empty if the file does not exist. Errors: FileError, with the line number.
[[nodiscard]] std::map<std::size_t, NumberedRow> read_rows(const std::filesystem::path& file);

/// Appends lines. Errors of all members: FileError.
class RowFile {
 public:
  /// Truncates a partial line at the end. Refuses a symbolic link, which could lead to a foreign file.
  explicit RowFile(std::filesystem::path path);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// lines: one or more of row_line(). A failed write is truncated to complete lines.
  void append(const std::string& lines);

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uintmax_t good_ = 0;  // size of the complete lines
};

}  // namespace signorini
