// parts.hpp: the parts of a structure that nothing couples.
//
//   P^T A P = diag(A_1, A_2, ...)   for all given matrices at once; every form acts on one part only
//
// A hundred blocks on a floor are a hundred structures: what costs n^3 then costs the sum of n_i^3, and a
// frequency that all of them have is found once in each.
//
//   const Parts parts({&mass, &k}, fixed);
//   for (const Part& part : parts) use(part.matrix(mass), part.forms(fixed));
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

class Parts;

/// Some degrees of freedom, ascending, and what of matrices and forms lies on them.
class Part {
 public:
  Part(const Parts& all, std::size_t number) : all_(&all), number_(number) {}

  [[nodiscard]] const std::vector<int>& dofs() const;
  [[nodiscard]] int size() const { return static_cast<int>(dofs().size()); }
  /// n_i x n_i
  [[nodiscard]] SparseMatrix matrix(const SparseMatrix& a) const;
  /// Those that act on this part, on its own numbers, in their order. A form without terms is on none.
  [[nodiscard]] std::vector<Combination> forms(const std::vector<Combination>& forms) const;

 private:
  const Parts* all_;
  std::size_t number_;
};

class Parts {
 public:
  /// Matrices n x n, n > 0, with symmetric patterns; entries that are zero couple nothing.
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
  std::vector<std::size_t> part_of_;  // one a degree of freedom
  std::vector<int> place_in_;         // its number in its part
  std::vector<Part> parts_;
};

/// Forms that act on common degrees of freedom, directly or through others: indices, ascending, in the order
/// of the first of each group. Forms without terms are alone.
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_forms(const std::vector<Combination>& forms);

/// Contacts whose forces reach each other through M, C, K and other contacts, in the same way.
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_contacts(const Model& model);

}  // namespace signorini
