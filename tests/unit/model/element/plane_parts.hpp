// plane_parts.hpp: plane elements on a mesh, assembled without anything of the program's assembly.
#pragma once

#include <Eigen/Sparse>
#include <memory>

#include "mesh/grids.hpp"
#include "model/element/plane_element.hpp"

namespace signorini::test {

using Field = std::function<element::PlaneVector(double x, double y)>;

/// Unknowns of node k: 2 k, 2 k + 1.
struct PlaneSystem {
  PlaneMesh mesh;
  std::vector<std::shared_ptr<element::PlaneElement>> elements;
  Eigen::SparseMatrix<double> stiffness, mass;

  PlaneSystem(PlaneMesh given, const element::PlaneMaterial& material, MassKind kind = MassKind::consistent)
      : mesh(std::move(given)) {
    std::vector<Eigen::Triplet<double>> k, m;
    for (const auto& e : mesh.elements) {
      std::vector<element::PlaneVector> at;
      for (const int n : e.nodes) at.push_back({node(n).x, node(n).y});
      elements.push_back(std::make_shared<element::PlaneElement>(e.nodes, 0, e.shape, at, material, kind));
      const element::ElementMatrix own_k = elements.back()->stiffness(), own_m = elements.back()->mass();
      for (int i = 0; i < own_k.rows(); ++i)
        for (int j = 0; j < own_k.cols(); ++j) {
          k.emplace_back(unknown(e, i), unknown(e, j), own_k(i, j));
          m.emplace_back(unknown(e, i), unknown(e, j), own_m(i, j));
        }
    }
    stiffness.resize(size(), size());
    mass.resize(size(), size());
    stiffness.setFromTriplets(k.begin(), k.end());
    mass.setFromTriplets(m.begin(), m.end());
  }

  [[nodiscard]] const PlaneMesh::Node& node(int i) const { return mesh.nodes[static_cast<std::size_t>(i)]; }
  [[nodiscard]] int size() const { return static_cast<int>(2 * mesh.nodes.size()); }
  [[nodiscard]] static int unknown(const PlaneMesh::Element& e, int i) {
    return 2 * e.nodes[static_cast<std::size_t>(i / 2)] + i % 2;
  }
  [[nodiscard]] Eigen::VectorXd sampled(const Field& field) const {
    Eigen::VectorXd u(size());
    for (int i = 0; i < size() / 2; ++i) {
      const element::PlaneVector v = field(node(i).x, node(i).y);
      u[2 * i] = v[0], u[2 * i + 1] = v[1];
    }
    return u;
  }
  [[nodiscard]] Eigen::VectorXd of_element(std::size_t e, const Eigen::VectorXd& u) const {
    const auto& element = mesh.elements[e];
    Eigen::VectorXd own(2 * static_cast<Eigen::Index>(element.nodes.size()));
    for (int i = 0; i < own.size(); ++i) own[i] = u[unknown(element, i)];
    return own;
  }

  /// K u = f where free, u given elsewhere.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f, const std::vector<bool>& held,
                                      Eigen::VectorXd u) const {
    Eigen::VectorXd rest = f;
    std::vector<int> row(static_cast<std::size_t>(size()), -1);
    int free = 0;
    for (int i = 0; i < size(); ++i)
      if (!held[static_cast<std::size_t>(i)]) u[i] = 0.0, row[static_cast<std::size_t>(i)] = free++;
    rest -= stiffness * u;
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < stiffness.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness, j); it; ++it) {
        const int r = row[static_cast<std::size_t>(it.row())], c = row[static_cast<std::size_t>(it.col())];
        if (r >= 0 && c >= 0) entries.emplace_back(r, c, it.value());
      }
    Eigen::SparseMatrix<double> k(free, free);
    k.setFromTriplets(entries.begin(), entries.end());
    Eigen::VectorXd b(free);
    for (int i = 0; i < size(); ++i)
      if (const int r = row[static_cast<std::size_t>(i)]; r >= 0) b[r] = rest[i];
    const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(k).solve(b);
    for (int i = 0; i < size(); ++i)
      if (const int r = row[static_cast<std::size_t>(i)]; r >= 0) u[i] = x[r];
    return u;
  }
};

[[nodiscard]] inline const char* name_of(PlaneShape shape) {
  return std::array{"t3", "t6", "q4", "q8"}[static_cast<std::size_t>(shape)];
}
inline constexpr std::array all_plane_shapes = {PlaneShape::t3, PlaneShape::t6, PlaneShape::q4,
                                                PlaneShape::q8};

/// A grid of a rectangle, turned by an odd angle, whose inner nodes are moved by up to a quarter of an element, by a fixed
/// pattern; with `curved` middles of inner edges as well.
[[nodiscard]] inline PlaneMesh distorted_grid(PlaneShape shape, bool curved) {
  const mesh::GridSpec grid{shape, {3, 3}, {1.0, 1.0}};
  PlaneMesh mesh = mesh::rectangle_mesh({{0.3, -0.2}, {2.1, 1.7}, 0.41}, grid);
  std::vector<bool> boundary(mesh.nodes.size(), false), corner(mesh.nodes.size(), false);
  for (const auto& group : mesh.groups)
    for (const int n : group.nodes) boundary[static_cast<std::size_t>(n)] = true;
  for (const auto& e : mesh.elements)
    for (std::size_t i = 0; i < mesh::corner_count(e.shape); ++i)
      corner[static_cast<std::size_t>(e.nodes[i])] = true;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (boundary[i] || !corner[i]) continue;
    const double k = static_cast<double>(i);
    mesh.nodes[i].x += 0.16 * std::sin(1.0 + 3.0 * k);
    mesh.nodes[i].y += 0.14 * std::cos(2.0 + 5.0 * k);
  }
  for (const auto& e : mesh.elements) {
    if (!mesh::has_midside_nodes(shape)) continue;
    for (std::size_t i = 0; i < mesh::corner_count(e.shape); ++i) {
      const auto nodes = mesh::edge_nodes(e, i);
      const auto &a = mesh.nodes[static_cast<std::size_t>(nodes[0])],
                 &b = mesh.nodes[static_cast<std::size_t>(nodes[1])];
      auto& m = mesh.nodes[static_cast<std::size_t>(nodes[2])];
      const bool inner = !boundary[static_cast<std::size_t>(nodes[2])];
      m.x = 0.5 * (a.x + b.x) + (curved && inner ? 0.02 : 0.0);
      m.y = 0.5 * (a.y + b.y) + (curved && inner ? 0.015 : 0.0);
    }
  }
  return mesh;
}

}  // namespace signorini::test
