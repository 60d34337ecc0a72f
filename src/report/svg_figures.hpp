// svg_figures.hpp: gnuplot's pictures as parts of a page.
//
// A page contains a picture as <img src="data:image/svg+xml,...">: its content is drawn but never executed,
// and its names cannot collide with others. gnuplot writes paths as absolute points with a resolution of 0.01
// pixel. compress_svg() converts them to relative steps of 0.1 pixel, whose error is invisible at this size,
// and drops coinciding points:
//
//   d='M112.00,61.99 L115.21,60.02 L115.22,60.03'     d='M112 62l3.2-2'
#pragma once

#include <filesystem>
#include <string>

namespace signorini::report {

/// The picture with shorter paths.
[[nodiscard]] std::string compress_svg(const std::string& svg);

/// <figure> with the picture; `caption` is text. Errors: FileError.
[[nodiscard]] std::string figure(const std::filesystem::path& svg, const std::string& caption);

/// Figures of the SVG files of DIR/plots, by name, each as the PNG beside it if that is smaller; empty if there are
/// none. At most `room` bytes: omitted pictures are listed in a sentence.
[[nodiscard]] std::string figures(const std::filesystem::path& directory, std::size_t room);

}  // namespace signorini::report
