#include "model/assembly/parts.hpp"

#include <limits>
#include <unordered_map>
#include <utility>

#include "base/containers.hpp"
#include "contact/constants.hpp"
#include "linear/unknowns.hpp"

namespace signorini::assembly {

Parts::Parts(const std::vector<const SparseMatrix*>& matrices, const std::vector<Combination>& forms) {
  const auto n = static_cast<std::size_t>(matrices.front()->rows());
  base::DisjointSets sets(n);
  for (const SparseMatrix* a : matrices)
    for (int column = 0; column < a->outerSize(); ++column)
      for (SparseMatrix::InnerIterator it(*a, column); it; ++it)
        if (it.value() != 0.0)
          sets.join(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(column));
  for (const Combination& form : forms)
    for (const auto& term : form.terms)
      sets.join(static_cast<std::size_t>(form.terms.front().first), static_cast<std::size_t>(term.first));
  part_of_.resize(n);
  index_in_part_.resize(n);
  for (const std::vector<std::size_t>& members : sets.sets()) {
    std::vector<int>& dofs = dofs_.emplace_back();
    for (const std::size_t i : members) {
      part_of_[i] = dofs_.size() - 1;
      index_in_part_[i] = static_cast<int>(dofs.size());
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
      if (all_->part_of_[row] == number_) entries.emplace_back(all_->index_in_part_[row], column, it.value());
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
      own.terms.emplace_back(all_->index_in_part_[static_cast<std::size_t>(dof)], factor);
  }
  return result;
}

std::vector<std::vector<std::size_t>> coupled_forms(const std::vector<Combination>& forms) {
  base::DisjointSets sets(forms.size());
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
  base::DisjointSets sets(forms.size());
  std::unordered_map<std::size_t, std::size_t> first;  // first contact on a part
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (!forms[i].terms.empty())
      sets.join(i, first.emplace(parts.part_of(forms[i].terms.front().first), i).first->second);
  return sets.sets();
}

SparseMatrix selection(const std::vector<int>& indices, int n) {
  SparseMatrix s(n, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t j = 0; j < indices.size(); ++j) s.insert(indices[j], static_cast<int>(j)) = 1.0;
  return s;
}

SparseMatrix select_by_mass(const SparseMatrix& mass, bool with_mass) {
  const auto n = static_cast<int>(mass.rows());
  std::vector<int> indices;
  for (int i = 0; i < n; ++i)
    if ((mass.coeff(i, i) > 0.0) == with_mass) indices.push_back(i);
  return selection(indices, n);
}

int degrees_with_mass(const SparseMatrix& mass) {
  return static_cast<int>((mass.diagonal().array() > 0.0).count());
}

namespace {

constexpr std::size_t most_pieces = 2000000;  // pieces of histories in all copies together: about 300 MB

/// One form per contact, with all degrees of freedom on which the contact acts.
std::vector<Combination> reaches(const Model& model) {
  std::vector<Combination> forms;
  for (const Contact& contact : model.contacts) {
    auto& terms = forms.emplace_back().terms;
    contact::visit_forms(
        contact, [&](const Combination& f) { terms.insert(terms.end(), f.terms.begin(), f.terms.end()); });
  }
  return forms;
}

std::size_t history_piece_count(const Model& model) {
  std::size_t count = 0;
  for (const Load& load : model.loads) count += load.history.pieces().size();
  return count;
}

/// Assigns degrees of freedom, contacts and loads to parts, and numbers them within each part.
class Split {
 public:
  explicit Split(const Model& model) : model_(model), part_of_(model.dofs.size()), place_(model.dofs.size()) {
    const std::vector<Combination> forms = reaches(model);
    const Parts coupled({&model.mass, &model.damping, &model.stiffness}, forms);
    std::vector<std::size_t> part_of_set(coupled.count(), none);
    for (std::size_t k = 0; k < forms.size(); ++k) {
      // A form without terms belongs to the part of the first degree of freedom.
      const int dof = forms[k].terms.empty() ? 0 : forms[k].terms.front().first;
      std::size_t& part = part_of_set[coupled.part_of(dof)];
      if (part == none) {
        part = parts_.size();
        parts_.emplace_back();
      }
      parts_[part].contacts.push_back(k);
    }
    with_contacts_ = parts_.size();
    for (std::size_t i = 0; i < part_of_.size(); ++i) {
      std::size_t part = part_of_set[coupled.part_of(static_cast<int>(i))];
      if (part == none) {
        part = with_contacts_;
        if (parts_.size() == part) parts_.emplace_back();
      }
      part_of_[i] = part;
      place_[i] = static_cast<int>(parts_[part].dofs.size());
      parts_[part].dofs.push_back(static_cast<int>(i));
    }
  }

  /// Number of parts that have contacts.
  [[nodiscard]] std::size_t with_contacts() const { return with_contacts_; }
  [[nodiscard]] std::size_t count() const { return parts_.size(); }

  [[nodiscard]] std::vector<PartModel> models() {
    for (PartModel& part : parts_) part.model = linear::restricted(model_, part.dofs, part.contacts);
    divide_loads();
    for (auto own : model_.columns) {
      std::size_t part = 0;
      if (own.dof >= 0) {
        part = part_of_[static_cast<std::size_t>(own.dof)];
        own.dof = place_[static_cast<std::size_t>(own.dof)];
      }
      parts_[part].model.columns.push_back(std::move(own));
    }
    return std::move(parts_);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void divide_loads() {
    std::vector<std::size_t> last(parts_.size(),
                                  none);  // for each part: index of the last load that was added to the part
    for (std::size_t i = 0; i < model_.loads.size(); ++i) {
      const Load& load = model_.loads[i];
      const auto give = [&](std::size_t part) -> Load& {
        std::vector<Load>& loads = parts_[part].model.loads;
        if (std::exchange(last[part], i) != i) {
          Load own = linear::without_direction(load);
          loads.push_back(std::move(own));
        }
        return loads.back();
      };
      for (const auto& [dof, factor] : load.direction.terms)
        give(part_of_[static_cast<std::size_t>(dof)])
            .direction.terms.emplace_back(place_[static_cast<std::size_t>(dof)], factor);
      if (load.direction.terms.empty()) give(0);
    }
  }

  const Model& model_;
  std::vector<PartModel> parts_;
  std::vector<std::size_t> part_of_;  // one per degree of freedom
  std::vector<int> place_;            // per degree of freedom: its number in its part
  std::size_t with_contacts_ = 0;
};

}  // namespace

std::vector<PartModel> part_models(const Model& model) {
  if (model.size() == 0 || !model.is_physical() || !model.outputs.empty() || !model.reaction_sums.empty())
    return {};
  Split split(model);
  if (split.with_contacts() < 2 || split.count() * history_piece_count(model) > most_pieces) return {};
  return split.models();
}

}  // namespace signorini::assembly
