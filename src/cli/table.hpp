// table.hpp: text in columns for the terminal; `right` columns are aligned to the right.
//
//   Table table({"t [s]", "contact"}, {true, false});  table.row({"0.5", "first"});  table.str()
#pragma once

#include <string>
#include <vector>

namespace signorini::cli {

/// Six digits.
[[nodiscard]] std::string number(double value);

class Table {
 public:
  Table(std::vector<std::string> header, std::vector<bool> right);
  void row(std::vector<std::string> cells);
  /// A line that is not split into columns.
  void line(std::string text);
  /// Two blanks in front and between.
  [[nodiscard]] std::string str() const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // one cell: a line
};

}  // namespace signorini::cli
