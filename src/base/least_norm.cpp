#include "base/least_norm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"

namespace signorini::base {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = ConvexSet::Kind;

constexpr int most_steps = 100;        // limit of the number of Newton steps; usually a few suffice
constexpr int max_step_halvings = 40;  // limit of the number of halvings of one step
// Damping added to the curvature of the dual function. The curvature is at most 1, and 0 where x is in a corner of a set.
// Damping is proportional to the residual, so that convergence is faster than linear, and at least the rounding error of the
// curvature.
constexpr double most_damping = 1e-3, least_damping = 1e-13;

/// Projection x = P(z) onto a convex set, and a generalised derivative of P.
struct Projection {
  VectorXd x;
  MatrixXd derivative;
};

Projection onto_cone(double f, const VectorXd& z) {
  const Index tangents = z.size() - 1;
  const VectorXd t = z.tail(tangents);
  const double length = t.norm();
  Projection p{VectorXd::Zero(z.size()), MatrixXd::Zero(z.size(), z.size())};
  if (z[0] >= 0.0 && length <= f * z[0]) return {z, MatrixXd::Identity(z.size(), z.size())};
  if (f * length <= -z[0]) return p;
  const VectorXd e = length > 0.0 ? VectorXd(t / length) : VectorXd(t);
  const double n = (z[0] + f * length) / (1.0 + f * f);
  VectorXd edge(z.size());  // generating line of the cone, through P(z)
  edge << 1.0, f * e;
  p.x = n * edge;
  p.derivative = edge * edge.transpose() / (1.0 + f * f);
  if (length > 0.0)
    p.derivative.bottomRightCorner(tangents, tangents) +=
        f * n / length * (MatrixXd::Identity(tangents, tangents) - e * e.transpose());
  return p;
}

Projection onto_disc(double radius, const VectorXd& z) {
  const double length = z.norm();
  if (length <= radius) return {z, MatrixXd::Identity(z.size(), z.size())};
  const VectorXd e = z / length;
  return {radius * e, radius / length * (MatrixXd::Identity(z.size(), z.size()) - e * e.transpose())};
}

Projection onto_ray(const VectorXd& e, const VectorXd& z) {
  const double along = e.dot(z);
  if (along <= 0.0) return {VectorXd::Zero(z.size()), MatrixXd::Zero(z.size(), z.size())};
  return {along * e, e * e.transpose()};
}

Projection onto_line(const VectorXd& e, const VectorXd& z) { return {e.dot(z) * e, e * e.transpose()}; }

Projection onto_half_space(const VectorXd& e, const VectorXd& z) {
  const MatrixXd all = MatrixXd::Identity(z.size(), z.size());
  const double along = e.dot(z);
  if (along >= 0.0) return {z, all};
  return {z - along * e, all - e * e.transpose()};
}

Projection onto(const ConvexSet& set, const VectorXd& z) {
  switch (set.kind) {
    case Kind::cone:
      return onto_cone(set.friction, z);
    case Kind::disc:
      return onto_disc(set.radius, z);
    case Kind::ray:
      return onto_ray(set.direction, z);
    case Kind::line:
      return onto_line(set.direction, z);
    case Kind::half_space:
      return onto_half_space(set.direction, z);
    case Kind::origin:
      return {VectorXd::Zero(z.size()), MatrixXd::Zero(z.size(), z.size())};
    case Kind::whole:
      break;
  }
  return {z, MatrixXd::Identity(z.size(), z.size())};
}

Projection projected(const std::vector<ConvexSet>& sets, const VectorXd& z) {
  Projection all{VectorXd(z.size()), MatrixXd::Zero(z.size(), z.size())};
  Index at = 0;
  for (const ConvexSet& set : sets) {
    VectorXd part = z.segment(at, set.size);
    if (set.offset.size() > 0) part -= set.offset;
    Projection p = onto(set, part);
    if (set.offset.size() > 0) p.x += set.offset;
    all.x.segment(at, set.size) = p.x;
    all.derivative.block(at, at, set.size, set.size) = p.derivative;
    at += set.size;
  }
  return all;
}

double dual(const VectorXd& r, const VectorXd& y, const VectorXd& z, const VectorXd& x) {
  return r.dot(y) - z.dot(x) + 0.5 * x.squaredNorm();
}

ConvexSet critical_cone_of_cone(const ConvexSet& set, const VectorXd& z, double zero) {
  const double f = set.friction, t = z.size() > 1 ? z[1] : 0.0, side = t < 0.0 ? -1.0 : 1.0;
  const double length = std::hypot(1.0, f);
  VectorXd edge = VectorXd::Ones(1), inward = edge;  // of the edge next to z
  if (z.size() > 1) {
    edge = Eigen::Vector2d(1.0, side * f) / length;
    inward = Eigen::Vector2d(f, -side) / length;
  }
  const double depth = inward.dot(z), along = edge.dot(z);
  if (z.norm() <= zero) return set;
  if (depth > zero) return {Kind::whole, set.size, 0.0, 0.0, {}};
  if (along > zero) {
    if (depth >= -zero) return {Kind::half_space, set.size, 0.0, 0.0, inward};
    return {Kind::line, set.size, 0.0, 0.0, edge};
  }
  if (along >= -zero) return {Kind::ray, set.size, 0.0, 0.0, edge};
  return {Kind::origin, set.size, 0.0, 0.0, {}};
}

/// Critical cone of { x : e.x >= 0 } or { c e : c >= 0 }: `within` where e.z is positive, `beyond` where it is negative.
ConvexSet critical_cone_of_half(const ConvexSet& set, const VectorXd& z, double zero, const ConvexSet& within,
                                const ConvexSet& beyond) {
  const double along = set.direction.dot(z);
  return along > zero ? within : along >= -zero ? set : beyond;
}

}  // namespace

ConvexSet critical_cone(const ConvexSet& moved, const VectorXd& of_moved, double zero) {
  const VectorXd z = moved.offset.size() > 0 ? VectorXd(of_moved - moved.offset) : of_moved;
  ConvexSet set = moved;
  set.offset = {};
  const ConvexSet whole{Kind::whole, set.size, 0.0, 0.0, {}}, origin{Kind::origin, set.size, 0.0, 0.0, {}};
  switch (set.kind) {
    case Kind::cone:
      return critical_cone_of_cone(set, z, zero);
    case Kind::disc: {
      const VectorXd inward = VectorXd::Constant(1, z[0] < 0.0 ? 1.0 : -1.0);
      const double depth = set.radius - std::abs(z[0]);
      return depth > zero    ? whole
             : depth < -zero ? origin
                             : ConvexSet{Kind::half_space, set.size, 0.0, 0.0, inward};
    }
    case Kind::ray:
      return critical_cone_of_half(set, z, zero, {Kind::line, set.size, 0.0, 0.0, set.direction}, origin);
    case Kind::half_space: {
      if (set.size == 1) return critical_cone_of_half(set, z, zero, whole, origin);
      const VectorXd along =
          Eigen::Vector2d(std::abs(set.direction[1]), std::copysign(set.direction[0], -set.direction[1]));
      return critical_cone_of_half(set, z, zero, whole, {Kind::line, set.size, 0.0, 0.0, along});
    }
    case Kind::line:
    case Kind::origin:
    case Kind::whole:
      break;
  }
  return set;
}

std::optional<VectorXd> least_norm(const MatrixXd& a, const VectorXd& r, const std::vector<ConvexSet>& sets) {
  auto found = least_norm_point(a, r, sets);
  return found ? std::optional<VectorXd>(std::move(found->x)) : std::nullopt;
}

std::optional<LeastNorm> least_norm_point(const MatrixXd& a, const VectorXd& r,
                                          const std::vector<ConvexSet>& sets) {
  const double size = r.norm();
  VectorXd y = r;  // the solution, if no set restricts x
  VectorXd z = a.transpose() * y;
  Projection now = projected(sets, z);
  std::optional<LeastNorm> best;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const VectorXd left = r - a * now.x;
    // A' y may be far greater than its projection; x then has the rounding error of A' y.
    if (left.norm() <= rounding::elimination * size + rounding::few_operations * z.norm()) {
      if (!(left.norm() < 0.5 * least)) return best;  // the residual is only rounding error
      least = left.norm();
      best = LeastNorm{now.x, z};
    }
    const double damping = std::max(least_damping, most_damping * std::min(1.0, left.norm() / size));
    MatrixXd curvature = a * now.derivative * a.transpose();
    curvature.diagonal().array() += damping;
    const VectorXd way = solve_dense(curvature, left);
    const double slope = left.dot(way), value = dual(r, y, z, now.x);
    if (!(slope > 0.0)) return best;
    double part = 1.0;
    for (int halving = 0;; ++halving, part *= 0.5) {
      if (halving == max_step_halvings) return best;
      const VectorXd tried = y + part * way;
      const VectorXd there = a.transpose() * tried;
      Projection next = projected(sets, there);
      // Near the solution the dual function changes by less than its rounding error; the residual then shows whether the
      // step is an improvement.
      const bool better = dual(r, tried, there, next.x) >= value + 1e-4 * part * slope;
      if (!better && !((r - a * next.x).norm() < 0.5 * left.norm())) continue;
      y = tried;
      z = there;
      now = std::move(next);
      break;
    }
  }
  return best;
}

}  // namespace signorini::base
