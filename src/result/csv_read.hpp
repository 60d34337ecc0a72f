// csv_read.hpp: reads back the tables of a run, for the pictures.
//
//   CsvReader reader("pipeline-run/events.csv");
//   const auto contact = reader.column("contact");
//   while (reader.next()) use(reader.cell(contact), reader.t());
//
// A last line without its line break (a run that is being written, or was killed) is left out. gnuplot does
// not know that: what it is to read of a table are the rows that were counted here. Of tables that people write
// (LastLine::counts) it is a row as any other, and a byte order mark before the header is none of its characters.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace signorini {

/// What a last line without its line break is.
enum class LastLine { cut, counts };

/// Errors of all members: FileError, of rows with their line.
class CsvReader {
 public:
  /// Opens the file and reads its header.
  explicit CsvReader(const std::filesystem::path& path, LastLine last = LastLine::cut);

  [[nodiscard]] const std::vector<std::string>& header() const { return header_; }
  /// Index of a column of that name.
  [[nodiscard]] std::size_t column(const std::string& name) const;

  /// The row's `t`.
  [[nodiscard]] double t() const { return number(time_ ? *time_ : column("t")); }

  /// Moves to the next row; false at the end. A row that has not as many cells as the header is refused.
  bool next();
  /// The same, whatever its length.
  bool next_of_any_length();
  /// What is wrong with the length of the row; empty: nothing.
  [[nodiscard]] std::string misfit() const;
  [[nodiscard]] const std::string& cell(std::size_t index) const { return cells_[index]; }
  [[nodiscard]] double number(std::size_t index) const;

  /// Of the row, from 1, where no cell holds a line break.
  [[nodiscard]] int line() const { return line_; }
  /// At the end: a line without its line break was left out.
  [[nodiscard]] bool is_cut() const { return cut_; }

  /// Throws the FileError that names this table.
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

/// The tables of a directory of results.
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
