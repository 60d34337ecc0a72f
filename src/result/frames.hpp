// frames.hpp: writes deformed shapes and contact forces at chosen times (docs/output.md), and reads them for
// pictures.
//
//   frames.csv          t,kind,element,node,x,y,ux,uy,rz
//   frame_contacts.csv  t,contact,state,node,x,y,ux,uy,nx,ny,tx,ty,N,T
//
// kind: beam, bar, spring, rigid or mesh (two rows per element, one for each end; "B-D.3" is an inner node), then node or
// support (one row per named node, element empty). x, y: undeformed position. The force on the body at a contact is
// -N n - T t. Both files are created with the first frame. Errors: FileError.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/element/line_elements.hpp"
#include "result/csv.hpp"
#include "result/run_tables.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

/// Displacements of the nodes of a scene. Each component is a degree of freedom, the motion of a support, or zero.
class NodeDisplacements {
 public:
  NodeDisplacements(const Scene& scene, const Model& model);
  /// Displacement (order 0) or velocity (1) of a node of the scene along an axis (0: x).
  [[nodiscard]] double value(std::size_t node, std::size_t axis, const Sample& sample, int order = 0) const;

 private:
  struct NodeComponent {
    int dof = -1;
    std::optional<History> given = {};
  };
  std::vector<std::array<NodeComponent, 2>> movers_;
};

class FrameWriter {
 public:
  FrameWriter(const std::filesystem::path& directory, const Model& model);
  void write(const Sample& sample);

 private:
  void write_shape(const Sample& sample);
  void write_contacts(const Sample& sample);

  const Model& model_;
  TableFile<FrameRow> shapes_;
  TableFile<FrameContactRow> contacts_;
};

// Reads deformed shapes, and finds the scales of their drawings.
//
//   X = x + magnification u,   arrow = force_scale (-N n - T t)
//
// magnification: 1, 2 or 5 times a power of ten, so that the largest displacement is drawn with at most an eighth of the
// structure's size; but at least 1. Frames share one magnification; a frame whose own magnification would be at least
// five times the shared one is drawn with its own. All arrows have one scale: the longest arrow is the largest force of
// the run.

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
    double fx = 0.0, fy = 0.0;  ///< force on the body
    double N = 0.0, T = 0.0;
  };
  double t = 0.0;
  /// Mean translation of the named nodes, subtracted from displacements and added to positions.
  double translation_x = 0.0, translation_y = 0.0;
  std::vector<Element> elements;
  std::vector<Point> points;
  std::vector<Force> forces;
};

struct FrameScales {
  double magnification = 1.0;
  double greatest_force = 0.0;                    ///< largest contact force
  double force_scale = 0.0;                       ///< length in the picture per unit of force
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< drawn area, arrows included
};

/// Reads the frames from time `from` to time `to`; empty if frames.csv is missing. Errors: FileError.
[[nodiscard]] std::vector<Frame> read_frames(const TableFolder& tables, double from, double to);
/// Subtracts each frame's mean translation from displacements and adds it to positions, so that only the deformation is
/// magnified. Does so only if all shapes differ from a translation by less than half of the largest displacement.
void subtract_translations(std::vector<Frame>& frames);
/// Common scales of all frames. greatest_force: largest force of the run; a larger force in the frames replaces this
/// value.
[[nodiscard]] FrameScales scales_of(const std::vector<Frame>& frames, double greatest_force = 0.0);
/// Scales for one frame: `shared`, or its own if its own magnification is at least five times the shared one.
[[nodiscard]] FrameScales scales_of(const Frame& frame, const FrameScales& shared);

/// Magnification: 1, 2 or 5 times a power of ten, so that the largest displacement is drawn with at most an
/// eighth of the size; 1 if all displacements are zero.
[[nodiscard]] double magnification_of(double size, double greatest);

/// Displacement at the fraction s of an element: linear along the element; across it, cubic for beams, else linear.
[[nodiscard]] FrameEnd between(const Frame::Element& element, double s);
/// Displacement at the fraction s between two ends, with given shape functions across the line
/// (model/element/line_elements.hpp).
[[nodiscard]] FrameEnd between(const FrameEnd& a, const FrameEnd& b, double s,
                               const element::LineShapes& across);

}  // namespace signorini::result
