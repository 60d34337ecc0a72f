// picture_look.hpp: how large pictures are, what files they become, and whether they have a title.
//
//   signorini plot DIR --size 160x90 --no-title --format pdf --language de
//
// Without a size a picture is 1120 pixels wide (PNG: 1680). With one it has that width, and keeps its proportions; a height is
// that of pictures over time. Letters follow the size: 8.3 points of 240 mm, 5.5 of 160 mm; fewer where the height is squeezed.
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

/// gnuplot's terminals, chosen by its variable `format`. `height`: of 1120 pixels' width; `over_time`: it may be another.
/// `line`: a pixel of text as a part of the picture's height, for what stands below its upper edge.
struct Terminals {
  std::string text;
  double line = 0.0, font = 13.0;
};
[[nodiscard]] Terminals terminals(const PictureLook& look, int height, bool over_time);

}  // namespace signorini
