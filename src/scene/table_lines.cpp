#include "scene/table_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "base/text.hpp"
#include "scene/data_file.hpp"

namespace signorini::scene {

namespace {

bool is_binary(std::string_view line) {
  return std::any_of(line.begin(), line.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r'; });
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

/// True for "-0,15" and "1,5e-3": digits, one comma, digits, and an exponent.
bool may_have_decimal_comma(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || !all_digits(word.substr(0, comma))) return false;
  std::string_view fraction = word.substr(comma + 1);
  if (const std::size_t e = fraction.find_first_of("eE"); e != std::string_view::npos) {
    if (!base::parse_integer(fraction.substr(e + 1))) return false;
    fraction = fraction.substr(0, e);
  }
  return all_digits(fraction);
}

}  // namespace

std::vector<TableWord> words_of_line(std::string_view line, std::string_view separators) {
  std::vector<TableWord> words;
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ' ' || c == '\t' || c == '\r' || separators.find(c) != std::string_view::npos) {
      inside = false;
      continue;
    }
    if (!inside) words.push_back({"", static_cast<int>(i) + 1});
    words.back().text += c;
    inside = true;
  }
  return words;
}

bool has_empty_cell(std::string_view line) {
  bool empty = true;
  for (const char c : line) {
    const bool separates = c == ',' || c == ';';
    if (separates && empty) return true;
    if (separates)
      empty = true;
    else if (c != ' ' && c != '\t')
      empty = false;
  }
  return false;
}

std::string_view without_comment(std::string_view line) {
  return line.substr(0, std::min(line.find_first_of("#%!"), line.find("//")));
}

const std::deque<std::string>& TableLines::ahead(std::size_t most) {
  for (std::string line; ahead_.size() < most && read_line(in_, line);) ahead_.push_back(line);
  return ahead_;
}

bool TableLines::take(std::string& line) {
  if (ahead_.empty()) return read_line(in_, line);
  line = std::move(ahead_.front());
  ahead_.pop_front();
  return true;
}

bool TableLines::next() {
  while (take(line_)) {
    ++number_;
    if (number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);  // byte order mark
    if (is_binary(line_)) fail("found binary data, expected a text file of numbers");
    if (line_.size() > max_line_length)
      fail(fmt::format("found a line of more than {} characters", max_line_length));
    while (!line_.empty() && line_.back() == '\r') line_.pop_back();
    if (!words_of_line(line_).empty()) return true;
  }
  if (in_.bad()) fail("cannot be read");
  return false;
}

void TableLines::fail(const std::string& message, int column) const { fail_at(number_, column, message); }

void TableLines::fail_at(int number, int column, const std::string& message) const {
  throw SceneError({file_, number, column}, key_, message);
}

void DecimalCommas::add_line(std::string_view line, int number, bool row) {
  if (separates_) return;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i] == '.' && (is_digit(line[i + 1]) || (i > 0 && is_digit(line[i - 1])))) separates_ = true;
  const std::vector<TableWord> words = words_of_line(line, ";");
  for (const TableWord& word : words) {
    if (word.text.find(',') == std::string::npos) continue;
    if (!may_have_decimal_comma(word.text))
      separates_ = true;
    else if (line_ == 0 && !(row && words.size() == 1)) {
      word_ = word;
      line_ = number;
    }
  }
}

}  // namespace signorini::scene
