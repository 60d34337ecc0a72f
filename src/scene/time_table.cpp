#include "scene/time_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text.hpp"
#include "scene/record_file.hpp"
#include "scene/table_lines.hpp"

namespace signorini::scene {

namespace {

/// Reads a table line by line.
class TableReader {
 public:
  TableReader(TableLines& lines, const TableLayout& layout) : lines_(lines), layout_(layout) {}

  TimeTable read() {
    bool heading_allowed = true;
    int last = 1;
    while (lines_.next()) {
      const std::string_view line = without_comment(lines_.line());
      const std::vector<TableWord> words = words_of_line(line);
      if (words.empty()) continue;
      last = lines_.number();
      const bool is_heading = heading_allowed && !base::parse_number(words[0].text);
      heading_allowed = false;
      if (is_heading) {
        if (values_only()) refuse_heading_of_times(words);
        continue;
      }
      if (has_empty_cell(line))
        lines_.fail(fmt::format("found \"{}\", expected no empty cell", base::excerpt(line)));
      commas_.add_line(line, lines_.number(), !values_only());
      if (values_only())
        append_values(lines_, words, layout_.time_step, table_);
      else
        read_row(line, words);
    }
    refuse_decimal_commas();
    if (table_.times.size() < 2)
      lines_.fail_at(last, 0,
                     fmt::format("found {}, expected two or more",
                                 base::count_text(table_.times.size(), values_only() ? "value" : "row")));
    return std::move(table_);
  }

 private:
  [[nodiscard]] bool values_only() const { return layout_.time_step > 0.0; }

  void refuse_heading_of_times(const std::vector<TableWord>& words) const {
    std::string first = words.front().text;
    for (char& c : first) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (words.size() > 1 && (first == "T" || first.starts_with("TIME")))
      lines_.fail(fmt::format(
          "found the heading \"{}\" of times and values, expected values only, because time_step is given",
          base::excerpt(lines_.line())));
  }

  void refuse_decimal_commas() const {
    const TableWord* word = commas_.found();
    if (!word) return;
    std::string with_point = word->text;
    with_point.replace(with_point.find(','), 1, ".");
    lines_.fail_at(
        commas_.line(), word->column,
        fmt::format("found \"{}\", one number with a decimal comma or two numbers; expected \"{}\", "
                    "or a blank or a semicolon between the two",
                    base::excerpt(word->text), base::excerpt(with_point)));
  }

  void read_row(std::string_view line, const std::vector<TableWord>& words) {
    const auto column = static_cast<std::size_t>(layout_.column == 0 ? 2 : layout_.column);
    const bool fits = layout_.column == 0 ? words.size() == 2 : words.size() >= column;
    const auto t = base::parse_number(words[0].text);
    const auto value = fits ? base::parse_number(words[column - 1].text) : std::nullopt;
    if (!t || !value || !std::isfinite(*t) || !std::isfinite(*value)) refuse_row(line, words, column);
    const std::size_t n = table_.times.size();
    if (n > 0 && *t < table_.times[n - 1]) {
      refuse_decimal_commas();
      lines_.fail(fmt::format("found time {} after {}, expected ascending times", base::format_number(*t),
                              base::format_number(table_.times[n - 1])));
    }
    if (n > 1 && *t == table_.times[n - 2]) {
      refuse_decimal_commas();
      lines_.fail(fmt::format("found time {} in three rows, expected it in at most two rows (a jump)",
                              base::format_number(*t)));
    }
    append(lines_, *t, *value, table_);
  }

  [[noreturn]] void refuse_row(std::string_view line, const std::vector<TableWord>& words,
                               std::size_t column) const {
    refuse_decimal_commas();
    const std::string found = base::excerpt(line);
    if (layout_.column != 0)
      lines_.fail(
          fmt::format("found \"{}\", expected a time in column 1 and a value in column {}", found, column));
    std::string help;
    const bool numbers = std::all_of(words.begin(), words.end(), [](const TableWord& word) {
      return base::parse_number(word.text).has_value();
    });
    if (numbers && words.size() != 2)
      help = words.size() == 1 ? "; for a file of values only give time_step"
                               : "; give column for a file of several columns, time_step for values only";
    else if (!numbers && table_.times.empty())
      help = "; a heading has one line, and other lines of text begin with #";
    lines_.fail(fmt::format("found \"{}\", expected two numbers, time and value{}", found, help));
  }

  TableLines& lines_;
  const TableLayout& layout_;
  TimeTable table_;
  DecimalCommas commas_;
};

}  // namespace

void append(const TableLines& lines, double t, double value, TimeTable& table) {
  constexpr std::size_t most_rows = 1'000'000;
  if (table.times.size() == most_rows) lines.fail(fmt::format("found more than {} rows", most_rows));
  table.times.push_back(t);
  table.values.push_back(value);
}

void append_values(const TableLines& lines, const std::vector<TableWord>& words, double time_step,
                   TimeTable& table) {
  for (const TableWord& word : words) {
    const auto value = base::parse_number(word.text);
    if (!value || !std::isfinite(*value))
      lines.fail(fmt::format("found \"{}\", expected a number", base::excerpt(word.text)), word.column);
    append(lines, static_cast<double>(table.times.size()) * time_step, *value, table);
  }
}

TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key,
                          const TableLayout& layout) {
  TableLines lines(in, file, key);
  if (std::optional<TimeTable> record = read_record(lines, layout)) return std::move(*record);
  return TableReader(lines, layout).read();
}

}  // namespace signorini::scene
