// condensed_matrix.hpp: the system of compliant contacts with the contact forces eliminated.
//
//   | S  H | | x |   | b |       S = M w_a + C w_v + K w_u,  the same weights for all
//   | R  B | | f | = | q |       f = B^-1 (q - R x)   contact by contact
//   (S - H B^-1 R) x = b - H B^-1 q
//
// If no row of a contact contains an acceleration, its forces are eliminated directly: they act like a soft
// spring on its degrees of freedom. The remaining matrix has the band of the structure. Its factors cost less
// than the solves of a general method, so that factors of other states or step sizes are not kept.
//
// If contacts have changed at the same weights, rows of the factors are computed again from the first
// affected one on. This ends near the contact, where rows become bitwise equal to the old ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "linear/band_factors.hpp"
#include "linear/system_matrices.hpp"
#include "linear/system_matrix.hpp"

namespace signorini::linear {

// An order of degrees of freedom in which matrices have a narrow band (Cuthill, McKee 1969).
//
//   |place(i) - place(j)| <= width   wherever M, C, K, or one contact, couple i and j
//
// From an end of each component its neighbours follow level by level, those with few neighbours first. The ends of a
// component are far from each other: two searches for the last level find them.

struct BandOrder {
  std::vector<int> place;  ///< place of each degree of freedom
  std::size_t width = 0;
};

/// The order for all states of the model's contacts.
[[nodiscard]] BandOrder band_order(const Model& model, const SystemMatrices& structure);

// Rows of the structure and of its compliant contacts in their present states, in the order of the band.
//
//   row i of  M w_a + C w_v + K w_u - H B^-1 R      i: a place in the band; H, B, R: linear/condensed_matrix.hpp
//
// Contains the data that do not depend on the weights: entries in the order in which a band is filled, and the rows of
// each contact. It remembers the contacts that have changed, so that factors can be updated.

class CondensedRows {
 public:
  /// An entry of M, C and K: its place `at` in a row of the band, whose diagonal is at width(), and its
  /// column.
  struct Entry {
    std::uint32_t at = 0, dof = 0;
    double m = 0.0, c = 0.0, k = 0.0;
  };
  /// A degree of freedom of a contact, its place in the band, and its components of n and t.
  struct ContactDof {
    std::uint32_t dof = 0, place = 0, contact = 0;
    double n = 0.0, t = 0.0;
  };
  /// Coefficients of the two rows of a contact in its present state.
  struct ContactCoefficients {
    double normal_N = 1.0, tangent_N = 0.0, tangent_T = 1.0;
    double normal_gap = 0.0, normal_ut = 0.0, normal_vn = 0.0, normal_vt = 0.0;
    double tangent_gap = 0.0, tangent_ut = 0.0, tangent_vn = 0.0, tangent_vt = 0.0;
    bool on_motion = false;  ///< its forces follow the motion
    bool known = false;      ///< its rows determine its forces and contain no acceleration
  };

  /// Rows of a model with saves_factorisations(), with all contacts open. nullopt: the band is wider than
  /// most_width.
  [[nodiscard]] static std::optional<CondensedRows> create(const Model& model,
                                                           const SystemMatrices& structure,
                                                           std::size_t most_width);

  [[nodiscard]] std::size_t size() const { return dof_at_.size(); }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t contacts() const { return coefficients_.size(); }
  [[nodiscard]] const ForceLayout& layout() const { return layout_; }

  /// Sets the rows of one contact, or those of all contacts.
  void set_rows(std::size_t contact, const Rows& rows);
  void set_rows(const std::vector<Rows>& rows);
  /// False: a row contains an acceleration or does not determine its force.
  [[nodiscard]] bool is_determined() const { return unknown_ == 0; }
  /// Version number; each change increases it.
  [[nodiscard]] long version() const { return dropped_changes_ + static_cast<long>(changed_.size()); }
  /// Contacts whose rows were set since that version, some possibly twice. nullopt: the record does not reach
  /// back so far.
  [[nodiscard]] std::optional<std::span<const std::size_t>> changed_since(long version) const;

  /// Degree of freedom at a place of the band, and the entries of its row.
  [[nodiscard]] std::size_t dof_at(std::size_t place) const { return dof_at_[place]; }
  [[nodiscard]] std::span<const Entry> entries(std::size_t place) const {
    return {entries_.data() + entries_end_[place], entries_.data() + entries_end_[place + 1]};
  }
  [[nodiscard]] const ContactCoefficients& coefficients(std::size_t contact) const {
    return coefficients_[contact];
  }
  /// The degrees of freedom of a contact are contact_dof(i) for i from first_contact_dof() to
  /// end_of_contact_dofs(), which is excluded.
  [[nodiscard]] std::size_t first_contact_dof(std::size_t contact) const {
    return contact_dofs_end_[contact];
  }
  [[nodiscard]] std::size_t end_of_contact_dofs(std::size_t contact) const {
    return contact_dofs_end_[contact + 1];
  }
  [[nodiscard]] const ContactDof& contact_dof(std::size_t i) const { return contact_dofs_[i]; }
  /// Arguments i of contact_dof() at a place of the band, ascending by contact.
  [[nodiscard]] std::span<const std::uint32_t> contact_dofs_at(std::size_t place) const {
    return {at_place_.data() + at_place_end_[place], at_place_.data() + at_place_end_[place + 1]};
  }

  /// B^-1 R of a contact at these weights; by_N, by_T: one entry for each of its degrees of freedom.
  void force_coefficients(std::size_t contact, const Weights& weights, double* by_N, double* by_T) const;
  /// The row at a place; out: 2 width() + 1 numbers that are zero before, with the diagonal in the middle.
  void fill(std::size_t place, const Weights& weights, const double* by_N, const double* by_T,
            double* out) const;

 private:
  CondensedRows() = default;

  std::size_t width_ = 0;
  ForceLayout layout_;
  std::vector<std::size_t> dof_at_;  // degree of freedom at each place
  std::vector<Entry> entries_;
  std::vector<std::size_t> entries_end_{0};       // place by place
  std::vector<ContactDof> contact_dofs_;          // contact by contact
  std::vector<std::size_t> contact_dofs_end_{0};  // end of each contact's entries in contact_dofs_
  std::vector<std::uint32_t> at_place_;           // indices into contact_dofs_, place by place
  std::vector<std::size_t> at_place_end_{0};
  std::vector<ContactCoefficients> coefficients_;
  std::size_t unknown_ = 0;           // number of contacts whose forces are not `known`
  std::vector<std::size_t> changed_;  // the last changed contacts
  long dropped_changes_ = 0;          // number of earlier changes
};

/// Number of unknowns from which avoiding a factorisation saves time: one factorisation with 200 unknowns
/// takes about 30 us. Chosen; the tests in tests/unit/engine/newmark cover both sides.
inline constexpr int min_condensed_size = 200;
/// True if all degrees of freedom have mass, contacts share no rows, and there are at least min_condensed_size unknowns.
[[nodiscard]] bool saves_factorisations(const Model& model, const SystemMatrices& structure,
                                        const RedundantRows& shared);

class CondensedMatrix {
 public:
  /// Greatest width of the band for which the condensed matrix saves time: its n width^2 products cost as
  /// much as those of a sparse method.
  static constexpr std::size_t max_width = 16;

  /// The rows must outlive the object.
  explicit CondensedMatrix(const CondensedRows& rows);

  /// Factors the matrix with the present rows. False: the rows do not determine their forces, or elimination
  /// loses digits.
  [[nodiscard]] bool set(const Weights& weights);
  /// True if the factors belong to these weights, possibly except for contacts that have changed.
  [[nodiscard]] bool is_factored_at(const Weights& w) const {
    return set_ && w.acceleration == weights_.acceleration && w.velocity == weights_.velocity &&
           w.displacement == weights_.displacement;
  }
  /// x := A^-1 x: n degrees of freedom, then N and T of each contact.
  void solve(double* x);

  long factorisations = 0;   ///< factorisations of all rows
  long refactored_rows = 0;  ///< rows computed again after changes of contacts, in addition

 private:
  [[nodiscard]] bool factor();
  [[nodiscard]] bool refactor(std::span<const std::size_t> contacts);
  [[nodiscard]] std::optional<std::size_t> refactor(std::size_t begin);
  void fill(std::size_t begin, std::size_t end);

  const CondensedRows& rows_;
  BandFactors band_;
  Weights weights_;
  long version_ = 0;                        // version of the rows of the factors
  bool set_ = false, has_factors_ = false;  // set_: weights_ are valid
  std::vector<double> by_N_, by_T_;         // B^-1 R, one entry for each ContactDof
  std::vector<double> x_, before_;          // scratch of solve(); rows before they are computed again
  std::vector<std::size_t> touched_;        // affected places
};

}  // namespace signorini::linear
