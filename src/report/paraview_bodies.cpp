#include "report/paraview_bodies.hpp"

#include <fmt/core.h>

#include <array>
#include <string_view>
#include <vector>

#include "mesh/plane_shapes.hpp"
#include "result/csv.hpp"
#include "result/csv_read.hpp"
#include "signorini/contact.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

/// A time of frame_bodies.csv.
struct BodiesAt {
  double t = 0.0;
  std::vector<std::array<double, 6>>
      nodes;  ///< ux, uy, xx, yy, xy, mises; of all bodies one behind the other
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

/// Numbers of states in files for ParaView.
int number_of_state(std::string_view name) {
  constexpr std::array<std::string_view, 5> names = {"stick", "slip+", "slip-", "closed", "open"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<int>(i);
  return -1;
}

std::vector<SeamNodeAt> read_seams_at(const TableFolder& tables) {
  std::vector<SeamNodeAt> all;
  if (!tables.has("frame_seams.csv")) return all;
  CsvReader rows = tables.open("frame_seams.csv");
  const std::size_t p = rows.column("pressure"), tau = rows.column("shear"), opening = rows.column("opening"),
                    state = rows.column("state");
  while (rows.next())
    all.push_back({rows.t(), rows.number(p), rows.number(tau), rows.number(opening),
                   number_of_state(rows.cell(state))});
  return all;
}

/// VTK's numbers of cells.
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

std::string data_array(std::string_view type, std::string_view name, const std::string& values,
                       int components = 1) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n",
      type, name, components, values);
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
    elements_ = cells_;
    for (std::size_t i = 0; i < scene.seams.size(); ++i)
      for (const SeamNode& node : scene.seams[i].nodes) cell(1, {node.node}, -1, static_cast<int>(i));
  }

  [[nodiscard]] std::size_t points() const { return count_; }
  [[nodiscard]] std::string frame(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const;

 private:
  void cell(int type, const std::vector<int>& nodes, int body, int seam) {
    for (const int n : nodes) connectivity_ += fmt::format("{} ", point_of_[static_cast<std::size_t>(n)]);
    connectivity_ += "\n";
    end_ += nodes.size();
    offsets_ += fmt::format("{} ", end_);
    types_ += fmt::format("{} ", type);
    bodies_ += fmt::format("{} ", body);
    seams_ += fmt::format("{} ", seam);
    ++cells_;
  }
  [[nodiscard]] std::string point_data(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const;

  const Scene& scene_;
  std::string points_, connectivity_, offsets_, types_, bodies_, seams_;
  std::vector<std::size_t> point_of_;  // a node of the scene
  std::size_t count_ = 0, cells_ = 0, elements_ = 0, end_ = 0;
};

/// seams: rows of all seams, in their order; empty: the run has no such table.
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
         data_array("Float64", "displacement", displacements, 3) +
         data_array("Float64", "stress", stresses, 3) + data_array("Float64", "mises", mises) +
         data_array("Float64", "traction", tractions, 3) + "</PointData>\n";
}

std::string BodyCells::frame(const BodiesAt& at, const std::vector<SeamNodeAt>& seams) const {
  std::string states, pressures, openings;
  const auto add = [&](int state, double pressure, double opening) {
    states += fmt::format("{} ", state);
    pressures += fmt::format("{:.7g} ", pressure);
    openings += fmt::format("{:.7g} ", opening);
  };
  for (std::size_t i = 0; i < elements_; ++i) add(-1, 0.0, 0.0);
  for (std::size_t i = elements_; i < cells_; ++i)
    if (const std::size_t row = i - elements_; row < seams.size())
      add(seams[row].state, seams[row].pressure, seams[row].opening);
    else
      add(-1, 0.0, 0.0);
  std::string s =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  s += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", count_, cells_);
  s += "<Points>\n" + data_array("Float64", "points", points_, 3) + "</Points>\n<Cells>\n";
  s += data_array("Int64", "connectivity", connectivity_) + data_array("Int64", "offsets", offsets_) +
       data_array("UInt8", "types", types_) + "</Cells>\n";
  s += point_data(at, seams) + "<CellData Scalars=\"body\">\n" + data_array("Int32", "body", bodies_) +
       data_array("Int32", "seam", seams_) + data_array("Int32", "state", states) +
       data_array("Float64", "pressure", pressures) + data_array("Float64", "opening", openings) +
       "</CellData>\n";
  return s + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

std::optional<fs::path> write_paraview_bodies(const fs::path& directory, const Scene& scene) {
  const TableFolder tables(directory);
  if (scene.bodies.empty() || !tables.has("frame_bodies.csv")) return std::nullopt;
  const fs::path folder = directory / "paraview";
  const BodyCells cells(scene);
  const std::vector<SeamNodeAt> seams = read_seams_at(tables);
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  int number = 0;
  std::size_t row = 0;
  for (const BodiesAt& at : read_bodies_at(tables)) {
    if (at.nodes.size() != cells.points()) break;  // of a run that was killed
    std::vector<SeamNodeAt> own;
    for (; row < seams.size() && seams[row].t == at.t; ++row) own.push_back(seams[row]);
    const std::string name = fmt::format("body-{:04}.vtu", ++number);
    write_file(folder / name, cells.frame(at, own));
    list += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", at.t, name);
  }
  write_file(folder / "bodies.pvd", list + "</Collection>\n</VTKFile>\n");
  return folder / "bodies.pvd";
}

}  // namespace signorini
