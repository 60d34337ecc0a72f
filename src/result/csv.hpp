// csv.hpp: writes CSV files that are valid at every moment, and reads them.
//
//   one header row, commas, no comments; numbers with the fewest digits that read back exactly
//
// A block of rows is passed to the system in one write as soon as it is complete; after a failed write (disk full) the
// file is truncated to whole rows, and a FileError is thrown. SIGKILL may end a write at a page boundary of the file,
// so a killed run leaves at most one incomplete line, the last, without its line end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace signorini::result {

/// Collects the cells of one block of rows.
class CsvBlock {
 public:
  CsvBlock& number(double value);
  /// Adds an empty cell for nullopt.
  CsvBlock& number(const std::optional<double>& value);
  /// The text is quoted if it contains a comma, a quote or a line break.
  CsvBlock& text(std::string_view value);
  CsvBlock& empty();
  /// Adds cells that are CSV text already, commas included.
  CsvBlock& raw(std::string_view cells);
  void end_row();

  [[nodiscard]] const std::string& str() const { return text_; }
  void clear() { text_.clear(); }

 private:
  void separate();

  std::string text_;
  bool row_begun_ = false;
};

/// A CSV file that is written in blocks. Errors of all members: FileError.
class CsvFile {
 public:
  explicit CsvFile(const std::filesystem::path& path);
  /// Writes all rows of the block and empties it.
  void write(CsvBlock& block);

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }  // unbuffered: nothing to flush
  };
  [[noreturn]] void fail();

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uintmax_t good_ = 0;  // number of bytes in complete blocks, which stay after a failed write
};

/// Writes the text to a temporary file in the same directory and renames it to `path`: readers see the old or the new
/// file, never a part.
void write_file(const std::filesystem::path& path, const std::string& text);

// Reads the tables of a run, for the pictures.
//
//   CsvReader reader("pipeline-run/events.csv");
//   const auto contact = reader.column("contact");
//   while (reader.next()) use(reader.cell(contact), reader.t());
//
// A last line without its line break (a run in progress, or killed) is omitted. gnuplot would read that line, so scripts
// limit gnuplot to the rows counted here. LastLine::counts, for tables written by hand, accepts that line as a row and
// skips a byte order mark before the header.

/// Treatment of a last line without its line break.
enum class LastLine { cut, counts };

/// Reads a CSV file row by row. Errors of all members: FileError; an error in a row names its line.
class CsvReader {
 public:
  /// Opens the file and reads its header.
  explicit CsvReader(const std::filesystem::path& path, LastLine last = LastLine::cut);

  [[nodiscard]] const std::vector<std::string>& header() const { return header_; }
  /// Index of the column with this name. Errors: FileError if there is none.
  [[nodiscard]] std::size_t column(const std::string& name) const;

  /// Value of the column `t` in the current row.
  [[nodiscard]] double t() const { return number(time_ ? *time_ : column("t")); }

  /// Moves to the next row; false at the end. Refuses a row whose number of cells differs from the header.
  bool next();
  /// Moves to the next row, which may have any number of cells; false at the end.
  bool next_of_any_length();
  /// Error message if the row's number of cells differs from the header; otherwise empty.
  [[nodiscard]] std::string row_length_error() const;
  [[nodiscard]] const std::string& cell(std::size_t index) const { return cells_[index]; }
  [[nodiscard]] double number(std::size_t index) const;

  /// Line number of the current row, from 1; correct only if no cell contains a line break.
  [[nodiscard]] int line() const { return line_; }
  /// After the last row: true if a last line without its line break was omitted.
  [[nodiscard]] bool is_cut() const { return cut_; }

  /// Throws a FileError that names this file and the reason `why`.
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
  /// Opens a table of the directory. Errors: FileError.
  [[nodiscard]] CsvReader open(const char* table) const { return CsvReader(directory_ / table); }

 private:
  std::filesystem::path directory_;
};

}  // namespace signorini::result
