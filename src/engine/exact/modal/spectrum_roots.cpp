// Computes all roots of a spectrum simultaneously, by the method of Ehrlich and Aberth, starting near the poles.

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "engine/exact/modal/complex_lanes.hpp"
#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {
namespace {

constexpr int max_sweeps = 200;
constexpr double nearly = 1e-9;     // relative step length below which rounding may limit the convergence
constexpr double straight = 1e-14;  // relative step length for which a linear update of G0 is accurate
// Imaginary part of initial values, relative to the real part. From real initial values no complex root would be found.
constexpr double lift = 1e-3;
constexpr double real_share = 1e-7;  // largest relative imaginary part of the offset of a real root
constexpr double paired = 1e-8;      // largest relative distance of a root from the conjugate of its partner

Complex complex_of(std::complex<double> a) { return {a.real(), a.imag()}; }
template <class S>
S start_of(std::complex<double> value, std::size_t index);
template <>
double start_of(std::complex<double> value, std::size_t) {
  return value.real();
}
template <>
Complex start_of(std::complex<double> value, std::size_t index) {
  Complex result = complex_of(value);
  if (std::abs(result.im) < lift * std::abs(result.re))
    result.im = (index % 2 == 0 ? lift : -lift) * std::abs(result.re);
  return result;
}

}  // namespace

/// Initial values of the offsets, accurate to first order: eigenvalues of the small matrix of each group of equal poles,
/// including the effect of all other poles.
template <class S>
void Spectrum::start(std::vector<S>& offset) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (std::size_t first = 0, last = 0; first < n_; first = last) {
    last = group_end_[first];
    SmallMatrix<double> g{};
    for (std::size_t a = 0; a < rank_; ++a) g[a][a] = 1.0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (i >= first && i < last) continue;
      const double weight = 1.0 / poles_.pole_difference(i, first);
      const double* term = terms_.data() + i * rank_ * rank_;
      for (std::size_t a = 0; a < rank_; ++a)
        for (std::size_t b = 0; b < rank_; ++b) g[a][b] += weight * term[a * rank_ + b];
    }
    const SmallLu<double> lu(g, rank_);
    const std::size_t count = last - first;
    Eigen::MatrixXd small(at(count), at(count));
    for (std::size_t j = 0; j < count; ++j) {
      SmallVector<double> column{};
      for (std::size_t a = 0; a < rank_; ++a) column[a] = v_(at(first + j), at(a));
      if (!lu.singular()) column = lu.solve(column);
      for (std::size_t i = 0; i < count; ++i) {
        double sum = i == j ? poles_.pole_difference(first + i, first) : 0.0;
        for (std::size_t a = 0; a < rank_; ++a) sum += u_(at(first + i), at(a)) * column[a];
        small(at(i), at(j)) = sum;
      }
    }
    std::vector<std::complex<double>> value(count, small(0, 0));
    if (count > 1) {
      const Eigen::VectorXcd found = base::general_eigenvalues(small);
      std::copy_n(found.data(), count, value.begin());
      std::sort(value.begin(), value.end(), [](auto a, auto b) { return a.real() < b.real(); });
    }
    const double down =
        first > 0 ? 0.5 * poles_.pole_difference(first, first - 1) : std::abs(poles_.base[last - 1]) + 1e300;
    const double up = last < n_ ? 0.5 * poles_.pole_difference(last, last - 1) : 1e300;
    for (std::size_t j = 0; j < count; ++j) {
      const double limit = value[j].real() > 0.0 ? up : down, size = std::abs(value[j]);
      const double part = (1.0 + static_cast<double>(j)) / (1.0 + static_cast<double>(count));
      if (size > limit) value[j] *= 2.0 * part * limit / size;
      const std::size_t k = first + j;
      // The offset refers to pole k, value[j] to the first pole of the group.
      offset[k] = start_of<S>(value[j] - poles_.pole_difference(k, first), k);
      if (!(size_of(offset[k]) > 0.0)) offset[k] = S(pole_separation * std::max(poles_.base[k], 1e-250));
    }
  }
}

template <class S>
void Spectrum::group_matrix(const SmallLu<S>& lu, S own, std::size_t home, Local<S>& local) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (std::size_t j = 0; j < local.count; ++j) {
    SmallVector<S> column{};
    for (std::size_t a = 0; a < rank_; ++a) column[a] = S(v_(at(local.first + j), at(a)));
    column = lu.solve(column);
    for (std::size_t i = 0; i < local.count; ++i) {
      S sum{};
      for (std::size_t a = 0; a < rank_; ++a) sum += column[a] * u_(at(local.first + i), at(a));
      if (i == j) sum += S(poles_.pole_difference(local.first + i, home)) - own;
      local.s[i][j] = sum;
    }
  }
}

template <class S>
void Spectrum::begin_local(std::size_t home, Local<S>& local) const {
  for (std::size_t a = 0; a < rank_; ++a) local.g[a][a] = S(1.0);
  if (local.count > 0) return;
  local.first = group_begin_[home];
  local.count = group_end_[home] - local.first;
}

/// Computes G0 and its derivative at l = (pole `home`) + own. Returns the sum of 1/(l - D_i) over the poles outside the group.
template <class S>
S Spectrum::gather(std::size_t home, S own, Local<S>& local) const {
  begin_local(home, local);
  const std::size_t squares = rank_ * rank_;
  S poles{};
  for (std::size_t i = 0; i < n_; ++i) {
    if (i >= local.first && i < local.first + local.count) continue;
    const S one = inverse(own - S(poles_.pole_difference(i, home)));  // 1 / (l - D_i)
    const auto rough = static_cast<Rough<S>>(one), two = rough * rough;
    const double* term = terms_.data() + i * squares;
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b) {
        const double w = *term++;
        local.g[a][b] -= one * w;
        local.slope[a][b] += two * w;
      }
    poles += one;
  }
  return poles;
}

/// Derivative of the matrix S of a group by l: S' = -1 - U G0^-1 G0' G0^-1 V^T.
template <class S>
SmallMatrix<S> Spectrum::group_slope(const SmallLu<S>& lu, const Local<S>& local) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  SmallMatrix<S> change{};
  for (std::size_t j = 0; j < local.count; ++j) {
    SmallVector<S> column{}, product{};
    for (std::size_t a = 0; a < rank_; ++a) column[a] = S(v_(at(local.first + j), at(a)));
    column = lu.solve(column);
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b) product[a] += local.slope[a][b] * column[b];
    product = lu.solve(product);
    for (std::size_t i = 0; i < local.count; ++i) {
      S value = i == j ? S(-1.0) : S(0.0);
      for (std::size_t a = 0; a < rank_; ++a) value -= product[a] * u_(at(local.first + i), at(a));
      change[i][j] = value;
    }
  }
  return change;
}

/// Vectorised specialisation of gather() for complex roots.
template <>
Complex Spectrum::gather(std::size_t home, Complex own, Local<Complex>& local) const {
  begin_local(home, local);
  const auto n = static_cast<std::ptrdiff_t>(n_);
  const std::unique_ptr<double[]> lists(new double[4 * n_]);
  double *re = lists.get(), *im = re + n, *square_re = im + n, *square_im = square_re + n;
  inverse_distances(poles_.base.data(), poles_.separation.data(), n, poles_.base[home],
                    poles_.separation[home], own, re, im);
  std::fill_n(re + local.first, local.count, 0.0);
  std::fill_n(im + local.first, local.count, 0.0);
  square_all(re, im, n, square_re, square_im);
  for (std::size_t a = 0; a < rank_; ++a)
    for (std::size_t b = 0; b < rank_; ++b) {
      const double* w = weights_.data() + (a * rank_ + b) * n_;
      local.g[a][b] -= weighted_sum(re, im, w, n);
      local.slope[a][b] += weighted_sum(square_re, square_im, w, n);
    }
  return complex_sum(re, im, n);
}

/// Derivative of log(det G0 det S) by l: tr(G0^-1 G0') + tr(S^-1 S'). nullopt if G0 or S is singular.
template <class S>
std::optional<S> Spectrum::trace(std::size_t home, S own, Local<S>& local) const {
  const SmallLu<S> lu(local.g, rank_);
  if (lu.singular()) return std::nullopt;
  group_matrix(lu, own, home, local);
  const SmallMatrix<S> change = group_slope(lu, local);
  const SmallLu<S> group(local.s, local.count);
  if (group.singular()) return std::nullopt;
  return lu.trace_of_solution(local.slope) + group.trace_of_solution(change);
}

template <class S>
typename Spectrum::Correction<S> Spectrum::correction(std::size_t k, const std::vector<S>& offset,
                                                      const std::vector<S>& shift) const {
  Local<S> local;
  const std::size_t home = home_[k];
  const S own = offset[k];
  const S poles = gather(home, own, local);
  const std::optional<S> slope = trace(home, own, local);
  if (!slope) return {S(0.0), S(0.0)};
  S sum{};
  for (std::size_t i = 0; i < n_; ++i) {
    const S f = (own - offset[i]) + poles_.pole_difference(home, home_[i]);
    const bool apart = !is_zero(f);
    if (i >= local.first && i < local.first + local.count) {
      if (i != k && apart) sum -= inverse(f);
      continue;
    }
    const S from_pole = own + poles_.pole_difference(home, i);
    if (i == k)
      sum += inverse(from_pole);
    else if (apart)  // 1/(l - D_i) - 1/(l - l_i) without cancellation
      sum += shift[i] * inverse(from_pole * f);
  }
  return {inverse(poles + *slope), inverse(sum + *slope)};
}

/// Refines the offset of a real root by one Newton step in extended precision, because double precision gives inaccurate
/// offsets of close roots. local: receives G0 at the refined root.
Spectrum::Wide Spectrum::refined_offset(std::size_t home, Wide own, Local<Wide>& local) const {
  const Wide poles = gather(home, own, local);
  const std::optional<Wide> slope = trace(home, own, local);
  if (!slope) return own;
  const Wide step = inverse(poles + *slope);
  if (!(size_of(step) <= nearly * size_of(own))) return own;
  if (size_of(step) > straight * size_of(own)) {
    local = {};
    (void)gather(home, own - step, local);
    return own - step;
  }
  for (std::size_t a = 0; a < rank_; ++a)
    for (std::size_t b = 0; b < rank_; ++b) local.g[a][b] -= step * local.slope[a][b];
  return own - step;
}

/// Makes the offset of root k refer to the pole nearest to the root.
template <class S>
void Spectrum::reassign_pole(std::size_t k, std::vector<S>& offset) {
  std::size_t best = home_[k];
  const auto distance = [&](std::size_t to) {
    return size_of(offset[k] - poles_.pole_difference(to, home_[k]));
  };
  const double step = real_part(offset[k]);
  const std::size_t now = home_[k];
  for (std::size_t i = now; step > 0.0 && i + 1 < n_ && distance(i + 1) <= distance(i); ++i) best = i + 1;
  for (std::size_t i = now; step < 0.0 && i > 0 && distance(i - 1) <= distance(i); --i) best = i - 1;
  if (!(distance(best) < distance(now))) return;
  const S moved = offset[k] - poles_.pole_difference(best, now);
  if (!(size_of(moved) > 0.0)) return;
  offset[k] = moved;
  home_[k] = best;
}

template <class S>
bool Spectrum::search(std::vector<S>& offset) {
  start(offset);
  std::vector<S> shift(n_);  // D_i - l_i of all roots
  for (std::size_t i = 0; i < n_; ++i) shift[i] = -offset[i];
  std::vector<double> last(n_, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> unsettled(n_);
  std::iota(unsettled.begin(), unsettled.end(), std::size_t(0));
  for (int sweep = 0; !unsettled.empty() && sweep < max_sweeps; ++sweep) {
    std::vector<std::size_t> left;
    for (const std::size_t k : unsettled) {
      const Correction<S> found = correction(k, offset, shift);
      // If two approximations nearly coincide, the deflated step is too short to separate them: use a part of the Newton step.
      const bool collides =
          size_of(found.newton) > 1e3 * size_of(found.deflated) || !std::isfinite(size_of(found.deflated));
      const S step =
          collides ? found.newton *
                         (0.3 + 0.1 * static_cast<double>((k + 7 * static_cast<std::size_t>(sweep)) % 5))
                   : found.deflated;
      const double size = size_of(step);
      if (!std::isfinite(size)) {
        failure_ = "the search for eigenvalues overflows";
        return false;
      }
      S next = offset[k] - step;
      if (!(size_of(next) > 0.0)) next = offset[k] * 0.5;
      offset[k] = next;
      const double relative = size / size_of(next);
      const std::size_t before = home_[k];
      reassign_pole(k, offset);
      shift[k] = S(poles_.pole_difference(k, home_[k])) - offset[k];
      const bool settled = !collides && (relative <= rounding::few_operations ||
                                         (relative < nearly && relative > 0.25 * last[k]));
      if (!settled || home_[k] != before) left.push_back(k);
      last[k] = relative;
    }
    unsettled = std::move(left);
  }
  if (unsettled.empty()) return true;
  failure_ = "the search for eigenvalues does not converge";
  return false;
}

bool Spectrum::split_real_and_pairs(const std::vector<Complex>& offset) {
  struct Found {
    std::size_t home;
    Complex offset;
    double size;
  };
  std::vector<Found> above, below;
  std::vector<Found> flat;
  for (std::size_t k = 0; k < n_; ++k) {
    const Complex value = offset[k] + poles_.base[home_[k]];
    const Found f{home_[k], offset[k], size_of(value)};
    if (std::abs(f.offset.im) <= real_share * size_of(f.offset))
      flat.push_back(f);
    else
      (f.offset.im > 0.0 ? above : below).push_back(f);
  }
  if (above.size() != below.size()) return false;
  const auto by_place = [](const Found& a, const Found& b) {
    return a.size < b.size || (a.size == b.size && a.offset.re < b.offset.re);
  };
  for (std::vector<Found>* list : {&above, &below, &flat}) std::sort(list->begin(), list->end(), by_place);
  for (const Found& a : above) {
    const bool has_twin = std::any_of(below.begin(), below.end(), [&](const Found& b) {
      const Complex off =
          a.offset - Complex(b.offset.re, -b.offset.im) + poles_.pole_difference(a.home, b.home);
      return size_of(off) <= paired * size_of(a.offset);
    });
    if (!has_twin) return false;
    pairs_.pole_index.push_back(a.home);
    pairs_.offset.push_back(a.offset);
  }
  for (const Found& f : flat) {
    real_.pole_index.push_back(f.home);
    real_.offset.push_back(f.offset.re);
  }
  return true;
}

template bool Spectrum::search(std::vector<double>&);
template bool Spectrum::search(std::vector<Complex>&);
template double Spectrum::gather(std::size_t, double, Local<double>&) const;
template Spectrum::Wide Spectrum::gather(std::size_t, Wide, Local<Wide>&) const;
template void Spectrum::group_matrix(const SmallLu<Wide>&, Wide, std::size_t, Local<Wide>&) const;
template SmallMatrix<Spectrum::Wide> Spectrum::group_slope(const SmallLu<Wide>&, const Local<Wide>&) const;
template void Spectrum::group_matrix(const SmallLu<Complex>&, Complex, std::size_t, Local<Complex>&) const;

// Eigenvectors of clusters of roots that are too close for search(). One small matrix S gives all eigenvectors of a cluster.
//
//   S(l + e) = S + e S';  in the space of the null vectors R (right), L (left) of S:   (L^T S R + e L^T S' R) w = 0
//
// The group of poles of S contains the poles of all roots of the cluster, so that G0 is not singular.

namespace {

/// Largest distance of neighbouring roots in a cluster, relative to their offsets: ten times the error of search(). Within this
/// distance S is linear, except for terms of the order of the square of the distance.
constexpr double together = 1e-8;

}  // namespace

std::vector<std::vector<std::size_t>> Spectrum::find_clusters(const Roots<double>& roots) const {
  const auto apart = [&](std::size_t a, std::size_t b) {
    return poles_.pole_difference(roots.pole_index[a], roots.pole_index[b]) +
           (roots.offset[a] - roots.offset[b]);
  };
  std::vector<std::size_t> order(roots.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return roots.offset[a] + poles_.base[roots.pole_index[a]] <
           roots.offset[b] + poles_.base[roots.pole_index[b]];
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

/// Range of poles for a cluster: the poles of its roots, and as many neighbouring poles as needed so that the range contains at
/// least as many poles as roots. Returns the first pole and the end of the range.
std::pair<std::size_t, std::size_t> Spectrum::cluster_poles(const std::vector<std::size_t>& members,
                                                            const Roots<double>& roots) const {
  std::size_t first = n_, last = 0;
  for (const std::size_t k : members) {
    first = std::min(first, group_begin_[roots.pole_index[k]]);
    last = std::max(last, group_end_[roots.pole_index[k]]);
  }
  const std::size_t home = roots.pole_index[members.front()];
  while (last - first < members.size()) {  // extend towards the nearer pole
    const bool down = last == n_ || (first > 0 && poles_.pole_difference(home, first - 1) <
                                                      poles_.pole_difference(last, home));
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

/// Returns L^T S R.
SmallMatrix<Extended> between(const NullVectors& null, const SmallMatrix<Extended>& s, std::size_t count) {
  SmallMatrix<Extended> result{};
  for (std::size_t i = 0; i < null.left.size(); ++i)
    for (std::size_t j = 0; j < null.right.size(); ++j)
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b) result[i][j] += null.left[i][a] * s[a][b] * null.right[j][b];
  return result;
}

struct Turned {
  Extended middle = 0;                      // mean of all values of e
  Eigen::VectorXd values;                   // values of e relative to the mean
  Eigen::MatrixXd right;                    // vectors w as columns
  std::vector<SmallVector<Extended>> left;  // scaled so that L^T S' R becomes the unit matrix
};

/// Solves the eigenproblem (here + e by_e) w = 0 of size m. nullopt if by_e is singular or an e is complex. rounding: values of
/// e whose difference is smaller are regarded as equal.
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
  base::EigenPairs pairs{Eigen::VectorXd::Zero(at(m)), Eigen::MatrixXd::Identity(at(m), at(m))};
  if (!(apart.cwiseAbs().maxCoeff() <= rounding)) {
    std::optional<base::EigenPairs> found = base::real_eigen(apart);
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

/// Separates a cluster of close roots and stores their eigenvectors. False: the cluster needs more poles than a small matrix
/// can contain, or a matrix is singular.
bool Spectrum::split_cluster(const std::vector<std::size_t>& members, Roots<double>& roots) {
  const std::size_t m = members.size(), home = roots.pole_index[members.front()];
  Wide own = 0;
  for (const std::size_t k : members)
    own += (Wide(roots.offset[k]) + poles_.pole_difference(roots.pole_index[k], home)) / static_cast<Wide>(m);
  const auto [first, last] = cluster_poles(members, roots);
  Local<Wide> local;
  local.first = first;
  local.count = last - first;
  if (local.count > max_rank) return false;
  (void)gather(home, own, local);
  const SmallLu<Wide> lu(local.g, rank_);
  if (lu.singular()) return false;
  group_matrix(lu, own, home, local);
  const NullVectors null = null_vectors_of(local.s, local.count, m);
  // Poles have rounding errors, so roots with a smaller distance than these errors are treated as equal.
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
    roots.pole_index[members[k]] = home;
    roots.offset[members[k]] = static_cast<double>(mine);
    keep_vectors(roots, members[k], mine, c, d);
  }
  return true;
}

}  // namespace signorini::modal
