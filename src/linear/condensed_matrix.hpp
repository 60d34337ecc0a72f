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
// If contact states change while the weights stay the same, rows of the factors are computed again, starting with the first
// affected row. The computation ends a few rows after the contact, as soon as the new rows are bitwise equal to the old ones.
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

// Order of the degrees of freedom in which M, C and K have a narrow band (Cuthill, McKee 1969).
//
//   |place(i) - place(j)| <= width   wherever M, C, K, or one contact, couple i and j
//
// Each connected component is numbered level by level, starting at one of its ends; degrees of freedom with few neighbours
// come first. Two searches by levels find an end: the second one starts at the last degree of freedom of the first one.

struct BandOrder {
  std::vector<int> place;  ///< place of each degree of freedom in the order
  std::size_t width = 0;   ///< largest distance of the places of two coupled degrees of freedom
};

/// Order that is valid for all states of the model's contacts.
[[nodiscard]] BandOrder band_order(const Model& model, const SystemMatrices& structure);

// Data of the condensed matrix for the present contact states, in the order of the band.
//
//   row i of  M w_a + C w_v + K w_u - H B^-1 R      i: a place in the band; H, B, R: linear/condensed_matrix.hpp
//
// Contains the data that do not depend on the weights: the entries of M, C and K in the order of the band, and the rows of
// each contact. It also records which contacts have changed, so that factors can be updated.

class CondensedRows {
 public:
  /// An entry of M, C and K. at: index in the row of the band, where the diagonal has the index width(); dof: column of M.
  struct Entry {
    std::uint32_t at = 0, dof = 0;
    double m = 0.0, c = 0.0, k = 0.0;
  };
  /// A degree of freedom on which a contact acts, its place in the band, and its factors in the forms n and t of the contact.
  struct ContactDof {
    std::uint32_t dof = 0, place = 0, contact = 0;
    double n = 0.0, t = 0.0;
  };
  /// Coefficients of the two rows of a contact in its present state; tangent_gap: factor of the gap in the tangent row.
  struct ContactCoefficients {
    double normal_N = 1.0, tangent_N = 0.0, tangent_T = 1.0;
    double normal_gap = 0.0, normal_ut = 0.0, normal_vn = 0.0, normal_vt = 0.0;
    double tangent_gap = 0.0, tangent_ut = 0.0, tangent_vn = 0.0, tangent_vt = 0.0;
    bool on_motion = false;  ///< the contact's forces depend on the motion
    bool known = false;      ///< the contact's rows determine its forces and contain no acceleration
  };

  /// Rows of a model for which saves_factorisations() is true; the caller then sets the rows of every contact with set_rows().
  /// nullopt: the band is wider than most_width.
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
  [[nodiscard]] bool is_determined() const { return undetermined_count_ == 0; }
  /// Version number, which increases by one whenever the rows of a contact are set.
  [[nodiscard]] long version() const { return dropped_changes_ + static_cast<long>(changed_.size()); }
  /// Contacts whose rows were set after version() had the given value; a contact may occur several times. nullopt: the version
  /// is older than the record of changes.
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

  /// Computes the rows of N and T in B^-1 R with these weights. by_N, by_T: entry i belongs to contact_dof(i); only the entries
  /// of the given contact are written.
  void force_coefficients(std::size_t contact, const Weights& weights, double* by_N, double* by_T) const;
  /// Computes the row of the condensed matrix at a place in the band. out: 2 width() + 1 numbers, which the caller has set to
  /// zero; the diagonal is in the middle.
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
  std::size_t undetermined_count_ = 0;  // number of contacts with ContactCoefficients::known = false
  std::vector<std::size_t> changed_;    // contact of each recorded change, the latest at the end
  long dropped_changes_ = 0;            // number of earlier changes that are no longer in changed_
};

/// Smallest number of unknowns for which a condensed matrix saves time: one factorisation with 200 unknowns takes about 30 us.
/// Chosen value; the tests in tests/unit/engine/newmark cover smaller and larger models.
inline constexpr int min_condensed_size = 200;
/// True if all degrees of freedom have mass, no contacts constrain the same motion, and the model has at least
/// min_condensed_size unknowns.
[[nodiscard]] bool saves_factorisations(const Model& model, const SystemMatrices& structure,
                                        const RedundantRows& shared);

class CondensedMatrix {
 public:
  /// Largest band width for which the condensed matrix saves time. The n width^2 products of a wider band cost as much as a
  /// sparse factorisation.
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
  long version_ = 0;                        // version of rows_ at the last set()
  bool set_ = false, has_factors_ = false;  // set_: weights_ are valid
  std::vector<double> by_N_, by_T_;         // B^-1 R, one entry per ContactDof
  std::vector<double> x_, before_;    // x_: scratch of solve(); before_: rows of the factors before an update
  std::vector<std::size_t> touched_;  // places in the band that changes of contacts affect
};

}  // namespace signorini::linear
