// text.hpp: numbers, lists, names and tables as text, independent of the locale.
//
//   format_number(0.1) == "0.1";  parse_number(format_number(x)) == x for every finite x
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::base {

/// The shortest text that is read back as exactly the same number (std::to_chars): "1e-08", "0.3", "100", "inf", "nan".
[[nodiscard]] std::string format_number(double value);

/// The whole text as a number (a leading + is allowed); nullopt if the text contains anything else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The whole text as an integer; nullopt if the text contains anything else or the integer overflows.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);

/// Number and noun, with a plural "s" unless the number is 1: "1 value", "3 values".
[[nodiscard]] std::string count_text(std::size_t number, std::string_view thing);

// Joins names for a sentence.
//
//   join_quoted({"A", "B", "C"}, 3)        "'A', 'B' and 'C'"
//   join_quoted({"A", "B", "C", "D"}, 2)   "'A', 'B' and 2 more"

/// Joins the first `most` names in quotes, followed by the number of further names.
[[nodiscard]] std::string join_quoted(const std::vector<std::string>& names, std::size_t most = 10);

/// Joins the first `most` texts without quotes, followed by the number of further texts.
[[nodiscard]] std::string join_texts(const std::vector<std::string>& texts, std::size_t most = 10);

// A duration as text.
//
//   duration_text(0.4) == "1 s", duration_text(75) == "1.3 min"

/// Duration as text, seconds >= 0: whole seconds below one minute, otherwise two digits in min, h or days.
[[nodiscard]] std::string duration_text(double seconds);

/// Excerpt of a text from a file, for a message: at most 80 characters, ending with "..." if the text is longer. Characters
/// other than printable ASCII become '?'.
[[nodiscard]] std::string excerpt(std::string_view text);

/// True for valid UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// True for UTF-8 text whose only control characters are tabs and line breaks.
[[nodiscard]] bool is_plain_text(std::string_view text);

/// The text without characters that a terminal obeys: ESC, BEL, DEL and all other control characters of ASCII and of U+0080 to
/// U+009F, except tabs and line breaks, become "\u001b". Bytes that are not UTF-8 are treated as characters of Latin-1. The
/// result is unchanged if the function is applied to it again, and JSON stays JSON.
[[nodiscard]] std::string printable(std::string_view text);

// Fingerprint: a short text computed from all bytes of a long text, equal on every machine.
//
//   FNV-1a of 64 bits:   h = 14695981039346656037,  for each byte  h = (h xor byte) 1099511628211 mod 2^64
//   sixteen hexadecimal digits of h
//
// A change of a single byte always changes the fingerprint. Any other change goes unnoticed with probability 2^-64.

/// Computes the fingerprint of a text that is added in parts.
class Fingerprint {
 public:
  void add(std::string_view part);
  /// Fingerprint of all parts added so far: sixteen hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

[[nodiscard]] std::string fingerprint_of(const std::string& text);

// Suggests known names that are similar to an unknown name.
//
//   suggestion("frictoin", {"friction", "gap"}) == "; did you mean \"friction\"?"

/// Number of insertions, deletions, replacements and swaps of neighbouring characters that turn a into b.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name most similar to the given one, if the difference may be a typing error; otherwise empty.
[[nodiscard]] std::string nearest_name(std::string_view given, const std::vector<std::string>& known);

/// Text for the end of a message, "; did you mean \"friction\"?"; empty if no known name is similar.
[[nodiscard]] std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

/// Text for the end of a message: "; did you mean ...?" with the most similar name, or else "; known: ..." with some known
/// names.
[[nodiscard]] std::string suggestion(std::string_view given, const std::vector<std::string>& known);

// Reads one row of a CSV table.
//
//   t,"a, quoted",1.5      cells separated by commas; a quoted cell may contain commas, line breaks and "" for "
//
// A last line without line break (of a run in progress or a killed run) is not a row. Its cells are returned, so that the
// caller can report or use them.

/// Reads the next row. Returns false at the end of the table; `cells` then contains the cells of a last line without line
/// break. Also returns false for a row longer than 100 MB, which is invalid (a million degrees of freedom need 40 MB).
[[nodiscard]] bool read_csv_row(std::istream& in, std::vector<std::string>& cells);

}  // namespace signorini::base
