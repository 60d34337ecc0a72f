// row_file.hpp: the finished rows of a sweep on disk, one JSON line each, in the order of completion; and
// shares of rows.
//
//   {"row":3,"values":["1.5"],"outcome":"done",...,"checksum":"9d0c5f1e2a7b4c38"}
//
// A line is complete or absent: a partial line at the end, left by a kill, is not a row. The checksum detects
// altered lines. If a row occurs twice, the later line is valid, because a crashed row is computed again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "study/sweep/sweep_row.hpp"

namespace signorini::sweep {

/// A row and its line number, from 1.
struct NumberedRow {
  SweepRow row;
  std::size_t line = 0;
};

/// The rows of a file by index; empty if the file does not exist. Errors: FileError, with the line number.
[[nodiscard]] std::map<std::size_t, NumberedRow> read_rows(const std::filesystem::path& file);

/// Appends finished rows to the file. Errors of all members: FileError.
class RowFile {
 public:
  /// Truncates a partial line at the end. Refuses a symbolic link, which could lead to a foreign file.
  explicit RowFile(std::filesystem::path path);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// lines: one or more of row_line(). After a failed write the file is truncated to its complete lines.
  void append(const std::string& lines);

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uintmax_t good_ = 0;  // size of the complete lines, in bytes
};

// The rows of a sweep that one of several processes computes.
//
//   3/16     every 16th row, starting with the third
//   auto     from the environment of Open MPI, of other launchers with PMI, and of Slurm arrays
//
// If a launcher runs inside an array, both shares multiply: in task 2 of 4, rank 1 of 8 (counted from 0) has
// share 10/32.

struct Share {
  std::size_t number = 1, count = 1;  ///< number: from 1 to count

  /// True if the row belongs to this share; row: index from 0.
  [[nodiscard]] bool holds(std::size_t row) const { return row % count == number - 1; }
  [[nodiscard]] bool all() const { return count == 1; }
  [[nodiscard]] std::string text() const { return std::to_string(number) + "/" + std::to_string(count); }
  friend bool operator==(const Share&, const Share&) = default;
};

/// Function that returns the value of an environment variable; nullopt if the variable is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;

/// Parses a share. Errors: UsageError for texts other than K/N with 1 <= K <= N or "auto", and for "auto" if
/// no launcher or array has set its variables.
[[nodiscard]] Share parse_share(const std::string& text, const Environment& environment);

/// Number of processes of this sweep that a launcher (not an array) has started; 1 without a launcher.
[[nodiscard]] std::size_t ranks(const Environment& environment);

}  // namespace signorini::sweep
