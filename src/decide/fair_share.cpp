#include "decide/fair_share.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/least_norm.hpp"
#include "base/rounding.hpp"
#include "decide/places.hpp"
#include "linear/shared_rows.hpp"

namespace signorini {
namespace {

using Kind = CoulombItem::Kind;

/// Items whose forces may change, their rows in turn, and the sets in which they may.
struct Shares {
  std::vector<Eigen::Index> rows;
  std::vector<ConvexSet> sets;
  std::vector<std::size_t> resting;  ///< items that may stick: what they bear is no slip
};

Shares shares_of(const CoulombProblem& p, const std::vector<bool>& may_share, const CoulombSolution& s) {
  Shares shares;
  const Eigen::VectorXd size = p.W.cwiseAbs() * s.force.cwiseAbs() + p.b.cwiseAbs();
  const auto rests = [&](Eigen::Index row) {
    return std::abs(s.response[row]) <= rounding::of_elimination * size[row];
  };
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const Eigen::Index n = normal_place(i), t = tangent_place(i);
    if (!may_share[i] || item.kind == Kind::limit) continue;
    if (item.kind == Kind::pressed) {
      if (!rests(t) || !(item.pressing > 0.0)) continue;
      shares.rows.push_back(t);
      shares.sets.push_back({ConvexSet::Kind::disc, 1, 0.0, item.static_friction * item.pressing, {}});
      shares.resting.push_back(i);
      continue;
    }
    if (!rests(n)) continue;
    shares.rows.push_back(n);
    if (item.kind == Kind::normal) {
      shares.sets.push_back({ConvexSet::Kind::cone, 1, 0.0, 0.0, {}});
      continue;
    }
    shares.rows.push_back(t);
    if (item.kind == Kind::frictional && rests(t)) {
      shares.sets.push_back({ConvexSet::Kind::cone, 2, item.static_friction, 0.0, {}});
      shares.resting.push_back(i);
      continue;
    }
    const double sign = item.kind == Kind::sliding ? item.sign : std::copysign(1.0, s.response[t]);
    Eigen::VectorXd along(2);
    along << 1.0, -sign * item.kinetic_friction;
    shares.sets.push_back({ConvexSet::Kind::ray, 2, 0.0, 0.0, along.normalized()});
  }
  return shares;
}

}  // namespace

void share_fairly(const CoulombProblem& problem, const std::vector<bool>& may_share,
                  CoulombSolution& solution) {
  const Shares shares = shares_of(problem, may_share, solution);
  if (shares.rows.size() < 2 || shares.resting.empty()) return;
  const Eigen::MatrixXd open = null_of_columns(problem.W(Eigen::all, shares.rows));  // moves nothing
  if (open.cols() == 0) return;
  const Eigen::VectorXd given = solution.force(shares.rows);
  const Eigen::MatrixXd kept = orthogonal_complement(open).transpose();
  const auto force = least_norm(kept, kept * given, shares.sets);
  if (!force) return;  // `given` alone holds it, to rounding
  solution.force(shares.rows) = *force;
  for (const std::size_t i : shares.resting) solution.kinetic[i] = false;
}

}  // namespace signorini
