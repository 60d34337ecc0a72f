// condensed_matrix.hpp: the system of compliant contacts and masses on degrees of freedom alone.
//
//   | S  H | | x |   | b |       S = M w_a + C w_v + K w_u,  the same weights for all
//   | R  B | | f | = | q |       f = B^-1 (q - R x)   contact by contact
//   (S - H B^-1 R) x = b - H B^-1 q
//
// Where no row of a contact holds an acceleration, its forces are eliminated as they stand: a soft spring more at its
// degrees of freedom. What is left has the band of the structure, whose factors cost less than the solves of a
// general method, so that nothing of other states or lengths has to be kept.
#pragma once

#include <memory>

#include "linear/band_factors.hpp"
#include "linear/system_matrix.hpp"

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

  /// Both must outlive it; of what is_economical().
  CondensedMatrix(const Model& model, const Structure& structure, std::size_t most_width = widest);

  /// False: the band is too wide.
  [[nodiscard]] bool narrow() const { return band_ != nullptr; }
  /// Factors of a state; narrow() holds. False: a row holds an acceleration or does not tell its force, or elimination
  /// loses digits.
  [[nodiscard]] bool set(const std::vector<Rows>& rows, const Weights& weights);
  /// x := A^-1 x: n degrees of freedom, then N and T of each contact.
  void solve(double* x);

  long factorisations = 0;

 private:
  struct Touch {  // a degree of freedom of a contact
    std::size_t dof = 0, place = 0;
    double n = 0.0, t = 0.0;
  };
  struct Held {  // a contact in force
    double normal_N = 1.0, tangent_N = 0.0, tangent_T = 1.0;
    bool on_motion = false;  // its forces follow the motion
  };
  void add(const Rows& rows, const Weights& weights, std::size_t contact);

  const Structure& structure_;
  std::unique_ptr<BandFactors> band_;      // null: too wide
  std::vector<std::size_t> place_, slot_;  // of degrees of freedom, of the structure's entries
  std::vector<Touch> touches_;             // contact by contact
  std::vector<std::size_t> end_;           // of each contact's
  std::vector<Held> held_;                 // one a contact
  std::vector<double> by_N_, by_T_;        // B^-1 R, one a touch
  std::vector<double> x_;
};

}  // namespace signorini
