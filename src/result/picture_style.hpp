// picture_style.hpp: size, formats and titles of pictures.
//
//   signorini plot DIR --size 160x90 --no-title --format pdf --language de
//
// Without a size a picture is 1120 pixels wide (PNG: 1680). A given size sets the width; its height applies to pictures
// over time. Letters scale with the size down to 6 points (8.3 points at 240 mm, 6 at 160 mm and at 85 mm); panels with
// too little room beside such letters get more of the height. A reduced height makes letters smaller.
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

/// Formats of pictures, in the order of lists.
[[nodiscard]] const std::vector<std::string>& picture_formats();

/// "160" or "160x90", in mm from 20 to 2000; "svg,pdf". Errors: UsageError.
void read_size(const std::string& text, PictureStyle& look);
void read_formats(const std::string& text, PictureStyle& look);
/// "en", "de", "ru". Errors: UsageError.
void read_language(const std::string& text, PictureStyle& look);

/// Layout area of a picture, in pixels of which a letter has 13. On paper such a pixel may be smaller.
///
///   pixel = max(6 points of 13, 1.05 size / 1120),   width = size / pixel,   height = height_1120 sqrt(width / 1120)
struct Canvas {
  double width = 1120.0, height = 0.0;
  double pixel = 1.0;  ///< size relative to 1/96 inch

  /// Left edge of the panels, and their right edge if `legend` pixels are left free; fractions of the width.
  [[nodiscard]] double left() const;
  [[nodiscard]] double right(double legend = usual_legend) const;
  [[nodiscard]] bool narrow() const { return width < 700.0; }
  /// Font size for gnuplot; the usual one is 13.
  [[nodiscard]] double font(double size) const { return size * pixel; }
  [[nodiscard]] double legend_font() const { return font(narrow() ? 11.0 : 13.0); }
  static constexpr double usual_legend = 185.0;
};
/// `height`: for a width of 1120. over_time: the height may differ; otherwise it is not reduced if `fixed`.
[[nodiscard]] Canvas canvas_of(const PictureStyle& look, double height, bool over_time, bool fixed = false);

/// The largest height of a `fixed` canvas. Cairo draws at most 32767 dots per side.
[[nodiscard]] double max_canvas_height(const PictureStyle& look);

/// gnuplot's terminals, selected by its variable `format`.
[[nodiscard]] std::string terminals(const Canvas& canvas, bool sized);

// Translations of the words in pictures.
//
//   say("de", "slip") == "Gleiten"
//
// One table, with one row per word or phrase; phrases without a row stay English. Names of contacts, symbols and units
// are not translated. Terms of mechanics follow the textbooks of each language; stick, slip: Haften, Gleiten;
// сцепление, скольжение, as in the paper behind the program.

/// Language codes, "en" first.
[[nodiscard]] const std::vector<std::string>& picture_languages();

/// The phrase in a language of picture_languages().
[[nodiscard]] std::string translate(std::string_view language, std::string_view english);

/// Every English phrase that has a row.
[[nodiscard]] std::vector<std::string> translated_phrases();

}  // namespace signorini::result
