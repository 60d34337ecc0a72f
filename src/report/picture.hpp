// picture.hpp: gnuplot's pictures as parts of a page.
//
// A page holds a picture as <img src="data:image/svg+xml,...">: what is in it is drawn and never run, and its names disturb no
// other's. gnuplot writes paths as absolute points to a hundredth of a pixel; slim_svg() turns them into steps of a tenth, which
// nobody sees at this size, and leaves out points that fall on the one before:
//
//   d='M112.00,61.99 L115.21,60.02 L115.22,60.03'     d='M112 62l3.2-2'
#pragma once

#include <filesystem>
#include <string>

namespace signorini {

[[nodiscard]] std::string slim_svg(const std::string& svg);

/// <figure> with the picture; `caption` is text. Errors: FileError.
[[nodiscard]] std::string figure(const std::filesystem::path& svg, const std::string& caption);

/// Figures of the SVG files of DIR/plots, by name, each as the PNG beside it where that is smaller; empty where there are none. No
/// more than `room` bytes: what does not fit is named in a sentence.
[[nodiscard]] std::string figures(const std::filesystem::path& directory, std::size_t room);

}  // namespace signorini
