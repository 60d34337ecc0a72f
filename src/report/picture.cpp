#include "report/picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "report/html.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

/// A coordinate in tenths, as short as it goes.
std::string tenths(long value) {
  std::string text = value < 0 ? "-" : "";
  const long size = std::labs(value);
  if (size / 10 != 0 || size == 0) text += std::to_string(size / 10);
  if (size % 10 != 0) text += "." + std::to_string(size % 10);
  return text;
}

/// "3.2" behind "1": a blank, or nothing before a sign.
void append(std::string& path, long value) {
  const std::string text = tenths(value);
  const bool apart =
      !path.empty() && (std::isdigit(static_cast<unsigned char>(path.back())) != 0) && text[0] != '-';
  path += (apart ? " " : "") + text;
}

struct Point {
  long x = 0, y = 0;
};

/// "74.59,420.49" at `at`, which then stands behind it; false for anything else.
bool read_point(const std::string& path, std::size_t& at, Point& point) {
  double x = 0.0, y = 0.0;
  const char* end = path.data() + path.size();
  const auto first = std::from_chars(path.data() + at, end, x);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ',') return false;
  const auto second = std::from_chars(first.ptr + 1, end, y);
  if (second.ec != std::errc()) return false;
  constexpr double most = 1e6;  // no picture is as large
  if (!(std::abs(x) < most && std::abs(y) < most)) return false;
  point = {std::lround(10.0 * x), std::lround(10.0 * y)};
  at = static_cast<std::size_t>(second.ptr - path.data());
  return true;
}

/// A path of M x,y and L x,y only; any other as it was.
std::string slim_path(const std::string& path) {
  std::string result;
  Point here;
  bool drawing = false;
  for (std::size_t at = 0; at < path.size();) {
    const char c = path[at];
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') {
      ++at;
      continue;
    }
    Point next;
    if ((c != 'M' && c != 'L') || !read_point(path, ++at, next)) return path;
    if (c == 'M') {
      result += "M";
      append(result, next.x);
      append(result, next.y);
      drawing = false;
    } else if (next.x != here.x || next.y != here.y || !drawing) {
      if (!drawing) result += "l";
      append(result, next.x - here.x);
      append(result, next.y - here.y);
      drawing = true;
    }
    here = next;
  }
  return result;
}

std::string read_whole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string(), "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What a data address in a quoted attribute may not have as it is.
std::string address(const std::string& svg) {
  std::string result;
  for (const char c : svg) {
    if (c == '%' || c == '#' || c == '"' || c == '&' || c == '<' || c == '>') {
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      result += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
    }
  }
  return result;
}

}  // namespace

std::string slim_svg(const std::string& svg) {
  std::string result;
  for (std::size_t at = 0; at < svg.size();) {
    constexpr std::string_view mark = " d='";
    const std::size_t begin = svg.find(mark, at);
    const std::size_t end = begin == std::string::npos ? begin : svg.find('\'', begin + mark.size());
    if (end == std::string::npos) return result + svg.substr(at);
    result += svg.substr(at, begin + mark.size() - at) +
              slim_path(svg.substr(begin + mark.size(), end - begin - mark.size())) + "'";
    at = end + 1;
  }
  return result;
}

std::string figure(const fs::path& svg, const std::string& caption) {
  return fmt::format(
      "<figure><img loading=lazy decoding=async alt=\"{0}\" src=\"data:image/svg+xml,{1}\">"
      "<figcaption>{0}</figcaption></figure>\n",
      html_text(caption), address(slim_svg(read_whole(svg))));
}

std::string figures(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / "plots", error))
    if (entry.path().extension() == ".svg") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string text;
  for (const fs::path& file : files) text += figure(file, file.stem().string());
  return text;
}

}  // namespace signorini
