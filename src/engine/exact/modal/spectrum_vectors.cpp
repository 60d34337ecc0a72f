// The eigenvectors of a spectrum, and scalar products of eigenvectors.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

#include "engine/exact/modal/complex_lanes.hpp"
#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {
namespace {

// Relative distance of eigenvalues below which rounding errors mix their eigenvectors.
constexpr double close_roots = 1e-3;
constexpr std::size_t max_neighbours = 6;
// Relative distance of eigenvalues below which products computed from c and h lose more than five digits.
constexpr double alike = 1e-5;

}  // namespace

/// Entries of the eigenvector of root k for the coupled modes: side small / (D - l). Right vector: side = U, small = c; left
/// vector: side = V, small = d.
template <class S>
void Spectrum::cauchy(const Roots<S>& roots, std::size_t k, const S* small, const Eigen::MatrixXd& side,
                      std::vector<S>& out) const {
  out.resize(n_);
  const std::size_t home = roots.pole_index[k];
  if constexpr (std::is_same_v<S, double>) {
    cauchy_vector(poles_.base.data(), poles_.separation.data(), static_cast<std::ptrdiff_t>(n_),
                  poles_.base[home], poles_.separation[home], roots.offset[k], small, side.data(),
                  static_cast<std::ptrdiff_t>(rank_), out.data());
  } else {
    for (std::size_t i = 0; i < n_; ++i) {
      S sum{};
      for (std::size_t a = 0; a < rank_; ++a)
        sum += small[a] * side(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      out[i] = sum * inverse(S(poles_.pole_difference(i, home)) - roots.offset[k]);
    }
  }
}

/// Computes c = -G0^-1 V^T right and d = -G0^-T U^T left from the null vectors of the group's matrix S.
template <class S>
void Spectrum::outside_group(const SmallLu<S>& lu, const Local<S>& local, const SmallVector<S>& right,
                             const SmallVector<S>& left, SmallVector<S>& c, SmallVector<S>& d) const {
  c = {};
  d = {};
  for (std::size_t j = 0; j < local.count; ++j)
    for (std::size_t a = 0; a < rank_; ++a) {
      const auto row = static_cast<Eigen::Index>(local.first + j), column = static_cast<Eigen::Index>(a);
      c[a] -= right[j] * v_(row, column);
      d[a] -= left[j] * u_(row, column);
    }
  c = lu.solve(c);
  d = lu.solve_transposed(d);
}

/// Computes c and d of all roots from null vectors of small matrices. For real roots in extended precision, because double
/// precision would lose up to five digits of close roots.
template <class S>
void Spectrum::find_vectors(Roots<S>& roots) {
  constexpr bool is_real = std::is_same_v<S, double>;
  using W = std::conditional_t<is_real, Wide, S>;
  roots.value.resize(roots.size());
  roots.right.resize(roots.size() * rank_);
  roots.left.resize(roots.size() * rank_);
  std::vector<char> known(roots.size(), 0);
  if constexpr (is_real)
    for (const std::vector<std::size_t>& members : find_clusters(roots))
      if (split_cluster(members, roots))
        for (const std::size_t k : members) known[k] = 1;
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const std::size_t home = roots.pole_index[k];
    if (known[k] == 0) {
      W own = roots.offset[k];
      Local<W> local;
      if constexpr (is_real)
        own = refined_offset(home, own, local);
      else
        (void)gather(home, own, local);
      const SmallLu<W> lu(local.g, rank_);
      group_matrix(lu, own, home, local);
      SmallVector<W> right{}, left{}, c{}, d{};
      SmallLu<W>(local.s, local.count).null_vectors(right, left);
      outside_group(lu, local, right, left, c, d);
      keep_vectors(roots, k, own, c, d);
    }
    roots.value[k] = roots.offset[k] + (poles_.base[home] + poles_.separation[home]);
  }
}

/// Stores the offset, c and d of root k, rounded to doubles. Then scales c and d so that the vectors x and y computed from the
/// rounded values satisfy |x| = 1 and y^T x = 1.
template <class S, class W>
void Spectrum::keep_vectors(Roots<S>& roots, std::size_t k, W own, const SmallVector<W>& c_wide,
                            const SmallVector<W>& d_wide) {
  const auto square_of = [](S a) {
    const double size = size_of(a);
    return size * size;
  };
  roots.offset[k] = static_cast<S>(own);
  SmallVector<S> c{}, d{};
  for (std::size_t a = 0; a < rank_; ++a) {
    c[a] = static_cast<S>(c_wide[a]);
    d[a] = static_cast<S>(d_wide[a]);
  }
  std::vector<S> x, y;
  cauchy(roots, k, c.data(), u_, x);
  cauchy(roots, k, d.data(), v_, y);
  double x_square = 0.0, y_square = 0.0;
  S product{};
  for (std::size_t i = 0; i < n_; ++i) {
    x_square += square_of(x[i]);
    y_square += square_of(y[i]);
    product += x[i] * y[i];
  }
  const double x_size = std::sqrt(x_square), y_size = std::sqrt(y_square);
  condition_ = std::max(condition_, x_size * y_size / size_of(product));
  const S to_right = S(1.0 / x_size), to_left = inverse(product) * x_size;
  for (std::size_t a = 0; a < rank_; ++a) {
    roots.right[k * rank_ + a] = c[a] * to_right;
    roots.left[k * rank_ + a] = d[a] * to_left;
  }
}

Eigen::VectorXd Spectrum::coupled_vector(const std::vector<double>& small, const Eigen::MatrixXd& side,
                                         std::size_t k) const {
  std::vector<double> x;
  cauchy(real_, k, small.data() + k * rank_, side, x);
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(n_));
}

/// Computes the matrix E of the correction Y := (1 - E) Y, which makes y_k^T x_l = 0 for close eigenvalues k and l. E contains
/// the uncorrected products y_k^T x_l.
void Spectrum::split_close_roots() {
  std::vector<std::size_t> order;
  for (const std::size_t k : order_)
    if (k < real_.size()) order.push_back(k);
  for (std::size_t p = 0; p < order.size(); ++p) {
    const std::size_t k = order[p];
    for (std::size_t m = p + 1; m < std::min(order.size(), p + max_neighbours); ++m) {
      const std::size_t l = order[m];
      if (real_.value[l] - real_.value[k] > close_roots * real_.value[l]) break;
      close_.push_back({k, l, coupled_vector(real_.left, v_, k).dot(coupled_vector(real_.right, u_, l))});
      close_.push_back({l, k, coupled_vector(real_.left, v_, l).dot(coupled_vector(real_.right, u_, k))});
    }
  }
}

/// Computes x^T x of all modes. Also corrects condition_ for the entries of x for uncoupled modes.
void Spectrum::find_squares() {
  double worst = 1.0;
  const auto square = [&](const auto& roots, std::size_t k) {
    using S = typename std::decay_t<decltype(roots.offset)>::value_type;
    S sum{};
    double beside = 1.0;  // |x| including the entries of uncoupled modes
    std::vector<S> x;
    cauchy(roots, k, roots.right.data() + k * rank_, u_, x);
    for (const S& entry : x) sum += entry * entry;
    for (std::size_t j = 0; j < uncoupled_.size(); ++j) {
      const S entry = uncoupled_coordinate(roots, k, j, uncoupled_poles_[j]);
      sum += entry * entry;
      beside = std::hypot(beside, size_of(entry));
    }
    // condition_ was computed as if |x| = 1, but only the coupled entries have this norm; `beside` is the norm of all entries.
    worst = std::max(worst, std::isfinite(beside) ? beside : std::numeric_limits<double>::infinity());
    return sum;
  };
  for (const std::size_t k : order_) {
    const bool seen = k < real_.size();
    squares_.push_back(seen ? square(real_, k) : 1.0);
    value_base_.push_back(seen ? poles_.base[real_.pole_index[k]] : uncoupled_poles_[k - real_.size()]);
    value_offset_.push_back(seen ? real_.offset[k] + poles_.separation[real_.pole_index[k]] : 0.0);
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) pair_squares_.push_back(square(pairs_, k));
  condition_ *= worst;
}

/// Computes x_k^T x_l directly from the vectors, for pairs of modes whose l_k - l_l is so small that products() is inaccurate.
void Spectrum::compute_close_products() {
  for (std::size_t l = 0; l < order_.size(); ++l)
    for (std::size_t k = l + 1; k < order_.size() && std::abs(difference(k, l)) <= alike * values_[k]; ++k) {
      const std::size_t own = order_[k], other = order_[l];
      if (own >= real_.size() || other >= real_.size()) continue;
      double product = coupled_vector(real_.right, u_, own).dot(coupled_vector(real_.right, u_, other));
      for (std::size_t j = 0; j < uncoupled_.size(); ++j)
        product += uncoupled_coordinate(real_, own, j, uncoupled_poles_[j]) *
                   uncoupled_coordinate(real_, other, j, uncoupled_poles_[j]);
      close_products_.push_back({k, l, product});
    }
}

double Spectrum::product(std::size_t k, std::size_t l) const {
  const double apart = difference(k, l);
  if (std::abs(apart) <= alike * std::abs(values_[k]))
    for (const Close& pair : close_products_)
      if (pair.k == std::max(k, l) && pair.l == std::min(k, l)) return pair.product;
  const std::vector<double>&c = products_.c, &h = products_.h;
  double sum = 0.0;
  for (std::size_t a = 0; a < rank_; ++a)
    sum += h[k * rank_ + a] * c[l * rank_ + a] - c[k * rank_ + a] * h[l * rank_ + a];
  return sum == 0.0 ? 0.0 : sum / apart;
}

void Spectrum::find_products() {
  auto& [c, h, c_pair, h_pair] = products_;
  const auto fill = [&](const auto& roots, auto& left, auto& right) {
    using S = typename std::decay_t<decltype(left)>::value_type;
    left = roots.right;
    right.assign(roots.size() * rank_, S(0.0));
    std::vector<S> x;
    for (std::size_t k = 0; k < roots.size(); ++k) {
      cauchy(roots, k, roots.right.data() + k * rank_, u_, x);
      for (std::size_t a = 0; a < rank_; ++a) {
        const double* column = u_.data() + a * n_;
        S sum{};
        for (std::size_t i = 0; i < n_; ++i) sum += x[i] * column[i];
        for (std::size_t j = 0; j < uncoupled_.size(); ++j)
          sum += uncoupled_coordinate(roots, k, j, uncoupled_poles_[j]) *
                 u_uncoupled_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a));
        right[k * rank_ + a] = sum;
      }
    }
  };
  fill(pairs_, c_pair, h_pair);
  std::vector<double> c_seen, h_seen;
  fill(real_, c_seen, h_seen);
  // The shape of an uncoupled mode is a unit vector, so the product with another shape has only one term: c = 0, and h is the
  // row of U of the uncoupled mode.
  c.assign(order_.size() * rank_, 0.0);
  h = c;
  for (std::size_t p = 0; p < order_.size(); ++p)
    if (order_[p] < real_.size())
      for (std::size_t a = 0; a < rank_; ++a) {
        c[p * rank_ + a] = c_seen[order_[p] * rank_ + a];
        h[p * rank_ + a] = h_seen[order_[p] * rank_ + a];
      }
    else
      for (std::size_t a = 0; a < rank_; ++a)
        h[p * rank_ + a] =
            u_uncoupled_(static_cast<Eigen::Index>(order_[p] - real_.size()), static_cast<Eigen::Index>(a));
}

template void Spectrum::cauchy(const Roots<double>&, std::size_t, const double*, const Eigen::MatrixXd&,
                               std::vector<double>&) const;
template void Spectrum::cauchy(const Roots<Complex>&, std::size_t, const Complex*, const Eigen::MatrixXd&,
                               std::vector<Complex>&) const;
template void Spectrum::find_vectors(Roots<double>&);
template void Spectrum::find_vectors(Roots<Complex>&);

// X and Y stored as matrices. Products with stored matrices need n^2 multiplications instead of n^2 divisions.

std::size_t Spectrum::stored_bytes() const {
  return sizeof(double) * static_cast<std::size_t>(x_.size() + y_.size());
}

/// Eigenvector of root k in the order of all modes: entries of cauchy() for coupled modes, zero for uncoupled modes.
template <class S>
void Spectrum::entries(const Roots<S>& roots, std::size_t k, const std::vector<S>& small,
                       const Eigen::MatrixXd& side, std::vector<S>& out) const {
  out.assign(coupled_.size() + uncoupled_.size(), S(0.0));
  std::vector<S> seen;
  cauchy(roots, k, small.data() + k * rank_, side, seen);
  for (std::size_t i = 0; i < n_; ++i) out[static_cast<std::size_t>(coupled_[i])] = seen[i];
}

void Spectrum::store_matrices() {
  const auto reals = static_cast<Eigen::Index>(order_.size()),
             pairs = static_cast<Eigen::Index>(pairs_.size()),
             n = static_cast<Eigen::Index>(coupled_.size() + uncoupled_.size());
  // Index in Amplitudes of each mode of the list real_, uncoupled_.
  std::vector<Eigen::Index> place(order_.size());
  for (std::size_t p = 0; p < order_.size(); ++p) place[order_[p]] = static_cast<Eigen::Index>(p);
  y_.setZero(reals + 2 * pairs, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, reals + 2 * pairs);
  std::vector<double> one;
  for (std::size_t k = 0; k < real_.size(); ++k) {
    entries(real_, k, real_.right, u_, one);
    right.col(place[k]) = Eigen::Map<const Eigen::VectorXd>(one.data(), n);
    for (std::size_t j = 0; j < uncoupled_.size(); ++j)
      right(uncoupled_[j], place[k]) = uncoupled_coordinate(real_, k, j, uncoupled_poles_[j]);
    entries(real_, k, real_.left, v_, one);
    y_.row(place[k]) = Eigen::Map<const Eigen::RowVectorXd>(one.data(), n);
  }
  std::vector<Complex> entry;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto at = reals + 2 * static_cast<Eigen::Index>(k);
    entries(pairs_, k, pairs_.right, u_, entry);
    for (std::size_t j = 0; j < uncoupled_.size(); ++j)
      entry[static_cast<std::size_t>(uncoupled_[j])] =
          uncoupled_coordinate(pairs_, k, j, uncoupled_poles_[j]);
    for (Eigen::Index i = 0; i < n; ++i) {  // x z plus its conjugate is 2 Re x Re z - 2 Im x Im z
      right(i, at) = 2.0 * entry[static_cast<std::size_t>(i)].re;
      right(i, at + 1) = -2.0 * entry[static_cast<std::size_t>(i)].im;
    }
    entries(pairs_, k, pairs_.left, v_, entry);
    for (Eigen::Index i = 0; i < n; ++i) {
      y_(at, i) = entry[static_cast<std::size_t>(i)].re;
      y_(at + 1, i) = entry[static_cast<std::size_t>(i)].im;
    }
  }
  std::map<std::size_t, Eigen::RowVectorXd> mixed;
  for (const Close& pair : close_) mixed.try_emplace(pair.l, y_.row(place[pair.l]));
  for (const Close& pair : close_) y_.row(place[pair.k]) -= pair.product * mixed.at(pair.l);
  for (std::size_t j = 0; j < uncoupled_.size(); ++j) {
    const Eigen::Index at = place[real_.size() + j];
    // Before this line, this row of y_ and this column of `right` are zero.
    y_.row(at) = -(right.row(uncoupled_[j]) * y_).eval();
    y_(at, uncoupled_[j]) += 1.0;
    right(uncoupled_[j], at) = 1.0;
  }
  for (const auto& [row, vectors] : rotations_) {
    right.middleRows(row, vectors.rows()) = (vectors * right.middleRows(row, vectors.rows())).eval();
    y_.middleCols(row, vectors.rows()) = (y_.middleCols(row, vectors.rows()) * vectors.transpose()).eval();
  }
  x_ = right;
}

void Spectrum::stored_form_coefficients(const Eigen::VectorXd& form, Amplitudes& row) const {
  const Eigen::VectorXd all = x_.transpose() * form;
  const auto reals = static_cast<Eigen::Index>(order_.size());
  row.real.assign(all.data(), all.data() + reals);
  row.pair.clear();
  for (Eigen::Index k = reals; k < all.size(); k += 2) row.pair.push_back({0.5 * all[k], -0.5 * all[k + 1]});
}

void Spectrum::to_modes_stored(const std::vector<const Eigen::VectorXd*>& q,
                               const std::vector<Amplitudes*>& z) const {
  std::vector<Eigen::VectorXd> all(q.size());
  std::vector<Eigen::VectorXd*> lists;
  for (Eigen::VectorXd& list : all) lists.push_back(&list);
  thin_product(y_, q, lists);
  const auto reals = static_cast<Eigen::Index>(order_.size());
  for (std::size_t s = 0; s < q.size(); ++s) {
    z[s]->real.assign(all[s].data(), all[s].data() + reals);
    z[s]->pair.clear();
    for (Eigen::Index k = reals; k < all[s].size(); k += 2) z[s]->pair.push_back({all[s][k], all[s][k + 1]});
  }
}

void Spectrum::from_modes_stored(const std::vector<const Amplitudes*>& z,
                                 const std::vector<Eigen::VectorXd*>& q) const {
  std::vector<Eigen::VectorXd> all(z.size(), Eigen::VectorXd(x_.cols()));
  std::vector<const Eigen::VectorXd*> lists;
  const auto reals = static_cast<Eigen::Index>(order_.size());
  for (std::size_t s = 0; s < z.size(); ++s) {
    all[s].head(reals) = Eigen::Map<const Eigen::VectorXd>(z[s]->real.data(), reals);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto at = reals + 2 * static_cast<Eigen::Index>(k);
      all[s][at] = z[s]->pair[k].re;
      all[s][at + 1] = z[s]->pair[k].im;
    }
    lists.push_back(&all[s]);
  }
  thin_product(x_, lists, q);
}

}  // namespace signorini::modal
