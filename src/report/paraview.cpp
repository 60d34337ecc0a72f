#include "report/paraview.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/drawn_lines.hpp"
#include "report/vtk.hpp"
#include "result/frame_data.hpp"
#include "result/plot_folder.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

using Pair = std::array<double, 2>;

/// A row of a record, and the fraction of the way to the next one; at a jump, the row after it.
struct Place {
  std::size_t row = 0;
  double part = 0.0;
};

Place place_in(const Json& times, double t) {
  const auto after = std::upper_bound(times.begin(), times.end(), t, [](double value, const Json& time) {
    return value < time.get<double>();
  });
  Place place;
  place.row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times.begin() - 1, 0));
  if (after == times.begin() || after == times.end()) return place;
  const double from = times[place.row].get<double>();
  place.part = (t - from) / (times[place.row + 1].get<double>() - from);
  return place;
}

/// Numbers that are not finite are null in JSON.
double number_of(const Json& value) { return value.is_number() ? value.get<double>() : 0.0; }

double value_at(const Json& values, const Place& place) {
  if (values.empty()) return 0.0;
  const double from = number_of(values[place.row]);
  return place.part > 0.0 ? from + place.part * (number_of(values[place.row + 1]) - from) : from;
}

/// The cells and data of a file under construction.
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

std::vector<FrameEnd> ends_at(const Json& data, double t) {
  const Json& times = data["curve"]["times"];
  const Json& columns = data["curve"]["columns"];
  std::vector<FrameEnd> ends;
  for (const Json& node : data["nodes"]) {
    const auto value = [&](std::size_t k) {
      const int number = node["u"][k].get<int>();
      if (number < 0) return 0.0;
      const Json& column = columns[static_cast<std::size_t>(number)];
      const Json& own = times[column["t"].get<std::size_t>()];
      return own.empty() ? 0.0 : value_at(column["u"], place_in(own, t));
    };
    ends.push_back({number_of(node["x"]), number_of(node["y"]), value(0), value(1), value(2)});
  }
  return ends;
}

void add_structure(Grid& grid, const Json& data, const std::vector<FrameEnd>& ends) {
  const auto end_of = [&](const Json& index) { return ends[index.get<std::size_t>()]; };
  for (const Json& piece : data["pieces"]) {
    const bool bar = piece["bar"].get<bool>();
    const FrameEnd a = end_of(piece["a"]), b = end_of(piece["b"]);
    std::vector<std::size_t> corners;
    for (const Json& row : data["shapes"][piece["shape"].get<std::size_t>()]) {
      const FrameEnd p = between(a, b, row[0].get<double>(), across_of(row));
      corners.push_back(grid.point(p.x, p.y, {p.ux, p.uy}));
    }
    grid.cell(polyline, corners, piece.contains("rigid") ? 6 : bar ? 1 : 0);
  }
  for (const Json& spring : data["springs"]) {
    if (spring["b"].get<int>() < 0) continue;
    const FrameEnd a = end_of(spring["a"]), b = end_of(spring["b"]);
    const std::size_t first = grid.point(a.x, a.y, {a.ux, a.uy});
    grid.cell(line, {first, grid.point(b.x, b.y, {b.ux, b.uy})}, 2);
  }
  for (const FrameEnd& p : ends) grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy})}, 3);
}

void add_forces(Grid& grid, const Json& data, const std::vector<FrameEnd>& ends, double t) {
  int item = 0;
  for (const Json& contact : data["contacts"]) {
    const Json& motion = contact["motion"];
    const int index = item++, node = contact["node"].get<int>();
    if (node < 0 || motion["t"].empty()) continue;
    const FrameEnd& p = ends[static_cast<std::size_t>(node)];
    const Place place = place_in(motion["t"], t);
    const double N = value_at(motion["N"], place), T = value_at(motion["T"], place);
    const double nx = number_of(contact["nx"]), ny = number_of(contact["ny"]);
    const Pair force{-N * nx - T * ny, -N * ny + T * nx};  // t = (ny, -nx)
    grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy}, force)}, 4, motion["state"][place.row].get<int>(),
              index);
  }
  item = 0;
  for (const Json& load : data["loads"]) {
    const FrameEnd& p = ends[load["node"].get<std::size_t>()];
    const double f = value_at(load["f"], place_in(load["t"], t));
    const Pair force{f * number_of(load["dx"]), f * number_of(load["dy"])};
    grid.cell(vertex, {grid.point(p.x, p.y, {p.ux, p.uy}, force)}, 5, -1, item++);
  }
}

}  // namespace

std::vector<double> frame_times(const Json& data, std::size_t count, bool events) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Json& own : data["curve"]["times"]) {
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
  for (const Json& event : data["events"])
    if (const double t = event[0].get<double>(); t <= last) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::string vtu_frame(const Json& data, double t) {
  Grid grid;
  const std::vector<FrameEnd> ends = ends_at(data, t);
  add_structure(grid, data, ends);
  add_forces(grid, data, ends, t);
  return grid.text();
}

fs::path write_paraview(const fs::path& directory, const Json& data, const std::vector<double>& times) {
  const fs::path folder = directory / "paraview";
  begin_plot_folder(folder, is_paraview);
  VtkSeries series(folder, "frame");
  for (const double t : times) series.add(t, vtu_frame(data, t));
  return series.finish("run.pvd");
}

}  // namespace signorini
