#include "base/text.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

namespace signorini::base {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string format_number(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::optional<double> parse_number(std::string_view text) { return parse_whole<double>(text); }

std::optional<long long> parse_integer(std::string_view text) { return parse_whole<long long>(text); }

std::string count_text(std::size_t number, std::string_view thing) {
  return std::to_string(number) + " " + std::string(thing) + (number == 1 ? "" : "s");
}

std::string join_texts(const std::vector<std::string>& texts, std::size_t most) {
  std::string text;
  const std::size_t shown = std::min(texts.size(), most);
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i > 0 && i + 1 == texts.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + texts[i];
  }
  return shown < texts.size() ? text + " and " + std::to_string(texts.size() - shown) + " more" : text;
}

std::string join_quoted(const std::vector<std::string>& names, std::size_t most) {
  std::vector<std::string> quoted;
  quoted.reserve(names.size());
  for (const std::string& name : names) quoted.push_back("'" + name + "'");
  return join_texts(quoted, most);
}

std::string duration_text(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0, day = 86400.0;
  const auto in = [&](double unit, const char* name) {
    const double value = seconds / unit;
    return value < 9.95 ? fmt::format("{:.1f} {}", value, name) : fmt::format("{:.0f} {}", value, name);
  };
  if (seconds < minute - 0.5) return fmt::format("{:.0f} s", std::max(1.0, std::ceil(seconds)));
  if (seconds < hour) return in(minute, "min");
  return seconds < day ? in(hour, "h") : in(day, "days");
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 80;
  std::string shown(text.substr(0, longest));
  for (char& c : shown)
    if (c < 0x20 || c > 0x7e) c = '?';
  return text.size() > longest ? shown.substr(0, longest - 3) + "..." : shown;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (length == 0 || lead > 0xf4 || i + length > text.size()) return false;
    char32_t code = length == 1 ? lead : lead & (0x7fU >> length);
    for (std::size_t j = 1; j < length; ++j) {
      const auto next = static_cast<unsigned char>(text[i + j]);
      if ((next & 0xc0U) != 0x80U) return false;
      code = code << 6U | (next & 0x3fU);
    }
    if ((length == 3 && code < 0x800) || (length == 4 && code < 0x10000) || code > 0x10ffff) return false;
    if (code >= 0xd800 && code <= 0xdfff) return false;
    i += length;
  }
  return true;
}

bool is_plain_text(std::string_view text) {
  for (const char c : text)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f)
      return false;
  return is_utf8(text);
}

std::string printable(std::string_view text) {
  constexpr unsigned first_byte_of_c1 = 0xc2, first_c1 = 0x80, last_c1 = 0x9f, del = 0x7f, blank = 0x20;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto continues = [&](std::size_t i) { return i < text.size() && (byte(i) & 0xc0U) == 0x80U; };
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned c = byte(i);
    const bool is_c1 = c == first_byte_of_c1 && continues(i + 1) && byte(i + 1) <= last_c1;
    const bool is_lone_c1 = c >= first_c1 && c <= last_c1;
    if (is_c1) {
      result += fmt::format("\\u{:04x}", byte(++i));
    } else if ((c < blank && c != '\t' && c != '\n') || c == del || is_lone_c1) {
      result += fmt::format("\\u{:04x}", c);
    } else {
      result += text[i];
      if (c > first_byte_of_c1)  // the continuation bytes of a longer character
        for (; continues(i + 1); ++i) result += text[i + 1];
      else if (c == first_byte_of_c1 && continues(i + 1))
        result += text[++i];
    }
  }
  return result;
}

void Fingerprint::add(std::string_view part) {
  std::uint64_t hash = hash_;  // local copy: a member would be written to memory after every byte
  for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  hash_ = hash;
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

std::string fingerprint_of(const std::string& text) {
  Fingerprint whole;
  whole.add(text);
  return whole.text();
}

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest_name(std::string_view given, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 60;  // longer names are unlikely to be typing errors
  if (given.size() > longest) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string& name : known) {
    if (name.size() > longest) continue;
    const std::size_t distance = edit_distance(lower(given), lower(name));
    if (distance < best_distance && distance < name.size()) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  const std::string best = nearest_name(given, known);
  return best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best);
}

std::string suggestion(std::string_view given, const std::vector<std::string>& known) {
  if (std::string meant = did_you_mean(given, known); !meant.empty()) return meant;
  if (known.empty()) return {};
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(known.size(), most); ++i) list += (i ? ", " : "") + known[i];
  return fmt::format("; known: {}{}", list, known.size() > most ? ", ..." : "");
}

bool read_csv_row(std::istream& in, std::vector<std::string>& cells) {
  constexpr std::size_t longest = 100u << 20;
  cells.clear();
  std::string cell;
  bool quoted = false;
  std::size_t size = 0;
  std::streambuf& bytes = *in.rdbuf();
  constexpr int end = std::char_traits<char>::eof();
  for (int next = bytes.sbumpc(); next != end && size < longest; next = bytes.sbumpc(), ++size) {
    const char c = static_cast<char>(next);
    if (c == '"') {
      const bool doubled = quoted && bytes.sgetc() == '"';
      if (doubled) cell += static_cast<char>(bytes.sbumpc());
      if (!doubled) quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      if (c == '\n' && !cell.empty() && cell.back() == '\r') cell.pop_back();
      cells.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') return true;
    } else {
      cell += c;
    }
  }
  if (size > 0) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    cells.push_back(std::move(cell));
  }
  return false;
}

}  // namespace signorini::base
