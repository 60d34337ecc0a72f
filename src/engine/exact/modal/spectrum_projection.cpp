// Conversions between a state and its amplitudes: sums over 1 / (D_i - l_k).
#include "engine/exact/modal/spectrum.hpp"

namespace signorini {

template <class S>
void Spectrum::project(const Roots<S>& roots, const Eigen::VectorXd& q, bool form, std::vector<S>& z) const {
  const std::size_t count = roots.size();
  z.assign(count, S(0.0));
  std::vector<double> base(count), tiny(count);
  for (std::size_t k = 0; k < count; ++k) {
    base[k] = poles_.base[roots.home[k]];
    tiny[k] = poles_.tiny[roots.home[k]];
  }
  const Eigen::MatrixXd& side = form ? u_ : v_;
  std::vector<S> sums(count * rank_, S(0.0)), one(count);
  for (std::size_t i = 0; i < n_; ++i) {
    const double entry = q[seen_[i]];
    if (entry == 0.0) continue;
    const double base_i = poles_.base[i], tiny_i = poles_.tiny[i];
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

/// Motion of an unseen mode in each seen mode: -1/(D_j - l) U_j c.
template <class S>
S Spectrum::moved(const Roots<S>& roots, std::size_t k, std::size_t j, double pole) const {
  S sum{};
  for (std::size_t a = 0; a < rank_; ++a)
    sum += roots.right[k * rank_ + a] * u_unseen_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a));
  if (!(size_of(sum) > 0.0)) return S(0.0);
  return sum * inverse(S(pole - poles_.base[roots.home[k]] - poles_.tiny[roots.home[k]]) - roots.offset[k]);
}

double Spectrum::moved_by_all(std::size_t j, const std::vector<double>& real,
                              const std::vector<Complex>& pair) const {
  double sum = 0.0;
  const double pole = unseen_poles_[j];
  for (std::size_t k = 0; k < real_.size(); ++k) sum += moved(real_, k, j, pole) * real[k];
  for (std::size_t k = 0; k < pairs_.size(); ++k) sum += whole(moved(pairs_, k, j, pole) * pair[k]);
  return sum;
}

void Spectrum::project(const Eigen::VectorXd& q, bool form, Amplitudes& z) const {
  if (rank_ == 0) {
    z.real.assign(q.data(), q.data() + q.size());
    z.pair.clear();
    return;
  }
  if (form && x_.size() > 0) return of_form_written(q, z);
  Eigen::VectorXd turned = q;
  for (const auto& [row, vectors] : turns_)
    turned.segment(row, vectors.rows()) = vectors.transpose() * q.segment(row, vectors.rows());
  std::vector<double> real;
  project(real_, turned, form, real);
  project(pairs_, turned, form, z.pair);
  if (!form) {
    const std::vector<double> mixed = real;
    for (const Close& pair : close_) real[pair.k] -= pair.product * mixed[pair.l];
  }
  if (form) {  // all modes move the unseen part of a form
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      if (const double entry = turned[unseen_[j]]; entry != 0.0) {
        for (std::size_t k = 0; k < real_.size(); ++k)
          real[k] += entry * moved(real_, k, j, unseen_poles_[j]);
        for (std::size_t k = 0; k < pairs_.size(); ++k)
          z.pair[k] += moved(pairs_, k, j, unseen_poles_[j]) * entry;
      }
    for (const Eigen::Index i : unseen_) real.push_back(turned[i]);
  } else {
    const std::vector<double> seen = real;
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      real.push_back(turned[unseen_[j]] - moved_by_all(j, seen, z.pair));
  }
  z.real.resize(order_.size());
  for (std::size_t p = 0; p < order_.size(); ++p) z.real[p] = real[order_[p]];
}

void Spectrum::to_modes(const std::vector<const Eigen::VectorXd*>& q,
                        const std::vector<Amplitudes*>& z) const {
  if (x_.size() > 0) return to_modes_written(q, z);
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
  if (x_.size() > 0) return from_modes_written(z, q);
  const auto n = static_cast<Eigen::Index>(n_), rank = static_cast<Eigen::Index>(rank_);
  std::vector<std::vector<double>> real(z.size(), std::vector<double>(order_.size()));
  for (std::size_t s = 0; s < z.size(); ++s)
    for (std::size_t p = 0; p < order_.size(); ++p) real[s][order_[p]] = z[s]->real[p];
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, rank * static_cast<Eigen::Index>(z.size()));
  std::vector<double> one(n_);
  for (std::size_t k = 0; k < real_.size(); ++k) {
    const double base = poles_.base[real_.home[k]], tiny = poles_.tiny[real_.home[k]], own = real_.offset[k];
    for (std::size_t i = 0; i < n_; ++i)
      one[i] = 1.0 / (((poles_.base[i] - base) + (poles_.tiny[i] - tiny)) - own);
    for (std::size_t s = 0; s < z.size(); ++s)
      for (std::size_t a = 0; a < rank_; ++a) {
        const double weight = real_.right[k * rank_ + a] * real[s][k];
        double* sum = sums.col(static_cast<Eigen::Index>(s * rank_ + a)).data();
        for (std::size_t i = 0; i < n_; ++i) sum[i] += weight * one[i];
      }
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    for (std::size_t i = 0; i < n_; ++i) {
      const Complex pole = inverse(Complex(poles_.between(i, pairs_.home[k])) - pairs_.offset[k]);
      for (std::size_t s = 0; s < z.size(); ++s)
        for (std::size_t a = 0; a < rank_; ++a)
          sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s * rank_ + a)) +=
              whole(pairs_.right[k * rank_ + a] * z[s]->pair[k] * pole);
    }
  for (std::size_t s = 0; s < z.size(); ++s) {
    q[s]->resize(static_cast<Eigen::Index>(seen_.size() + unseen_.size()));
    (*q[s])(seen_) =
        u_.cwiseProduct(sums.middleCols(static_cast<Eigen::Index>(s) * rank, rank)).rowwise().sum();
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      (*q[s])[unseen_[j]] = real[s][real_.size() + j] + moved_by_all(j, real[s], z[s]->pair);
    for (const auto& [row, vectors] : turns_)
      q[s]->segment(row, vectors.rows()) = (vectors * q[s]->segment(row, vectors.rows())).eval();
  }
}

template double Spectrum::moved(const Roots<double>&, std::size_t, std::size_t, double) const;
template Complex Spectrum::moved(const Roots<Complex>&, std::size_t, std::size_t, double) const;

}  // namespace signorini
