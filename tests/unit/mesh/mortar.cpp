// Dual mortar: lengths and weights by hand, partly covered edges, curves, invariance.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "mesh/grids.hpp"
#include "mesh/mortar.hpp"
#include "mesh/shape_functions.hpp"

using namespace signorini;

namespace {

/// Edges along given places on a line through the origin at an odd angle; `back`: they run the other way.
struct Line {
  std::vector<mesh::PlanePoint> at;
  std::vector<PlaneMesh::Edge> slave, master;
  static constexpr double angle = 0.53;

  int add(double s, double off) {
    at.push_back({s * std::cos(angle) - off * std::sin(angle), s * std::sin(angle) + off * std::cos(angle)});
    return static_cast<int>(at.size()) - 1;
  }
  /// The body of the slave lies above, its edges run along; that of the master below, they run back.
  void add_side(const std::vector<double>& places, bool is_slave, bool quadratic, double off = 0.0) {
    auto& edges = is_slave ? slave : master;
    int last = add(places[0], off);
    for (std::size_t i = 1; i < places.size(); ++i) {
      const int next = add(places[i], off);
      PlaneMesh::Edge edge{is_slave ? std::vector{last, next} : std::vector{next, last}};
      if (quadratic) edge.nodes.push_back(add(0.5 * (places[i - 1] + places[i]), off));
      edges.push_back(edge);
      last = next;
    }
  }
  [[nodiscard]] mesh::MortarSeam seam() const {
    return mesh::mortar_between(slave, master, [&](int n) { return at[static_cast<std::size_t>(n)]; });
  }
};

}  // namespace

TEST_SUITE_BEGIN("unit/mesh/mortar");

TEST_CASE("two linear edges over one: lengths and weights as by hand") {
  Line line;
  line.add_side({0.0, 1.0, 3.0}, true, false);  // nodes 0, 1, 2
  line.add_side({0.0, 3.0}, false, false);      // nodes 3 at 0, 4 at 3
  const mesh::MortarSeam seam = line.seam();
  REQUIRE(seam.nodes.size() == 3);
  const double length[3] = {0.5, 1.5, 1.0};
  // psi_k reproduces linear fields: sum_l w_l x_l = x_k.
  const double right[3] = {0.0, 1.0 / 3.0, 1.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::MortarNode& node = seam.nodes[k];
    CHECK(node.node == static_cast<int>(k));
    CHECK(node.length == doctest::Approx(length[k]).epsilon(1e-14));
    double w3 = 0.0, w4 = 0.0;
    for (const auto& [l, w] : node.master) (l == 3 ? w3 : w4) += w;
    CHECK(w4 == doctest::Approx(right[k]).epsilon(1e-13));
    CHECK(w3 == doctest::Approx(1.0 - right[k]).epsilon(1e-13));
    CHECK(node.gap == 0.0);
    CHECK(node.normal[0] == doctest::Approx(-std::sin(Line::angle)).epsilon(1e-14));
    CHECK(node.normal[1] == doctest::Approx(std::cos(Line::angle)).epsilon(1e-14));
  }
}

TEST_CASE(
    "meshes that do not match: forces of a constant pressure are those of both sides' shape functions") {
  for (const bool slave_quadratic : {false, true})
    for (const bool master_quadratic : {false, true}) {
      CAPTURE(slave_quadratic);
      CAPTURE(master_quadratic);
      Line line;
      line.add_side({0.0, 0.31, 0.8, 1.13, 1.7}, true, slave_quadratic);
      line.add_side({0.0, 0.52, 0.91, 1.7}, false, master_quadratic);
      const mesh::MortarSeam seam = line.seam();
      std::vector<double> force(line.at.size(), 0.0), wanted(line.at.size(), 0.0);
      for (const mesh::MortarNode& k : seam.nodes) {
        double sum = 0.0;
        for (const auto& [l, w] : k.master) force[static_cast<std::size_t>(l)] += w * k.length, sum += w;
        force[static_cast<std::size_t>(k.node)] = k.length;
        CHECK(sum == doctest::Approx(1.0).epsilon(1e-13));
      }
      for (const auto* side : {&line.slave, &line.master})
        for (const auto& edge : *side) {
          const auto &a = line.at[static_cast<std::size_t>(edge.nodes[0])],
                     &b = line.at[static_cast<std::size_t>(edge.nodes[1])];
          const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
          const bool three = edge.nodes.size() == 3;
          for (std::size_t i = 0; i < edge.nodes.size(); ++i)
            wanted[static_cast<std::size_t>(edge.nodes[i])] +=
                length * (three ? (i == 2 ? 4.0 : 1.0) / 6.0 : 0.5);
        }
      for (std::size_t i = 0; i < force.size(); ++i)
        CHECK(force[i] == doctest::Approx(wanted[i]).epsilon(1e-12));
    }
}

TEST_CASE("a partly covered edge: its rows carry the covered length alone") {
  Line line;
  line.add_side({0.0, 1.0, 2.0, 3.0}, true, false);
  line.add_side({0.6, 1.9}, false, false, -0.01);
  const mesh::MortarSeam seam = line.seam();
  REQUIRE(seam.nodes.size() == 3);  // the one at 3 touches nothing
  double total = 0.0;
  for (const mesh::MortarNode& k : seam.nodes) {
    total += k.length;
    double sum = 0.0, moment = 0.0;
    for (const auto& [l, w] : k.master) {
      sum += w;
      const auto& x = line.at[static_cast<std::size_t>(l)];
      moment += w * (x[0] * std::cos(Line::angle) + x[1] * std::sin(Line::angle));
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(moment == doctest::Approx(static_cast<double>(&k - seam.nodes.data())).epsilon(1e-11));
    CHECK(k.gap == doctest::Approx(0.01).epsilon(1e-10));
  }
  CHECK(total == doctest::Approx(1.3).epsilon(1e-12));
  CHECK(seam.negative.empty());
}

TEST_CASE(
    "an edge that is covered by rounding alone carries nothing; nodes that nearly meet keep all of their "
    "length") {
  Line line;
  line.add_side({0.0, 1.0, 2.0}, true, false);
  line.add_side({-1.0, 1.000001}, false, false);
  const mesh::MortarSeam ended = line.seam();
  REQUIRE(ended.nodes.size() == 2);
  CHECK(ended.nodes[1].length == doctest::Approx(0.5).epsilon(1e-14));
  Line near;
  near.add_side({0.0, 1.0, 2.0}, true, false);  // 0, 1, 2
  near.add_side({0.0, 1.0000001, 2.0}, false, false);
  const mesh::MortarSeam seam = near.seam();
  REQUIRE(seam.nodes.size() == 3);
  double total = 0.0;
  std::vector<double> force(near.at.size(), 0.0);
  for (const mesh::MortarNode& k : seam.nodes) {
    total += k.length;
    for (const auto& [l, w] : k.master) force[static_cast<std::size_t>(l)] += w * k.length;
  }
  CHECK(total == doctest::Approx(2.0).epsilon(1e-14));
  CHECK(force[3] == doctest::Approx(0.50000005).epsilon(1e-12));
  CHECK(force[4] == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE(
    "arcs that do not match: gaps shrink with the square of the elements, of quadratic ones by the fourth "
    "power") {
  const auto worst_gap = [](PlaneShape shape, int n) {
    const double end = 0.7;
    PlaneMesh inner = mesh::ring_mesh({{0.1, 0.2}, 0.5, 1.0, 0.0, end}, {shape, {1, 2 * n}, {1.0, 1.0}});
    const PlaneMesh outer =
        mesh::ring_mesh({{0.1, 0.2}, 1.0, 1.5, 0.0, end}, {shape, {1, 3 * n}, {1.0, 1.0}});
    const auto shift = static_cast<int>(inner.nodes.size());
    std::vector<PlaneMesh::Edge> slave = inner.groups[0].edges, master = outer.groups[1].edges;
    REQUIRE(inner.groups[0].name == "outer");
    REQUIRE(outer.groups[1].name == "inner");
    for (auto& edge : master)
      for (int& k : edge.nodes) k += shift;
    const mesh::MortarSeam seam = mesh::mortar_between(slave, master, [&](int k) {
      const auto& node = k < shift ? inner.nodes[static_cast<std::size_t>(k)]
                                   : outer.nodes[static_cast<std::size_t>(k - shift)];
      return mesh::PlanePoint{node.x, node.y};
    });
    double worst = 0.0;
    for (const mesh::MortarNode& k : seam.nodes) worst = std::max(worst, std::abs(k.gap));
    return worst;
  };
  CHECK(std::log2(worst_gap(PlaneShape::q4, 4) / worst_gap(PlaneShape::q4, 8)) >= 1.8);
  CHECK(std::log2(worst_gap(PlaneShape::q8, 4) / worst_gap(PlaneShape::q8, 8)) >= 2.8);
}

TEST_CASE(
    "boundaries that lie on each other have no gap, however their bodies were turned: rounding is none") {
  for (const double degrees : {0.0, 90.0, 180.0, 270.0, 33.7, 89.999}) {
    CAPTURE(degrees);
    const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
    // Turned as bodies are, about a corner of each: what lies on an axis then lies off it by eps of its distance.
    std::vector<mesh::PlanePoint> at;
    const auto add = [&](const mesh::PlanePoint& corner, double x, double y) {
      const double tx = c * corner[0] - s * corner[1], ty = s * corner[0] + c * corner[1];
      at.push_back({tx + (c * x - s * y), ty + (s * x + c * y)});
    };
    for (const double x : {0.0, 0.13, 0.4}) add({-0.4, 0.0}, x, 0.0);         // 0, 1, 2: the slave, above
    for (const double x : {0.0, 0.35, 0.55, 0.7}) add({-0.5, -0.2}, x, 0.2);  // 3 to 6: the master, below
    const std::vector<PlaneMesh::Edge> slave{{{0, 1}}, {{1, 2}}}, master{{{6, 5}}, {{5, 4}}, {{4, 3}}};
    const auto place = [&](int n) { return at[static_cast<std::size_t>(n)]; };
    const mesh::MortarSeam seam = mesh::mortar_between(slave, master, place);
    REQUIRE(seam.nodes.size() == 3);
    for (const mesh::MortarNode& node : seam.nodes) CHECK(node.gap == 0.0);
    for (const mesh::MortarNode& node : mesh::mortar_on_line(slave, {0.0, 0.0}, {-s, c}, place).nodes)
      CHECK(node.gap == 0.0);
    at[1][0] += 1e-12 * s;  // what is no rounding stays
    at[1][1] -= 1e-12 * c;
    CHECK(mesh::mortar_between(slave, master, place).nodes[1].gap == doctest::Approx(-1e-12).epsilon(1e-2));
  }
}

TEST_CASE("on the ground and on a line") {
  Line line;
  line.add_side({0.0, 0.4, 1.1}, true, false);
  const auto place = [&](int n) { return line.at[static_cast<std::size_t>(n)]; };
  const mesh::MortarSeam ground = mesh::mortar_on_ground(line.slave, place);
  REQUIRE(ground.nodes.size() == 3);
  CHECK(ground.nodes[1].length == doctest::Approx(0.55).epsilon(1e-14));
  CHECK(ground.nodes[1].master.empty());
  const mesh::PlanePoint up{0.0, 1.0};
  const mesh::MortarSeam flat = mesh::mortar_on_line(line.slave, {5.0, -2.0}, up, place);
  REQUIRE(flat.nodes.size() == 3);
  for (const mesh::MortarNode& k : flat.nodes)
    CHECK(k.gap == doctest::Approx(place(k.node)[1] + 2.0).epsilon(1e-14));
  CHECK(mesh::mortar_on_line(line.slave, {5.0, 2.0}, {0.0, -1.0}, place).nodes.empty());  // it faces away
}

TEST_CASE("an interference reaches as far as the slave's body: no farther, and not to its other side") {
  // The slave's body lies between 0 and 0.5; the master's edge 0.3, 0.5, 0.7 into it, or before it.
  for (const double off : {-0.2, 0.0, 0.3, 0.5, 0.7}) {
    CAPTURE(off);
    Line line;
    line.add_side({0.0, 1.0, 3.0}, true, false);
    std::vector<PlaneMesh::Edge> outline = line.slave;
    line.add_side({-0.5, 3.5}, false, false, 0.5);  // its back
    outline.insert(outline.end(), line.master.begin(), line.master.end());
    if (off != 0.5) {
      line.master.clear();
      line.add_side({0.4, 2.8}, false, false, off);
    }
    const mesh::MortarSeam seam = mesh::mortar_between(
        line.slave, line.master, [&](int n) { return line.at[static_cast<std::size_t>(n)]; }, outline);
    REQUIRE(seam.nodes.size() == (off < 0.5 ? 3 : 0));
    for (const mesh::MortarNode& node : seam.nodes) CHECK(node.gap == doctest::Approx(-off).epsilon(1e-14));
    if (off != 0.5) CHECK(line.seam().nodes.size() == 3);  // of what body it is, nobody has said
  }
}

TEST_CASE("of two edges behind the slave's the nearer one counts, in any order") {
  for (const bool nearer_first : {false, true}) {
    Line line;
    line.add_side({0.0, 1.0, 3.0}, true, false);
    line.add_side({-0.5, 3.5}, false, false, nearer_first ? 0.1 : 0.3);
    line.add_side({-0.5, 3.5}, false, false, nearer_first ? 0.3 : 0.1);
    const mesh::MortarSeam seam = line.seam();
    REQUIRE(seam.nodes.size() == 3);
    for (const mesh::MortarNode& node : seam.nodes) CHECK(node.gap == doctest::Approx(-0.1).epsilon(1e-14));
  }
}

TEST_SUITE_END();
