// picture_look.hpp: how large pictures are, what files they become, and whether they have a title.
//
//   signorini plot DIR --size 160x90 --no-title --format pdf --language de
//
// Without a size a picture is 1120 pixels wide (PNG: 1680). With one it has that width; a height is that of pictures over time.
// Letters follow the size down to 6 points (8.3 of 240 mm, 6 of 160 mm and of 85 mm); what then has too little room beside them
// gets more of the height. A height that is squeezed makes smaller letters.
#pragma once

#include <string>
#include <vector>

namespace signorini {

struct PictureLook {
  bool title = true;
  double width = 0.0, height = 0.0;  ///< mm; 0: as large as a screen takes, and in proportion
  std::vector<std::string> formats = {"svg", "png"};
  std::string language = "en";  ///< of labels, legends and subtitles
};

/// What pictures can be, in the order of lists.
[[nodiscard]] const std::vector<std::string>& picture_formats();

/// "160" or "160x90", in mm from 20 to 2000; "svg,pdf". Errors: UsageError.
void read_size(const std::string& text, PictureLook& look);
void read_formats(const std::string& text, PictureLook& look);
/// "en", "de", "ru". Errors: UsageError.
void read_language(const std::string& text, PictureLook& look);

/// What a picture is laid out on: in pixels of which a letter has 13. On paper such a pixel may be smaller.
///
///   pixel = max(6 points of 13, 1.05 size / 1120),   width = size / pixel,   height = height_1120 sqrt(width / 1120)
struct Canvas {
  double width = 1120.0, height = 0.0;
  double pixel = 1.0;  ///< of 96 an inch

  /// Where panels begin, and where they end that leave `legend` pixels at the right; parts of the width.
  [[nodiscard]] double left() const;
  [[nodiscard]] double right(double legend = usual_legend) const;
  [[nodiscard]] bool narrow() const { return width < 700.0; }
  /// A size of letters where the usual one is 13, for gnuplot.
  [[nodiscard]] double font(double size) const { return size * pixel; }
  [[nodiscard]] double legend_font() const { return font(narrow() ? 11.0 : 13.0); }
  static constexpr double usual_legend = 185.0;
};
/// `height`: of a width of 1120. over_time: it may be another; else it is no less than that in any case where `fixed`.
[[nodiscard]] Canvas canvas_of(const PictureLook& look, double height, bool over_time, bool fixed = false);

/// The greatest height that a `fixed` canvas may have. Cairo draws 32767 dots a side.
[[nodiscard]] double tallest(const PictureLook& look);

/// gnuplot's terminals, chosen by its variable `format`.
[[nodiscard]] std::string terminals(const Canvas& canvas, bool sized);

}  // namespace signorini
