// mode_pairs.hpp: what any two modes of a state have to do with each other, whatever moves.
//
//   e_kl = 1 / ( (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l) ),      shared_kl = x_k^T x_l e_kl
//
// Real modes k != l; e = 0 for two without frequency. Both are symmetric, and known for l < k.
#pragma once

#include "engine/exact/modal/spectrum.hpp"

namespace signorini {

/// One column a mode k, in which rows l < k count; empty where the state's X is not written out either.
struct ModePairs {
  Eigen::ArrayXXd e, shared;
};

/// Rows below k of column k, into arrays of that length.
void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, Eigen::Ref<Eigen::ArrayXd> e,
                   Eigen::Ref<Eigen::ArrayXd> shared);
[[nodiscard]] ModePairs mode_pairs(const Spectrum& spectrum, double alpha);

}  // namespace signorini
