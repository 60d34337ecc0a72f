// table_lines.hpp: lines of a file of numbers, with a look ahead; words of a line; numbers with decimal commas.
#pragma once

#include <deque>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::scene {

/// A part of a line between separators; `column` counts bytes from 1.
struct TableWord {
  std::string text;
  int column = 0;
};
/// Parts of the line between blanks and any of the other separators.
[[nodiscard]] std::vector<TableWord> words_of_line(std::string_view line, std::string_view separators = ",;");

/// True if a cell is empty: two separators in a row, or a leading one; blanks alone do not separate cells.
[[nodiscard]] bool has_empty_cell(std::string_view line);

/// The line without its comment, which begins with #, %, ! or //.
[[nodiscard]] std::string_view without_comment(std::string_view line);

class TableLines {
 public:
  TableLines(std::istream& in, const std::string& file, const std::string& key)
      : in_(in), file_(file), key_(key) {}

  /// Reads ahead and returns the next lines, at most `most`, without advancing.
  [[nodiscard]] const std::deque<std::string>& ahead(std::size_t most);
  /// Advances to the next line that is not blank; false at the end of the file.
  bool next();
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] int number() const { return number_; }

  /// Throws a SceneError at the current line, or at the line with this number.
  [[noreturn]] void fail(const std::string& message, int column = 0) const;
  [[noreturn]] void fail_at(int number, int column, const std::string& message) const;

 private:
  bool take(std::string& line);

  std::istream& in_;
  const std::string &file_, &key_;
  std::deque<std::string> ahead_;
  std::string line_;
  int number_ = 0;
};

/// Finds decimal commas where a comma also separates values. "0,15" is one number or two; the file's other lines decide:
/// a point between digits, or a comma that can only be a separator ("1,-2", "1, 2", "1,2,3"), shows that commas separate.
class DecimalCommas {
 public:
  /// `row`: the line is a row of several cells, in which a single "0,15" is two cells.
  void add_line(std::string_view line, int number, bool row);
  /// The first word that may be a number with a decimal comma, unless commas separate values in this file.
  [[nodiscard]] const TableWord* found() const { return separates_ || line_ == 0 ? nullptr : &word_; }
  [[nodiscard]] int line() const { return line_; }

 private:
  TableWord word_;
  int line_ = 0;
  bool separates_ = false;
};

}  // namespace signorini::scene
