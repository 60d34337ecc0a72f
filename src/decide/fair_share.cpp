#include "decide/fair_share.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "decide/places.hpp"
#include "linear/shared_rows.hpp"

namespace signorini {
namespace {

/// Compression of a contact that may stick; 0 of others.
double pressing_of(const CoulombItem& item, double force) {
  return item.kind == CoulombItem::Kind::frictional ? force
         : item.kind == CoulombItem::Kind::pressed  ? item.pressing
                                                    : 0.0;
}

/// Rows of friction that hold: their contacts press, and do not move.
std::vector<Eigen::Index> held_rows(const CoulombProblem& p, const CoulombSolution& s) {
  std::vector<Eigen::Index> rows;
  const Eigen::VectorXd size = p.W.cwiseAbs() * s.force.cwiseAbs() + p.b.cwiseAbs();
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const Eigen::Index n = normal_place(i), t = tangent_place(i);
    if (!(pressing_of(p.items[i], s.force[n]) > 0.0)) continue;
    if (std::abs(s.response[t]) <= rounding::of_elimination * size[t]) rows.push_back(t);
  }
  return rows;
}

/// The least k = k0 + Z y with k_i = at_i where that is given. Nothing: there is none.
std::optional<Eigen::VectorXd> least(const Eigen::VectorXd& k0, const Eigen::MatrixXd& z,
                                     const std::vector<Eigen::Index>& given, const Eigen::VectorXd& at) {
  Eigen::VectorXd y = -(z.transpose() * k0);
  if (!given.empty()) {
    const Eigen::MatrixXd rows = z(given, Eigen::all);
    const Eigen::VectorXd miss = at(given) - k0(given) - rows * y;
    y += pseudo_inverse(rows) * miss;
    if ((rows * y - (at(given) - k0(given))).norm() >
        rounding::of_elimination * (at(given).norm() + k0.norm()))
      return std::nullopt;
  }
  return Eigen::VectorXd(k0 + z * y);
}

}  // namespace

void share_fairly(const CoulombProblem& problem, CoulombSolution& solution) {
  const std::vector<Eigen::Index> rows = held_rows(problem, solution);
  if (rows.size() < 2) return;
  const Eigen::MatrixXd z = null_of_columns(problem.W(Eigen::all, rows));
  if (z.cols() == 0) return;
  const Eigen::VectorXd k0 = solution.force(rows);
  Eigen::VectorXd limit(k0.size()), at = Eigen::VectorXd::Zero(k0.size());
  for (Eigen::Index i = 0; i < k0.size(); ++i) {
    const Eigen::Index t = rows[static_cast<std::size_t>(i)];
    const CoulombItem& item = problem.items[contact_of_place(t)];
    limit[i] = item.static_friction * pressing_of(item, solution.force[normal_place(contact_of_place(t))]);
  }
  std::vector<Eigen::Index> given;
  for (Eigen::Index round = 0; round <= k0.size(); ++round) {  // each holds one more at its limit
    const auto k = least(k0, z, given, at);
    if (!k) return;
    Eigen::Index worst = -1;
    double excess = 0.0;
    for (Eigen::Index i = 0; i < k->size(); ++i) {
      const bool held = std::find(given.begin(), given.end(), i) != given.end();
      if (const double over = std::abs((*k)[i]) - limit[i]; !held && over > excess) {
        worst = i;
        excess = over;
      }
    }
    if (worst < 0) {
      for (Eigen::Index i = 0; i < k->size(); ++i) {
        const Eigen::Index t = rows[static_cast<std::size_t>(i)];
        solution.force[t] = (*k)[i];
        solution.kinetic[contact_of_place(t)] = false;
      }
      return;
    }
    given.push_back(worst);
    at[worst] = std::copysign(limit[worst], (*k)[worst]);
  }
}

}  // namespace signorini
