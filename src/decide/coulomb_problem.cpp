#include "decide/coulomb_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"
#include "base/lcp.hpp"
#include "base/rounding.hpp"

namespace signorini::decide {
namespace {

using Kind = CoulombItem::Kind;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Tolerance for the conditions of a solution, relative to the magnitude of the problem's forces and responses.
constexpr double misses = rounding::elimination;
// Two solutions are equal if their responses differ by less than this fraction of the magnitude of the responses, or by less
// than `misses` times the condition number of their equations. Chosen value, far below the differences of the solutions in
// Painleve's paradox.
constexpr double same_solution = 1e-9;
// Upper limit of the tolerance `misses` times condition number. Chosen value: tests/unit/base/lcp.cpp needs 1e-4 at a margin
// of 1e-10; in Painleve's paradox responses differ by their own magnitude.
constexpr double max_same_solution = 1e-3;

/// The problem in units in which the diagonal of W is one.
struct Scaled {
  VectorXd unit;  // response / unit, force * unit
  MatrixXd W;
  VectorXd b;
  std::vector<double> ratio;  // unit of the normal / unit of the tangent, a factor of the limit force f l
};

Scaled scaled(const CoulombProblem& p) {
  Scaled s;
  const Index n = p.b.size();
  s.unit = VectorXd::Ones(n);
  for (Index i = 0; i < n; ++i)
    if (p.W(i, i) > 0.0) s.unit[i] = std::sqrt(p.W(i, i));
  const VectorXd inverse = s.unit.cwiseInverse();
  s.W = inverse.asDiagonal() * p.W * inverse.asDiagonal();
  s.b = inverse.cwiseProduct(p.b);
  // An unused place has the diagonal entry one and the force zero.
  for (std::size_t place = 0; place < p.layout.size(); ++place)
    if (!p.layout.is_used(place)) s.W(static_cast<Index>(place), static_cast<Index>(place)) = 1.0;
  for (std::size_t i = 0; i < p.items.size(); ++i)
    s.ratio.push_back(s.unit[p.tangent(i)] / s.unit[p.normal(i)]);
  return s;
}

/// Limit of the number of covering vectors for Lemke's method. If W is semidefinite, any covering vector leads to a solution in
/// exact arithmetic. With rounding errors, and if many contacts constrain few motions, the method may end in a ray. Chosen
/// value: 4 of 150 seams need a second vector (tests/unit/base/lcp.cpp).
constexpr int max_covering_vectors = 12;

/// Covering vector d number `way`: all ones for 0; otherwise irregular numbers from 1 to 2 (multiples of the golden section).
VectorXd covering_vector(Index size, int way) {
  VectorXd d = VectorXd::Ones(size);
  for (Index i = 0; way > 0 && i < size; ++i) {
    const double turns = 0.6180339887498949 * static_cast<double>((i + 1) * way);
    d[i] += turns - std::floor(turns);
  }
  return d;
}

/// Solves the problem by Lemke's method. The scaled forces are F z; w contains responses, or distances of forces from their
/// friction cones. way: number of the covering vector. Returns the scaled forces; nullopt: no solution was found.
std::optional<VectorXd> solve_by_lemke(const CoulombProblem& p, const Scaled& s,
                                       const std::vector<bool>& kinetic, int way) {
  Index size = 0;
  for (const CoulombItem& item : p.items)
    size += item.kind == Kind::frictional ? 4 : item.kind == Kind::pressed ? 3 : 1;
  const Index n = s.b.size();
  MatrixXd F = MatrixXd::Zero(n, size);  // forces per unit of each variable
  MatrixXd G = MatrixXd::Zero(size, n);  // w = G response + H z + h
  MatrixXd H = MatrixXd::Zero(size, size);
  VectorXd h = VectorXd::Zero(size);
  Index at = 0;
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Index ni = p.normal(i), ti = p.tangent(i);
    // In scaled units the tangential force is k unit_t, and f l unit_t = f (l unit_n) unit_t / unit_n.
    const double f = item.friction(kinetic[i] || item.kind == Kind::sliding) * s.ratio[i];
    switch (item.kind) {
      case Kind::normal:
      case Kind::sliding:
        F(ni, at) = 1.0;
        if (item.kind == Kind::sliding) F(ti, at) = -item.sign * f;
        G(at, ni) = 1.0;
        ++at;
        break;
      case Kind::limit:
        F(ti, at) = item.sign;
        G(at, ti) = item.sign;
        ++at;
        break;
      case Kind::frictional:
        F(ni, at) = 1.0;
        G(at, ni) = 1.0;
        H(at + 3, at) = f;
        ++at;
        [[fallthrough]];
      case Kind::pressed:
        F(ti, at) = 1.0;
        F(ti, at + 1) = -1.0;
        G(at, ti) = 1.0;
        G(at + 1, ti) = -1.0;
        H(at, at + 2) = H(at + 1, at + 2) = 1.0;
        H(at + 2, at) = H(at + 2, at + 1) = -1.0;
        if (item.kind == Kind::pressed) {
          // b already contains the effect of the given l. In this row l determines only the friction limit.
          h[at + 2] = f * item.applied_normal_force * s.unit[ni];
        }
        at += 3;
        break;
    }
  }
  const MatrixXd M = G * s.W * F + H;
  const VectorXd q = G * s.b + h;
  const double size_of_q = q.cwiseAbs().maxCoeff();
  if (!(size_of_q > 0.0)) return VectorXd::Zero(n);
  const auto z = base::solve_lcp(M, q / size_of_q, covering_vector(size, way));
  if (!z) return std::nullopt;
  return VectorXd(F * *z * size_of_q);
}

/// States of an item in the enumeration. sign_of() gives the direction of slip.
enum class TrialState : unsigned char { open, stick, slip_plus, slip_minus };

int sign_of(TrialState state) {
  return state == TrialState::slip_plus ? 1 : state == TrialState::slip_minus ? -1 : 0;
}

std::vector<TrialState> choices(const CoulombItem& item) {
  switch (item.kind) {
    case Kind::normal:
      return {TrialState::open, TrialState::stick};  // `stick` means closed
    case Kind::sliding:
      return {TrialState::open, item.sign > 0 ? TrialState::slip_plus : TrialState::slip_minus};
    case Kind::frictional:
      return {TrialState::open, TrialState::stick, TrialState::slip_plus, TrialState::slip_minus};
    case Kind::pressed:
      return {TrialState::stick, TrialState::slip_plus, TrialState::slip_minus};
    case Kind::limit:
      return {TrialState::stick, TrialState::slip_plus};  // `slip_plus` means slip in direction item.sign
  }
  return {};
}

/// Equations A x = c for one combination of states; x: the scaled forces at all places.
struct Equations {
  MatrixXd A;
  VectorXd c;
};

Equations equations_of(const CoulombProblem& p, const Scaled& s, const std::vector<TrialState>& states,
                       const std::vector<bool>& kinetic) {
  const Index n = s.b.size();
  Equations e{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
  const auto no_force = [&](Index row) { e.A(row, row) = 1.0; };
  for (std::size_t place = 0; place < p.layout.size(); ++place)
    if (!p.layout.is_used(place)) no_force(static_cast<Index>(place));
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Index ni = p.normal(i), ti = p.tangent(i);
    const double f = item.friction(kinetic[i] || item.kind == Kind::sliding) * s.ratio[i];
    const int sign = sign_of(states[i]);
    const auto respond = [&](Index row) {
      e.A.row(row) = s.W.row(row);
      e.c[row] = -s.b[row];
    };
    const bool own_normal = item.kind != Kind::pressed && item.kind != Kind::limit;
    if (own_normal && states[i] != TrialState::open)
      respond(ni);
    else
      no_force(ni);
    const bool may_stick = item.kind != Kind::normal && item.kind != Kind::sliding;
    if (states[i] == TrialState::stick && may_stick) {
      respond(ti);
    } else {
      no_force(ti);
      if (item.kind == Kind::pressed) e.c[ti] = -sign * f * item.applied_normal_force * s.unit[ni];
      if (own_normal && sign != 0) e.A(ti, ni) = sign * f;
    }
  }
  return e;
}

/// Scaled forces for one combination of states. miss: largest violation of a condition, relative to the magnitude of forces and
/// right-hand side.
struct Attempt {
  VectorXd force;
  double miss = 0.0;
};

Attempt attempt(const CoulombProblem& p, const Scaled& s, const std::vector<TrialState>& states,
                const std::vector<bool>& kinetic) {
  const Equations e = equations_of(p, s, states, kinetic);
  Attempt result{base::particular_solution(e.A, e.c)};
  const VectorXd& x = result.force;
  const VectorXd r = s.b + s.W * x;
  double miss = (e.A * x - e.c).cwiseAbs().maxCoeff();
  const auto must_not_be_negative = [&](double value) { miss = std::max(miss, -value); };
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Index ni = p.normal(i), ti = p.tangent(i);
    const double f = item.friction(kinetic[i] || item.kind == Kind::sliding) * s.ratio[i];
    const int sign = sign_of(states[i]);
    if (item.kind == Kind::limit) {
      must_not_be_negative(item.sign * (states[i] == TrialState::stick ? x[ti] : r[ti]));
      continue;
    }
    const double l = item.kind == Kind::pressed ? item.applied_normal_force * s.unit[ni] : x[ni];
    must_not_be_negative(l);
    if (item.kind != Kind::pressed) must_not_be_negative(r[ni]);
    if (states[i] == TrialState::stick && item.kind != Kind::normal)
      must_not_be_negative(f * l - std::abs(x[ti]));
    if (sign != 0 && item.kind != Kind::sliding) must_not_be_negative(sign * r[ti]);
  }
  const double size = s.b.cwiseAbs().maxCoeff() + x.cwiseAbs().maxCoeff();
  result.miss = miss > 0.0 ? miss / size : 0.0;
  if (!std::isfinite(result.miss)) result.miss = std::numeric_limits<double>::infinity();
  return result;
}

CoulombSolution finished(const CoulombProblem& p, const Scaled& s, const VectorXd& force,
                         std::vector<bool> kinetic) {
  CoulombSolution solution;
  solution.force = s.unit.cwiseInverse().cwiseProduct(force);
  solution.response = p.b + p.W * solution.force;
  solution.kinetic = std::move(kinetic);
  return solution;
}

/// True if the scaled forces x satisfy all conditions. Lemke's method may return forces that violate a condition if there are
/// ties in its ratio test.
bool fulfils(const CoulombProblem& p, const Scaled& s, const VectorXd& x, const std::vector<bool>& kinetic) {
  const VectorXd r = s.b + s.W * x;
  const double zero = misses * (s.b.cwiseAbs().maxCoeff() + x.cwiseAbs().maxCoeff());
  const auto complementary = [&](double a, double b) { return std::abs(std::min(a, b)) <= zero; };
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const double xt = x[p.tangent(i)], rt = r[p.tangent(i)];
    if (item.kind == Kind::limit) {
      if (!complementary(item.sign * xt, item.sign * rt)) return false;
      continue;
    }
    if (item.kind != Kind::pressed && !complementary(x[p.normal(i)], r[p.normal(i)])) return false;
    if (item.kind == Kind::normal) continue;
    const double l =
        item.kind == Kind::pressed ? item.applied_normal_force * s.unit[p.normal(i)] : x[p.normal(i)];
    const double most = item.friction(kinetic[i] || item.kind == Kind::sliding) * s.ratio[i] * l;
    const int sign = item.kind == Kind::sliding ? item.sign : rt > zero ? 1 : rt < -zero ? -1 : 0;
    const bool good = sign == 0 ? std::abs(xt) <= most + zero : std::abs(xt + sign * most) <= zero;
    if (!good) return false;
  }
  return true;
}

/// Condition number of the equations: the factor by which the solution amplifies a relative residual.
double amplification(const MatrixXd& equations) {
  const VectorXd values = base::singular_values(equations);
  return values.size() > 0 ? values[0] / values[values.size() - 1] : 1.0;
}

/// Marks as `kinetic` items that slip in the solution x, which was computed with their static coefficient. True: at least one
/// item was marked.
bool mark_slipping(const CoulombProblem& p, const Scaled& s, const VectorXd& x, std::vector<bool>& kinetic) {
  const VectorXd r = s.b + s.W * x;
  const double zero = misses * (s.b.cwiseAbs().maxCoeff() + x.cwiseAbs().maxCoeff());
  bool changed = false;
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    if (kinetic[i] || item.static_friction == item.kinetic_friction) continue;
    if (item.kind != Kind::frictional && item.kind != Kind::pressed) continue;
    const double l = item.kind == Kind::pressed ? item.applied_normal_force : x[p.normal(i)];
    if (l > zero && std::abs(r[p.tangent(i)]) > zero) kinetic[i] = changed = true;
  }
  return changed;
}

}  // namespace

EnumerationResult all_solutions(const CoulombProblem& p) {
  EnumerationResult all;
  std::vector<CoulombSolution>& found = all.solutions;
  if (p.items.size() > max_enumerated) return all;
  const Scaled s = scaled(p);
  const VectorXd inverse = s.unit.cwiseInverse();
  std::vector<std::vector<TrialState>> options;
  std::size_t combinations = 1;
  for (const CoulombItem& item : p.items) {
    options.push_back(choices(item));
    combinations *= options.back().size();
  }
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> conditions;  // condition number of the equations of each solution in `found`
  std::vector<TrialState> states(p.items.size());
  for (std::size_t code = 0; code < combinations; ++code) {
    std::size_t rest = code;
    // A slipping item has the kinetic coefficient, any other item the static coefficient.
    std::vector<bool> kinetic(p.items.size(), false);
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = options[i][rest % options[i].size()];
      rest /= options[i].size();
      kinetic[i] = sign_of(states[i]) != 0;
    }
    const Attempt tried = attempt(p, s, states, kinetic);
    least = std::min(least, tried.miss);
    if (tried.miss > misses) continue;
    CoulombSolution solution = finished(p, s, tried.force, kinetic);
    // Close to Painleve's paradox, two combinations of states may give one motion at a friction limit. Their solutions then
    // differ only by rounding.
    const double condition = amplification(equations_of(p, s, states, kinetic).A);
    bool known = false;
    for (std::size_t k = 0; k < found.size() && !known; ++k) {
      const VectorXd& other = found[k].response;
      const double size = s.b.cwiseAbs().maxCoeff() + inverse.cwiseProduct(other).cwiseAbs().maxCoeff();
      const double amplified = misses * std::max(condition, conditions[k]);
      const double same = std::max(same_solution, std::min(amplified, max_same_solution));
      known = inverse.cwiseProduct(solution.response - other).cwiseAbs().maxCoeff() <= same * size;
    }
    if (known) continue;
    found.push_back(std::move(solution));
    conditions.push_back(condition);
  }
  all.min_violation = found.empty() ? least / rounding::eps : 0.0;
  return all;
}

std::optional<CoulombSolution> solve(const CoulombProblem& p) {
  const Scaled s = scaled(p);
  std::vector<bool> kinetic(p.items.size(), false);
  for (int way = 0; way < max_covering_vectors;) {  // ends, because each round marks an item or changes `way`
    const auto x = solve_by_lemke(p, s, kinetic, way);
    if (!x || !fulfils(p, s, *x, kinetic)) {
      // With few contacts all combinations of states are tried instead, which shows whether a solution exists.
      way = p.items.size() > max_enumerated ? way + 1 : max_covering_vectors;
      continue;
    }
    if (!mark_slipping(p, s, *x, kinetic)) return finished(p, s, *x, kinetic);
  }
  EnumerationResult all = all_solutions(p);
  if (all.solutions.empty()) return std::nullopt;
  return std::move(all.solutions.front());
}

double condition_number(const CoulombProblem& p) { return amplification(scaled(p).W); }

bool may_be_nonunique(const CoulombProblem& p) {
  const Scaled s = scaled(p);
  const auto m = static_cast<Index>(p.items.size());
  MatrixXd nt(m, m);  // normal responses to friction forces at their limit
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      const auto at = static_cast<std::size_t>(j);
      nt(i, j) = s.W(normal_place(p.layout, i), tangent_place(p.layout, j)) * p.items[at].static_friction *
                 s.ratio[at];
    }
  const MatrixXd symmetric = 0.5 * (s.W + s.W.transpose());
  const double least = base::symmetric_eigenvalues(symmetric)[0];
  return !(least > 2.0 * nt.norm());
}

namespace {

using Kind = CoulombItem::Kind;

// Ratio of the noise of a result to the noise of the right-hand side, because solving adds noise of the same magnitude.
constexpr double noise_of_solution = 2.0;

/// rows: places of forces whose response is zero. columns: the responses to a unit of each of these forces. The tangential
/// force k of a slipping contact is proportional to l and is included in the column of l.
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
    const Eigen::Index n = p.normal(i), t = p.tangent(i);
    const double l = s.force[n], k = s.force[t];
    const double f = item.friction(s.kinetic[i]);
    const bool presses = item.kind != Kind::pressed && item.kind != Kind::limit && l > 0.0;
    const bool sticks = item.kind == Kind::limit     ? k != 0.0
                        : item.kind == Kind::pressed ? std::abs(k) < f * item.applied_normal_force
                                                     : item.kind == Kind::frictional && std::abs(k) < f * l;
    if (presses) result.add(n, p.W.col(n) + (sticks ? 0.0 : k / l) * p.W.col(t));
    if (sticks) result.add(t, p.W.col(t));
  }
  return result;
}

}  // namespace

CoulombSignificance::CoulombSignificance(const CoulombProblem& p, const CoulombSolution& s,
                                         const Eigen::VectorXd& noise)
    : problem_(p), solution_(s), force_noise_(Eigen::VectorXd::Zero(noise.size())), response_noise_(noise) {
  double greatest = 0.0;
  for (Eigen::Index i = 0; i < noise.size(); ++i)
    if (p.W(i, i) > 0.0) greatest = std::max(greatest, std::abs(p.b[i]) / std::sqrt(p.W(i, i)));
  const double smallest = rounding::many_operations * greatest;
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    if (!(p.W(i, i) > 0.0)) continue;
    const double unit = std::sqrt(p.W(i, i));
    response_noise_[i] += smallest * unit;
    force_noise_[i] = noise[i] / p.W(i, i) + smallest / unit;
  }
  const Acting act = acting(p, s);
  if (act.rows.empty()) return;
  const Eigen::MatrixXd inverse = base::pseudo_inverse(act.columns(act.rows, Eigen::all));
  const Eigen::VectorXd forces = inverse.cwiseAbs() * noise(act.rows);
  for (std::size_t i = 0; i < act.rows.size(); ++i)
    force_noise_[act.rows[i]] = std::max(force_noise_[act.rows[i]], forces[static_cast<Eigen::Index>(i)]);
  response_noise_ += act.columns.cwiseAbs() * forces;
}

double CoulombSignificance::applied_normal_force(std::size_t i) const {
  return item(i).kind == Kind::pressed ? item(i).applied_normal_force : force(normal(i));
}

double CoulombSignificance::friction(std::size_t i) const { return item(i).friction(solution_.kinetic[i]); }

double CoulombSignificance::force_tolerance(Eigen::Index row) const {
  return noise_of_solution * force_noise_[row];
}

bool CoulombSignificance::is_zero_response(Eigen::Index row) const {
  return std::abs(response(row)) <= noise_of_solution * response_noise_[row];
}

bool CoulombSignificance::is_inside_cone(std::size_t i) const {
  const Eigen::Index n = normal(i), t = tangent(i);
  const double f = friction(i);
  return f * applied_normal_force(i) - std::abs(force(t)) > force_tolerance(t) + f * force_tolerance(n);
}

}  // namespace signorini::decide
