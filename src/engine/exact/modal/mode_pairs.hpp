// mode_pairs.hpp: coefficients of work integrals for pairs of modes of a contact state; independent of the motion.
//
//   e_kl = 1 / ( (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l) ),      shared_kl = x_k^T x_l e_kl
//
// Both are defined for real modes k != l, and 0 if both frequencies are zero. shared_kl is symmetric, so only l < k is stored.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {

/// Table of shared_kl for all pairs of modes.
class ModePairs {
 public:
  ModePairs() = default;
  ModePairs(const Spectrum& spectrum, double alpha);
  /// False if the table was not computed.
  [[nodiscard]] bool available() const { return !shared_.empty(); }
  /// shared_kl for all l < k.
  [[nodiscard]] const double* row(Eigen::Index k) const { return shared_.data() + k * (k - 1) / 2; }
  [[nodiscard]] std::size_t bytes() const { return sizeof(double) * shared_.size(); }

 private:
  std::vector<double> shared_;  // rows k = 1, 2, ... one after the other; row k has k entries
};

/// Computes shared_kl for all l < k.
void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, double* shared);

// Sums over the pairs of one mode k with each mode i < k.
//
//   y: oscillating part of a mode;  y0, r0: y, y' at the beginning of an interval;  y1, r1: y, y' at its end
//   l = omega^2,  e = 1/( d^2 + 2 alpha^2 (l_k + l_i) ),  d = l_i - l_k
//   int y_k' y_i' = -e ( 2 alpha l_k l_i [yy] + alpha (l_k + l_i) [rr] + d (l_k [yr] - l_i [ry]) )
//   int y_k y_i'  =  e ( l_i (d + 2 alpha^2) [yy] + d [rr] - 2 alpha (l_k [yr] - l_i [ry]) )
//
// Brackets are differences between end and beginning: [yy] of y_k y_i, [yr] of y_k y_i', [ry] of y_k' y_i, [rr] of y_k' y_i'.
// Every sum is computed as four partial sums.

/// Arrays of l, y0, r0, y1 and r1, with one entry for each mode.
struct ModeEnds {
  const double *l, *y0, *r0, *y1, *r1;
};

/// Writes [yy] to yy and int y_k y_i' to mixed, for mode k and all i < k. shared: coefficients shared_ki. Returns the sum of
/// -x_k^T x_i int y_k' y_i'.
[[nodiscard]] double pair_integrals(const ModeEnds& ends, double alpha, std::ptrdiff_t k,
                                    const double* shared, double* yy, double* mixed);

/// Part of int (sum n y)(sum t y') that is due to the pairs of mode k with all i < k: the sum of
/// n_k t_i mixed_i + t_k n_i ( yy_i - mixed_i ).
[[nodiscard]] double cross_integral(const double* n, const double* t, std::ptrdiff_t k, const double* yy,
                                    const double* mixed);

}  // namespace signorini::modal
