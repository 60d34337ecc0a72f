#include "report/vtk.hpp"

#include <fmt/core.h>

#include "result/csv.hpp"

namespace signorini {

std::string vtk_array(std::string_view type, std::string_view name, const std::string& values,
                      int components) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n",
      type, name, components, values);
}

void VtkCells::add(int type, const std::vector<std::size_t>& corners) {
  for (const std::size_t corner : corners) connectivity_ += fmt::format("{} ", corner);
  connectivity_ += "\n";
  end_ += corners.size();
  offsets_ += fmt::format("{} ", end_);
  types_ += fmt::format("{} ", type);
  ++count_;
}

std::string VtkCells::text() const {
  return "<Cells>\n" + vtk_array("Int64", "connectivity", connectivity_) +
         vtk_array("Int64", "offsets", offsets_) + vtk_array("UInt8", "types", types_) + "</Cells>\n";
}

std::string vtk_grid(const std::string& points, std::size_t point_count, const VtkCells& cells,
                     const std::string& data) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n" +
         fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", point_count, cells.count()) +
         "<Points>\n" + vtk_array("Float64", "points", points, 3) + "</Points>\n" + cells.text() + data +
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void VtkSeries::add(double t, const std::string& text) {
  const std::string name = fmt::format("{}-{:04}.vtu", prefix_, ++number_);
  write_file(folder_ / name, text);
  list_ += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", t, name);
}

std::filesystem::path VtkSeries::finish(const std::string& name) const {
  write_file(folder_ / name,
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
                 list_ + "</Collection>\n</VTKFile>\n");
  return folder_ / name;
}

}  // namespace signorini
