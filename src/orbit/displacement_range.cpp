#include "orbit/displacement_range.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::orbit {
namespace {

// Limit of the evaluations between two nodes; a second one is needed only if two displacements turn there.
constexpr int most_refinements = 4;

/// Cubic between two nodes, x from 0 to 1: u(x) = u_a + x (p + x (q + x r)).
struct Cubic {
  double start, p, q, r;

  Cubic(double u_a, double v_a, double u_b, double v_b, double h)
      : start(u_a),
        p(h * v_a),
        q(3.0 * (u_b - u_a) - h * (2.0 * v_a + v_b)),
        r(2.0 * (u_a - u_b) + h * (v_a + v_b)) {}

  [[nodiscard]] double at(double x) const { return start + x * (p + x * (q + x * r)); }
  /// Calls use(x) for each zero of the slope p + 2 q x + 3 r x^2 inside.
  template <class Use>
  void each_turn(Use use) const {
    const double square = q * q - 3.0 * r * p;
    if (!(square > 0.0)) return;
    const double sum = -(q + std::copysign(std::sqrt(square), q));  // without cancellation
    for (const double x : {sum / (3.0 * r), p / sum})
      if (x > 0.0 && x < 1.0) use(x);
  }
};

}  // namespace

DisplacementRange::DisplacementRange(const Model& model, double duration, int nodes)
    : model_(model), spacing_(duration / nodes) {
  const std::vector<Dof>& dofs = model.physical_dofs();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    if (!dofs[i].rotation) translations_.push_back(static_cast<Eigen::Index>(i));
}

DisplacementRange::Node DisplacementRange::node_at(double t, const Vector& u, const Vector& v) const {
  Node node{t, Vector(static_cast<Eigen::Index>(translations_.size())), {}};
  node.v = node.u;
  const bool plain = model_.is_physical();
  const Vector physical_u = plain ? Vector() : model_.physical(u, t, 0);
  const Vector physical_v = plain ? Vector() : model_.physical(v, t, 1);
  for (std::size_t i = 0; i < translations_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    node.u[row] = (plain ? u : physical_u)[translations_[i]];
    node.v[row] = (plain ? v : physical_v)[translations_[i]];
  }
  return node;
}

void DisplacementRange::extend(const Node& node) {
  if (low_.size() == 0) low_ = high_ = node.u;
  low_ = low_.cwiseMin(node.u);
  high_ = high_.cwiseMax(node.u);
}

void DisplacementRange::begin_stretch(double t, const Vector& u, const Vector& v) {
  last_ = node_at(t, u, v);
  extend(last_);
}

std::optional<double> DisplacementRange::turning_time(const Node& a, const Node& b) const {
  const double h = b.t - a.t, known = (high_ - low_).maxCoeff();
  double greatest = (1.0 + rounding::many_operations) * known;
  std::optional<double> time;
  for (Eigen::Index i = 0; i < a.u.size(); ++i) {
    if (a.v[i] * b.v[i] > 0.0 && (b.u[i] - a.u[i]) * a.v[i] > 0.0)
      continue;  // monotone, as far as the nodes show
    const Cubic cubic(a.u[i], a.v[i], b.u[i], b.v[i], h);
    cubic.each_turn([&](double x) {
      const double value = cubic.at(x), range = std::max(high_[i], value) - std::min(low_[i], value);
      if (!(range > greatest)) return;
      greatest = range;
      time = a.t + x * h;
    });
  }
  return time;
}

void DisplacementRange::follow(const run::RunStep& step) {
  motion::Point point;
  const double end = step.step.end;
  while (last_.t < end) {
    const double left = end - last_.t;
    const double t = left > (1.0 + rounding::many_operations) * spacing_ ? last_.t + spacing_ : end;
    step.motion.evaluate(t, point);
    Node next = node_at(t, point.u, point.v);
    extend(next);
    for (int i = 0; i < most_refinements; ++i) {
      const std::optional<double> turn = turning_time(last_, next);
      if (!turn) break;
      step.motion.evaluate(*turn, point);
      Node there = node_at(*turn, point.u, point.v);
      const double before = (high_ - low_).maxCoeff();
      extend(there);
      if (!((high_ - low_).maxCoeff() > before)) break;
    }
    last_ = std::move(next);
  }
}

double DisplacementRange::amplitude() const {
  return low_.size() == 0 ? 0.0 : 0.5 * (high_ - low_).maxCoeff() * model_.unit.length;
}

}  // namespace signorini::orbit
