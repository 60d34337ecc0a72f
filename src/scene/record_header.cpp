#include "scene/record_header.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "base/text.hpp"

namespace signorini::scene {

namespace {

using Quantity = RecordQuantity;

struct SpelledUnit {
  std::string_view spelling;
  RecordUnit unit;
};
constexpr SpelledUnit spelled_units[] = {{"G", {"g", Quantity::acceleration, standard_gravity}},
                                         {"M/S/S", {"m/s^2", Quantity::acceleration, 1.0}},
                                         {"CM/S/S", {"cm/s^2", Quantity::acceleration, 0.01}},
                                         {"GAL", {"cm/s^2", Quantity::acceleration, 0.01}},
                                         {"MM/S/S", {"mm/s^2", Quantity::acceleration, 0.001}},
                                         {"M/S", {"m/s", Quantity::velocity, 1.0}},
                                         {"CM/S", {"cm/s", Quantity::velocity, 0.01}},
                                         {"MM/S", {"mm/s", Quantity::velocity, 0.001}},
                                         {"M", {"m", Quantity::displacement, 1.0}},
                                         {"CM", {"cm", Quantity::displacement, 0.01}},
                                         {"MM", {"mm", Quantity::displacement, 0.001}}};

std::string upper(std::string_view text) {
  std::string result;
  for (const char c : text) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool joins_units(char c) { return c == '/' || c == '*' || c == '^'; }

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// "(cm / sec**2). Filter" -> "CM/S/S". A unit ends at a blank beside which no / * ^ stands, and at any other character.
std::string spelling_of(std::string_view text) {
  std::string unit;
  for (std::size_t i = text.find_first_not_of(" \t(:="); i < text.size(); ++i) {
    const char c = text[i];
    if (c == ' ' || c == '\t') {
      const std::size_t next = text.find_first_not_of(" \t", i);
      if (next == std::string_view::npos || !(joins_units(text[next]) || joins_units(unit.back()))) break;
      continue;
    }
    if (!std::isalnum(static_cast<unsigned char>(c)) && !joins_units(c)) break;
    unit += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  replace_all(unit, "SEC", "S");
  replace_all(unit, "**", "^");
  replace_all(unit, "/S^2", "/S/S");
  replace_all(unit, "/S2", "/S/S");
  return unit;
}

/// A number at the beginning of a text, after blanks and "=", with Fortran's exponents E and D, and the text after it.
struct LeadingNumber {
  double value;
  std::string_view rest;
};

/// nullopt: there is no number, or it goes on with what a number does not have: "0.02.5", "1/50", "6,000".
std::optional<LeadingNumber> leading_number(std::string_view text) {
  const std::size_t from = std::min(text.find_first_not_of(" \t="), text.size());
  const std::size_t to = std::min(text.find_first_not_of("+-.0123456789EeDd", from), text.size());
  for (std::size_t end = to; end > from; --end) {
    std::string word(text.substr(from, end - from));
    for (char& c : word)
      if (c == 'D' || c == 'd') c = 'E';
    const auto value = base::parse_number(word);
    if (!value) continue;
    const std::string_view rest = text.substr(end);
    const bool digits_follow =
        rest.size() > 1 && rest[0] == ',' && std::isdigit(static_cast<unsigned char>(rest[1]));
    if (digits_follow || (!rest.empty() && std::string_view("+-.0123456789/").find(rest[0]) != rest.npos))
      return std::nullopt;
    return LeadingNumber{*value, rest};
  }
  return std::nullopt;
}

/// The number that follows `mark`, unless another number follows it; the text is in upper case.
std::optional<LeadingNumber> number_after(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  std::optional<LeadingNumber> found = leading_number(text.substr(at + mark.size()));
  if (!found) return std::nullopt;
  const std::size_t next = found->rest.find_first_not_of(" \t");
  if (next != std::string_view::npos && std::isdigit(static_cast<unsigned char>(found->rest[next])))
    return std::nullopt;
  return found;
}

std::optional<double> value_of(const std::optional<LeadingNumber>& number) {
  return number ? std::optional(number->value) : std::nullopt;
}

/// The number of seconds that follows `mark`; nullopt if the word behind the number is no unit of seconds.
std::optional<double> seconds_after(std::string_view text, std::string_view mark) {
  const std::optional<LeadingNumber> found = number_after(text, mark);
  if (!found) return std::nullopt;
  std::string_view word =
      found->rest.substr(std::min(found->rest.find_first_not_of(" \t,"), found->rest.size()));
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  word = word.substr(
      0, static_cast<std::size_t>(std::find_if_not(word.begin(), word.end(), is_letter) - word.begin()));
  for (const std::string_view unit : {"", "S", "SEC", "SECS", "SECOND", "SECONDS", "NPTS"})
    if (word == unit) return found->value;
  return std::nullopt;
}

RecordQuantity quantity_in(std::string_view upper_text) {
  constexpr std::pair<std::string_view, RecordQuantity> words[] = {
      {"ACCEL", Quantity::acceleration}, {"VELOC", Quantity::velocity}, {"DISPL", Quantity::displacement}};
  for (const auto& [word, quantity] : words)
    if (upper_text.find(word) != std::string_view::npos) return quantity;
  return Quantity::none;
}

/// Adds the unit after the first of the marks that the line has. True if it has one.
bool add_unit(std::string_view upper_text, std::initializer_list<std::string_view> marks,
              RecordHeader& header) {
  for (const std::string_view mark : marks) {
    const std::size_t at = upper_text.find(mark);
    if (at == std::string_view::npos) continue;
    header.names_unit = true;
    header.unit = record_unit(upper_text.substr(at + mark.size()));
    return true;
  }
  return false;
}

bool is_count(std::optional<double> points) {
  constexpr double most = 1e9;
  return points && *points >= 2.0 && *points <= most && *points == std::floor(*points);
}

/// Width of a value in "(8F10.3)" at the end of a line; 0 without such a format.
int format_width(std::string_view upper_text) {
  const std::size_t at = upper_text.rfind('(');
  if (at == std::string_view::npos) return 0;
  const std::string_view format = upper_text.substr(at + 1);
  const std::size_t letter = format.find_first_not_of("0123456789");
  constexpr double widest = 40.0;
  if (letter == std::string_view::npos || letter == 0 || (format[letter] != 'F' && format[letter] != 'E'))
    return 0;
  const std::size_t point = format.find_first_not_of("0123456789", letter + 1);
  if (point == std::string_view::npos || format[point] != '.') return 0;
  const auto width = base::parse_number(format.substr(letter + 1, point - letter - 1));
  return width && *width >= 1.0 && *width <= widest ? static_cast<int>(*width) : 0;
}

}  // namespace

const char* name_of(RecordQuantity quantity) {
  return quantity == Quantity::acceleration   ? "acceleration"
         : quantity == Quantity::velocity     ? "velocity"
         : quantity == Quantity::displacement ? "displacement"
                                              : "values";
}

const char* units_of(RecordQuantity quantity) {
  return quantity == Quantity::acceleration   ? "G, CM/S/S, M/S/S, MM/S/S or GAL"
         : quantity == Quantity::velocity     ? "CM/S, M/S or MM/S"
         : quantity == Quantity::displacement ? "CM, M or MM"
                                              : "none";
}

std::optional<RecordUnit> record_unit(std::string_view text) {
  const std::string spelling = spelling_of(text);
  for (const SpelledUnit& known : spelled_units)
    if (known.spelling == spelling) return known.unit;
  return std::nullopt;
}

std::optional<RecordHeader> peer_points(std::string_view line) {
  const std::string text = upper(line);
  if (text.find("NPTS") == std::string::npos || text.find("DT") == std::string::npos) return std::nullopt;
  std::optional<double> points = value_of(number_after(text, "NPTS")), step = seconds_after(text, "DT");
  if (const auto first = leading_number(text); first && !points) {  // "5372 0.0050 NPTS, DT"
    points = first->value;
    step = value_of(leading_number(first->rest));
  }
  if (!is_count(points) || !step || !(*step > 0.0) || !std::isfinite(*step)) return std::nullopt;
  RecordHeader header;
  header.points = static_cast<std::size_t>(*points);
  header.time_step = *step;
  return header;
}

bool add_peer_line(std::string_view line, RecordHeader& header) {
  const std::string text = upper(line);
  const bool names_unit = add_unit(text, {"UNITS OF", "UNITS ARE", "UNITS:", "UNITS="}, header);
  const RecordQuantity found = quantity_in(text);
  const std::size_t first = text.find_first_not_of(" \t");
  // In a title, such as the name of a station, these words mean nothing: the quantity begins the line or has a unit.
  const bool begins = first != std::string::npos && quantity_in(text.substr(first, 5)) != Quantity::none;
  if (found != Quantity::none && (names_unit || begins)) header.quantity = found;
  return names_unit || begins;
}

std::optional<RecordHeader> block_header(std::string_view line) {
  const std::string text = upper(line);
  const bool csmip = text.find("POINTS OF") != std::string::npos &&
                     text.find("EQUALLY SPACED AT") != std::string::npos,
             cosmos = text.find(" PTS, APPROX") != std::string::npos;
  const auto points = value_of(leading_number(text));
  RecordHeader header;
  header.quantity = quantity_in(text);
  if (!(csmip || cosmos) || !is_count(points) || header.quantity == Quantity::none) return std::nullopt;
  header.points = static_cast<std::size_t>(*points);
  if (csmip) header.time_step = std::max(seconds_after(text, "EQUALLY SPACED AT").value_or(0.0), 0.0);
  add_unit(text, {"UNITS=", "UNITS:", ", IN ", " IN "}, header);
  header.width = format_width(text);
  return header;
}

}  // namespace signorini::scene
