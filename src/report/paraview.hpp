// paraview.hpp: a run as frames in VTK's XML format, for ParaView and other programs.
//
//   DIR/paraview/run.pvd          the frames with their real times
//   DIR/paraview/frame-0001.vtu   one per time, ASCII:
//
//   points      undeformed; `displacement` moves them (Warp By Vector)
//               `force`: force on the structure at the point
//   cells       members as polylines of ten parts, springs as lines; nodes, contacts and loads as vertices
//   cell data   kind: 0 beam, 1 bar, 2 spring, 3 node, 4 contact, 5 load, 6 rigid body
//               state: 0 stick, 1 slip+, 2 slip-, 3 closed, 4 open, -1 none
//               item: number of the contact or load, from 0
//
// Displacements and forces are those of the page (run_data.hpp): six digits, members cubic between named
// nodes. The force of a contact is -N n - T t, in the scene's units.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "signorini/scene.hpp"

namespace signorini::report {

// Parts of VTK's XML files that all frames share, as text.
//
//   VtkCells cells;  cells.add(type, corners);  ...
//   vtk_grid(points, point_count, cells, point_data + cell_data)   the text of a .vtu file
//   VtkSeries series(folder, "frame");  series.add(t, text);  return series.finish("run.pvd");

/// Text of a data array. values: numbers separated by blanks or line ends.
[[nodiscard]] std::string vtk_array(std::string_view type, std::string_view name, const std::string& values,
                                    int components = 1);

class VtkCells {
 public:
  /// Adds a cell. type: VTK's cell type; corners: indices of points.
  void add(int type, const std::vector<std::size_t>& corners);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string text() const;

 private:
  std::string connectivity_, offsets_, types_;
  std::size_t count_ = 0, end_ = 0;
};

/// Text of a .vtu file. points: three coordinates per point; data: texts of point data and cell data.
[[nodiscard]] std::string vtk_grid(const std::string& points, std::size_t point_count, const VtkCells& cells,
                                   const std::string& data);

/// Writes files FOLDER/PREFIX-0001.vtu, ... and a list of these files with their times. Errors: FileError.
class VtkSeries {
 public:
  VtkSeries(std::filesystem::path folder, std::string prefix)
      : folder_(std::move(folder)), prefix_(std::move(prefix)) {}
  void add(double t, const std::string& text);
  /// Writes the list, and returns its path.
  [[nodiscard]] std::filesystem::path finish(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::string prefix_, list_;
  int number_ = 0;
};

// Bodies and seams at the times of run.frames, for ParaView.
//
//   DIR/paraview/bodies.pvd        the frames with their times
//   DIR/paraview/body-0001.vtu     one per time, ASCII:
//
//   points      undeformed nodes of all bodies; `displacement` moves them (Warp By Vector)
//               `stress`: xx, yy, xy; `mises`
//               `traction`: force per area of a seam on its slave, -p n - tau t at its nodes, zero elsewhere
//   cells       triangles and quadrilaterals, linear or quadratic; one vertex per node of a seam
//   cell data   body: from 0, -1 for vertices; seam: from 0, -1 for elements
//               state, as above; pressure, opening
//
// Data: frame_bodies.csv and frame_seams.csv (result/body_frames.hpp) on the mesh of the scene.

/// Adds frames of bodies to DIR/paraview after write_paraview(), and returns the path of bodies.pvd; nullopt if the run
/// has no frame_bodies.csv. Errors: FileError.
std::optional<std::filesystem::path> write_paraview_bodies(const std::filesystem::path& directory,
                                                           const Scene& scene);

/// `count` equidistant times from the first to the last time of the record; with `events` also the times of events.
[[nodiscard]] std::vector<double> frame_times(const base::Json& data, std::size_t count, bool events);

/// Text of the .vtu file of the frame at time t. data: result of run_data().
[[nodiscard]] std::string vtu_frame(const base::Json& data, double t);

/// Removes earlier frames from DIR/paraview, writes frames at these times, and returns the path of run.pvd. Errors:
/// FileError.
std::filesystem::path write_paraview(const std::filesystem::path& directory, const base::Json& data,
                                     const std::vector<double>& times);

}  // namespace signorini::report
