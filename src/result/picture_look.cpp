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
constexpr double pixels_a_mm = 96.0 / 25.4, dots_a_pixel = 300.0 / 96.0;  // PNG: 300 dots per inch
constexpr double usual_dots = 1.5;                                        // PNG: dots per pixel
constexpr double most_dots = 32000.0;                                     // per side
constexpr double letter_height = 13.0;                                    // pixels
constexpr double least_letter = 6.0 * 96.0 / 72.0;                        // 6 points, the minimum of journals

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

double Canvas::left() const { return (narrow() ? 96.0 : 112.0) / width; }

double Canvas::right(double legend) const {
  const double room = narrow() ? legend * 155.0 / usual_legend : legend;
  return 1.0 - std::min(room / width, 0.5);
}

Canvas canvas_of(const PictureLook& look, double height, bool over_time, bool fixed) {
  Canvas canvas;
  canvas.height = height;
  if (look.width <= 0.0) return canvas;
  const double size = look.width * pixels_a_mm;
  canvas.pixel = std::max(least_letter / letter_height, 1.05 * size / wide);
  const double high = over_time ? look.height * pixels_a_mm : 0.0;
  // Panels of less than half their height have no room for text beside them: smaller letters, then.
  if (high > 0.0) canvas.pixel = std::min(canvas.pixel, high / (0.5 * height));
  canvas.width = size / canvas.pixel;
  if (high > 0.0) {
    canvas.height = high / canvas.pixel;
  } else if (!fixed) {
    canvas.height *= std::sqrt(canvas.width / wide);
  }
  return canvas;
}

double tallest(const PictureLook& look) {
  const double dots = look.width > 0.0 ? dots_a_pixel : usual_dots;
  return most_dots / (dots * canvas_of(look, 0.0, false, true).pixel);
}

std::string terminals(const Canvas& canvas, bool sized) {
  const double dots = sized ? dots_a_pixel : usual_dots;
  const auto size = [&](double scale) {
    return fmt::format("{},{}", std::lround(canvas.width * canvas.pixel * scale),
                       std::lround(canvas.height * canvas.pixel * scale));
  };
  const double font = canvas.font(letter_height), line = canvas.pixel;
  return fmt::format(
      "if (format eq 'svg') {{ set terminal svg noenhanced {} linewidth {:.4g} }}\n"
      "if (format eq 'png') {{ set terminal pngcairo noenhanced {} fontscale {:.4g} linewidth {:.4g} "
      "pointscale {:.4g} }}\n"
      "if (format eq 'pdf') {{ set terminal pdfcairo noenhanced {} linewidth {:.4g} pointscale {:.4g} }}\n",
      white(size(1.0), font), line, white(size(dots), font), 1.3 / 1.5 * dots, dots * line,
      sized ? line : 1.0,
      white(fmt::format("{:.3f}in,{:.3f}in", canvas.width * canvas.pixel / 96.0,
                        canvas.height * canvas.pixel / 96.0),
            0.75 * font),
      line, line);
}

}  // namespace signorini
