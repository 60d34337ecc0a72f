// csv_read.hpp: reads the tables of a run, for the pictures.
//
//   CsvReader reader("pipeline-run/events.csv");
//   const auto contact = reader.column("contact");
//   while (reader.next()) use(reader.cell(contact), reader.t());
//
// A last line without its line break (a run in progress, or killed) is omitted. gnuplot would read it, so scripts limit
// it to the rows counted here. In tables written by people (LastLine::counts) it is a row like any other, and a byte
// order mark before the header is skipped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace signorini {

/// Treatment of a last line without its line break.
enum class LastLine { cut, counts };

/// Errors of all members: FileError; errors in rows have their line.
class CsvReader {
 public:
  /// Opens the file and reads its header.
  explicit CsvReader(const std::filesystem::path& path, LastLine last = LastLine::cut);

  [[nodiscard]] const std::vector<std::string>& header() const { return header_; }
  /// Index of the column with this name.
  [[nodiscard]] std::size_t column(const std::string& name) const;

  /// The row's `t`.
  [[nodiscard]] double t() const { return number(time_ ? *time_ : column("t")); }

  /// Moves to the next row; false at the end. Refuses a row whose number of cells differs from the header.
  bool next();
  /// Same for a row of any length.
  bool next_of_any_length();
  /// Error message for the row's length; empty: the length is right.
  [[nodiscard]] std::string misfit() const;
  [[nodiscard]] const std::string& cell(std::size_t index) const { return cells_[index]; }
  [[nodiscard]] double number(std::size_t index) const;

  /// Line number of the row, from 1, if no cell contains a line break.
  [[nodiscard]] int line() const { return line_; }
  /// At the end: true if a line without its line break was omitted.
  [[nodiscard]] bool is_cut() const { return cut_; }

  /// Throws a FileError with the name of this table.
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::string> header_, cells_;
  std::optional<std::size_t> time_;
  LastLine last_;
  int line_ = 1;
  bool cut_ = false;
};

/// The tables in a directory of results.
class TableFolder {
 public:
  explicit TableFolder(std::filesystem::path directory) : directory_(std::move(directory)) {}
  [[nodiscard]] bool has(const char* table) const;
  /// Errors: FileError.
  [[nodiscard]] CsvReader open(const char* table) const { return CsvReader(directory_ / table); }

 private:
  std::filesystem::path directory_;
};

}  // namespace signorini
