#include "engine/exact/modal/mode_pairs.hpp"

namespace signorini {

void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, double* shared) {
  const std::vector<double>& values = spectrum.real();
  const auto own = static_cast<std::size_t>(k);
  const double lk = values[own];
  for (std::size_t i = 0; i < own; ++i) {
    const double l = values[i], d = l - lk, all = d * d + 2.0 * alpha * alpha * (l + lk);
    shared[i] = all == 0.0 ? 0.0 : spectrum.product(own, i) / all;
  }
}

ModePairs::ModePairs(const Spectrum& spectrum, double alpha) {
  const std::size_t n = spectrum.real().size();
  shared_.resize(n * (n - 1) / 2);
  double* next = shared_.data();
  for (std::size_t k = 1; k < n; next += k, ++k)
    pairs_of_mode(spectrum, alpha, static_cast<Eigen::Index>(k), next);
}

}  // namespace signorini
