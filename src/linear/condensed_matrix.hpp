// condensed_matrix.hpp: the system of compliant contacts and masses on degrees of freedom alone.
//
//   | S  H | | x |   | b |       S = M w_a + C w_v + K w_u,  the same weights for all
//   | R  B | | f | = | q |       f = B^-1 (q - R x)   contact by contact
//   (S - H B^-1 R) x = b - H B^-1 q
//
// Where no row of a contact holds an acceleration, its forces are eliminated as they stand: a soft spring more at its
// degrees of freedom. What is left has the band of the structure, whose factors cost less than the solves of a
// general method, so that nothing of other states or lengths has to be kept. Where contacts have changed since, at the same
// weights, rows of the factors are made anew from the first that they touch to where these are as they were, to the last
// bit: what is far from a contact does not feel it.
#pragma once

#include "linear/band_factors.hpp"
#include "linear/condensed_rows.hpp"

namespace signorini {

/// Unknowns from which a factorisation is worth avoiding: of 200 it takes some 30 us. Chosen: unit/engine/newmark tests
/// both sides.
inline constexpr int economical_from = 200;
/// All degrees of freedom have mass, contacts share nothing, and there are so many unknowns.
[[nodiscard]] bool is_economical(const Model& model, const Structure& structure, const SharedRows& shared);

class CondensedMatrix {
 public:
  /// The widest band for which this is worth it: its n width^2 products beside those of a sparse method.
  static constexpr std::size_t widest = 16;

  /// rows: must outlive it.
  explicit CondensedMatrix(const CondensedRows& rows);

  /// Factors of the rows in force. False: those do not tell their forces, or elimination loses digits.
  [[nodiscard]] bool set(const Weights& weights);
  /// Whether its factors are of these weights, but for contacts that have changed.
  [[nodiscard]] bool is_at(const Weights& w) const {
    return set_ && w.acceleration == weights_.acceleration && w.velocity == weights_.velocity &&
           w.displacement == weights_.displacement;
  }
  /// x := A^-1 x: n degrees of freedom, then N and T of each contact.
  void solve(double* x);

  long factorisations = 0;  ///< of all rows
  long renewed_rows = 0;    ///< made anew besides

 private:
  [[nodiscard]] bool factor();
  [[nodiscard]] bool renew(std::span<const std::size_t> contacts);
  [[nodiscard]] std::optional<std::size_t> renew(std::size_t begin);
  void fill(std::size_t begin, std::size_t end);

  const CondensedRows& rows_;
  BandFactors band_;
  Weights weights_;
  long version_ = 0;                  // of the rows that it has factors of
  bool set_ = false, holds_ = false;  // for weights_; there are factors
  std::vector<double> by_N_, by_T_;   // B^-1 R, one a touch
  std::vector<double> x_, before_;    // rows as they were
  std::vector<std::size_t> touched_;  // places
};

}  // namespace signorini
