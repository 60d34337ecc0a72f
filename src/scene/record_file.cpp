#include "scene/record_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/text.hpp"

namespace signorini::scene {

namespace {

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

class RecordReader {
 public:
  RecordReader(TableLines& lines, const TableLayout& layout) : lines_(lines), layout_(layout) {}

  std::optional<TimeTable> read() {
    constexpr std::size_t longest_heading = 200;  // CSMIP has 45 lines, COSMOS some more, and comments
    const std::deque<std::string>& ahead = lines_.ahead(longest_heading);
    if (const PeerHeading heading = peer_heading(ahead); heading.last > 0 || layout_.peer)
      read_peer(heading);
    else if (std::any_of(ahead.begin(), ahead.end(),
                         [](const std::string& line) { return block_header(line).has_value(); }))
      read_blocks();
    else
      return std::nullopt;
    return std::move(table_);
  }

 private:
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
      append_values(lines_, words_of_line(without_comment(lines_.line())), layout_.time_step, table_);
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
    else if (!(layout_.time_step > 0.0))
      lines_.fail(
          fmt::format("found \"{}\", a record that does not state its time step here, expected "
                      "time_step in the scene",
                      base::excerpt(lines_.line())));
    const int from = lines_.number();
    while (table_.times.size() < header.points && lines_.next() && !block_header(lines_.line())) {
      const std::string& line = lines_.line();
      if (header.width == 0) {
        append_values(lines_, words_of_line(line), layout_.time_step, table_);
        continue;
      }
      for (std::size_t at = 0; at < line.size(); at += static_cast<std::size_t>(header.width)) {
        const std::string field = line.substr(at, static_cast<std::size_t>(header.width));
        const std::vector<TableWord> words = words_of_line(field, "");
        if (words.empty()) continue;
        append_values(lines_,
                      {{words.size() == 1 ? words[0].text : field, static_cast<int>(at) + words[0].column}},
                      layout_.time_step, table_);
      }
    }
    if (table_.times.size() != header.points)
      lines_.fail(fmt::format("found {}, expected {}, the number in line {}",
                              base::count_text(table_.times.size(), "value"), header.points, from));
  }

  TableLines& lines_;
  TableLayout layout_;
  TimeTable table_;
  std::size_t points_ = 0;
};

}  // namespace

std::optional<TimeTable> read_record(TableLines& lines, const TableLayout& layout) {
  return RecordReader(lines, layout).read();
}

}  // namespace signorini::scene
