// parts.hpp: uncoupled parts (substructures) of a structure.
//
//   P^T A P = diag(A_1, A_2, ...)   for all given matrices at once; every form acts on one part only
//
// A scene may have many uncoupled parts (a hundred blocks on a floor). A cost O(n^3) then becomes the sum of n_i^3, and
// a frequency that all parts have in common is found once in each part.
//
//   const Parts parts({&mass, &k}, fixed);
//   for (const Part& part : parts) use(part.matrix(mass), part.forms(fixed));
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini::assembly {

class Parts;

/// A set of degrees of freedom, ascending, and the restriction of matrices and forms to it.
class Part {
 public:
  Part(const Parts& all, std::size_t number) : all_(&all), number_(number) {}

  [[nodiscard]] const std::vector<int>& dofs() const;
  [[nodiscard]] int size() const { return static_cast<int>(dofs().size()); }
  /// Block of A with the rows and columns of this part, n_i x n_i.
  [[nodiscard]] SparseMatrix matrix(const SparseMatrix& a) const;
  /// Returns the given forms that act on this part, in the same order, with the part's numbers. A form without terms
  /// acts on no part.
  [[nodiscard]] std::vector<Combination> forms(const std::vector<Combination>& forms) const;

 private:
  const Parts* all_;
  std::size_t number_;
};

class Parts {
 public:
  /// Matrices n x n, n > 0, with symmetric patterns; zero entries couple nothing.
  explicit Parts(const std::vector<const SparseMatrix*>& matrices,
                 const std::vector<Combination>& forms = {});
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  [[nodiscard]] std::size_t count() const { return parts_.size(); }
  [[nodiscard]] std::size_t part_of(int dof) const { return part_of_[static_cast<std::size_t>(dof)]; }
  [[nodiscard]] std::vector<Part>::const_iterator begin() const { return parts_.begin(); }
  [[nodiscard]] std::vector<Part>::const_iterator end() const { return parts_.end(); }

 private:
  friend class Part;
  std::vector<std::vector<int>> dofs_;
  std::vector<std::size_t> part_of_;  // for each degree of freedom: its part
  std::vector<int> index_in_part_;    // per degree of freedom: its number in its part
  std::vector<Part> parts_;
};

/// Groups of forms that act on common degrees of freedom, directly or through other forms. Indices in a group
/// ascend, and groups are in the order of their first forms. A form without terms is a separate group.
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_forms(const std::vector<Combination>& forms);

/// Groups of contacts whose forces are coupled through M, C, K and other contacts; in the order of
/// coupled_forms().
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_contacts(const Model& model);

// Some rows and columns of a sparse matrix.
//
//   S = [e_i1 e_i2 ...],   S^T A S = A(i, i),   S x scatters x to its original positions

/// Selection matrix S, n x m, where m is the number of indices.
[[nodiscard]] SparseMatrix selection(const std::vector<int>& indices, int n);

/// Selection S of the degrees of freedom with mass > 0, or of those without mass.
[[nodiscard]] SparseMatrix select_by_mass(const SparseMatrix& mass, bool with_mass);

/// Number of degrees of freedom with mass.
[[nodiscard]] int degrees_with_mass(const SparseMatrix& mass);

// Splits a model into uncoupled models.
//
//   M, C, K, n_k, t_k:   block by block (parts.hpp);   P_i: restriction of P(t) to block i
//
// The contacts of one part are coupled with each other; the last part contains everything that is not coupled with a
// contact. A part has the loads that act on it; loads without effect belong to the first part. A part keeps the
// scales, frequencies and Rayleigh factors of the whole model, so that a run of the part makes the same decisions.

struct PartModel {
  Model model;            ///< data needed by a run: without outputs, names of other parts and drawing
  std::vector<int> dofs;  ///< the part's degrees of freedom, by number in the whole model, ascending
  std::vector<std::size_t> contacts;  ///< the part's contacts, by index in the whole model, ascending
};

/// Parts in the order of their first contacts. Empty if all contacts are coupled; if the model is reduced, has rigid
/// bodies or has outputs, which may be sums over parts; or if the histories are too long for one copy per part.
[[nodiscard]] std::vector<PartModel> part_models(const Model& model);

}  // namespace signorini::assembly
