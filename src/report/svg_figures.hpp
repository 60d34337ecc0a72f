// svg_figures.hpp: gnuplot's pictures as parts of a page.
//
// A page contains a picture as <img src="data:image/svg+xml,...">: the picture is drawn, but its scripts never run, and
// its identifiers cannot collide with those of the page. gnuplot writes paths as absolute points with a resolution of
// 0.01 pixel. compress_svg() converts the points to relative steps of 0.1 pixel, whose error is invisible, and drops
// coinciding points:
//
//   d='M112.00,61.99 L115.21,60.02 L115.22,60.03'     d='M112 62l3.2-2'
#pragma once

#include <filesystem>
#include <string>

namespace signorini::report {

/// The picture with shorter paths.
[[nodiscard]] std::string compress_svg(const std::string& svg);

/// <figure> with the picture; caption: plain text, which is escaped. Errors: FileError.
[[nodiscard]] std::string figure(const std::filesystem::path& svg, const std::string& caption);

/// Figures of the SVG files of DIR/plots, by name; a PNG of the same name replaces the SVG if it is smaller. Empty if
/// there are none. The figures have at most `room` bytes; a sentence lists the pictures that are omitted.
[[nodiscard]] std::string figures(const std::filesystem::path& directory, std::size_t room);

}  // namespace signorini::report
