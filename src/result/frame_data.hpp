// frame_data.hpp: deformed shapes read back, with the scales at which they are drawn.
//
//   X = x + magnification u,   arrow = force_scale (-N n - T t)
//
// magnification: 1, 2 or 5 times a power of ten, so that the greatest displacement is drawn at most an
// eighth of the structure's size; 1 when it is that large by itself. Frames share one, but for those that
// would show less than a fifth of what they could. Arrows have one scale: the longest is that of the greatest
// force of the run.
#pragma once

#include <string>
#include <vector>

#include "model/element/line_element.hpp"
#include "result/csv_read.hpp"

namespace signorini {

struct FrameEnd {
  double x = 0.0, y = 0.0, ux = 0.0, uy = 0.0, rz = 0.0;
};

struct Frame {
  struct Element {
    std::string kind;
    FrameEnd a, b;
  };
  struct Point {
    std::string name;
    bool support = false;
    FrameEnd at;
  };
  struct Force {
    std::string contact, state;
    double x = 0.0, y = 0.0, ux = 0.0, uy = 0.0, nx = 0.0, ny = 0.0;
    double fx = 0.0, fy = 0.0;  ///< on the body
    double N = 0.0, T = 0.0;
  };
  double t = 0.0;
  double slid_x = 0.0, slid_y = 0.0;  ///< taken out of the displacements, and added to the places
  std::vector<Element> elements;
  std::vector<Point> points;
  std::vector<Force> forces;
};

struct FrameScales {
  double magnification = 1.0;
  double greatest_force = 0.0;                    ///< force
  double force_scale = 0.0;                       ///< length on the picture for each unit of force
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< what is drawn, arrows included
};

/// Frames between the two times; none where frames.csv is missing. Errors: FileError.
[[nodiscard]] std::vector<Frame> read_frames(const TableFolder& tables, double from, double to);
/// A structure that slides far shows nothing of its deformation: where the shapes differ from a translation
/// by less than half of their greatest displacement, each frame's mean translation is drawn in true scale.
void take_out_slides(std::vector<Frame>& frames);
/// greatest_force: of the run, at least that of the frames.
[[nodiscard]] FrameScales scales_of(const std::vector<Frame>& frames, double greatest_force = 0.0);
/// Those of a frame beside others whose scales are `shared`.
[[nodiscard]] FrameScales scales_of(const Frame& frame, const FrameScales& shared);

/// 1, 2 or 5 times a power of ten, so that the greatest displacement is drawn at most an eighth of the size; 1 where
/// nothing moves.
[[nodiscard]] double magnification_of(double size, double greatest);

/// Displacement at the fraction s of an element: along it linear, across cubic (beams).
[[nodiscard]] FrameEnd between(const Frame::Element& element, double s);
/// The same by what both ends do to a place across the line (model/element/line_element.hpp).
[[nodiscard]] FrameEnd between(const FrameEnd& a, const FrameEnd& b, double s, const LineShapes& across);

}  // namespace signorini
