#include "model/assembly/parts.hpp"

#include <unordered_map>

#include "base/disjoint_sets.hpp"

namespace signorini {

Parts::Parts(const std::vector<const SparseMatrix*>& matrices, const std::vector<Combination>& forms) {
  const auto n = static_cast<std::size_t>(matrices.front()->rows());
  DisjointSets sets(n);
  for (const SparseMatrix* a : matrices)
    for (int column = 0; column < a->outerSize(); ++column)
      for (SparseMatrix::InnerIterator it(*a, column); it; ++it)
        if (it.value() != 0.0)
          sets.join(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(column));
  for (const Combination& form : forms)
    for (const auto& term : form.terms)
      sets.join(static_cast<std::size_t>(form.terms.front().first), static_cast<std::size_t>(term.first));
  part_of_.resize(n);
  place_in_.resize(n);
  for (const std::vector<std::size_t>& members : sets.sets()) {
    std::vector<int>& dofs = dofs_.emplace_back();
    for (const std::size_t i : members) {
      part_of_[i] = dofs_.size() - 1;
      place_in_[i] = static_cast<int>(dofs.size());
      dofs.push_back(static_cast<int>(i));
    }
  }
  for (std::size_t i = 0; i < dofs_.size(); ++i) parts_.emplace_back(*this, i);
}

const std::vector<int>& Part::dofs() const { return all_->dofs_[number_]; }

SparseMatrix Part::matrix(const SparseMatrix& a) const {
  if (all_->count() == 1) return a;
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < size(); ++column)
    for (SparseMatrix::InnerIterator it(a, dofs()[static_cast<std::size_t>(column)]); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      if (all_->part_of_[row] == number_) entries.emplace_back(all_->place_in_[row], column, it.value());
    }
  SparseMatrix result(size(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<Combination> Part::forms(const std::vector<Combination>& forms) const {
  std::vector<Combination> result;
  for (const Combination& form : forms) {
    if (form.terms.empty() || all_->part_of_[static_cast<std::size_t>(form.terms.front().first)] != number_)
      continue;
    Combination& own = result.emplace_back();
    for (const auto& [dof, factor] : form.terms)
      own.terms.emplace_back(all_->place_in_[static_cast<std::size_t>(dof)], factor);
  }
  return result;
}

std::vector<std::vector<std::size_t>> coupled_forms(const std::vector<Combination>& forms) {
  DisjointSets sets(forms.size());
  std::unordered_map<int, std::size_t> first;  // first form that acts on a degree of freedom
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (const auto& term : forms[i].terms) sets.join(i, first.emplace(term.first, i).first->second);
  return sets.sets();
}

std::vector<std::vector<std::size_t>> coupled_contacts(const Model& model) {
  std::vector<Combination> forms;  // one per contact
  for (const Contact& c : model.contacts) {
    Combination& form = forms.emplace_back(c.normal);
    form.terms.insert(form.terms.end(), c.tangent.terms.begin(), c.tangent.terms.end());
  }
  const Parts parts({&model.mass, &model.damping, &model.stiffness}, forms);
  DisjointSets sets(forms.size());
  std::unordered_map<std::size_t, std::size_t> first;  // first contact on a part
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (!forms[i].terms.empty())
      sets.join(i, first.emplace(parts.part_of(forms[i].terms.front().first), i).first->second);
  return sets.sets();
}

}  // namespace signorini
