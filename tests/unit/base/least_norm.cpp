// The point of least norm against what makes it one: no feasible point lies in a direction that is shorter.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/least_norm.hpp"

using namespace signorini;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd normal_matrix(std::mt19937_64& random, Index rows, Index columns) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// By how much x leaves the sets at worst; negative: it lies inside.
double excess(const std::vector<base::ConvexSet>& sets, const VectorXd& x) {
  double worst = -1e300;
  Index at = 0;
  for (const base::ConvexSet& set : sets) {
    const VectorXd part = x.segment(at, set.size);
    if (set.kind == base::ConvexSet::Kind::cone)
      worst = std::max({worst, part.tail(set.size - 1).norm() - set.friction * part[0], -part[0]});
    else if (set.kind == base::ConvexSet::Kind::disc)
      worst = std::max(worst, part.norm() - set.radius);
    else
      worst = std::max(
          {worst, (part - set.direction.dot(part) * set.direction).norm(), -set.direction.dot(part)});
    at += set.size;
  }
  return worst;
}

/// The last feasible point from a feasible one along a direction that A does not see.
VectorXd farthest(const std::vector<base::ConvexSet>& sets, const VectorXd& from, const VectorXd& way) {
  double inside = 0.0, outside = 1e3;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (inside + outside);
    (excess(sets, from + middle * way) <= 1e-13 ? inside : outside) = middle;
  }
  return from + inside * way;
}

void check_case(std::mt19937_64& random, const std::vector<base::ConvexSet>& sets, const VectorXd& feasible,
                Index kept) {
  const MatrixXd a = base::orthonormal(normal_matrix(random, feasible.size(), kept)).transpose();
  const auto x = base::least_norm(a, a * feasible, sets);
  const MatrixXd open = base::orthogonal_complement(MatrixXd(a.transpose()));
  if (!x) {  // discs and cones of two tangents may touch the affine space in one point: its dual has no greatest value
    for (Index i = 0; i < open.cols(); ++i)
      for (const double side : {1.0, -1.0})
        CHECK((farthest(sets, feasible, side * open.col(i)) - feasible).norm() < 1e-3 * feasible.norm());
    return;
  }
  CHECK((a * (*x - feasible)).norm() <= 1e-12 * feasible.norm());
  CHECK(excess(sets, *x) <= 1e-12 * feasible.norm());
  CHECK(x->norm() <= feasible.norm() * (1.0 + 1e-12));
  for (int i = 0; i < 40; ++i) {
    const VectorXd way = (open * normal_matrix(random, open.cols(), 1)).normalized();
    const VectorXd other = farthest(sets, feasible, way);
    CHECK(x->dot(other - *x) >= -1e-10 * feasible.squaredNorm());
  }
}

/// Sets with a point inside, or on the boundary.
std::pair<std::vector<base::ConvexSet>, VectorXd> random_sets(std::mt19937_64& random, int count,
                                                              Index tangents, bool rays) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<base::ConvexSet> sets;
  std::vector<double> point;
  for (int i = 0; i < count; ++i) {
    const VectorXd e = normal_matrix(random, tangents, 1).normalized();
    const double f = 0.1 + part(random), n = 0.2 + 3.0 * part(random),
                 share = part(random) < 0.3 ? 1.0 : part(random);
    if (i % 7 == 3) {  // without friction
      sets.push_back({base::ConvexSet::Kind::cone, 1, 0.0, 0.0, {}});
      point.push_back(n);
    } else if (rays && i % 3 == 1) {
      VectorXd along(1 + tangents);
      along << 1.0, f * e;
      sets.push_back({base::ConvexSet::Kind::ray, 1 + tangents, 0.0, 0.0, along.normalized()});
      for (const double value : VectorXd(n * along)) point.push_back(value);
    } else if (rays && i % 3 == 2) {
      sets.push_back({base::ConvexSet::Kind::disc, tangents, 0.0, f * n, {}});
      for (const double value : VectorXd(share * f * n * e)) point.push_back(value);
    } else {
      sets.push_back({base::ConvexSet::Kind::cone, 1 + tangents, f, 0.0, {}});
      point.push_back(n);
      for (const double value : VectorXd(share * f * n * e)) point.push_back(value);
    }
  }
  return {sets, Eigen::Map<VectorXd>(point.data(), static_cast<Index>(point.size()))};
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/least_norm");

TEST_CASE("no feasible point lies in a shorter direction: cones of one and two tangents, discs, rays") {
  std::mt19937_64 random(7);
  for (const Index tangents : {Index{1}, Index{2}})
    for (const bool rays : {false, true})
      for (int i = 0; i < 100; ++i) {
        CAPTURE(tangents);
        CAPTURE(rays);
        CAPTURE(i);
        const auto [sets, point] = random_sets(random, 2 + i % 5, tangents, rays);
        check_case(random, sets, point, std::max<Index>(1, point.size() - 1 - i % 3));
      }
}

TEST_CASE("two cones and one free direction: the least of a parabola on an interval") {
  std::mt19937_64 random(11);
  for (int i = 0; i < 200; ++i) {
    const auto [sets, point] = random_sets(random, 2, 1, false);
    const VectorXd way = normal_matrix(random, 4, 1).normalized();
    const MatrixXd a = base::orthogonal_complement(MatrixXd(way)).transpose();
    double low = -1e3, high = 1e3;  // of point + y way within |t| <= f n
    for (const Index k : {Index{0}, Index{1}})
      for (const double side : {1.0, -1.0}) {
        const double f = sets[static_cast<std::size_t>(k)].friction;
        const double room = f * point[2 * k] - side * point[2 * k + 1],
                     rate = f * way[2 * k] - side * way[2 * k + 1];
        (rate > 0.0 ? low : high) = rate > 0.0 ? std::max(low, -room / rate) : std::min(high, -room / rate);
      }
    const VectorXd expected = point + std::clamp(-way.dot(point), low, high) * way;
    const auto x = base::least_norm(a, a * point, sets);
    REQUIRE(x);
    CHECK((*x - expected).norm() <= 1e-11 * point.norm());
  }
}

TEST_CASE("what has no friction does not pull: a push between two walls beside a foot that sticks") {
  // k + right - left = P: of all that hold it those with left = 0 have the least norm.
  const MatrixXd a = (MatrixXd(1, 4) << 0.0, 1.0, 1.0, -1.0).finished() / std::sqrt(3.0);
  const std::vector<base::ConvexSet> sets{{base::ConvexSet::Kind::cone, 2, 0.5, 0.0, {}},
                                          {base::ConvexSet::Kind::cone, 1, 0.0, 0.0, {}},
                                          {base::ConvexSet::Kind::cone, 1, 0.0, 0.0, {}}};
  const MatrixXd weighed = (MatrixXd(2, 4) << 1.0, 0.0, 0.0, 0.0, a).finished();
  const auto x = base::least_norm(weighed, Eigen::Vector2d(10.0, 3.0 / std::sqrt(3.0)), sets);
  REQUIRE(x);
  CHECK((*x - Eigen::Vector4d(10.0, 1.5, 1.5, 0.0)).norm() <= 1e-12);
}

TEST_CASE("no point: a pull beyond both cones") {
  const MatrixXd a = (MatrixXd(2, 4) << 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0).finished() / std::sqrt(2.0);
  const std::vector<base::ConvexSet> sets(2, {base::ConvexSet::Kind::cone, 2, 0.5, 0.0, {}});
  CHECK(base::least_norm(a, Eigen::Vector2d(1.0, 0.49), sets));
  CHECK_FALSE(base::least_norm(a, Eigen::Vector2d(1.0, 0.51), sets));
  CHECK_FALSE(base::least_norm(a, Eigen::Vector2d(-1.0, 0.0), sets));
}

TEST_CASE(
    "the minimum moves by the point of least norm within critical cones, on faces and where faces meet") {
  // r_0 + h r_1: the same sets and, for a small h, the same faces. Some feet begin on an edge, in the apex or both.
  std::mt19937_64 random(17);
  int solved = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const auto [sets, point] = random_sets(random, 3, 1, false);
    const MatrixXd a = base::orthonormal(normal_matrix(random, 6, 3)).transpose();
    VectorXd y = normal_matrix(random, 3, 1);
    if (i % 2 == 0) {  // the argument of the first foot lies on an edge of its cone, or of the polar cone
      const double f = sets[0].friction, side = i % 4 == 0 ? 1.0 : -1.0;
      const VectorXd edge =
          i % 3 == 0 ? VectorXd(Eigen::Vector2d(-f, side)) : VectorXd(Eigen::Vector2d(1.0, side * f));
      y = a.topLeftCorner(3, 2).transpose().completeOrthogonalDecomposition().solve(edge);
    }
    if (i % 5 == 0) y.setZero();
    const VectorXd z = a.transpose() * y;
    std::vector<base::ConvexSet> critical;
    VectorXd x0(6);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = 2 * static_cast<Index>(k);
      critical.push_back(base::critical_cone(sets[k], z.segment(at, 2), 1e-12));
      const double f = sets[k].friction, side = z[at + 1] < 0.0 ? -1.0 : 1.0;
      const Eigen::Vector2d edge = Eigen::Vector2d(1.0, side * f).normalized();
      const bool inside = std::abs(z[at + 1]) <= f * z[at];
      x0.segment(at, 2) = inside ? Eigen::Vector2d(z.segment(at, 2))
                                 : Eigen::Vector2d(std::max(0.0, edge.dot(z.segment(at, 2))) * edge);
    }
    const VectorXd direction = a * point;
    const auto rate = base::least_norm(a, direction, critical);
    if (!rate) continue;
    const double h = 1e-6;
    const auto moved = base::least_norm(a, a * x0 + h * direction, sets);
    if (!moved) continue;  // no forces within the cones, or rounding hides them
    ++solved;
    CHECK((*moved - x0 - h * *rate).norm() <= 1e-4 * h * (1.0 + rate->norm()));
  }
  CHECK(solved > 150);
}

TEST_SUITE_END();
