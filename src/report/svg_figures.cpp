#include "report/svg_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "report/html.hpp"
#include "signorini/error.hpp"

namespace signorini::report {

namespace fs = std::filesystem;

namespace {

/// Shortest text of a coordinate that is given in tenths of a pixel: 5 -> ".5", -30 -> "-3".
std::string tenths(long value) {
  std::string text = value < 0 ? "-" : "";
  const long size = std::labs(value);
  if (size / 10 != 0 || size == 0) text += std::to_string(size / 10);
  if (size % 10 != 0) text += "." + std::to_string(size % 10);
  return text;
}

/// Appends a number to a path: after a blank, or directly if the number has a minus sign.
void append(std::string& path, long value) {
  const std::string text = tenths(value);
  const bool apart =
      !path.empty() && (std::isdigit(static_cast<unsigned char>(path.back())) != 0) && text[0] != '-';
  path += (apart ? " " : "") + text;
}

struct Point {
  long x = 0, y = 0;
};

/// Reads a point such as "74.59,420.49" at position `at` and advances `at`; false if there is no point.
bool read_point(const std::string& path, std::size_t& at, Point& point) {
  double x = 0.0, y = 0.0;
  const char* end = path.data() + path.size();
  const auto first = std::from_chars(path.data() + at, end, x);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ',') return false;
  const auto second = std::from_chars(first.ptr + 1, end, y);
  if (second.ec != std::errc()) return false;
  constexpr double most = 1e6;  // limit of coordinates, in pixels: larger than any picture
  if (!(std::abs(x) < most && std::abs(y) < most)) return false;
  point = {std::lround(10.0 * x), std::lround(10.0 * y)};
  at = static_cast<std::size_t>(second.ptr - path.data());
  return true;
}

/// Shortens a path that has only commands M x,y and L x,y; any other path stays unchanged.
std::string shorten_path(const std::string& path) {
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

/// Escapes characters that a data address in a quoted attribute must not contain.
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

std::string compress_svg(const std::string& svg) {
  std::string result;
  for (std::size_t at = 0; at < svg.size();) {
    constexpr std::string_view mark = " d='";
    const std::size_t begin = svg.find(mark, at);
    const std::size_t end = begin == std::string::npos ? begin : svg.find('\'', begin + mark.size());
    if (end == std::string::npos) return result + svg.substr(at);
    result += svg.substr(at, begin + mark.size() - at) +
              shorten_path(svg.substr(begin + mark.size(), end - begin - mark.size())) + "'";
    at = end + 1;
  }
  return result;
}

std::string figure(const fs::path& svg, const std::string& caption) {
  return fmt::format(
      "<figure><img loading=lazy decoding=async alt=\"{0}\" src=\"data:image/svg+xml,{1}\">"
      "<figcaption>{0}</figcaption></figure>\n",
      html_text(caption), address(compress_svg(read_whole(svg))));
}

namespace {

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned long three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = 256 * three + (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[(three >> (18 - 6 * k)) & 63U];
  }
  return text;
}

/// Figure with the SVG, or with the PNG of the same name if it is smaller, as for a picture with many thousand points.
std::string smaller_figure(const fs::path& svg) {
  std::string text = figure(svg, svg.stem().string());
  const fs::path png = fs::path(svg).replace_extension(".png");
  std::error_code error;
  constexpr double letters_a_byte = 4.0 / 3.0;
  const auto size = static_cast<double>(fs::file_size(png, error));
  if (error || letters_a_byte * size > static_cast<double>(text.size())) return text;
  return fmt::format(
      "<figure><img loading=lazy decoding=async alt=\"{0}\" src=\"data:image/png;base64,{1}\">"
      "<figcaption>{0}</figcaption></figure>\n",
      html_text(svg.stem().string()), base64(read_whole(png)));
}

}  // namespace

std::string figures(const fs::path& directory, std::size_t room) {
  std::vector<std::pair<fs::path, std::string>> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / "plots", error))
    if (entry.path().extension() == ".svg") all.emplace_back(entry.path(), smaller_figure(entry.path()));
  std::sort(all.begin(), all.end());
  // Order in which pictures get room: pictures of the whole run; then the others, small ones first; pictures of single
  // contacts last, large ones first, because the charts of the page show the same curves.
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  const auto rank = [&](std::size_t i) {
    const std::string name = all[i].first.stem().string();
    const auto size = static_cast<double>(all[i].second.size());
    if (name.starts_with("contact-")) return std::pair(2, -size);
    return std::pair(name == "displacement" || name == "response" || name == "states" ? 0 : 1, size);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::vector<bool> shown(all.size(), false);
  for (const std::size_t i : order) {
    shown[i] = all[i].second.size() <= room;
    if (shown[i]) room -= all[i].second.size();
  }
  std::string text, left_out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (shown[i])
      text += all[i].second;
    else
      left_out += (left_out.empty() ? "" : ", ") + all[i].first.stem().string();
  }
  if (!left_out.empty())
    text += "<p class=hint>In plots/ only, because the page must stay below 3 MB: " + html_text(left_out) +
            ".</p>\n";
  return text;
}

}  // namespace signorini::report
