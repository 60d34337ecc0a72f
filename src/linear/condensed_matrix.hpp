// condensed_matrix.hpp: the system of compliant contacts and masses on degrees of freedom alone.
//
//   | S  H | | x |   | b |       S = M w_a + C w_v + K w_u,  the same weights for all
//   | R  B | | f | = | q |       f = B^-1 (q - R x)   contact by contact
//   (S - H B^-1 R) x = b - H B^-1 q
//
// If no row of a contact contains an acceleration, its forces are eliminated directly: they act like a soft spring on
// its degrees of freedom. The remaining matrix has the band of the structure. Its factors cost less than the solves of
// a general method, so that factors of other states or lengths are not kept. If contacts have changed at the same
// weights, rows of the factors are renewed from the first affected one up to the place where they are bitwise
// unchanged, which is near the contact.
#pragma once

#include "linear/band_factors.hpp"
#include "linear/condensed_rows.hpp"

namespace signorini {

/// Number of unknowns from which avoiding a factorisation saves time: one with 200 takes about 30 us. Chosen: the tests
/// unit/engine/newmark cover both sides.
inline constexpr int economical_from = 200;
/// True if all degrees of freedom have mass, contacts share no rows, and there are at least economical_from unknowns.
[[nodiscard]] bool is_economical(const Model& model, const Structure& structure, const SharedRows& shared);

class CondensedMatrix {
 public:
  /// The widest band for which this saves time: its n width^2 products compared with those of a sparse method.
  static constexpr std::size_t widest = 16;

  /// The rows must outlive the object.
  explicit CondensedMatrix(const CondensedRows& rows);

  /// Factors of the rows in force. False: the rows do not determine their forces, or elimination loses digits.
  [[nodiscard]] bool set(const Weights& weights);
  /// True if its factors belong to these weights, possibly except for contacts that have changed.
  [[nodiscard]] bool is_at(const Weights& w) const {
    return set_ && w.acceleration == weights_.acceleration && w.velocity == weights_.velocity &&
           w.displacement == weights_.displacement;
  }
  /// x := A^-1 x: n degrees of freedom, then N and T of each contact.
  void solve(double* x);

  long factorisations = 0;  ///< factorisations of all rows
  long renewed_rows = 0;    ///< additional renewed rows

 private:
  [[nodiscard]] bool factor();
  [[nodiscard]] bool renew(std::span<const std::size_t> contacts);
  [[nodiscard]] std::optional<std::size_t> renew(std::size_t begin);
  void fill(std::size_t begin, std::size_t end);

  const CondensedRows& rows_;
  BandFactors band_;
  Weights weights_;
  long version_ = 0;                  // version of the rows of the factors
  bool set_ = false, holds_ = false;  // set_: weights_ are valid; holds_: there are factors
  std::vector<double> by_N_, by_T_;   // B^-1 R, one entry for each touch
  std::vector<double> x_, before_;    // rows before the renewal
  std::vector<std::size_t> touched_;  // affected places
};

}  // namespace signorini
