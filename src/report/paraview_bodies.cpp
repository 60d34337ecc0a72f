#include "report/paraview_bodies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "mesh/plane_shapes.hpp"
#include "report/vtk.hpp"
#include "result/csv_read.hpp"
#include "result/plot_parts.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

/// Rows of frame_bodies.csv for one time.
struct BodiesAt {
  double t = 0.0;
  std::vector<std::array<double, 6>>
      nodes;  ///< ux, uy, xx, yy, xy, mises of each node; the bodies one after another
};

/// A row of frame_seams.csv.
struct SeamNodeAt {
  double t = 0.0, pressure = 0.0, shear = 0.0, opening = 0.0;
  int state = -1;
};

std::vector<BodiesAt> read_bodies_at(const TableFolder& tables) {
  CsvReader rows = tables.open("frame_bodies.csv");
  std::array<std::size_t, 6> columns{};
  constexpr std::array names = {"ux", "uy", "xx", "yy", "xy", "mises"};
  for (std::size_t i = 0; i < names.size(); ++i) columns[i] = rows.column(names[i]);
  std::vector<BodiesAt> all;
  while (rows.next()) {
    if (all.empty() || all.back().t != rows.t()) all.push_back({rows.t(), {}});
    std::array<double, 6>& values = all.back().nodes.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) values[i] = rows.number(columns[i]);
  }
  return all;
}

std::vector<SeamNodeAt> read_seams_at(const TableFolder& tables) {
  std::vector<SeamNodeAt> all;
  if (!tables.has("frame_seams.csv")) return all;
  CsvReader rows = tables.open("frame_seams.csv");
  const std::size_t p = rows.column("pressure"), tau = rows.column("shear"), opening = rows.column("opening"),
                    state = rows.column("state");
  const std::vector<std::string>& names = state_names();
  while (rows.next())
    all.push_back(
        {rows.t(), rows.number(p), rows.number(tau), rows.number(opening),
         static_cast<int>(std::find(names.begin(), names.end(), rows.cell(state)) - names.begin())});
  return all;
}

/// Cell types of VTK.
int cell_type(PlaneShape shape) {
  switch (shape) {
    case PlaneShape::t3:
      return 5;
    case PlaneShape::t6:
      return 22;
    case PlaneShape::q4:
      return 9;
    case PlaneShape::q8:
      break;
  }
  return 23;
}

/// The mesh of all bodies, and the nodes of the seams, as text that all frames share.
class BodyCells {
 public:
  explicit BodyCells(const Scene& scene) : scene_(scene) {
    for (const BodySpec& body : scene.bodies)
      for (std::size_t k = 0; k < body.node_count; ++k) {
        const Node& node = scene.nodes[body.first_node + k];
        points_ += fmt::format("{:.9g} {:.9g} 0\n", node.x, node.y);
        point_of_.resize(std::max(point_of_.size(), body.first_node + k + 1), 0);
        point_of_[body.first_node + k] = count_++;
      }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      for (const PlaneMesh::Element& e : scene.bodies[i].mesh.elements)
        cell(cell_type(e.shape), e.nodes, static_cast<int>(i), -1);
    elements_ = cells_.count();
    for (std::size_t i = 0; i < scene.seams.size(); ++i)
      for (const SeamNode& node : scene.seams[i].nodes) cell(1, {node.node}, -1, static_cast<int>(i));
  }

  [[nodiscard]] std::size_t points() const { return count_; }
  [[nodiscard]] std::string frame(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const;

 private:
  void cell(int type, const std::vector<int>& nodes, int body, int seam) {
    std::vector<std::size_t> corners;
    for (const int n : nodes) corners.push_back(point_of_[static_cast<std::size_t>(n)]);
    cells_.add(type, corners);
    bodies_ += fmt::format("{} ", body);
    seams_ += fmt::format("{} ", seam);
  }
  [[nodiscard]] std::string point_data(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const;

  const Scene& scene_;
  std::string points_, bodies_, seams_;
  VtkCells cells_;
  std::vector<std::size_t> point_of_;  // by node of the scene
  std::size_t count_ = 0, elements_ = 0;
};

/// seams: rows of all seams, in their order; empty if the run has no such table.
std::string BodyCells::point_data(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const {
  std::string displacements, stresses, mises;
  for (const auto& [ux, uy, xx, yy, xy, equivalent] : at.nodes) {
    displacements += fmt::format("{:.7g} {:.7g} 0\n", ux, uy);
    stresses += fmt::format("{:.7g} {:.7g} {:.7g}\n", xx, yy, xy);
    mises += fmt::format("{:.7g} ", equivalent);
  }
  std::vector<std::array<double, 2>> traction(count_, {0.0, 0.0});
  std::size_t row = 0;
  for (const SeamSpec& seam : scene_.seams)
    for (const SeamNode& node : seam.nodes) {
      if (row >= seams.size()) break;
      const SeamNodeAt& k = seams[row++];
      const auto [nx, ny] = node.normal;  // the tangent is (ny, -nx)
      auto& sum = traction[point_of_[static_cast<std::size_t>(node.node)]];
      sum[0] += k.pressure * nx - k.shear * ny;
      sum[1] += k.pressure * ny + k.shear * nx;
    }
  std::string tractions;
  for (const auto& [x, y] : traction) tractions += fmt::format("{:.7g} {:.7g} 0\n", x, y);
  return "<PointData Scalars=\"mises\" Vectors=\"displacement\">\n" +
         vtk_array("Float64", "displacement", displacements, 3) +
         vtk_array("Float64", "stress", stresses, 3) + vtk_array("Float64", "mises", mises) +
         vtk_array("Float64", "traction", tractions, 3) + "</PointData>\n";
}

std::string BodyCells::frame(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const {
  std::string states, pressures, openings;
  const auto add = [&](int state, double pressure, double opening) {
    states += fmt::format("{} ", state);
    pressures += fmt::format("{:.7g} ", pressure);
    openings += fmt::format("{:.7g} ", opening);
  };
  for (std::size_t i = 0; i < elements_; ++i) add(-1, 0.0, 0.0);
  for (std::size_t i = elements_; i < cells_.count(); ++i)
    if (const std::size_t row = i - elements_; row < seams.size())
      add(seams[row].state, seams[row].pressure, seams[row].opening);
    else
      add(-1, 0.0, 0.0);
  return vtk_grid(points_, count_, cells_,
                  point_data(at, seams) + "<CellData Scalars=\"body\">\n" +
                      vtk_array("Int32", "body", bodies_) + vtk_array("Int32", "seam", seams_) +
                      vtk_array("Int32", "state", states) + vtk_array("Float64", "pressure", pressures) +
                      vtk_array("Float64", "opening", openings) + "</CellData>\n");
}

}  // namespace

std::optional<fs::path> write_paraview_bodies(const fs::path& directory, const Scene& scene) {
  const TableFolder tables(directory);
  if (scene.bodies.empty() || !tables.has("frame_bodies.csv")) return std::nullopt;
  VtkSeries series(directory / "paraview", "body");
  const BodyCells cells(scene);
  const std::vector<SeamNodeAt> seams = read_seams_at(tables);
  std::size_t row = 0;
  for (const BodiesAt& at : read_bodies_at(tables)) {
    if (at.nodes.size() != cells.points()) break;  // incomplete frame of a killed run
    std::vector<SeamNodeAt> own;
    for (; row < seams.size() && seams[row].t == at.t; ++row) own.push_back(seams[row]);
    series.add(at.t, cells.frame(at, own));
  }
  return series.finish("bodies.pvd");
}

}  // namespace signorini
