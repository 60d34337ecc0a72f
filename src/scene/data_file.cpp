#include "scene/data_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "base/files.hpp"
#include "base/text.hpp"

namespace signorini::scene {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = 1'000'000;

std::vector<std::string> words_of(std::string line) {
  for (char& c : line) {
    if (c == ',' || c == ';' || c == '\t' || c == '\r') c = ' ';
  }
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// True if a cell is empty: two separators in a row, or a leading one; blanks alone do not separate cells.
bool has_empty_cell(const std::string& line) {
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

bool is_binary(const std::string& line) {
  for (const char c : line) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') return true;
  }
  return false;
}

std::string upper(const std::string& line) {
  std::string result;
  for (const char c : line) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool contains_word(const std::string& line, const std::string& word) {
  return upper(line).find(word) != std::string::npos;
}

/// "... IN UNITS OF CM/SEC**2" -> "CM/S/S"; empty if the line names no unit.
std::string unit_in(const std::string& line) {
  const std::string mark = "UNITS OF", text = upper(line);
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return {};
  std::string unit;
  for (const char c : text.substr(at + mark.size()))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '/') unit += c;
  if (const std::size_t sec = unit.find("SEC"); sec != std::string::npos)
    for (std::size_t i = sec; i != std::string::npos; i = unit.find("SEC")) unit.replace(i, 3, "S");
  if (unit.ends_with("/S2")) unit.replace(unit.size() - 3, 3, "/S/S");
  return unit.empty() ? mark : unit;
}

/// Value of the unit in m/s^2; nullopt if the text is not a known unit of acceleration.
std::optional<double> acceleration_unit(const std::string& unit) {
  static const std::map<std::string, double> known{
      {"G", standard_gravity}, {"CM/S/S", 0.01}, {"GAL", 0.01}, {"MM/S/S", 0.001}, {"M/S/S", 1.0}};
  const auto found = known.find(unit);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// Reads a file of numbers line by line.
class TableReader {
 public:
  TableReader(std::istream& in, const std::string& file, const std::string& key, const TableLayout& layout)
      : in_(in), file_(file), key_(key), layout_(layout) {}

  TimeTable read() {
    if (layout_.peer) read_peer_heading();
    const bool values_only = layout_.peer || layout_.time_step > 0.0;
    while (next()) {
      if (!layout_.peer && words_[0][0] == '#') continue;
      last_ = number_;
      const bool heading = heading_allowed_ && !base::parse_number(words_[0]);
      heading_allowed_ = false;
      if (heading && values_only && names_times())
        fail(fmt::format(
            "found the heading \"{}\" of times and values, expected values only, because time_step is given",
            base::excerpt(line_)));
      if (heading) continue;
      if (has_empty_cell(line_))
        fail(fmt::format("found \"{}\", expected no empty cell", base::excerpt(line_)));
      if (values_only)
        for (const std::string& word : words_) add(time_of_next(), number(word, "a number"));
      else
        read_row();
    }
    number_ = last_;
    if (in_.bad()) fail("cannot be read");
    if (table_.times.size() < 2)
      fail(fmt::format("found {}, expected two or more",
                       base::count_text(table_.times.size(), values_only ? "value" : "row")));
    if (layout_.peer && table_.times.size() != points_)
      fail(fmt::format("found {}, expected {}, the number given by NPTS",
                       base::count_text(table_.times.size(), "value"), points_));
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError({file_, number_, 0}, key_, message);
  }

  /// Advances to the next line that is not blank; false at the end of the file.
  bool next() {
    while (read_line(in_, line_)) {
      ++number_;
      if (number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);  // byte order mark
      if (is_binary(line_)) fail("found binary data, expected a text file of numbers");
      if (line_.size() > max_line_length)
        fail(fmt::format("found a line of more than {} characters", max_line_length));
      words_ = words_of(line_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  [[nodiscard]] bool names_times() const {
    const std::string first = upper(words_.front());
    return words_.size() > 1 && (first == "T" || first.starts_with("TIME"));
  }

  double number(const std::string& word, const char* what) const {
    const auto value = base::parse_number(word);
    if (!value || !std::isfinite(*value))
      fail(fmt::format("found \"{}\", expected {}", base::excerpt(word), what));
    return *value;
  }

  void read_peer_heading() {
    for (int line = 1; line <= 4; ++line) {
      if (!next()) fail("the file ends in its heading, expected the four heading lines of a PEER file");
      if (line < 4) read_unit();
      if (line == 3 && !table_.unit && !layout_.unit_given)
        fail(fmt::format(
            "found \"{}\", and no unit of acceleration in the first three lines; expected for example "
            "\"ACCELERATION IN UNITS OF G\" (G, CM/S/S, M/S/S, MM/S/S or GAL); records of velocity or "
            "displacement cannot be used",
            base::excerpt(line_)));
    }
    std::vector<double> numbers;
    for (char& c : line_)
      if (c == '=' || c == ',') c = ' ';
    for (const std::string& word : words_of(line_))
      if (const auto value = base::parse_number(word)) numbers.push_back(*value);
    const bool whole = numbers.size() >= 2 && numbers[0] >= 2.0 &&
                       numbers[0] <= static_cast<double>(most_rows) && numbers[0] == std::floor(numbers[0]);
    if (!contains_word(line_, "NPTS") || !whole || !(numbers[1] > 0.0) || !std::isfinite(numbers[1]))
      fail(
          "found no valid NPTS and DT in the fourth line of the PEER file, expected for example "
          "\"NPTS= 5372, DT= .0050\"");
    points_ = static_cast<std::size_t>(numbers[0]);
    layout_.time_step = numbers[1] * layout_.second;
    heading_allowed_ = false;
  }

  void read_unit() {
    const std::string unit = unit_in(line_);
    if (unit.empty()) return;
    table_.unit = acceleration_unit(unit);
    table_.in_g = unit == "G";
    if (!table_.unit)
      fail(fmt::format("found \"{}\", expected an acceleration in units of G, CM/S/S, M/S/S, MM/S/S or GAL",
                       base::excerpt(line_)));
  }

  [[nodiscard]] double time_of_next() const {
    return static_cast<double>(table_.times.size()) * layout_.time_step;
  }

  void read_row() {
    const auto column = static_cast<std::size_t>(layout_.column == 0 ? 2 : layout_.column);
    const bool fits = layout_.column == 0 ? words_.size() == 2 : words_.size() >= column;
    const auto t = base::parse_number(words_[0]);
    const auto value = fits ? base::parse_number(words_[column - 1]) : std::nullopt;
    if (!t || !value || !std::isfinite(*t) || !std::isfinite(*value)) {
      while (!line_.empty() && line_.back() == '\r') line_.pop_back();
      fail(layout_.column == 0
               ? fmt::format("found \"{}\", expected two numbers, time and value", base::excerpt(line_))
               : fmt::format("found \"{}\", expected a time in column 1 and a value in column {}",
                             base::excerpt(line_), column));
    }
    const std::size_t n = table_.times.size();
    if (n > 0 && *t < table_.times[n - 1]) {
      fail(fmt::format("found time {} after {}, expected ascending times", base::format_number(*t),
                       base::format_number(table_.times[n - 1])));
    }
    if (n > 1 && *t == table_.times[n - 2]) {
      fail(fmt::format("found time {} in three rows, expected it in at most two rows (a jump)",
                       base::format_number(*t)));
    }
    add(*t, *value);
  }

  void add(double t, double value) {
    if (table_.times.size() == most_rows) fail(fmt::format("found more than {} rows", most_rows));
    table_.times.push_back(t);
    table_.values.push_back(value);
  }

  std::istream& in_;
  const std::string &file_, &key_;
  TableLayout layout_;
  TimeTable table_;
  std::string line_;
  std::vector<std::string> words_;
  int number_ = 0, last_ = 1;  // number of the current line, and of the last line that was not skipped
  std::size_t points_ = 0;
  bool heading_allowed_ = true;
};

}  // namespace

bool read_line(std::istream& in, std::string& line) {
  line.clear();
  char c = 0;
  while (in.get(c) && c != '\n') {
    line += c;
    if (line.size() > max_line_length) return true;
  }
  return in || !line.empty();
}

void refuse_file(const Table& table, std::string_view key, const FileError& error) {
  const SourcePlace place = table.place(key);
  const std::string where =
      place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column) : place.file;
  throw FileError(where, fmt::format("{}: {}", table.path(key), error.what()));
}

void refuse_file(const Table& table, std::string_view key, const fs::path& path, const std::string& why) {
  refuse_file(table, key, FileError(path.string(), why));
}

std::ifstream open_data_file(const Table& table, std::string_view key, const fs::path& path) {
  // The system would end the name at NUL, and open another file.
  if (path.native().find('\0') != std::string::npos)
    table.wrong(key, "the name of a file, which has no character NUL");
  if (const std::string why = base::input_file_error(path); !why.empty())
    refuse_file(table, key, path, why + ", expected a file");
  errno = 0;
  std::ifstream in(path);
  if (!in) refuse_file(table, key, path, std::strerror(errno ? errno : EIO));
  return in;
}

TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key,
                          const TableLayout& layout) {
  return TableReader(in, file, key, layout).read();
}

}  // namespace signorini::scene
