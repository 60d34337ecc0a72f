// csv.hpp: a CSV file that is readable at every moment.
//
//   one header row, commas, no comments; numbers as shortest() writes them
//
// A block of rows is handed to the system in one write as soon as it is complete; a write that fails (disk
// full) is cut back to whole rows and becomes a FileError. SIGKILL may end a write where a page of the file
// ends, so what a killed run leaves has at most one line that is cut, the last: without its line end.
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
  /// An empty cell when absent.
  CsvBlock& number(const std::optional<double>& value);
  /// Quoted if it holds a comma, a quote or a line break.
  CsvBlock& text(std::string_view value);
  CsvBlock& empty();
  /// Cells that are text of a table already, commas and all.
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
  std::uintmax_t good_ = 0;  // bytes that surely arrived
};

/// Writes a whole text file through a neighbour that is renamed: the old one or the new one, never half.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace signorini
