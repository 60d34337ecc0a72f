#include "scene/time_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "scene/table_lines.hpp"

namespace signorini::scene {

namespace {

constexpr std::size_t most_rows = 1'000'000;

/// Numbers of the lines of a PEER heading; 0 without one.
struct PeerHeading {
  int last = 0;    // the line with NPTS and DT
  int before = 0;  // the line of words before it
};

/// True for a line that begins with #, also in the heading of a record.
bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '#';
}

/// Reads a file of numbers line by line.
class TableReader {
 public:
  TableReader(std::istream& in, const std::string& file, const std::string& key, const TableLayout& layout)
      : lines_(in, file, key), layout_(layout) {}

  TimeTable read() {
    constexpr std::size_t longest_heading = 200;  // CSMIP has 45 lines, COSMOS some more, and comments
    const std::deque<std::string>& ahead = lines_.ahead(longest_heading);
    if (const PeerHeading heading = peer_heading(ahead); heading.last > 0 || layout_.peer)
      read_peer(heading);
    else if (std::any_of(ahead.begin(), ahead.end(),
                         [](const std::string& line) { return block_header(line).has_value(); }))
      read_blocks();
    else
      read_plain();
    return std::move(table_);
  }

 private:
  [[nodiscard]] bool values_only() const { return layout_.time_step > 0.0; }

  double number(const TableWord& word) const {
    const auto value = base::parse_number(word.text);
    if (!value || !std::isfinite(*value))
      lines_.fail(fmt::format("found \"{}\", expected a number", base::excerpt(word.text)), word.column);
    return *value;
  }

  void add(double t, double value) {
    if (table_.times.size() == most_rows) lines_.fail(fmt::format("found more than {} rows", most_rows));
    table_.times.push_back(t);
    table_.values.push_back(value);
  }

  void add_value(const TableWord& word) {
    add(static_cast<double>(table_.times.size()) * layout_.time_step, number(word));
  }

  // Tables.

  void read_plain() {
    bool heading_allowed = true;
    int last = 1;
    while (lines_.next()) {
      const std::string_view line = without_comment(lines_.line());
      const std::vector<TableWord> words = words_of_line(line);
      if (words.empty()) continue;
      last = lines_.number();
      const bool heading = heading_allowed && !base::parse_number(words[0].text);
      heading_allowed = false;
      if (heading) {
        if (values_only()) refuse_heading_of_times(words);
        continue;
      }
      if (has_empty_cell(line))
        lines_.fail(fmt::format("found \"{}\", expected no empty cell", base::excerpt(line)));
      commas_.add_line(line, lines_.number(), !values_only());
      if (values_only())
        for (const TableWord& word : words) add_value(word);
      else
        read_row(line, words);
    }
    refuse_decimal_commas();
    check_size(last);
  }

  void check_size(int line) const {
    if (table_.times.size() < 2)
      lines_.fail_at(line, 0,
                     fmt::format("found {}, expected two or more",
                                 base::count_text(table_.times.size(), values_only() ? "value" : "row")));
  }

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
    add(*t, *value);
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
    if (numbers)
      help = words.size() == 1 ? "; for a file of values only give time_step"
                               : "; give column for a file of several columns, time_step for values only";
    else if (table_.times.empty())
      help = "; a heading has one line, and other lines of text begin with #";
    lines_.fail(fmt::format("found \"{}\", expected two numbers, time and value{}", found, help));
  }

  // Records.

  /// A file of another name is a PEER record if the third line or a later one of its heading has NPTS and DT.
  [[nodiscard]] PeerHeading peer_heading(const std::deque<std::string>& ahead) const {
    constexpr int longest = 10;
    const int first = layout_.peer ? 2 : 3;
    PeerHeading heading;
    int number = 0, lines = 0;
    for (const std::string& line : ahead) {
      ++number;
      if (words_of_line(line).empty() || is_comment(line)) continue;
      if (++lines > longest) break;
      if (lines >= first && peer_points(line)) {
        heading.last = number;
        return heading;
      }
      heading.before = number;
    }
    return {};
  }

  void read_peer(const PeerHeading& heading) {
    if (heading.last == 0) refuse_peer_heading();
    RecordHeader header;
    int stated = heading.before;
    std::string stated_line;
    while (lines_.next() && lines_.number() < heading.last) {
      if (is_comment(lines_.line())) continue;
      if (add_peer_line(lines_.line(), header)) {
        stated = lines_.number();
        stated_line = lines_.line();
      } else if (lines_.number() == heading.before && stated_line.empty()) {
        stated_line = lines_.line();
      }
    }
    if (header.quantity == RecordQuantity::none && !header.unit) header.quantity = layout_.by_name;
    check_record("PEER", header, stated, stated_line);
    take_step(*peer_points(lines_.line()), heading.last);
    while (lines_.next())
      for (const TableWord& word : words_of_line(without_comment(lines_.line()))) add_value(word);
    check_size(lines_.number());
    if (table_.times.size() != points_)
      lines_.fail(fmt::format("found {}, expected {}, the number given by NPTS",
                              base::count_text(table_.times.size(), "value"), points_));
  }

  [[noreturn]] void refuse_peer_heading() {
    for (int line = 1; line <= 4; ++line)
      if (!lines_.next())
        lines_.fail("the file ends in its heading, expected the four heading lines of a PEER file");
    lines_.fail(
        "found no valid NPTS and DT in the fourth line of the PEER file, expected for example "
        "\"NPTS= 5372, DT= .0050\"");
  }

  /// Refuses records of another quantity or unit than the key takes. `line`: the line that states them.
  void check_record(const char* format, const RecordHeader& header, int number, const std::string& line) {
    const RecordQuantity quantity = header.quantity != RecordQuantity::none ? header.quantity
                                    : header.unit                           ? header.unit->quantity
                                                                            : RecordQuantity::none;
    const std::string found = base::excerpt(line);
    if (layout_.wanted == RecordQuantity::none)
      lines_.fail_at(number, 0,
                     fmt::format("found a {} record of {}, expected a file of values in the scene's units, "
                                 "because only accelerations, motions and velocities take records",
                                 format, name_of(quantity)));
    const std::string name = name_of(layout_.wanted), units = units_of(layout_.wanted);
    const std::string expected = fmt::format("a{} {} in units of {}", name[0] == 'a' ? "n" : "", name, units);
    const bool other = quantity != RecordQuantity::none && quantity != layout_.wanted;
    const bool unknown =
        header.names_unit && (header.unit ? header.unit->quantity != layout_.wanted : !layout_.unit_given);
    if (other || unknown)
      lines_.fail_at(
          number, 0,
          fmt::format("found \"{}\", expected {}{}", found, expected,
                      other || header.unit
                          ? ""
                          : "; give the unit in the scene, for example unit = \"" + example_unit() + "\""));
    if (!header.names_unit && !layout_.unit_given)
      lines_.fail_at(
          number, 0,
          fmt::format("found \"{}\", and no unit of {} in the heading; expected {}, or the unit in "
                      "the scene, for example unit = \"{}\"",
                      found, name, expected, example_unit()));
    if (layout_.column != 0)
      lines_.fail_at(
          number, 0,
          fmt::format("found a {} record, expected a table, because the scene gives column", format));
    table_.unit = header.unit;
  }

  [[nodiscard]] std::string example_unit() const {
    return layout_.wanted == RecordQuantity::acceleration ? "g"
           : layout_.wanted == RecordQuantity::velocity   ? "cm/s"
                                                          : "cm";
  }

  /// Takes the step of a record; a step in the scene must agree with it.
  void take_step(const RecordHeader& header, int number) {
    points_ = header.points;
    const double step = header.time_step * layout_.second;
    if (layout_.time_step > 0.0 &&
        std::abs(layout_.time_step - step) > rounding::few_operations * std::abs(step))
      lines_.fail_at(
          number, 0,
          fmt::format("found a time step of {} s, expected the time_step of the scene, {}; remove "
                      "time_step, because the record states its own",
                      base::format_number(header.time_step), base::format_number(layout_.time_step)));
    layout_.time_step = step;
  }

  /// Reads the block of the wanted quantity; a file with two such blocks has several channels.
  void read_blocks() {
    int first = 0;
    std::string others;
    while (lines_.next()) {
      const auto header = block_header(lines_.line());
      if (!header) continue;
      const bool wanted = layout_.wanted == RecordQuantity::none || header->quantity == layout_.wanted;
      if (!wanted) {
        others += fmt::format("{}{} in line {}", others.empty() ? "" : ", ", name_of(header->quantity),
                              lines_.number());
        continue;
      }
      if (first > 0)
        lines_.fail(
            fmt::format("found a second channel of {}, after that of line {}, expected one; copy the "
                        "channel to a file of its own",
                        name_of(header->quantity), first));
      first = lines_.number();
      read_block(*header);
    }
    if (first == 0)
      lines_.fail(fmt::format("found a record of {}, expected one of {}", others, name_of(layout_.wanted)));
  }

  void read_block(const RecordHeader& header) {
    check_record("CSMIP or COSMOS", header, lines_.number(), lines_.line());
    if (header.time_step > 0.0)
      take_step(header, lines_.number());
    else if (!values_only())
      lines_.fail(
          fmt::format("found \"{}\", a record that does not state its time step here, expected "
                      "time_step in the scene",
                      base::excerpt(lines_.line())));
    const int from = lines_.number();
    while (table_.times.size() < header.points && lines_.next() && !block_header(lines_.line())) {
      const std::string& line = lines_.line();
      if (header.width == 0) {
        for (const TableWord& word : words_of_line(line)) add_value(word);
        continue;
      }
      for (std::size_t at = 0; at < line.size(); at += static_cast<std::size_t>(header.width)) {
        const std::string field = line.substr(at, static_cast<std::size_t>(header.width));
        const std::vector<TableWord> words = words_of_line(field, "");
        if (words.empty()) continue;
        add_value({words.size() == 1 ? words[0].text : field, static_cast<int>(at) + words[0].column});
      }
    }
    if (table_.times.size() != header.points)
      lines_.fail(fmt::format("found {}, expected {}, the number in line {}",
                              base::count_text(table_.times.size(), "value"), header.points, from));
  }

  TableLines lines_;
  TableLayout layout_;
  TimeTable table_;
  DecimalCommas commas_;
  std::size_t points_ = 0;
};

}  // namespace

TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key,
                          const TableLayout& layout) {
  return TableReader(in, file, key, layout).read();
}

}  // namespace signorini::scene
