#include "differential/continuations.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace signorini::differential {
namespace {

// Of the problem's size. 64 bits and a condition of 1e8 leave 1e-11; a miss of 1e-10 is none, one up to 1e-8
// may be one of the data.
constexpr long double none = 1e-10L, near = 1e-8L;

enum class What { open, stick, plus, minus };

std::vector<What> possible(double friction, int sliding) {
  if (friction == 0.0) return {What::open, What::plus};  // plus: closed, without a force along the tangent
  if (sliding != 0) return {What::open, sliding > 0 ? What::plus : What::minus};
  return {What::open, What::stick, What::plus, What::minus};
}

/// In units that make the diagonal of W one.
struct InUnits {
  Extended unit;
  Question question;
};

InUnits in_units(const Question& q) {
  InUnits result{q.W.diagonal().cwiseMax(0.0L).cwiseSqrt(), q};
  for (long double& u : result.unit)
    if (!(u > 0.0L)) u = 1.0L;
  const Extended inverse = result.unit.cwiseInverse();
  result.question.W = inverse.asDiagonal() * q.W * inverse.asDiagonal();
  result.question.b = inverse.cwiseProduct(q.b);
  result.question.size = inverse.cwiseProduct(q.size);
  return result;
}

struct Try {
  Extended response, force;
  long double miss = 0.0L;
};

/// Nothing: the rows of what is closed and stuck are dependent.
std::optional<Try> attempt(const InUnits& in, const std::vector<What>& what) {
  const Question& q = in.question;
  const auto m = static_cast<Eigen::Index>(what.size());
  // Forces = F x, one unknown a row that is zero.
  ExtendedMatrix F = ExtendedMatrix::Zero(2 * m, 2 * m);
  std::vector<Eigen::Index> zero;
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (what[at] == What::open) continue;
    const long double mu = q.friction[at] * in.unit[2 * i + 1] / in.unit[2 * i];
    const auto column = static_cast<Eigen::Index>(zero.size());
    F(2 * i, column) = 1.0L;
    zero.push_back(2 * i);
    if (what[at] == What::stick) {
      F(2 * i + 1, column + 1) = 1.0L;
      zero.push_back(2 * i + 1);
    } else {
      F(2 * i + 1, column) = what[at] == What::plus ? -mu : mu;
    }
  }
  const auto size = static_cast<Eigen::Index>(zero.size());
  Extended f = Extended::Zero(2 * m);
  if (size > 0) {
    const ExtendedMatrix active = F.leftCols(size);
    const ExtendedMatrix A = (q.W * active)(zero, Eigen::all);
    const Eigen::FullPivLU<ExtendedMatrix> lu(A);
    if (!lu.isInvertible()) return std::nullopt;
    f = active * lu.solve(Extended(-q.b(zero)));
  }
  Try result{q.b + q.W * f, f};
  const long double scale = q.size.maxCoeff() + f.cwiseAbs().maxCoeff();
  long double worst = 0.0L;
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const long double mu = q.friction[at] * in.unit[2 * i + 1] / in.unit[2 * i];
    const long double rt = result.response[2 * i + 1];
    if (what[at] == What::open) worst = std::min(worst, result.response[2 * i]);
    if (what[at] != What::open) worst = std::min(worst, f[2 * i]);
    if (what[at] == What::stick) worst = std::min(worst, mu * f[2 * i] - std::abs(f[2 * i + 1]));
    const bool may_turn = q.sliding[at] == 0 && q.friction[at] > 0.0;
    if (may_turn && what[at] == What::plus) worst = std::min(worst, rt);
    if (may_turn && what[at] == What::minus) worst = std::min(worst, -rt);
  }
  if (worst < 0.0L) result.miss = -worst / scale;
  return result;
}

double condition_of(const Question& scaled) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < scaled.friction.size(); ++i) {
    rows.push_back(static_cast<Eigen::Index>(2 * i));
    if (scaled.friction[i] > 0.0) rows.push_back(static_cast<Eigen::Index>(2 * i) + 1);
  }
  const ExtendedMatrix W = scaled.W(rows, rows);
  const Extended values = Eigen::JacobiSVD<ExtendedMatrix>(W).singularValues();
  const long double least = values[values.size() - 1];
  return least > 0.0L ? static_cast<double>(values[0] / least) : std::numeric_limits<double>::infinity();
}

}  // namespace

Continuations continuations(const Question& question) {
  Continuations result;
  const std::size_t m = question.friction.size();
  if (m == 0) return result;
  const InUnits in = in_units(question);
  result.condition = condition_of(in.question);
  std::vector<std::vector<What>> options;
  std::size_t combinations = 1;
  for (std::size_t i = 0; i < m; ++i) {
    options.push_back(possible(question.friction[i], question.sliding[i]));
    combinations *= options.back().size();
  }
  std::vector<Extended> doubtful;
  const auto known = [&](const Extended& r) {
    return std::any_of(result.responses.begin(), result.responses.end(), [&](const Extended& other) {
      const long double scale = in.question.size.maxCoeff() + other.cwiseAbs().maxCoeff();
      return (r - other).cwiseAbs().maxCoeff() <= near * scale;
    });
  };
  for (std::size_t code = 0; code < combinations; ++code) {
    std::vector<What> what(m);
    std::size_t rest = code;
    for (std::size_t i = 0; i < m; ++i) {
      what[i] = options[i][rest % options[i].size()];
      rest /= options[i].size();
    }
    const auto tried = attempt(in, what);
    if (!tried || !(tried->miss <= near)) continue;
    if (tried->miss > none)
      doubtful.push_back(tried->response);
    else if (!known(tried->response)) {
      result.responses.push_back(tried->response);
      result.forces.push_back(in.unit.cwiseInverse().cwiseProduct(tried->force));
    }
  }
  result.sharp = std::all_of(doubtful.begin(), doubtful.end(), known);
  for (Extended& r : result.responses) r = in.unit.cwiseProduct(r);
  return result;
}

}  // namespace signorini::differential
