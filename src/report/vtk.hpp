// vtk.hpp: parts of VTK's XML files that all frames share, as text.
//
//   VtkCells cells;  cells.add(type, corners);  ...
//   vtk_grid(points, cells, point_data + cell_data)           the text of a .vtu file
//   VtkSeries series(folder, "frame");  series.add(t, text);  return series.finish("run.pvd");
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// values: numbers separated by blanks or line ends.
[[nodiscard]] std::string vtk_array(std::string_view type, std::string_view name, const std::string& values,
                                    int components = 1);

class VtkCells {
 public:
  /// type: VTK's cell type; corners: indices of points.
  void add(int type, const std::vector<std::size_t>& corners);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string text() const;

 private:
  std::string connectivity_, offsets_, types_;
  std::size_t count_ = 0, end_ = 0;
};

/// points: three coordinates per point.
[[nodiscard]] std::string vtk_grid(const std::string& points, std::size_t point_count, const VtkCells& cells,
                                   const std::string& data);

/// Files FOLDER/PREFIX-0001.vtu, ... and a list of them with their times. Errors: FileError.
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

}  // namespace signorini
