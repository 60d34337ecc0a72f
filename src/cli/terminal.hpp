// terminal.hpp: output streams and tables. Data go to stdout, messages and progress to stderr.
//
// Control characters in titles, names and paths are printed as "\u001b", so that a scene cannot command the terminal.
// Messages are coloured only on a terminal, and not if NO_COLOR is set (https://no-color.org).
#pragma once

#include <string>
#include <vector>

namespace signorini::cli {

/// Writes to stdout and flushes it. Errors: FileError, for example if stdout is a file on a full disk.
void print(const std::string& text);

/// Print "error: ...", "warning: ..." and "note: ..." to stderr.
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_note(const std::string& message);

/// True if stderr is a terminal, so that a progress line can be shown.
[[nodiscard]] bool stderr_is_terminal();
/// Opens /dev/null in place of a closed standard input, output or error. Otherwise the next opened file would get this
/// descriptor, and printed text would be written to this file. print() then fails, because the output would be lost.
void open_closed_streams();

/// Replaces the progress line; an empty text removes it.
void progress_line(const std::string& text);

// Table: text in columns for the terminal; columns with `right` are aligned to the right.
//
//   Table table({"t [s]", "contact"}, {true, false});  table.row({"0.5", "first"});  table.str()
//
// For papers a table can also be written in Markdown, or as a LaTeX tabular that needs no package.

/// The number with six significant digits.
[[nodiscard]] std::string number(double value);

enum class TableStyle { plain, markdown, latex };
/// Style with this name in --table; plain if the name is empty. Errors: UsageError.
[[nodiscard]] TableStyle table_style(const std::string& name);

class Table {
 public:
  Table(std::vector<std::string> header, std::vector<bool> right);
  void row(std::vector<std::string> cells);
  /// Adds a line that is not split into columns.
  void line(std::string text);
  /// The table for a terminal: columns are separated and indented by two blanks.
  [[nodiscard]] std::string str() const;
  /// The table in a style. Lines without columns follow the table in Markdown, and are comments in LaTeX.
  [[nodiscard]] std::string str(TableStyle style) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // a row with one cell is a line
};

}  // namespace signorini::cli
