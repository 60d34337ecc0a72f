// condensed_matrix.hpp: the system matrix of compliant contacts, with the contact forces eliminated.
//
//   | S  H | | x |   | b |       S = M w_a + C w_v + K w_u,  the same weights for all dofs
//   | R  B | | f | = | q |       f = B^-1 (q - R x)   contact by contact
//   (S - H B^-1 R) x = b - H B^-1 q
//
// If no row of a contact contains an acceleration, its forces are eliminated: they act on its degrees of freedom like a soft
// spring. The remaining matrix has the band of the structure. Its factorisation costs less than a solve by a general sparse
// method, so factors of other states or step sizes are not kept.
//
// If contacts change while the weights stay the same, rows of the factors are computed again from the first affected row on.
// This ends near the contact, where the rows become bitwise equal to the old ones.
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

// An order of the degrees of freedom in which matrices have a narrow band (Cuthill, McKee 1969).
//
//   |place(i) - place(j)| <= width   wherever M, C, K, or one contact, couple i and j
//
// In each connected component, degrees of freedom are numbered from one end of the component, level by level, those with few
// neighbours first. The ends of a component are far from each other; two searches for the last level find them.

struct BandOrder {
  std::vector<int> place;  ///< place in the order, by degree of freedom
  std::size_t width = 0;
};

/// Order that is valid for all states of the model's contacts.
[[nodiscard]] BandOrder band_order(const Model& model, const SystemMatrices& structure);

// Rows of the structure and of its compliant contacts in their present states, in the order of the band matrix.
//
//   row i of  M w_a + C w_v + K w_u - H B^-1 R      i: a place in the band; H, B, R: linear/condensed_matrix.hpp
//
// Contains the data that do not depend on the weights: entries in the order in which the band is filled, and the rows of each
// contact. It also records which contacts have changed, so that factors can be updated.

class CondensedRows {
 public:
  /// An entry of M, C and K. `at`: its place in a row of the band, whose diagonal is at width(); `dof`: its column.
  struct Entry {
    std::uint32_t at = 0, dof = 0;
    double m = 0.0, c = 0.0, k = 0.0;
  };
  /// A degree of freedom of a contact, its place in the band, and its components in the forms n and t.
  struct ContactDof {
    std::uint32_t dof = 0, place = 0, contact = 0;
    double n = 0.0, t = 0.0;
  };
  /// Coefficients of the two rows of a contact in its present state.
  struct ContactCoefficients {
    double normal_N = 1.0, tangent_N = 0.0, tangent_T = 1.0;
    double normal_gap = 0.0, normal_ut = 0.0, normal_vn = 0.0, normal_vt = 0.0;
    double tangent_gap = 0.0, tangent_ut = 0.0, tangent_vn = 0.0, tangent_vt = 0.0;
    bool on_motion = false;  ///< the contact's forces depend on the motion
    bool known = false;      ///< the contact's rows determine its forces and contain no acceleration
  };

  /// Rows of a model with saves_factorisations(), with all contacts open. nullopt: the band is wider than most_width.
  [[nodiscard]] static std::optional<CondensedRows> create(const Model& model,
                                                           const SystemMatrices& structure,
                                                           std::size_t most_width);

  [[nodiscard]] std::size_t size() const { return dof_at_.size(); }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t contacts() const { return coefficients_.size(); }
  [[nodiscard]] const ForceLayout& layout() const { return layout_; }

  /// Sets the rows of one contact.
  void set_rows(std::size_t contact, const Rows& rows);
  /// Sets the rows of all contacts.
  void set_rows(const std::vector<Rows>& rows);
  /// True if the rows of every contact determine its forces and contain no acceleration.
  [[nodiscard]] bool is_determined() const { return unknown_ == 0; }
  /// Version number, which each change increases by one.
  [[nodiscard]] long version() const { return dropped_changes_ + static_cast<long>(changed_.size()); }
  /// Contacts whose rows were set since that version; a contact may occur twice. nullopt: the record does not reach back to
  /// that version.
  [[nodiscard]] std::optional<std::span<const std::size_t>> changed_since(long version) const;

  /// Degree of freedom at a place in the band.
  [[nodiscard]] std::size_t dof_at(std::size_t place) const { return dof_at_[place]; }
  /// Entries of M, C and K in the row at a place in the band.
  [[nodiscard]] std::span<const Entry> entries(std::size_t place) const {
    return {entries_.data() + entries_end_[place], entries_.data() + entries_end_[place + 1]};
  }
  [[nodiscard]] const ContactCoefficients& coefficients(std::size_t contact) const {
    return coefficients_[contact];
  }
  /// The degrees of freedom of a contact are contact_dof(i) for first_contact_dof() <= i < end_of_contact_dofs().
  [[nodiscard]] std::size_t first_contact_dof(std::size_t contact) const {
    return contact_dofs_end_[contact];
  }
  [[nodiscard]] std::size_t end_of_contact_dofs(std::size_t contact) const {
    return contact_dofs_end_[contact + 1];
  }
  [[nodiscard]] const ContactDof& contact_dof(std::size_t i) const { return contact_dofs_[i]; }
  /// Indices i of contact_dof() that belong to a place in the band, ascending by contact.
  [[nodiscard]] std::span<const std::uint32_t> contact_dofs_at(std::size_t place) const {
    return {at_place_.data() + at_place_end_[place], at_place_.data() + at_place_end_[place + 1]};
  }

  /// B^-1 R of a contact with these weights; by_N, by_T: one entry for each degree of freedom of the contact.
  void force_coefficients(std::size_t contact, const Weights& weights, double* by_N, double* by_T) const;
  /// Computes the row at a place. out: 2 width() + 1 numbers, zero before the call, with the diagonal in the middle.
  void fill(std::size_t place, const Weights& weights, const double* by_N, const double* by_T,
            double* out) const;

 private:
  CondensedRows() = default;

  std::size_t width_ = 0;
  ForceLayout layout_;
  std::vector<std::size_t> dof_at_;  // degree of freedom, by place
  std::vector<Entry> entries_;
  std::vector<std::size_t> entries_end_{0};       // end of each place's entries in entries_
  std::vector<ContactDof> contact_dofs_;          // sorted by contact
  std::vector<std::size_t> contact_dofs_end_{0};  // end of each contact's entries in contact_dofs_
  std::vector<std::uint32_t> at_place_;           // indices into contact_dofs_, sorted by place
  std::vector<std::size_t> at_place_end_{0};
  std::vector<ContactCoefficients> coefficients_;
  std::size_t unknown_ = 0;           // number of contacts whose forces are not `known`
  std::vector<std::size_t> changed_;  // contacts of the last changes, in order
  long dropped_changes_ = 0;          // number of earlier changes that are no longer in changed_
};

/// Number of unknowns from which avoiding a factorisation saves time; one factorisation with 200 unknowns takes about 30 us.
/// Chosen value; the tests in tests/unit/engine/newmark cover smaller and larger models.
inline constexpr int min_condensed_size = 200;
/// True if all degrees of freedom have mass, contacts share no rows, and there are at least min_condensed_size unknowns.
[[nodiscard]] bool saves_factorisations(const Model& model, const SystemMatrices& structure,
                                        const RedundantRows& shared);

class CondensedMatrix {
 public:
  /// Largest band width for which the condensed matrix saves time; with a wider band its n width^2 products cost as much as a
  /// sparse method.
  static constexpr std::size_t max_width = 16;

  /// The rows must outlive the object.
  explicit CondensedMatrix(const CondensedRows& rows);

  /// Factors the matrix with the present rows. False: the rows do not determine the contact forces, or factoring loses too
  /// many digits.
  [[nodiscard]] bool set(const Weights& weights);
  /// True if the factors were computed with these weights; contacts may have changed since.
  [[nodiscard]] bool is_factored_at(const Weights& w) const {
    return set_ && w.acceleration == weights_.acceleration && w.velocity == weights_.velocity &&
           w.displacement == weights_.displacement;
  }
  /// x := A^-1 x. x: n degrees of freedom, then N and T of each contact.
  void solve(double* x);

  long factorisations = 0;   ///< number of factorisations of all rows
  long refactored_rows = 0;  ///< number of rows factored again after changes of contacts

 private:
  [[nodiscard]] bool factor();
  [[nodiscard]] bool refactor(std::span<const std::size_t> contacts);
  [[nodiscard]] std::optional<std::size_t> refactor(std::size_t begin);
  void fill(std::size_t begin, std::size_t end);

  const CondensedRows& rows_;
  BandFactors band_;
  Weights weights_;
  long version_ = 0;                        // version of rows_ in the factors
  bool set_ = false, has_factors_ = false;  // set_: weights_ are valid
  std::vector<double> by_N_, by_T_;         // B^-1 R, one entry per ContactDof
  std::vector<double> x_, before_;          // scratch of solve(); factors before an update
  std::vector<std::size_t> touched_;        // places in the band that changes of contacts affect
};

}  // namespace signorini::linear
