// Roots so close to each other that the search cannot part them: all their vectors from one small matrix.
//
//   S(l + e) = S + e S', on null vectors R, L of S:   (L^T S R + e L^T S' R) w = 0
//
// The group whose poles S leaves out is that of all roots that lie together, so that G0 is not singular.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "engine/exact/modal/spectrum.hpp"

namespace signorini {
namespace {

/// Relative to the offset, ten times what the search may leave undone. S is a line over it but for its square.
constexpr double together = 1e-8;

}  // namespace

std::vector<std::vector<std::size_t>> Spectrum::find_together(const Roots<double>& roots) const {
  const auto between = [&](std::size_t a, std::size_t b) {
    return poles_.between(roots.home[a], roots.home[b]) + (roots.offset[a] - roots.offset[b]);
  };
  std::vector<std::size_t> order(roots.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return roots.offset[a] + poles_.base[roots.home[a]] < roots.offset[b] + poles_.base[roots.home[b]];
  });
  std::vector<std::vector<std::size_t>> lists;
  std::vector<std::size_t> list;
  for (const std::size_t k : order) {
    const bool near = !list.empty() &&
                      std::abs(between(k, list.back())) <=
                          together * std::min(std::abs(roots.offset[k]), std::abs(roots.offset[list.back()]));
    if (!near) {
      if (list.size() > 1) lists.push_back(list);
      list.clear();
    }
    list.push_back(k);
  }
  if (list.size() > 1) lists.push_back(list);
  return lists;
}

/// False: as many poles do not fit into the small matrices, or these are singular otherwise.
bool Spectrum::part_together(const std::vector<std::size_t>& members, Roots<double>& roots) {
  const std::size_t m = members.size(), home = roots.home[members.front()];
  Wide own = 0;
  std::size_t first = n_, last = 0;
  for (const std::size_t k : members) {
    own += (Wide(roots.offset[k]) + poles_.between(roots.home[k], home)) / static_cast<Wide>(m);
    first = std::min(first, group_begin_[roots.home[k]]);
    last = std::max(last, group_end_[roots.home[k]]);
  }
  while (last - first < m) {  // by the nearer neighbour
    const bool down =
        last == n_ || (first > 0 && poles_.between(home, first - 1) < poles_.between(last, home));
    (down ? first : last) = down ? group_begin_[first - 1] : group_end_[last];
  }
  if (last - first > most_rank) return false;
  Local<Wide> local;
  local.first = first;
  local.count = last - first;
  (void)gather(home, own, local);
  const SmallLu<Wide> lu(local.g, rank_);
  if (lu.singular()) return false;
  group_matrix(lu, own, home, local);
  const SmallMatrix<Wide> slope = group_slope(lu, local);
  const SmallLu<Wide> group(local.s, local.count);
  std::vector<SmallVector<Wide>> right(m), left(m);
  for (std::size_t i = 0; i < m; ++i) group.null_vectors(right[i], left[i], m, i);
  const auto on_null_vectors = [&](const SmallMatrix<Wide>& matrix) {
    SmallMatrix<Wide> result{};
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j)
        for (std::size_t a = 0; a < local.count; ++a)
          for (std::size_t b = 0; b < local.count; ++b)
            result[i][j] += left[i][a] * matrix[a][b] * right[j][b];
    return result;
  };
  const SmallMatrix<Wide> here = on_null_vectors(local.s), by_e = on_null_vectors(slope);
  const SmallLu<Wide> lu_by_e(by_e, m);
  if (lu_by_e.singular()) return false;
  const auto size = static_cast<Eigen::Index>(m);
  Eigen::MatrixXd apart(size, size);
  for (std::size_t j = 0; j < m; ++j) {
    SmallVector<Wide> column{};
    for (std::size_t i = 0; i < m; ++i) column[i] = -here[i][j];
    column = lu_by_e.solve(column);
    for (std::size_t i = 0; i < m; ++i)
      apart(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = static_cast<double>(column[i]);
  }
  const double middle = apart.trace() / static_cast<double>(m);
  own += middle;
  apart.diagonal().array() -= middle;
  EigenPairs pairs{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Identity(size, size)};
  // Poles are known to their rounding: what is no farther apart is one root.
  const double rounding = rounding::eps * static_cast<double>(std::abs(own + Wide(poles_.base[home])));
  if (!(apart.cwiseAbs().maxCoeff() <= rounding)) {
    const std::optional<EigenPairs> found = real_eigen(apart);
    if (!found) return false;
    pairs = *found;
  }
  // Left ones so that L^T S' R is diagonal.
  SmallMatrix<Wide> turned{};
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t j = 0; j < m; ++j)
        turned[i][k] +=
            by_e[i][j] * pairs.vectors(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
  const SmallLu<Wide> back(turned, m);
  if (back.singular()) return false;
  for (std::size_t k = 0; k < m; ++k) {
    SmallVector<Wide> unit{}, x{}, y{}, c{}, d{};
    unit[k] = 1;
    const SmallVector<Wide> mix = back.solve_transposed(unit);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t a = 0; a < local.count; ++a) {
        x[a] += pairs.vectors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * right[i][a];
        y[a] += mix[i] * left[i][a];
      }
    outside_group(lu, local, x, y, c, d);
    const Wide mine = own + pairs.values[static_cast<Eigen::Index>(k)];
    roots.home[members[k]] = home;
    roots.offset[members[k]] = static_cast<double>(mine);
    keep_vectors(roots, members[k], mine, c, d);
  }
  return true;
}

}  // namespace signorini
