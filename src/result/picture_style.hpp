// picture_style.hpp: size, formats, titles and language of pictures.
//
//   signorini plot DIR --size 160x90 --no-title --format pdf --language de
//
// Without a size a picture is 1120 pixels wide (PNG: 1680). A given size sets the width; its height applies
// to pictures over time only. Letters scale with the size down to 6 points (8.3 points at 240 mm, 6 at 160 mm
// and at 85 mm). Panels that have too little room for such letters get more of the height. A reduced height
// makes letters smaller.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace signorini::result {

struct PictureStyle {
  bool title = true;
  double width = 0.0, height = 0.0;  ///< mm; 0: screen width, and height in proportion
  std::vector<std::string> formats = {"svg", "png"};
  std::string language = "en";  ///< for labels, legends and subtitles
};

/// Formats of pictures, in the order in which messages list them.
[[nodiscard]] const std::vector<std::string>& picture_formats();

/// Reads a size, "160" or "160x90", in mm from 20 to 2000. Errors: UsageError.
void read_size(const std::string& text, PictureStyle& look);
/// Reads formats, "svg,pdf". Errors: UsageError.
void read_formats(const std::string& text, PictureStyle& look);
/// Reads a language: "en", "de" or "ru". Errors: UsageError.
void read_language(const std::string& text, PictureStyle& look);

/// Layout area of a picture, in pixels; letters usually are 13 pixels high. On paper a pixel may be smaller.
///
///   pixel = max(6 points of 13, 1.05 size / 1120),   width = size / pixel,   height = height_1120 sqrt(width / 1120)
struct Canvas {
  double width = 1120.0, height = 0.0;
  double pixel = 1.0;  ///< size of a pixel, in 1/96 inch

  /// Left edge of the panels, and their right edge if `legend` pixels are left free; fractions of the width.
  [[nodiscard]] double left() const;
  [[nodiscard]] double right(double legend = usual_legend) const;
  [[nodiscard]] bool narrow() const { return width < 700.0; }
  /// Font size for gnuplot of letters that are `size` pixels high.
  [[nodiscard]] double font(double size) const { return size * pixel; }
  [[nodiscard]] double legend_font() const { return font(narrow() ? 11.0 : 13.0); }
  static constexpr double usual_legend = 185.0;
};
/// Canvas of a picture. height: in pixels, for a width of 1120; over_time: a height in `look` replaces this height;
/// fixed: without a height in `look`, the height does not depend on the width.
[[nodiscard]] Canvas canvas_of(const PictureStyle& look, double height, bool over_time, bool fixed = false);

/// Largest height of a `fixed` canvas, in pixels. The limit is Cairo, which draws at most 32767 dots per side.
[[nodiscard]] double max_canvas_height(const PictureStyle& look);

/// gnuplot lines that set the terminal for each value of the variable `format`. sized: the user gave a size in mm.
[[nodiscard]] std::string terminals(const Canvas& canvas, bool sized);

// Translations of the words in pictures.
//
//   translate("de", "slip") == "Gleiten"
//
// A table has one row per word or phrase; phrases without a row stay English. Names of contacts, symbols and units are
// not translated. Terms of mechanics follow the textbooks of each language. Stick and slip: Haften and Gleiten;
// сцепление and скольжение.

/// Language codes, "en" first.
[[nodiscard]] const std::vector<std::string>& picture_languages();

/// The phrase in a language of picture_languages(); in English if the phrase has no translation.
[[nodiscard]] std::string translate(std::string_view language, std::string_view english);

/// All English phrases that have translations.
[[nodiscard]] std::vector<std::string> translated_phrases();

}  // namespace signorini::result
