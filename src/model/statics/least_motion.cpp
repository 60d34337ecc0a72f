#include "model/statics/least_motion.hpp"

#include <algorithm>

#include "base/complementarity.hpp"
#include "base/eigen_dense.hpp"

namespace signorini {

Eigen::VectorXd least_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g, const std::vector<Way>& ways,
                             const Eigen::VectorXd& about) {
  const Eigen::MatrixXd q = orthonormal(b);
  const Eigen::VectorXd a = b * about, rest = g - a;
  const Eigen::VectorXd free = a + rest - q * (q.transpose() * rest);
  std::vector<Eigen::Index> bound;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (ways[i] != Way::both) bound.push_back(static_cast<Eigen::Index>(i));
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
  const auto z = solve_complementarity(open * open.transpose(), start / size);
  if (!z) return g;
  return free + size * (q * (open.transpose() * *z));
}

bool is_one_of_many(const Eigen::MatrixXd& b, const Eigen::VectorXd& r, const std::vector<Way>& ways) {
  constexpr double moves = 1e-6;  // relative to the trial displacement: far above rounding; the trial motion
                                  // is nowhere nearly orthogonal to an admissible cone
                                  // of ways so nearly square
  Eigen::VectorXd draft(b.cols());
  for (Eigen::Index j = 0; j < draft.size(); ++j)
    draft[j] = (1.0 + 0.37 * static_cast<double>(j)) / b.col(j).norm();  // a generic direction
  const double size = (b * draft).norm() + r.norm();
  draft *= size / (b * draft).norm();
  const Eigen::VectorXd own = least_squares(b, r);
  for (const double way : {1.0, -1.0})
    if ((least_motion(b, r, ways, own + way * draft) - r).norm() > moves * size) return true;
  return false;
}

}  // namespace signorini
