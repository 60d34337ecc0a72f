#include "mesh/grids.hpp"

#include <cmath>
#include <numbers>

#include "base/rounding.hpp"
#include "mesh/shape_functions.hpp"

namespace signorini::mesh {
namespace {

/// Regular lattice of nodes in u and v. For quadratic elements a lattice step is half an element.
struct Lattice {
  const GridSpec& grid;
  bool closed;  // full ring: nodes at v = 1 coincide with those at v = 0
  int step, columns, rows;
  std::vector<int> index;  // node at each lattice point; -1: no node
  PlaneMesh mesh;

  Lattice(const GridSpec& spec, bool is_closed)
      : grid(spec),
        closed(is_closed),
        step(has_midside_nodes(spec.shape) ? 2 : 1),
        columns(spec.elements[0] * step + 1),
        rows(spec.elements[1] * step + 1) {}

  [[nodiscard]] std::size_t slot(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }
  [[nodiscard]] int at(int i, int j) const { return index[slot(i, closed && j == rows - 1 ? 0 : j)]; }

  template <class Map>
  void add_nodes(const Map& map) {
    index.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), -1);
    const std::vector<double> u = parts(0), v = parts(1);
    for (int j = 0; j < (closed ? rows - 1 : rows); ++j)
      for (int i = 0; i < columns; ++i) {
        if (grid.shape == PlaneShape::q8 && i % 2 == 1 && j % 2 == 1) continue;
        const auto [x, y] = map(u[static_cast<std::size_t>(i)], v[static_cast<std::size_t>(j)]);
        index[slot(i, j)] = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back({x, y, static_cast<long>(mesh.nodes.size()) + 1, {}});
      }
  }

  /// Coordinates 0 to 1 of the lattice points along one axis. A middle node is half-way between two corners.
  [[nodiscard]] std::vector<double> parts(std::size_t axis) const {
    const int n = grid.elements[axis];
    const double q = n > 1 ? std::pow(grid.grading[axis], 1.0 / (n - 1)) : 1.0;
    std::vector<double> ends{0.0};
    double length = 1.0;
    for (int i = 0; i < n; ++i, length *= q) ends.push_back(ends.back() + length);
    std::vector<double> all;
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (i > 0 && step == 2) all.push_back(0.5 * (ends[k - 1] + ends[k]) / ends.back());
      all.push_back(q == 1.0 ? static_cast<double>(i) / n : ends[k] / ends.back());
    }
    return all;
  }

  void add_element(std::vector<int> nodes) {
    mesh.elements.push_back({grid.shape, std::move(nodes), static_cast<long>(mesh.elements.size()) + 1, {}});
  }

  void add_cell(int i, int j) {
    const int s = step, h = step / 2;
    const int a = at(i, j), b = at(i + s, j), c = at(i + s, j + s), d = at(i, j + s);
    switch (grid.shape) {
      case PlaneShape::q4:
        return add_element({a, b, c, d});
      case PlaneShape::q8:
        return add_element({a, b, c, d, at(i + h, j), at(i + s, j + h), at(i + h, j + s), at(i, j + h)});
      case PlaneShape::t3:
      case PlaneShape::t6:
        break;
    }
    // Diagonals alternate, so that the mesh has no preferred direction.
    const bool forth = (i / s + j / s) % 2 == 0;
    const bool middles = grid.shape == PlaneShape::t6;
    const int m = middles ? at(i + h, j + h) : -1;
    const auto triangle = [&](std::vector<int> corners, const std::vector<int>& between) {
      if (middles) corners.insert(corners.end(), between.begin(), between.end());
      add_element(std::move(corners));
    };
    const int ab = middles ? at(i + h, j) : -1, bc = middles ? at(i + s, j + h) : -1;
    const int cd = middles ? at(i + h, j + s) : -1, da = middles ? at(i, j + h) : -1;
    if (forth) {
      triangle({a, b, c}, {ab, bc, m});
      triangle({a, c, d}, {m, cd, da});
    } else {
      triangle({a, b, d}, {ab, m, da});
      triangle({b, c, d}, {bc, cd, m});
    }
  }

  void add_elements() {
    for (int j = 0; j + 1 < rows; j += step)
      for (int i = 0; i + 1 < columns; i += step) add_cell(i, j);
  }

  /// Adds a group along a side: from (i, j) by steps (di, dj) to the end of the lattice, with the body on the left.
  void add_group(const char* name, int i, int j, int di, int dj) {
    PlaneMesh::Group group{name, {}, {}};
    const int steps = di != 0 ? grid.elements[0] : grid.elements[1];
    for (int k = 0; k < steps; ++k) {
      const int a = at(i, j), b = at(i + di * step, j + dj * step);
      PlaneMesh::Edge edge{{a, b}};
      group.nodes.push_back(a);
      if (step == 2) {
        edge.nodes.push_back(at(i + di, j + dj));
        group.nodes.push_back(edge.nodes.back());
      }
      group.edges.push_back(std::move(edge));
      i += di * step, j += dj * step;
    }
    if (at(i, j) != group.nodes.front()) group.nodes.push_back(at(i, j));
    mesh.groups.push_back(std::move(group));
  }
};

}  // namespace

PlaneMesh rectangle_mesh(const RectangleSpec& r, const GridSpec& grid) {
  Lattice lattice(grid, false);
  const double c = std::cos(r.angle), s = std::sin(r.angle);
  lattice.add_nodes([&](double u, double v) {
    const double x = u * r.size[0], y = v * r.size[1];
    return std::array{r.from[0] + c * x - s * y, r.from[1] + s * x + c * y};
  });
  lattice.add_elements();
  const int i = lattice.columns - 1, j = lattice.rows - 1;
  lattice.add_group("bottom", 0, 0, 1, 0);
  lattice.add_group("right", i, 0, 0, 1);
  lattice.add_group("top", i, j, -1, 0);
  lattice.add_group("left", 0, j, 0, -1);
  return std::move(lattice.mesh);
}

PlaneMesh ring_mesh(const RingSpec& ring, const GridSpec& grid) {
  const double turn = ring.end - ring.start, whole = 2.0 * std::numbers::pi;
  Lattice lattice(grid, std::abs(turn - whole) <= rounding::few_operations * whole);
  lattice.add_nodes([&](double u, double v) {
    const double r = ring.inner + u * (ring.outer - ring.inner), angle = ring.start + v * turn;
    return std::array{ring.centre[0] + r * std::cos(angle), ring.centre[1] + r * std::sin(angle)};
  });
  lattice.add_elements();
  const int i = lattice.columns - 1, j = lattice.rows - 1;
  lattice.add_group("outer", i, 0, 0, 1);
  lattice.add_group("inner", 0, j, 0, -1);
  if (lattice.closed) return std::move(lattice.mesh);
  lattice.add_group("start", 0, 0, 1, 0);
  lattice.add_group("end", i, j, -1, 0);
  return std::move(lattice.mesh);
}

}  // namespace signorini::mesh
