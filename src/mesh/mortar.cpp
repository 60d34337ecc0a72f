#include "mesh/mortar.hpp"

#include <Eigen/LU>  // inverses of small matrices
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>

#include "base/rounding.hpp"
#include "mesh/shape_functions.hpp"

namespace signorini::mesh {
namespace {

using Point2 = Eigen::Vector2d;

/// An edge of which a smaller fraction is covered is treated as uncovered. If the fraction d of an edge is covered, the
/// matrix int N_i N_j has the condition number 1/d^2: at d = 1e-5 the weights of the master keep six of sixteen digits.
/// Overlaps that only result from coordinates rounded to six digits in a file are below this limit.
constexpr double no_overlap = 1e-5;
constexpr double cosine_of_corner = 0.70710678118654752;

/// An edge as a curve x(s), -1 <= s <= 1.
struct EdgeCurve {
  std::vector<int> nodes;
  std::vector<Point2> at;
  Point2 chord;  ///< unit vector from end to end
  double length = 0.0;

  EdgeCurve(const PlaneMesh::Edge& edge, const NodePosition& place) : nodes(edge.nodes) {
    for (const int n : nodes) {
      const auto [x, y] = place(n);
      at.emplace_back(x, y);
    }
    chord = at[1] - at[0];
    length = chord.norm();
    chord /= length;
  }

  [[nodiscard]] Point2 outward() const { return {chord[1], -chord[0]}; }
  [[nodiscard]] Point2 sum(const std::array<double, 3>& factors) const {
    Point2 x(0.0, 0.0);
    for (std::size_t i = 0; i < at.size(); ++i) x += factors[i] * at[i];
    return x;
  }
  [[nodiscard]] Point2 x(double s) const { return sum(edge_shape_functions(at.size(), s).values); }
  /// The s at which x(s) . along equals `value`; by Newton's method, exact without iteration for edges of two nodes.
  [[nodiscard]] double s_at(const Point2& along, double value) const {
    const double from = at[0].dot(along), to = at[1].dot(along);
    double s = -1.0 + 2.0 * (value - from) / (to - from);
    constexpr int most_steps = 20;
    for (int i = 0; at.size() == 3 && i < most_steps; ++i) {
      const EdgeValues v = edge_shape_functions(3, s);
      const double step = (value - sum(v.values).dot(along)) / sum(v.derivatives).dot(along);
      s += step;
      if (std::abs(step) <= rounding::few_operations) break;
    }
    return s;
  }
};

using Curves = std::vector<EdgeCurve>;

Curves curves_of(const std::vector<PlaneMesh::Edge>& edges, const NodePosition& place) {
  Curves curves;
  for (const PlaneMesh::Edge& edge : edges) curves.emplace_back(edge, place);
  return curves;
}

/// The largest distance of a node from the origin. Each coordinate has an error of eps times this distance, even
/// a zero coordinate: meshes are rotated and moved as a whole, and the computed cos 90 degrees is 6e-17.
double reach_of(std::initializer_list<const Curves*> all) {
  double reach = 0.0;
  for (const Curves* curves : all)
    for (const EdgeCurve& curve : *curves)
      for (const Point2& at : curve.at) reach = std::max(reach, at.norm());
  return reach;
}

/// Sorts edges into chains of connected edges.
Curves sorted_into_chains(Curves curves) {
  std::map<int, std::size_t> by_start;
  std::map<int, int> ends;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    by_start[curves[i].nodes[0]] = i;
    ++ends[curves[i].nodes[1]];
  }
  std::vector<bool> taken(curves.size(), false);
  Curves ordered;
  const auto follow = [&](std::size_t i) {
    while (!taken[i]) {
      taken[i] = true;
      ordered.push_back(curves[i]);
      const auto next = by_start.find(curves[i].nodes[1]);
      if (next == by_start.end()) return;
      i = next->second;
    }
  };
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (!ends.contains(curves[i].nodes[0])) follow(i);
  for (std::size_t i = 0; i < curves.size(); ++i) follow(i);  // closed chains
  return ordered;
}

/// Integrals at a node of the slave.
struct NodeSums {
  double length = 0.0;
  Point2 outward{0.0, 0.0};
  std::map<int, double> master;  // M_kl
  std::optional<Point2> edge;    // normal of the edge that was added before
  bool corner = false;
};

/// A part of a slave edge. master: the master edge that covers this part; null for the ground or a line.
struct Overlap {
  double from, to;
  const EdgeCurve* master;
};

class MortarSums {
 public:
  /// reach: largest distance of a node from the origin; rounding errors of gaps are relative to it.
  MortarSums(const Curves& slave, double reach) : slave_(slave), reach_(reach) {}

  void add(const EdgeCurve& edge, const std::vector<Overlap>& overlaps) {
    if (overlaps.empty()) return;
    const auto n = static_cast<Eigen::Index>(edge.nodes.size());
    Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), normals = Eigen::MatrixXd::Zero(n, 2);
    std::map<int, Eigen::VectorXd> mixed;  // by node of the master: int N_i N_l
    for (const Overlap& part : overlaps)
      for (const EdgePoint& point : edge_points()) {
        const double half = 0.5 * (part.to - part.from);
        const double s = 0.5 * (part.from + part.to) + half * point.s;
        const EdgeValues v = edge_shape_functions(edge.nodes.size(), s);
        const Eigen::Map<const Eigen::VectorXd> shapes(v.values.data(), n);
        const Point2 slope = edge.sum(v.derivatives);
        const double ds = point.weight * half * slope.norm();
        d += ds * shapes;
        mass += ds * shapes * shapes.transpose();
        normals += point.weight * half * shapes * Eigen::RowVector2d(slope[1], -slope[0]);
        if (!part.master) continue;
        const EdgeCurve& m = *part.master;
        const double r = m.s_at(edge.chord, edge.sum(v.values).dot(edge.chord));
        const EdgeValues w = edge_shape_functions(m.nodes.size(), r);
        for (std::size_t l = 0; l < m.nodes.size(); ++l) {
          Eigen::VectorXd& sum = mixed.try_emplace(m.nodes[l], Eigen::VectorXd::Zero(n)).first->second;
          sum += ds * w.values[l] * shapes;
        }
      }
    const Eigen::MatrixXd dual = d.asDiagonal() * inverse_of(mass);  // psi = dual N
    for (Eigen::Index k = 0; k < n; ++k) {
      NodeSums& node = sums_[edge.nodes[static_cast<std::size_t>(k)]];
      node.length += d[k];
      node.outward += normals.row(k).transpose();
      if (node.edge && node.edge->dot(edge.outward()) < cosine_of_corner) node.corner = true;
      node.edge = edge.outward();
      for (const auto& [l, sum] : mixed) node.master[l] += dual.row(k).dot(sum);
    }
  }

  [[nodiscard]] MortarSeam seam(const NodePosition& place) const {
    MortarSeam seam;
    std::vector<int> done;
    for (const EdgeCurve& edge : slave_) {
      std::vector<int> course{edge.nodes[0]};
      if (edge.nodes.size() == 3) course.push_back(edge.nodes[2]);
      course.push_back(edge.nodes[1]);
      for (const int k : course) {
        const auto found = sums_.find(k);
        if (found == sums_.end() || std::find(done.begin(), done.end(), k) != done.end()) continue;
        done.push_back(k);
        add_node(k, found->second, place, seam);
      }
    }
    return seam;
  }

 private:
  static Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& mass) {
    if (mass.rows() == 2) return Eigen::Matrix2d(mass).inverse();
    return Eigen::Matrix3d(mass).inverse();
  }

  void add_node(int k, const NodeSums& sums, const NodePosition& place, MortarSeam& seam) const {
    if (sums.corner) seam.corners.push_back(k);
    if (!(sums.length > 0.0)) {
      seam.negative.push_back(k);
      return;
    }
    MortarNode node{k, sums.length, {0.0, 0.0}, {}, 0.0};
    const Point2 n = -sums.outward.normalized();
    node.normal = {n[0], n[1]};
    const auto [x, y] = place(k);
    double gap = n[0] * x + n[1] * y, size = reach_;
    for (const auto& [l, m] : sums.master) {
      const double w = m / sums.length;
      if (std::abs(w) <= rounding::many_operations) continue;
      node.master.emplace_back(l, w);
      const auto [xl, yl] = place(l);
      gap -= w * (n[0] * xl + n[1] * yl);
      size += std::abs(w) * reach_;
    }
    node.gap = std::abs(gap) <= rounding::many_operations * size ? 0.0 : gap;
    seam.nodes.push_back(std::move(node));
  }

  const Curves& slave_;
  double reach_;
  std::map<int, NodeSums> sums_;
};

/// Depth of the slave's body behind a point of its edge: distance to the nearest edge that faces the opposite way.
/// Infinite if the outline has no such edge.
double depth_of(const Point2& point, const EdgeCurve& slave, const Curves& outline) {
  const double along = point.dot(slave.chord);
  double depth = std::numeric_limits<double>::infinity();
  for (const EdgeCurve& edge : outline) {
    if (!(edge.outward().dot(slave.outward()) < 0.0)) continue;
    if (edge.at[1].dot(slave.chord) > along || edge.at[0].dot(slave.chord) < along) continue;
    const double behind = (point - edge.x(edge.s_at(slave.chord, along))).dot(slave.outward());
    if (behind > 0.0) depth = std::min(depth, behind);
  }
  return depth;
}

/// Parts of a slave edge, each with the nearest master edge in front of it.
std::vector<Overlap> overlaps_of(const EdgeCurve& slave, const Curves& master, const Curves& outline) {
  std::vector<const EdgeCurve*> facing;
  std::vector<double> breaks{-1.0, 1.0};
  const double from = slave.at[0].dot(slave.chord), to = slave.at[1].dot(slave.chord);
  for (const EdgeCurve& m : master) {
    if (!(m.outward().dot(slave.outward()) < 0.0)) continue;  // the edges do not face each other
    const double start = m.at[1].dot(slave.chord), end = m.at[0].dot(slave.chord);
    if (end <= from || start >= to) continue;
    facing.push_back(&m);
    for (const double place : {start, end})
      if (place > from && place < to) breaks.push_back(slave.s_at(slave.chord, place));
  }
  std::sort(breaks.begin(), breaks.end());
  std::vector<Overlap> overlaps;
  double covered = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (breaks[i + 1] <= breaks[i]) continue;
    const Point2 middle = slave.x(0.5 * (breaks[i] + breaks[i + 1]));
    const double along = middle.dot(slave.chord);
    const EdgeCurve* nearest = nullptr;
    double least = 0.0, depth = 0.0;
    for (const EdgeCurve* m : facing) {
      if (m->at[1].dot(slave.chord) > along || m->at[0].dot(slave.chord) < along) continue;
      const double ahead = (m->x(m->s_at(slave.chord, along)) - middle).dot(slave.outward());
      if (nearest && std::abs(ahead) >= least) continue;
      if (ahead < 0.0) {
        if (depth == 0.0) depth = depth_of(middle, slave, outline);
        if (-ahead >= depth * (1.0 - rounding::many_operations)) continue;
      }
      nearest = m;
      least = std::abs(ahead);
    }
    if (!nearest) continue;
    overlaps.push_back({breaks[i], breaks[i + 1], nearest});
    covered += breaks[i + 1] - breaks[i];
  }
  if (covered <= 2.0 * no_overlap) return {};
  return overlaps;
}

}  // namespace

MortarSeam mortar_between(const std::vector<PlaneMesh::Edge>& slave,
                          const std::vector<PlaneMesh::Edge>& master, const NodePosition& place,
                          const std::vector<PlaneMesh::Edge>& outline) {
  const Curves own = sorted_into_chains(curves_of(slave, place)), other = curves_of(master, place),
               body = curves_of(outline, place);
  MortarSums sums(own, reach_of({&own, &other, &body}));
  for (const EdgeCurve& edge : own) sums.add(edge, overlaps_of(edge, other, body));
  return sums.seam(place);
}

MortarSeam mortar_on_ground(const std::vector<PlaneMesh::Edge>& slave, const NodePosition& place) {
  const Curves own = sorted_into_chains(curves_of(slave, place));
  const double reach = reach_of({&own});
  MortarSums sums(own, reach);
  for (const EdgeCurve& edge : own) sums.add(edge, {{-1.0, 1.0, nullptr}});
  MortarSeam seam = sums.seam(place);
  for (MortarNode& node : seam.nodes) node.gap = 0.0;
  return seam;
}

MortarSeam mortar_on_line(const std::vector<PlaneMesh::Edge>& slave, const PlanePoint& point,
                          const PlanePoint& normal, const NodePosition& place) {
  const Curves all = sorted_into_chains(curves_of(slave, place));
  Curves own;
  for (const EdgeCurve& edge : all)
    if (edge.outward().dot(Point2(normal[0], normal[1])) < 0.0) own.push_back(edge);
  const double reach = reach_of({&own});
  MortarSums sums(own, reach);
  for (const EdgeCurve& edge : own) sums.add(edge, {{-1.0, 1.0, nullptr}});
  MortarSeam seam = sums.seam(place);
  for (MortarNode& node : seam.nodes) {
    const auto [x, y] = place(node.node);
    node.normal = normal;
    const double gap = normal[0] * (x - point[0]) + normal[1] * (y - point[1]);
    const double size = reach + std::hypot(point[0], point[1]);
    node.gap = std::abs(gap) <= rounding::many_operations * size ? 0.0 : gap;
  }
  seam.corners.clear();  // corners do not matter: the normal is that of the line
  return seam;
}

}  // namespace signorini::mesh
