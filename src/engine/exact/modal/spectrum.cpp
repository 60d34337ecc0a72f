#include "engine/exact/modal/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/eigen_dense.hpp"

namespace signorini::modal {
namespace {

constexpr double filling = 1e-30;  // replaces zero rows of U, relative to the greatest entry of U
constexpr double equal = 1e-13;    // relative distance below which poles are regarded as equal
// Largest coupling of an uncoupled mode, relative to the greatest coupling of all modes with an equal pole.
constexpr double uncoupled_share = 1e-13;
/// Limit of |X Y q - q| for a q with entries between -1 and 1; chosen. The contact states of the pipeline with 201 unknowns
/// have 1e-13; the relative error of an event time is about as large as this value. The test "flows: stiff beside soft" depends
/// on this limit.
constexpr double worst_round_trip = 1e-12;
constexpr double worst_condition = 1e4;

}  // namespace

Poles::Poles(const Eigen::VectorXd& values)
    : base(values.data(), values.data() + values.size()), separation(base.size(), 0.0) {
  double scale = 1.0;
  for (const double value : base)
    if (value > 0.0) {
      scale = value;
      break;
    }
  for (std::size_t i = 1; i < base.size(); ++i)
    if (base[i] - base[i - 1] <= equal * base[i]) base[i] = base[i - 1];
  for (std::size_t i = 1; i < base.size(); ++i)
    if (base[i] == base[i - 1])
      separation[i] = separation[i - 1] + pole_separation * std::max(scale, base[i]);
}

Spectrum::Spectrum(const Poles& poles, Eigen::MatrixXd u, Eigen::MatrixXd v, bool symmetric,
                   std::size_t max_stored)
    : rank_(static_cast<std::size_t>(u.cols())), order_(poles.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  values_ = poles.base;
  if (rank_ > max_rank) {
    failure_ = "the contact state has too many contact springs for modes";
    return;
  }
  if (rank_ == 0) {  // the modes are the unconstrained modes
    squares_.assign(poles.size(), 1.0);
    value_base_ = values_;
    value_offset_.assign(poles.size(), 0.0);
    return;
  }
  // Groups of equal poles, which are consecutive.
  group_begin_.resize(poles.size());
  group_end_ = group_begin_;
  for (std::size_t first = 0, last = 0; first < poles.size(); first = last) {
    last = first + 1;
    while (last < poles.size() && poles.base[last] == poles.base[first]) ++last;
    std::fill_n(group_begin_.begin() + static_cast<std::ptrdiff_t>(first), last - first, first);
    std::fill_n(group_end_.begin() + static_cast<std::ptrdiff_t>(first), last - first, last);
  }
  rotate_equal_modes(u, v);
  select_coupled(poles, u, v);
  if (symmetric) {
    std::vector<double> offset(n_);
    if (search(offset)) {
      real_.pole_index = home_;
      real_.offset = std::move(offset);
    }
  } else {
    std::vector<Complex> offset(n_);
    if (search(offset) && !split_real_and_pairs(offset))
      failure_ = "complex eigenvalues do not come in conjugate pairs";
  }
  if (!failure_.empty()) return;
  find_vectors(real_);
  find_vectors(pairs_);
  order_values();
  find_squares();
  compute_close_products();
  split_close_roots();
  find_products();
  if (order_.size() + 2 * pairs_.size() <= max_stored) store_matrices();
  test();
}

/// Rotates modes with equal poles so that V has at most `rank` nonzero rows for each group of equal poles.
void Spectrum::rotate_equal_modes(Eigen::MatrixXd& u, Eigen::MatrixXd& v) {
  for (std::size_t first = 0; first < group_end_.size(); first = group_end_[first]) {
    const auto row = static_cast<Eigen::Index>(first),
               rows = static_cast<Eigen::Index>(group_end_[first] - first);
    if (rows == 1) continue;
    const Eigen::MatrixXd seen = v.middleRows(row, rows);
    const base::EigenPairs pairs = base::symmetric_eigen(seen * seen.transpose());
    rotations_.emplace_back(row, pairs.vectors);
    for (Eigen::MatrixXd* matrix : {&u, &v})
      matrix->middleRows(row, rows) = (pairs.vectors.transpose() * matrix->middleRows(row, rows)).eval();
    const double most = v.middleRows(row, rows).cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < rows; ++j)
      if (v.row(row + j).cwiseAbs().maxCoeff() <= uncoupled_share * most) v.row(row + j).setZero();
  }
}

void Spectrum::select_coupled(const Poles& poles, const Eigen::MatrixXd& u, const Eigen::MatrixXd& v) {
  const double least = filling * v.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < v.rows(); ++i)
    (v.row(i).cwiseAbs().maxCoeff() > least ? coupled_ : uncoupled_).push_back(i);
  n_ = coupled_.size();
  std::vector<std::size_t> begin, end;
  for (std::size_t i = 0; i < n_; ++i) {
    const auto old = static_cast<std::size_t>(coupled_[i]);
    poles_.base.push_back(poles.base[old]);
    poles_.separation.push_back(poles.separation[old]);
    const bool same = i > 0 && poles_.base[i] == poles_.base[i - 1];
    begin.push_back(same ? begin.back() : i);
  }
  end.assign(n_, n_);
  for (std::size_t i = n_; i-- > 1;) end[i - 1] = begin[i] == begin[i - 1] ? end[i] : i;
  group_begin_ = std::move(begin);
  group_end_ = std::move(end);
  u_ = u(coupled_, Eigen::all);
  v_ = v(coupled_, Eigen::all);
  u_uncoupled_ = u(uncoupled_, Eigen::all);
  for (const Eigen::Index i : uncoupled_) uncoupled_poles_.push_back(poles.base[static_cast<std::size_t>(i)]);
  const double fill = filling * u.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < u_.rows(); ++i)
    if (u_.row(i).cwiseAbs().maxCoeff() <= fill) u_.row(i).setConstant(fill);
  home_.resize(n_);
  std::iota(home_.begin(), home_.end(), std::size_t(0));
  terms_.resize(n_ * rank_ * rank_);
  weights_.resize(terms_.size());
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b)
        weights_[(a * rank_ + b) * n_ + i] = terms_[(i * rank_ + a) * rank_ + b] =
            v_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) *
            u_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(b));
}

void Spectrum::order_values() {
  std::vector<double> values = real_.value;
  values.insert(values.end(), uncoupled_poles_.begin(), uncoupled_poles_.end());
  order_.resize(values.size());
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  values_.resize(values.size());
  for (std::size_t p = 0; p < order_.size(); ++p) values_[p] = values[order_[p]];
}

void Spectrum::test() {
  Eigen::VectorXd q(static_cast<Eigen::Index>(order_.size() + 2 * pairs_.size())), back;
  double entry = 0.5;
  for (Eigen::Index i = 0; i < q.size(); ++i) {  // logistic map: all modes are excited, equally in every run
    entry = 3.99 * entry * (1.0 - entry) + 1e-3;
    q[i] = 2.0 * entry - 1.0;
  }
  Amplitudes z;
  to_modes(q, z);
  from_modes({&z}, {&back});
  round_trip_ = (back - q).norm();  // not maxCoeff(), which may ignore a NaN
  if (!(round_trip_ < worst_round_trip))
    failure_ =
        "the modes of the contact state are inaccurate: a motion changes by conversion to modes and back";
  if (!(condition_ < worst_condition)) failure_ = "the modes of the contact state are nearly parallel";
}

// Conversions between a motion q and its modal amplitudes z, as sums with the factors 1 / (D_i - l_k).

template <class S>
void Spectrum::project(const Roots<S>& roots, const Eigen::VectorXd& q, bool form, std::vector<S>& z) const {
  const std::size_t count = roots.size();
  z.assign(count, S(0.0));
  std::vector<double> base(count), tiny(count);
  for (std::size_t k = 0; k < count; ++k) {
    base[k] = poles_.base[roots.pole_index[k]];
    tiny[k] = poles_.separation[roots.pole_index[k]];
  }
  const Eigen::MatrixXd& side = form ? u_ : v_;
  std::vector<S> sums(count * rank_, S(0.0)), one(count);
  for (std::size_t i = 0; i < n_; ++i) {
    const double entry = q[coupled_[i]];
    if (entry == 0.0) continue;
    const double base_i = poles_.base[i], tiny_i = poles_.separation[i];
    for (std::size_t k = 0; k < count; ++k)
      one[k] = inverse(S((base_i - base[k]) + (tiny_i - tiny[k])) - roots.offset[k]);
    for (std::size_t a = 0; a < rank_; ++a) {
      const double weight = entry * side(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      S* sum = sums.data() + a * count;
      for (std::size_t k = 0; k < count; ++k) sum[k] += one[k] * weight;
    }
  }
  const std::vector<S>& small = form ? roots.right : roots.left;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t a = 0; a < rank_; ++a) z[k] += small[k * rank_ + a] * sums[a * count + k];
}

/// Entry of the right eigenvector x of root k for the uncoupled mode j: U_j c / (D_j - l).
template <class S>
S Spectrum::uncoupled_coordinate(const Roots<S>& roots, std::size_t k, std::size_t j, double pole) const {
  S sum{};
  for (std::size_t a = 0; a < rank_; ++a)
    sum +=
        roots.right[k * rank_ + a] * u_uncoupled_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a));
  if (!(size_of(sum) > 0.0)) return S(0.0);
  return sum * inverse(S(pole - poles_.base[roots.pole_index[k]] - poles_.separation[roots.pole_index[k]]) -
                       roots.offset[k]);
}

double Spectrum::uncoupled_sum(std::size_t j, const std::vector<double>& real,
                               const std::vector<Complex>& pair) const {
  double sum = 0.0;
  const double pole = uncoupled_poles_[j];
  for (std::size_t k = 0; k < real_.size(); ++k) sum += uncoupled_coordinate(real_, k, j, pole) * real[k];
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    sum += real_contribution(uncoupled_coordinate(pairs_, k, j, pole) * pair[k]);
  return sum;
}

void Spectrum::project(const Eigen::VectorXd& q, bool form, Amplitudes& z) const {
  if (rank_ == 0) {
    z.real.assign(q.data(), q.data() + q.size());
    z.pair.clear();
    return;
  }
  if (form && x_.size() > 0) return stored_form_coefficients(q, z);
  Eigen::VectorXd turned = q;
  for (const auto& [row, vectors] : rotations_)
    turned.segment(row, vectors.rows()) = vectors.transpose() * q.segment(row, vectors.rows());
  std::vector<double> real;
  project(real_, turned, form, real);
  project(pairs_, turned, form, z.pair);
  if (!form) {
    const std::vector<double> mixed = real;
    for (const Close& pair : close_) real[pair.k] -= pair.product * mixed[pair.l];
  }
  if (form) {  // a row of X for an uncoupled mode may have entries in all columns
    for (std::size_t j = 0; j < uncoupled_.size(); ++j)
      if (const double entry = turned[uncoupled_[j]]; entry != 0.0) {
        for (std::size_t k = 0; k < real_.size(); ++k)
          real[k] += entry * uncoupled_coordinate(real_, k, j, uncoupled_poles_[j]);
        for (std::size_t k = 0; k < pairs_.size(); ++k)
          z.pair[k] += uncoupled_coordinate(pairs_, k, j, uncoupled_poles_[j]) * entry;
      }
    for (const Eigen::Index i : uncoupled_) real.push_back(turned[i]);
  } else {
    const std::vector<double> seen = real;
    for (std::size_t j = 0; j < uncoupled_.size(); ++j)
      real.push_back(turned[uncoupled_[j]] - uncoupled_sum(j, seen, z.pair));
  }
  z.real.resize(order_.size());
  for (std::size_t p = 0; p < order_.size(); ++p) z.real[p] = real[order_[p]];
}

void Spectrum::to_modes(const std::vector<const Eigen::VectorXd*>& q,
                        const std::vector<Amplitudes*>& z) const {
  if (x_.size() > 0) return to_modes_stored(q, z);
  for (std::size_t s = 0; s < q.size(); ++s) project(*q[s], false, *z[s]);
}

void Spectrum::from_modes(const std::vector<const Amplitudes*>& z,
                          const std::vector<Eigen::VectorXd*>& q) const {
  if (rank_ == 0) {
    for (std::size_t s = 0; s < z.size(); ++s)
      *q[s] =
          Eigen::Map<const Eigen::VectorXd>(z[s]->real.data(), static_cast<Eigen::Index>(z[s]->real.size()));
    return;
  }
  if (x_.size() > 0) return from_modes_stored(z, q);
  const auto n = static_cast<Eigen::Index>(n_), rank = static_cast<Eigen::Index>(rank_);
  std::vector<std::vector<double>> real(z.size(), std::vector<double>(order_.size()));
  for (std::size_t s = 0; s < z.size(); ++s)
    for (std::size_t p = 0; p < order_.size(); ++p) real[s][order_[p]] = z[s]->real[p];
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, rank * static_cast<Eigen::Index>(z.size()));
  std::vector<double> one(n_);
  for (std::size_t k = 0; k < real_.size(); ++k) {
    const double base = poles_.base[real_.pole_index[k]], tiny = poles_.separation[real_.pole_index[k]],
                 own = real_.offset[k];
    for (std::size_t i = 0; i < n_; ++i)
      one[i] = 1.0 / (((poles_.base[i] - base) + (poles_.separation[i] - tiny)) - own);
    for (std::size_t s = 0; s < z.size(); ++s)
      for (std::size_t a = 0; a < rank_; ++a) {
        const double weight = real_.right[k * rank_ + a] * real[s][k];
        double* sum = sums.col(static_cast<Eigen::Index>(s * rank_ + a)).data();
        for (std::size_t i = 0; i < n_; ++i) sum[i] += weight * one[i];
      }
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    for (std::size_t i = 0; i < n_; ++i) {
      const Complex pole =
          inverse(Complex(poles_.pole_difference(i, pairs_.pole_index[k])) - pairs_.offset[k]);
      for (std::size_t s = 0; s < z.size(); ++s)
        for (std::size_t a = 0; a < rank_; ++a)
          sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s * rank_ + a)) +=
              real_contribution(pairs_.right[k * rank_ + a] * z[s]->pair[k] * pole);
    }
  for (std::size_t s = 0; s < z.size(); ++s) {
    q[s]->resize(static_cast<Eigen::Index>(coupled_.size() + uncoupled_.size()));
    (*q[s])(coupled_) =
        u_.cwiseProduct(sums.middleCols(static_cast<Eigen::Index>(s) * rank, rank)).rowwise().sum();
    for (std::size_t j = 0; j < uncoupled_.size(); ++j)
      (*q[s])[uncoupled_[j]] = real[s][real_.size() + j] + uncoupled_sum(j, real[s], z[s]->pair);
    for (const auto& [row, vectors] : rotations_)
      q[s]->segment(row, vectors.rows()) = (vectors * q[s]->segment(row, vectors.rows())).eval();
  }
}

template double Spectrum::uncoupled_coordinate(const Roots<double>&, std::size_t, std::size_t, double) const;
template Complex Spectrum::uncoupled_coordinate(const Roots<Complex>&, std::size_t, std::size_t,
                                                double) const;

}  // namespace signorini::modal
