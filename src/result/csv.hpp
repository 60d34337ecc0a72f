// csv.hpp: a CSV file that is valid at every moment.
//
//   one header row, commas, no comments; numbers as shortest() writes them
//
// A block of rows is passed to the system in one write as soon as it is complete; after a failed write (disk full) the
// file is truncated to whole rows, and a FileError is thrown. SIGKILL may end a write at a page boundary of the file,
// so a killed run leaves at most one incomplete line, the last, without its line end.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace signorini {

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

/// The file. Errors of all members: FileError.
class CsvFile {
 public:
  explicit CsvFile(const std::filesystem::path& path);
  /// Writes all rows of the block and empties it.
  void write(CsvBlock& block);

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }  // unbuffered
  };
  [[noreturn]] void fail();

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uintmax_t good_ = 0;  // number of bytes known to be written
};

/// Writes a text file through a temporary neighbour and a rename: readers see the old or the new file, never a part.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace signorini
