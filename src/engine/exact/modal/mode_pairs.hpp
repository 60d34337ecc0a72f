// mode_pairs.hpp: coefficients of pairs of modes of a state that do not depend on the motion.
//
//   e_kl = 1 / ( (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l) ),      shared_kl = x_k^T x_l e_kl
//
// For real modes k != l; 0 for two modes without frequency. Symmetric, stored for l < k.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {

/// Empty if the state's X is not written out.
class ModePairs {
 public:
  ModePairs() = default;
  ModePairs(const Spectrum& spectrum, double alpha);
  [[nodiscard]] bool available() const { return !shared_.empty(); }
  /// shared_kl for all l < k.
  [[nodiscard]] const double* row(Eigen::Index k) const { return shared_.data() + k * (k - 1) / 2; }
  [[nodiscard]] std::size_t bytes() const { return sizeof(double) * shared_.size(); }

 private:
  std::vector<double> shared_;  // k = 1, 2, ... one after the other
};

/// Computes shared_kl for all l < k.
void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, double* shared);

// Sums over pairs of one mode with each mode before it.
//
//   y = oscillating part of a mode, y0, r0 = y, y' at the beginning, y1, r1 at the end of an interval
//   l = omega^2,  e = 1/( d^2 + 2 alpha^2 (l_k + l_i) ),  d = l_i - l_k
//   int y_k' y_i' = -e ( 2 alpha l_k l_i [yy] + alpha (l_k + l_i) [rr] + d (l_k [yr] - l_i [ry]) )
//   int y_k y_i'  =  e ( l_i (d + 2 alpha^2) [yy] + d [rr] - 2 alpha (l_k [yr] - l_i [ry]) )
//
// [yy] = y_k y_i at the end minus its value at the beginning, [yr] the same of y_k y_i', [ry] of y_k' y_i,
// [rr] of y_k' y_i'. Every sum is computed as four partial sums.

/// Arrays with one entry for each mode.
struct ModeEnds {
  const double *l, *y0, *r0, *y1, *r1;
};

/// For mode k and all i < k: writes [yy] and int y_k y_i' (mixed), returns the sum of -x_k^T x_i int y_k'
/// y_i'. shared: shared_ki.
[[nodiscard]] double pair_integrals(const ModeEnds& ends, double alpha, std::ptrdiff_t k,
                                    const double* shared, double* yy, double* mixed);

/// sum over i < k of n_k t_i mixed_i + t_k n_i ( yy_i - mixed_i ): the contribution of these pairs of modes
/// to int (sum n y)(sum t y').
[[nodiscard]] double cross_integral(const double* n, const double* t, std::ptrdiff_t k, const double* yy,
                                    const double* mixed);

}  // namespace signorini::modal
