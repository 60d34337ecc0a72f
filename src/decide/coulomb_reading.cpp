#include "decide/coulomb_reading.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "decide/places.hpp"

namespace signorini {
namespace {

using Kind = CoulombItem::Kind;

constexpr double noise_of_solution =
    2.0;  // relative to the noise of the right-hand side: the solution adds as much again

/// Forces whose responses are zero, and the responses to a unit of each; k of a slipping contact is proportional to its
/// l.
struct Acting {
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd columns;
  void add(Eigen::Index row, const Eigen::VectorXd& column) {
    rows.push_back(row);
    columns.conservativeResize(column.size(), columns.cols() + 1);
    columns.rightCols(1) = column;
  }
};

Acting acting(const CoulombProblem& p, const CoulombSolution& s) {
  Acting result;
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Eigen::Index n = normal_place(i), t = tangent_place(i);
    const double l = s.force[n], k = s.force[t];
    const double f = item.friction(s.kinetic[i]);
    const bool presses = item.kind != Kind::pressed && item.kind != Kind::limit && l > 0.0;
    const bool sticks = item.kind == Kind::limit     ? k != 0.0
                        : item.kind == Kind::pressed ? std::abs(k) < f * item.pressing
                                                     : item.kind == Kind::frictional && std::abs(k) < f * l;
    if (presses) result.add(n, p.W.col(n) + (sticks ? 0.0 : k / l) * p.W.col(t));
    if (sticks) result.add(t, p.W.col(t));
  }
  return result;
}

}  // namespace

CoulombReading::CoulombReading(const CoulombProblem& p, const CoulombSolution& s,
                               const Eigen::VectorXd& noise)
    : problem_(p), solution_(s), force_noise_(Eigen::VectorXd::Zero(noise.size())), response_noise_(noise) {
  double greatest = 0.0;
  for (Eigen::Index i = 0; i < noise.size(); ++i)
    if (p.W(i, i) > 0.0) greatest = std::max(greatest, std::abs(p.b[i]) / std::sqrt(p.W(i, i)));
  const double smallest = rounding::of_many * greatest;
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    if (!(p.W(i, i) > 0.0)) continue;
    const double unit = std::sqrt(p.W(i, i));
    response_noise_[i] += smallest * unit;
    force_noise_[i] = noise[i] / p.W(i, i) + smallest / unit;
  }
  const Acting act = acting(p, s);
  if (act.rows.empty()) return;
  const Eigen::MatrixXd inverse = pseudo_inverse(act.columns(act.rows, Eigen::all));
  const Eigen::VectorXd forces = inverse.cwiseAbs() * noise(act.rows);
  for (std::size_t i = 0; i < act.rows.size(); ++i)
    force_noise_[act.rows[i]] = std::max(force_noise_[act.rows[i]], forces[static_cast<Eigen::Index>(i)]);
  response_noise_ += act.columns.cwiseAbs() * forces;
}

double CoulombReading::pressing(std::size_t i) const {
  return item(i).kind == Kind::pressed ? item(i).pressing : force(normal_place(i));
}

double CoulombReading::friction(std::size_t i) const { return item(i).friction(solution_.kinetic[i]); }

double CoulombReading::zero_force(Eigen::Index row) const { return noise_of_solution * force_noise_[row]; }

bool CoulombReading::is_zero_response(Eigen::Index row) const {
  return std::abs(response(row)) <= noise_of_solution * response_noise_[row];
}

bool CoulombReading::is_inside_cone(std::size_t i) const {
  const Eigen::Index n = normal_place(i), t = tangent_place(i);
  const double f = friction(i);
  return f * pressing(i) - std::abs(force(t)) > zero_force(t) + f * zero_force(n);
}

}  // namespace signorini
