#include "scene/data_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>

#include "base/excerpt.hpp"
#include "base/input_file.hpp"
#include "base/number.hpp"

namespace signorini {

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

bool is_binary(const std::string& line) {
  for (const char c : line) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') return true;
  }
  return false;
}

}  // namespace

bool read_line(std::istream& in, std::string& line) {
  line.clear();
  char c = 0;
  while (in.get(c) && c != '\n') {
    line += c;
    if (line.size() > longest_line) return true;
  }
  return in || !line.empty();
}

std::ifstream open_data_file(const Table& table, std::string_view key, const fs::path& path) {
  const auto refuse_file = [&](const std::string& why) {
    const SourcePlace place = table.place(key);
    const std::string where =
        place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column) : place.file;
    throw FileError(where, fmt::format("{}: {}: {}", table.path(key), path.string(), why));
  };
  if (const std::string why = why_no_input_file(path); !why.empty()) refuse_file(why + ", expected a file");
  errno = 0;
  std::ifstream in(path);
  if (!in) refuse_file(std::strerror(errno ? errno : EIO));
  return in;
}

TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key) {
  TimeTable table;
  int number = 0, last = 1;  // lines: this one, the last one that was not skipped
  const auto fail = [&](const std::string& message) { throw SceneError({file, number, 0}, key, message); };
  bool heading_allowed = true;
  for (std::string line; read_line(in, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // written by spreadsheets
    if (is_binary(line)) fail("found binary data, expected lines of time and value");
    if (line.size() > longest_line)
      fail(fmt::format("found a line of more than {} characters", longest_line));
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    last = number;
    const auto t = parse_number(words[0]);
    const auto value = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    const bool heading = heading_allowed && !t;
    heading_allowed = false;
    if (heading) continue;
    if (!t || !value || !std::isfinite(*t) || !std::isfinite(*value)) {
      while (!line.empty() && line.back() == '\r') line.pop_back();
      fail(fmt::format("found \"{}\", expected two numbers, time and value", excerpt(line)));
    }
    const std::size_t n = table.times.size();
    if (n > 0 && *t < table.times[n - 1]) {
      fail(fmt::format("found time {} after {}, expected ascending times", shortest(*t),
                       shortest(table.times[n - 1])));
    }
    if (n > 1 && *t == table.times[n - 2]) {
      fail(fmt::format("found time {} three times, expected at most twice (a jump)", shortest(*t)));
    }
    if (n == most_rows) fail(fmt::format("found more than {} rows", most_rows));
    table.times.push_back(*t);
    table.values.push_back(*value);
  }
  number = last;
  if (in.bad()) fail("cannot be read");
  if (table.times.size() < 2) {
    fail(fmt::format("found {}, expected two or more", count_of(table.times.size(), "row")));
  }
  return table;
}

}  // namespace signorini
