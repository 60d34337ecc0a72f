#include "result/picture_look.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/number.hpp"
#include "base/suggest.hpp"
#include "result/picture_words.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace {

constexpr double wide = 1120.0;                                           // pixels
constexpr double pixels_a_mm = 96.0 / 25.4, dots_a_pixel = 300.0 / 96.0;  // PNG: 300 an inch

std::string white(const std::string& size, double font) {
  return fmt::format("size {} background '#ffffff' font 'DejaVu Sans,{:.4g}'", size, font);
}

}  // namespace

const std::vector<std::string>& picture_formats() {
  static const std::vector<std::string> names = {"svg", "png", "pdf"};
  return names;
}

void read_size(const std::string& text, PictureLook& look) {
  const std::size_t cross = text.find('x');
  const auto width = parse_number(text.substr(0, cross));
  const bool both = cross != std::string::npos;
  const auto height = parse_number(both ? text.substr(cross + 1) : "0");
  const auto fits = [](double mm) { return mm >= 20.0 && mm <= 2000.0; };
  if (!width || !height || !fits(*width) || (both && !fits(*height)))
    throw UsageError(
        fmt::format("--size: found \"{}\", expected WIDTH or WIDTHxHEIGHT in mm, 20 to 2000 each", text));
  look.width = *width;
  look.height = *height;
}

void read_formats(const std::string& text, PictureLook& look) {
  look.formats.clear();
  std::istringstream words(text);
  const std::vector<std::string>& known = picture_formats();
  for (std::string word; std::getline(words, word, ',');) {
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw UsageError(fmt::format("--format: found \"{}\"{}", word, suggestion(word, known)));
    if (std::find(look.formats.begin(), look.formats.end(), word) == look.formats.end())
      look.formats.push_back(word);
  }
  if (look.formats.empty()) throw UsageError("--format: expected svg, png or pdf");
}

void read_language(const std::string& text, PictureLook& look) {
  const std::vector<std::string>& known = picture_languages();
  if (std::find(known.begin(), known.end(), text) == known.end())
    throw UsageError(fmt::format("--language: found \"{}\"{}", text, suggestion(text, known)));
  look.language = text;
}

Terminals terminals(const PictureLook& look, int height, bool over_time) {
  const bool sized = look.width > 0.0;
  const double width = sized ? look.width * pixels_a_mm : wide;
  const double high = look.height > 0.0 && over_time ? look.height * pixels_a_mm : height * width / wide;
  Terminals result;
  // Panels, their margins and legends stand at fractions of the picture: letters a tenth larger would lose the time axis its name.
  result.font = sized ? 1.05 * 13.0 * std::min(width / wide, high / height) : 13.0;
  result.line = result.font / 13.0 / high;
  const double dots = sized ? dots_a_pixel : 1.5;
  const auto size = [&](double scale) {
    return fmt::format("{},{}", std::lround(width * scale), std::lround(high * scale));
  };
  result.text = fmt::format(
      "if (format eq 'svg') {{ set terminal svg noenhanced {} }}\n"
      "if (format eq 'png') {{ set terminal pngcairo noenhanced {} fontscale {:.4g} linewidth {:.4g} }}\n"
      "if (format eq 'pdf') {{ set terminal pdfcairo noenhanced {} }}\n",
      white(size(1.0), result.font), white(size(dots), result.font), 1.3 / 1.5 * dots, dots,
      white(fmt::format("{:.3f}in,{:.3f}in", width / 96.0, high / 96.0), 0.75 * result.font));
  return result;
}

}  // namespace signorini
