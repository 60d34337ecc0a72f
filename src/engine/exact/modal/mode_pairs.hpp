// mode_pairs.hpp: coefficients of pairs of modes of a state that do not depend on the motion.
//
//   e_kl = 1 / ( (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l) ),      shared_kl = x_k^T x_l e_kl
//
// Real modes k != l; 0 for two without frequency. Symmetric, and known for l < k.
#pragma once

#include <vector>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini {

/// Empty if the state's X is not written out.
class ModePairs {
 public:
  ModePairs() = default;
  ModePairs(const Spectrum& spectrum, double alpha);
  [[nodiscard]] bool known() const { return !shared_.empty(); }
  /// shared_kl for all l < k.
  [[nodiscard]] const double* of(Eigen::Index k) const { return shared_.data() + k * (k - 1) / 2; }
  [[nodiscard]] std::size_t bytes() const { return sizeof(double) * shared_.size(); }

 private:
  std::vector<double> shared_;  // k = 1, 2, ... one after the other
};

/// Computes shared_kl for all l < k.
void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, double* shared);

}  // namespace signorini
