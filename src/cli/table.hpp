// table.hpp: text in columns for the terminal; `right` columns are aligned to the right.
//
//   Table table({"t [s]", "contact"}, {true, false});  table.row({"0.5", "first"});  table.str()
//
// The same for papers: in Markdown, and as a LaTeX tabular that needs no package.
#pragma once

#include <string>
#include <vector>

namespace signorini::cli {

/// Six digits.
[[nodiscard]] std::string number(double value);

enum class TableStyle { plain, markdown, latex };
/// Of --table; plain where it is empty. Errors: UsageError.
[[nodiscard]] TableStyle table_style(const std::string& name);

class Table {
 public:
  Table(std::vector<std::string> header, std::vector<bool> right);
  void row(std::vector<std::string> cells);
  /// A line that is not split into columns.
  void line(std::string text);
  /// Two blanks in front and between.
  [[nodiscard]] std::string str() const;
  /// Lines stand behind the table in Markdown, and as comments in LaTeX.
  [[nodiscard]] std::string str(TableStyle style) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // one cell: a line
};

}  // namespace signorini::cli
