#include "report/paraview.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mesh/shape_functions.hpp"
#include "report/mesh_motion.hpp"
#include "result/csv.hpp"
#include "result/frames.hpp"
#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"

namespace signorini::report {

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
  result::write_file(folder_ / name, text);
  list_ += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", t, name);
}

std::filesystem::path VtkSeries::finish(const std::string& name) const {
  result::write_file(
      folder_ / name,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + list_ +
          "</Collection>\n</VTKFile>\n");
  return folder_ / name;
}

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

std::vector<BodiesAt> read_bodies_at(const result::TableFolder& tables) {
  result::CsvReader rows = tables.open("frame_bodies.csv");
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

std::vector<SeamNodeAt> read_seams_at(const result::TableFolder& tables) {
  std::vector<SeamNodeAt> all;
  if (!tables.has("frame_seams.csv")) return all;
  result::CsvReader rows = tables.open("frame_seams.csv");
  const std::size_t p = rows.column("pressure"), tau = rows.column("shear"), opening = rows.column("opening"),
                    state = rows.column("state");
  const std::vector<std::string>& names = result::state_names();
  while (rows.next())
    all.push_back(
        {rows.t(), rows.number(p), rows.number(tau), rows.number(opening),
         static_cast<int>(std::find(names.begin(), names.end(), rows.cell(state)) - names.begin())});
  return all;
}

/// Number of the VTK cell type for an element shape.
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
  std::vector<std::size_t> point_of_;  // index of the VTK point of each node of the scene
  std::size_t count_ = 0, elements_ = 0;
};

/// seams: rows of frame_seams.csv at this time; empty if the run has no frame_seams.csv.
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
  const result::TableFolder tables(directory);
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

namespace {

using Pair = std::array<double, 2>;

/// Place of a time in a record: the last row that is not later, and the fraction of the interval to the next row. At a
/// jump this is the row after the jump.
struct Place {
  std::size_t row = 0;
  double part = 0.0;
};

Place place_in(const base::Json& times, double t) {
  const auto after =
      std::upper_bound(times.begin(), times.end(), t,
                       [](double value, const base::Json& time) { return value < time.get<double>(); });
  Place place;
  place.row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times.begin() - 1, 0));
  if (after == times.begin() || after == times.end()) return place;
  const double from = times[place.row].get<double>();
  place.part = (t - from) / (times[place.row + 1].get<double>() - from);
  return place;
}

/// The number; 0 for null, which JSON has for numbers that are not finite.
double number_of(const base::Json& value) { return value.is_number() ? value.get<double>() : 0.0; }

double value_at(const base::Json& values, const Place& place) {
  if (values.empty()) return 0.0;
  const double from = number_of(values[place.row]);
  return place.part > 0.0 ? from + place.part * (number_of(values[place.row + 1]) - from) : from;
}

/// Collects the points, cells and data of a .vtu file.
class Grid {
 public:
  std::size_t point(double x, double y, const Pair& displacement, const Pair& force = {0.0, 0.0}) {
    points_ += fmt::format("{:.9g} {:.9g} 0\n", x, y);
    displacements_ += fmt::format("{:.7g} {:.7g} 0\n", displacement[0], displacement[1]);
    forces_ += fmt::format("{:.7g} {:.7g} 0\n", force[0], force[1]);
    return count_++;
  }
  void cell(int type, const std::vector<std::size_t>& corners, int kind, int state = -1, int item = -1) {
    cells_.add(type, corners);
    kinds_ += fmt::format("{} ", kind);
    states_ += fmt::format("{} ", state);
    items_ += fmt::format("{} ", item);
  }
  [[nodiscard]] std::string text() const {
    return vtk_grid(
        points_, count_, cells_,
        "<PointData Vectors=\"displacement\">\n" + vtk_array("Float64", "displacement", displacements_, 3) +
            vtk_array("Float64", "force", forces_, 3) + "</PointData>\n<CellData Scalars=\"state\">\n" +
            vtk_array("Int32", "kind", kinds_) + vtk_array("Int32", "state", states_) +
            vtk_array("Int32", "item", items_) + "</CellData>\n");
  }

 private:
  std::string points_, displacements_, forces_, kinds_, states_, items_;
  VtkCells cells_;
  std::size_t count_ = 0;
};

constexpr int vertex = 1, line = 3, polyline = 4;  // cell types of VTK

std::vector<result::FrameEnd> ends_at(const base::Json& data, double t) {
  const base::Json& times = data["curve"]["times"];
  const base::Json& columns = data["curve"]["columns"];
  std::vector<result::FrameEnd> ends;
  for (const base::Json& node : data["nodes"]) {
    const auto value = [&](std::size_t k) {
      const int number = node["u"][k].get<int>();
      if (number < 0) return 0.0;
      const base::Json& column = columns[static_cast<std::size_t>(number)];
      const base::Json& own = times[column["t"].get<std::size_t>()];
      return own.empty() ? 0.0 : value_at(column["u"], place_in(own, t));
    };
    ends.push_back({number_of(node["x"]), number_of(node["y"]), value(0), value(1), value(2)});
  }
  return ends;
}

void add_structure(Grid& grid, const base::Json& data, const std::vector<result::FrameEnd>& ends) {
  const auto end_of = [&](const base::Json& index) { return ends[index.get<std::size_t>()]; };
  for (const base::Json& piece : data["pieces"]) {
    const bool bar = piece["bar"].get<bool>();
    const result::FrameEnd a = end_of(piece["a"]), b = end_of(piece["b"]);
    std::vector<std::size_t> corners;
    for (const base::Json& row : data["shapes"][piece["shape"].get<std::size_t>()]) {
      const result::FrameEnd p = result::between(a, b, row[0].get<double>(), across_of(row));
      corners.push_back(grid.point(p.x, p.y, {p.ux, p.uy}));
    }
    grid.cell(polyline, corners, piece.contains("rigid") ? 6 : bar ? 1 : 0);
  }
  for (const base::Json& spring : data["springs"]) {
    if (spring["b"].get<int>() < 0) continue;
    const result::FrameEnd a = end_of(spring["a"]), b = end_of(spring["b"]);
    const std::size_t first = grid.point(a.x, a.y, {a.ux, a.uy});
    grid.cell(line, {first, grid.point(b.x, b.y, {b.ux, b.uy})}, 2);
  }
  for (const result::FrameEnd& p : ends) grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy})}, 3);
}

void add_forces(Grid& grid, const base::Json& data, const std::vector<result::FrameEnd>& ends, double t) {
  int item = 0;
  for (const base::Json& contact : data["contacts"]) {
    const base::Json& motion = contact["motion"];
    const int index = item++, node = contact["node"].get<int>();
    if (node < 0 || motion["t"].empty()) continue;
    const result::FrameEnd& p = ends[static_cast<std::size_t>(node)];
    const Place place = place_in(motion["t"], t);
    const double N = value_at(motion["N"], place), T = value_at(motion["T"], place);
    const double nx = number_of(contact["nx"]), ny = number_of(contact["ny"]);
    const Pair force{-N * nx - T * ny, -N * ny + T * nx};  // t = (ny, -nx)
    grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy}, force)}, 4, motion["state"][place.row].get<int>(),
              index);
  }
  item = 0;
  for (const base::Json& load : data["loads"]) {
    const result::FrameEnd& p = ends[load["node"].get<std::size_t>()];
    const double f = value_at(load["f"], place_in(load["t"], t));
    const Pair force{f * number_of(load["dx"]), f * number_of(load["dy"])};
    grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy}, force)}, 5, -1, item++);
  }
}

}  // namespace

std::vector<double> frame_times(const base::Json& data, std::size_t count, bool events) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const base::Json& own : data["curve"]["times"]) {
    if (own.empty()) continue;
    first = std::min(first, own.front().get<double>());
    last = std::max(last, own.back().get<double>());
  }
  if (!(first <= last)) return {};
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(
        count < 2 ? first : first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1));
  if (!events) return times;
  for (const base::Json& event : data["events"])
    if (const double t = event[0].get<double>(); t <= last) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::string vtu_frame(const base::Json& data, double t) {
  Grid grid;
  const std::vector<result::FrameEnd> ends = ends_at(data, t);
  add_structure(grid, data, ends);
  add_forces(grid, data, ends, t);
  return grid.text();
}

fs::path write_paraview(const fs::path& directory, const base::Json& data, const std::vector<double>& times) {
  const fs::path folder = directory / "paraview";
  result::begin_plot_folder(folder, result::is_paraview);
  VtkSeries series(folder, "frame");
  for (const double t : times) series.add(t, vtu_frame(data, t));
  return series.finish("run.pvd");
}

}  // namespace signorini::report
