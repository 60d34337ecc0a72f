#include "mesh/shape_functions.hpp"

namespace signorini::mesh {
namespace {

// Corners and middle nodes of a quadrilateral.
constexpr std::array<std::array<double, 2>, 8> square_points = {
    {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}, {0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}}};
constexpr std::array<std::array<double, 2>, 6> triangle_points = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};

// Integration points of degree 2.
constexpr std::array<IntegrationPoint, 3> triangle_3 = {{{1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0},
                                                         {2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0},
                                                         {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0}}};
// Integration points of degree 4: weights and coordinates solve the moment equations to machine precision.
constexpr double p1 = 0.44594849091596488632, w1 = 0.5 * 0.22338158967801146570;
constexpr double p2 = 0.09157621350977074346, w2 = 0.5 * 0.10995174365532186764;
constexpr std::array<IntegrationPoint, 6> triangle_6 = {{{p1, p1, w1},
                                                         {1.0 - 2.0 * p1, p1, w1},
                                                         {p1, 1.0 - 2.0 * p1, w1},
                                                         {p2, p2, w2},
                                                         {1.0 - 2.0 * p2, p2, w2},
                                                         {p2, 1.0 - 2.0 * p2, w2}}};

constexpr double g2 = 0.57735026918962576451;  // sqrt(1/3)
constexpr double g3 = 0.77459666924148337704;  // sqrt(3/5)
constexpr std::array<IntegrationPoint, 4> square_2 = {
    {{-g2, -g2, 1.0}, {g2, -g2, 1.0}, {g2, g2, 1.0}, {-g2, g2, 1.0}}};
constexpr double edge_weight = 5.0 / 9.0, middle_weight = 8.0 / 9.0;
constexpr double ww = edge_weight * edge_weight, wm = edge_weight * middle_weight,
                 mm = middle_weight * middle_weight;
constexpr std::array<IntegrationPoint, 9> square_3 = {{{-g3, -g3, ww},
                                                       {0.0, -g3, wm},
                                                       {g3, -g3, ww},
                                                       {-g3, 0.0, wm},
                                                       {0.0, 0.0, mm},
                                                       {g3, 0.0, wm},
                                                       {-g3, g3, ww},
                                                       {0.0, g3, wm},
                                                       {g3, g3, ww}}};

constexpr std::array<EdgePoint, 5> line_5 = {{{-0.90617984593866399280, 0.23692688505618908751},
                                              {-0.53846931010568309104, 0.47862867049936646804},
                                              {0.0, 0.56888888888888888889},
                                              {0.53846931010568309104, 0.47862867049936646804},
                                              {0.90617984593866399280, 0.23692688505618908751}}};

ShapeValues zero_values(PlaneShape shape) {
  const auto n = static_cast<Eigen::Index>(node_count(shape));
  return {Eigen::VectorXd::Zero(n), Eigen::MatrixX2d::Zero(n, 2)};
}

ShapeValues triangle_at(PlaneShape shape, double a, double b) {
  ShapeValues v = zero_values(shape);
  const std::array<double, 3> L{1.0 - a - b, a, b}, da{-1.0, 1.0, 0.0}, db{-1.0, 0.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (shape == PlaneShape::t3) {
      v.values[k] = L[i];
      v.gradients.row(k) << da[i], db[i];
      continue;
    }
    const std::size_t j = (i + 1) % 3;
    v.values[k] = L[i] * (2.0 * L[i] - 1.0);
    v.gradients.row(k) << (4.0 * L[i] - 1.0) * da[i], (4.0 * L[i] - 1.0) * db[i];
    v.values[k + 3] = 4.0 * L[i] * L[j];
    v.gradients.row(k + 3) << 4.0 * (L[i] * da[j] + L[j] * da[i]), 4.0 * (L[i] * db[j] + L[j] * db[i]);
  }
  return v;
}

ShapeValues square_at(PlaneShape shape, double a, double b) {
  ShapeValues v = zero_values(shape);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double x = square_points[i][0], y = square_points[i][1], fa = 1.0 + a * x, fb = 1.0 + b * y;
    if (shape == PlaneShape::q4) {
      v.values[k] = 0.25 * fa * fb;
      v.gradients.row(k) << 0.25 * x * fb, 0.25 * y * fa;
    } else {
      v.values[k] = 0.25 * fa * fb * (a * x + b * y - 1.0);
      v.gradients.row(k) << 0.25 * x * fb * (2.0 * a * x + b * y), 0.25 * y * fa * (a * x + 2.0 * b * y);
    }
  }
  if (shape == PlaneShape::q4) return v;
  for (std::size_t i = 4; i < 8; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double x = square_points[i][0], y = square_points[i][1];
    if (x == 0.0) {
      v.values[k] = 0.5 * (1.0 - a * a) * (1.0 + b * y);
      v.gradients.row(k) << -a * (1.0 + b * y), 0.5 * y * (1.0 - a * a);
    } else {
      v.values[k] = 0.5 * (1.0 - b * b) * (1.0 + a * x);
      v.gradients.row(k) << 0.5 * x * (1.0 - b * b), -b * (1.0 + a * x);
    }
  }
  return v;
}

}  // namespace

std::size_t node_count(PlaneShape shape) { return corner_count(shape) * (has_midside_nodes(shape) ? 2 : 1); }

ShapeValues shape_functions(PlaneShape shape, double a, double b) {
  return corner_count(shape) == 3 ? triangle_at(shape, a, b) : square_at(shape, a, b);
}

std::span<const IntegrationPoint> integration_points(PlaneShape shape) {
  switch (shape) {
    case PlaneShape::t3:
      return triangle_3;
    case PlaneShape::t6:
      return triangle_6;
    case PlaneShape::q4:
      return square_2;
    case PlaneShape::q8:
      break;
  }
  return square_3;
}

std::span<const StressPoint> stress_points(PlaneShape shape) {
  static constexpr std::array<StressPoint, 1> middle = {{{1.0 / 3.0, 1.0 / 3.0}}};
  static constexpr std::array<StressPoint, 3> triangle = {
      {{1.0 / 6.0, 1.0 / 6.0}, {2.0 / 3.0, 1.0 / 6.0}, {1.0 / 6.0, 2.0 / 3.0}}};
  static constexpr std::array<StressPoint, 4> square = {{{-g2, -g2}, {g2, -g2}, {g2, g2}, {-g2, g2}}};
  if (shape == PlaneShape::t3) return middle;
  if (shape == PlaneShape::t6) return triangle;
  return square;
}

double extrapolation_weight(PlaneShape shape, std::size_t point, std::size_t node) {
  if (shape == PlaneShape::t3) return 1.0;
  const auto [a, b] = node_coordinates(shape, node);
  if (shape == PlaneShape::t6) {
    const std::array<double, 3> L{1.0 - a - b, a, b};
    return 2.0 * L[point] - 1.0 / 3.0;
  }
  const StressPoint p = stress_points(shape)[point];
  return 0.25 * (1.0 + a * p.a / (g2 * g2)) * (1.0 + b * p.b / (g2 * g2));
}

std::array<double, 2> node_coordinates(PlaneShape shape, std::size_t node) {
  return corner_count(shape) == 3 ? triangle_points[node] : square_points[node];
}

std::vector<int> edge_nodes(const PlaneMesh::Element& element, std::size_t i) {
  const std::size_t corners = corner_count(element.shape);
  std::vector<int> nodes{element.nodes[i], element.nodes[(i + 1) % corners]};
  if (has_midside_nodes(element.shape)) nodes.push_back(element.nodes[corners + i]);
  return nodes;
}

EdgeValues edge_shape_functions(std::size_t nodes, double s) {
  if (nodes == 2) return {{0.5 * (1.0 - s), 0.5 * (1.0 + s), 0.0}, {-0.5, 0.5, 0.0}};
  return {{0.5 * s * (s - 1.0), 0.5 * s * (s + 1.0), 1.0 - s * s}, {s - 0.5, s + 0.5, -2.0 * s}};
}

std::span<const EdgePoint> edge_points() { return line_5; }

}  // namespace signorini::mesh
