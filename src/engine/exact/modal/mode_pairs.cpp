#include "engine/exact/modal/mode_pairs.hpp"

namespace signorini {

void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, Eigen::Ref<Eigen::ArrayXd> e,
                   Eigen::Ref<Eigen::ArrayXd> shared) {
  const std::vector<double>& values = spectrum.real();
  const auto own = static_cast<std::size_t>(k);
  const double lk = values[own];
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto other = static_cast<std::size_t>(i);
    const double l = values[other], d = l - lk, all = d * d + 2.0 * alpha * alpha * (l + lk);
    e[i] = all == 0.0 ? 0.0 : 1.0 / all;
    shared[i] = spectrum.product(own, other) * e[i];
  }
}

ModePairs mode_pairs(const Spectrum& spectrum, double alpha) {
  ModePairs pairs;
  const auto n = static_cast<Eigen::Index>(spectrum.real().size());
  pairs.e.setZero(n, n);
  pairs.shared.setZero(n, n);
  for (Eigen::Index k = 1; k < n; ++k)
    pairs_of_mode(spectrum, alpha, k, pairs.e.col(k).head(k), pairs.shared.col(k).head(k));
  return pairs;
}

}  // namespace signorini
