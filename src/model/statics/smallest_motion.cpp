#include "model/statics/smallest_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/lcp.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::statics {

Eigen::VectorXd smallest_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                const std::vector<AdmissibleDirection>& ways, const Eigen::VectorXd& about) {
  const Eigen::MatrixXd q = base::orthonormal(b);
  const Eigen::VectorXd a = b * about, rest = g - a;
  const Eigen::VectorXd free = a + rest - q * (q.transpose() * rest);
  std::vector<Eigen::Index> bound;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (ways[i] != AdmissibleDirection::both) bound.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(bound.size());
  if (n == 0) return free;
  Eigen::MatrixXd open(n, q.cols());  // S Q
  Eigen::VectorXd start(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index row = bound[static_cast<std::size_t>(i)];
    const int way = static_cast<int>(ways[static_cast<std::size_t>(row)]);
    open.row(i) = way * q.row(row);
    start[i] = way * free[row];
  }
  const double size = start.cwiseAbs().maxCoeff();
  if (size == 0.0) return free;
  const auto z = base::solve_lcp(open * open.transpose(), start / size);
  if (!z) return g;
  return free + size * (q * (open.transpose() * *z));
}

bool has_other_motions(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                       const std::vector<AdmissibleDirection>& ways) {
  // Smallest difference of two motions, relative to the trial displacement; smaller ones are rounding. Chosen
  // value.
  constexpr double moves = 1e-6;
  Eigen::VectorXd draft(b.cols());
  for (Eigen::Index j = 0; j < draft.size(); ++j)
    draft[j] = (1.0 + 0.37 * static_cast<double>(j)) / b.col(j).norm();  // not parallel to any special motion
  const double size = (b * draft).norm() + r.norm();
  draft *= size / (b * draft).norm();
  const Eigen::VectorXd own = base::least_squares(b, r);
  for (const double way : {1.0, -1.0})
    if ((smallest_motion(b, r, ways, own + way * draft) - r).norm() > moves * size) return true;
  return false;
}

namespace {

// Rates and forces below this fraction of the largest one are zero, up to the error of one solve. Chosen
// value.
constexpr double same_rate = 1e-9;

/// A row along which a contact may slip or open: its rate, and the admissible directions.
struct MechanismSlip {
  std::size_t row, contact;
  double rate;
  AdmissibleDirection way;
};

std::vector<MechanismSlip> mechanism_rows(const SlipDistribution& given, const std::vector<bool>& may) {
  std::vector<MechanismSlip> loose;
  for (std::size_t j = 0; j < given.unknowns.size(); ++j) {
    if (!may[j]) continue;
    const Unknown& unknown = given.unknowns[j];
    const auto row = static_cast<std::size_t>(unknown.row);
    const double rate = unknown.sign * given.z[static_cast<Eigen::Index>(j)] / given.rows[row].stiffness;
    if (!loose.empty() && loose.back().row == row) {  // the two directions of a slip are adjacent
      loose.back().rate += rate;
      loose.back().way = AdmissibleDirection::both;
    } else {
      loose.push_back({row, unknown.contact, rate,
                       unknown.sign > 0 ? AdmissibleDirection::positive : AdmissibleDirection::negative});
    }
  }
  return loose;
}

/// Motions that neither the structure nor the remaining rows resist.
Eigen::MatrixXd free_motions(const SlipDistribution& given, const std::vector<MechanismSlip>& loose) {
  std::vector<assembly::LineSpring> stay;
  for (std::size_t i = 0; i < given.rows.size(); ++i)
    if (std::none_of(loose.begin(), loose.end(), [&](const MechanismSlip& l) { return l.row == i; }))
      stay.push_back({given.rows[i].form, given.rows[i].stiffness});
  const SparseMatrix held = assembly::with_springs(given.stiffness, stay);
  if (loose.empty() || !may_have_null_motions(held)) return {given.stiffness.rows(), 0};
  return null_motions(held);
}

}  // namespace

SmallestSlips smallest_slips(const SlipDistribution& given, Vector& rates) {
  SmallestSlips share;
  for (const double z : given.z) share.moves.push_back(z > 0.0);
  const double zero = same_rate * std::max(given.greatest_force, given.z.cwiseAbs().maxCoeff());
  std::vector<bool> may;
  for (std::size_t j = 0; j < given.unknowns.size(); ++j)
    may.push_back(given.z[static_cast<Eigen::Index>(j)] > 0.0 || given.conditions[j] <= zero);
  const std::vector<MechanismSlip> loose = mechanism_rows(given, may);
  const Eigen::MatrixXd motions = free_motions(given, loose);
  if (motions.cols() == 0) return share;

  Eigen::MatrixXd b(static_cast<Eigen::Index>(loose.size()), motions.cols());
  Eigen::VectorXd g(b.rows());
  std::vector<AdmissibleDirection> ways;
  for (Eigen::Index i = 0; i < b.rows(); ++i) {
    const MechanismSlip& l = loose[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < b.cols(); ++j) b(i, j) = given.rows[l.row].form.dot(motions.col(j));
    g[i] = l.rate;
    ways.push_back(l.way);
  }
  Eigen::VectorXd r = smallest_motion(b, g, ways, Eigen::VectorXd::Zero(b.cols()));
  rates += motions * base::least_squares(b, Eigen::VectorXd(r - g));
  const bool moves = r.cwiseAbs().maxCoeff() > same_rate * assembly::max_translation(rates, given.map);
  if (moves && has_other_motions(b, r, ways)) {
    share.motion = motions.col(0);
    for (const MechanismSlip& l : loose)
      if (share.undetermined.empty() || share.undetermined.back() != l.contact)
        share.undetermined.push_back(l.contact);
  }
  for (double& rate : r)
    if (std::abs(rate) <= same_rate * r.cwiseAbs().maxCoeff()) rate = 0.0;
  for (std::size_t j = 0; j < given.unknowns.size(); ++j) {
    const Unknown& unknown = given.unknowns[j];
    for (std::size_t i = 0; i < loose.size() && may[j]; ++i)
      if (loose[i].row == static_cast<std::size_t>(unknown.row))
        share.moves[j] = unknown.sign * r[static_cast<Eigen::Index>(i)] > 0.0;
  }
  return share;
}

}  // namespace signorini::statics
