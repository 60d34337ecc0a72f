// Roots so close to each other that the search cannot separate them: all their vectors from one small matrix.
//
//   S(l + e) = S + e S', on null vectors R, L of S:   (L^T S R + e L^T S' R) w = 0
//
// The group whose poles are left to S is that of all close roots, so that G0 is not singular.
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

/// Relative to the offset, ten times the error of the search. S is linear over it up to its square.
constexpr double together = 1e-8;

}  // namespace

std::vector<std::vector<std::size_t>> Spectrum::find_together(const Roots<double>& roots) const {
  const auto apart = [&](std::size_t a, std::size_t b) {
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
                      std::abs(apart(k, list.back())) <=
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

/// The poles of a list of roots: their own, and neighbours until there are enough.
std::pair<std::size_t, std::size_t> Spectrum::poles_of(const std::vector<std::size_t>& members,
                                                       const Roots<double>& roots) const {
  std::size_t first = n_, last = 0;
  for (const std::size_t k : members) {
    first = std::min(first, group_begin_[roots.home[k]]);
    last = std::max(last, group_end_[roots.home[k]]);
  }
  const std::size_t home = roots.home[members.front()];
  while (last - first < members.size()) {  // extends towards the nearer one
    const bool down =
        last == n_ || (first > 0 && poles_.between(home, first - 1) < poles_.between(last, home));
    (down ? first : last) = down ? group_begin_[first - 1] : group_end_[last];
  }
  return {first, last};
}

namespace {

using Extended = long double;

struct NullVectors {
  std::vector<SmallVector<Extended>> right, left;
};

NullVectors null_vectors_of(const SmallMatrix<Extended>& s, std::size_t count, std::size_t m) {
  NullVectors all{std::vector<SmallVector<Extended>>(m), std::vector<SmallVector<Extended>>(m)};
  const SmallLu<Extended> group(s, count);
  for (std::size_t i = 0; i < m; ++i) group.null_vectors(all.right[i], all.left[i], m, i);
  return all;
}

/// L^T S R
SmallMatrix<Extended> between(const NullVectors& null, const SmallMatrix<Extended>& s, std::size_t count) {
  SmallMatrix<Extended> result{};
  for (std::size_t i = 0; i < null.left.size(); ++i)
    for (std::size_t j = 0; j < null.right.size(); ++j)
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b) result[i][j] += null.left[i][a] * s[a][b] * null.right[j][b];
  return result;
}

struct Turned {
  Extended middle = 0;                      // mean of all e
  Eigen::VectorXd values;                   // relative to the mean
  Eigen::MatrixXd right;                    // w, one in each column
  std::vector<SmallVector<Extended>> left;  // scaled so that L^T S' R becomes 1
};

/// Eigenproblem of here + e by_e; nullopt if by_e is singular or values are complex.
std::optional<Turned> turned(const SmallMatrix<Extended>& here, const SmallMatrix<Extended>& by_e,
                             std::size_t m, double rounding) {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  const SmallLu<Extended> lu(by_e, m);
  if (lu.singular()) return std::nullopt;
  Eigen::MatrixXd apart(at(m), at(m));
  for (std::size_t j = 0; j < m; ++j) {
    SmallVector<Extended> column{};
    for (std::size_t i = 0; i < m; ++i) column[i] = -here[i][j];
    column = lu.solve(column);
    for (std::size_t i = 0; i < m; ++i) apart(at(i), at(j)) = static_cast<double>(column[i]);
  }
  const double middle = apart.trace() / static_cast<double>(m);
  apart.diagonal().array() -= middle;
  EigenPairs pairs{Eigen::VectorXd::Zero(at(m)), Eigen::MatrixXd::Identity(at(m), at(m))};
  if (!(apart.cwiseAbs().maxCoeff() <= rounding)) {
    std::optional<EigenPairs> found = real_eigen(apart);
    if (!found) return std::nullopt;
    pairs = std::move(*found);
  }
  SmallMatrix<Extended> product{};
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t j = 0; j < m; ++j) product[i][k] += by_e[i][j] * pairs.vectors(at(j), at(k));
  const SmallLu<Extended> back(product, m);
  if (back.singular()) return std::nullopt;
  Turned result{middle, pairs.values, pairs.vectors, {}};
  for (std::size_t k = 0; k < m; ++k) {
    SmallVector<Extended> unit{};
    unit[k] = 1;
    result.left.push_back(back.solve_transposed(unit));
  }
  return result;
}

}  // namespace

/// False: the small matrices cannot hold so many poles, or are singular in another way.
bool Spectrum::part_together(const std::vector<std::size_t>& members, Roots<double>& roots) {
  const std::size_t m = members.size(), home = roots.home[members.front()];
  Wide own = 0;
  for (const std::size_t k : members)
    own += (Wide(roots.offset[k]) + poles_.between(roots.home[k], home)) / static_cast<Wide>(m);
  const auto [first, last] = poles_of(members, roots);
  Local<Wide> local;
  local.first = first;
  local.count = last - first;
  if (local.count > most_rank) return false;
  (void)gather(home, own, local);
  const SmallLu<Wide> lu(local.g, rank_);
  if (lu.singular()) return false;
  group_matrix(lu, own, home, local);
  const NullVectors null = null_vectors_of(local.s, local.count, m);
  // Poles are known to their rounding: roots closer than that are one root.
  const double rounding = rounding::eps * static_cast<double>(std::abs(own + Wide(poles_.base[home])));
  const std::optional<Turned> turn = turned(between(null, local.s, local.count),
                                            between(null, group_slope(lu, local), local.count), m, rounding);
  if (!turn) return false;
  for (std::size_t k = 0; k < m; ++k) {
    SmallVector<Wide> x{}, y{}, c{}, d{};
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t a = 0; a < local.count; ++a) {
        x[a] += turn->right(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * null.right[i][a];
        y[a] += turn->left[k][i] * null.left[i][a];
      }
    outside_group(lu, local, x, y, c, d);
    const Wide mine = own + turn->middle + turn->values[static_cast<Eigen::Index>(k)];
    roots.home[members[k]] = home;
    roots.offset[members[k]] = static_cast<double>(mine);
    keep_vectors(roots, members[k], mine, c, d);
  }
  return true;
}

}  // namespace signorini
