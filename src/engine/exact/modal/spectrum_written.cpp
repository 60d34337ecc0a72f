// X and Y written out as matrices: a product with them is n^2 multiplications instead of n^2 divisions.
#include <map>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini {

std::size_t Spectrum::written_bytes() const {
  return sizeof(double) * static_cast<std::size_t>(x_.size() + y_.size());
}

/// side * small / (D - l) of one root, at the places of the seen modes; zero elsewhere.
template <class S>
void Spectrum::entries(const Roots<S>& roots, std::size_t k, const std::vector<S>& small,
                       const Eigen::MatrixXd& side, std::vector<S>& out) const {
  out.assign(seen_.size() + unseen_.size(), S(0.0));
  std::vector<S> seen;
  cauchy(roots, k, small.data() + k * rank_, side, seen);
  for (std::size_t i = 0; i < n_; ++i) out[static_cast<std::size_t>(seen_[i])] = seen[i];
}

void Spectrum::write_out() {
  const auto reals = static_cast<Eigen::Index>(order_.size()),
             pairs = static_cast<Eigen::Index>(pairs_.size()),
             n = static_cast<Eigen::Index>(seen_.size() + unseen_.size());
  std::vector<Eigen::Index> place(order_.size());  // places of real_ and unseen_ among amplitudes
  for (std::size_t p = 0; p < order_.size(); ++p) place[order_[p]] = static_cast<Eigen::Index>(p);
  y_.setZero(reals + 2 * pairs, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, reals + 2 * pairs);
  std::vector<double> one;
  for (std::size_t k = 0; k < real_.size(); ++k) {
    entries(real_, k, real_.right, u_, one);
    right.col(place[k]) = Eigen::Map<const Eigen::VectorXd>(one.data(), n);
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      right(unseen_[j], place[k]) = moved(real_, k, j, unseen_poles_[j]);
    entries(real_, k, real_.left, v_, one);
    y_.row(place[k]) = Eigen::Map<const Eigen::RowVectorXd>(one.data(), n);
  }
  std::vector<Complex> entry;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto at = reals + 2 * static_cast<Eigen::Index>(k);
    entries(pairs_, k, pairs_.right, u_, entry);
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      entry[static_cast<std::size_t>(unseen_[j])] = moved(pairs_, k, j, unseen_poles_[j]);
    for (Eigen::Index i = 0; i < n; ++i) {  // x z + its conjugate
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
  for (std::size_t j = 0; j < unseen_.size(); ++j) {
    const Eigen::Index at = place[real_.size() + j];
    y_.row(at) = -(right.row(unseen_[j]) * y_).eval();  // none of this row yet, and none of right's column
    y_(at, unseen_[j]) += 1.0;
    right(unseen_[j], at) = 1.0;
  }
  for (const auto& [row, vectors] : turns_) {
    right.middleRows(row, vectors.rows()) = (vectors * right.middleRows(row, vectors.rows())).eval();
    y_.middleCols(row, vectors.rows()) = (y_.middleCols(row, vectors.rows()) * vectors.transpose()).eval();
  }
  x_ = right;
}

void Spectrum::of_form_written(const Eigen::VectorXd& form, Amplitudes& row) const {
  const Eigen::VectorXd all = x_.transpose() * form;
  const auto reals = static_cast<Eigen::Index>(order_.size());
  row.real.assign(all.data(), all.data() + reals);
  row.pair.clear();
  for (Eigen::Index k = reals; k < all.size(); k += 2) row.pair.push_back({0.5 * all[k], -0.5 * all[k + 1]});
}

void Spectrum::to_modes_written(const std::vector<const Eigen::VectorXd*>& q,
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

void Spectrum::from_modes_written(const std::vector<const Amplitudes*>& z,
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

}  // namespace signorini
