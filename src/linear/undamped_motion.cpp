#include "linear/undamped_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/rounding.hpp"

namespace signorini {
namespace {

using SparseRow = std::map<int, double>;

/// a += factor b; cancelled entries are removed.
void add_row(SparseRow& a, double factor, const SparseRow& b) {
  for (const auto& [dof, value] : b) {
    double& entry = a[dof];
    const double change = factor * value, size = std::abs(entry) + std::abs(change);
    entry += change;
    if (std::abs(entry) <= rounding::of_many * size) a.erase(dof);
  }
}

/// The velocity that a row depends on, on degrees of freedom without other damping.
SparseRow velocity_of(const Form& row, const Contact& contact, const std::vector<DofKind>& own) {
  SparseRow result;
  const auto add = [&](const Combination& form, double factor) {
    if (factor == 0.0) return;
    SparseRow part;
    for (const auto& [dof, value] : form.terms)
      if (own[static_cast<std::size_t>(dof)] == DofKind::algebraic && value != 0.0)
        part[dof] += factor * value;
    add_row(result, 1.0, part);
  };
  add(contact.normal, row.vn);
  add(contact.tangent, row.vt);
  return result;
}

/// Rows in reduced form: each is one at its own column, where all others are zero.
class Elimination {
 public:
  void add(SparseRow row) {
    for (auto& [pivot, reduced] : rows_)
      if (const auto at = row.find(pivot); at != row.end()) {
        const double factor = -at->second;
        add_row(row, factor, reduced);
        row.erase(pivot);
      }
    if (row.empty()) return;
    const int pivot = std::max_element(row.begin(), row.end(), [](const auto& a, const auto& b) {
                        return std::abs(a.second) < std::abs(b.second);
                      })->first;
    const double value = row[pivot];
    for (auto& entry : row) entry.second /= value;
    row[pivot] = 1.0;
    for (auto& other : rows_)
      if (const auto at = other.second.find(pivot); at != other.second.end()) {
        const double factor = -at->second;
        add_row(other.second, factor, row);
        other.second.erase(pivot);
      }
    rows_.emplace(pivot, std::move(row));
  }
  [[nodiscard]] const std::map<int, SparseRow>& rows() const { return rows_; }

 private:
  std::map<int, SparseRow> rows_;  // by column
};

/// Terms of the velocities that rows of the contact may depend on, each in one of its states.
std::vector<Combination> velocities_of(const Contact& contact) {
  if (!contact.obeys_coulomb()) {
    Combination both = contact.normal;
    both.terms.insert(both.terms.end(), contact.tangent.terms.begin(), contact.tangent.terms.end());
    return {both};
  }
  std::vector<Combination> result;
  if (contact.normal_damping != 0.0) result.push_back(contact.normal);
  if (contact.sliding_point()) result.push_back(contact.tangent);
  return result;
}

}  // namespace

MotionKinds kinds_in_mode(const std::vector<DofKind>& own, const Model& model,
                          const std::vector<Rows>& rows) {
  MotionKinds result{own, {}};
  Elimination elimination;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const Form* row : {&rows[k].normal, &rows[k].tangent}) {
      if (row->vn == 0.0 && row->vt == 0.0) continue;
      if (SparseRow velocity = velocity_of(*row, model.contacts[k], own); !velocity.empty())
        elimination.add(std::move(velocity));
    }
  std::map<int, UndampedMotion> motions;
  for (const auto& [pivot, row] : elimination.rows()) {
    result.kinds[static_cast<std::size_t>(pivot)] = DofKind::damped;
    for (const auto& [dof, value] : row)
      if (dof != pivot) motions[dof].others.emplace_back(pivot, -value);
  }
  for (auto& [dof, motion] : motions) {
    motion.dof = dof;
    result.undamped.push_back(std::move(motion));
  }
  return result;
}

std::vector<std::vector<int>> undamped_together(const std::vector<DofKind>& own, const Model& model) {
  std::map<int, int> leader;  // representative of the set that contains a degree of freedom
  const auto find = [&](int dof) {
    int at = leader.emplace(dof, dof).first->second;
    while (leader[at] != at) at = leader[at];
    return at;
  };
  for (const Contact& contact : model.contacts)
    for (const Combination& form : velocities_of(contact)) {
      int first = -1;
      for (const auto& term : form.terms) {
        if (own[static_cast<std::size_t>(term.first)] != DofKind::algebraic) continue;
        if (first < 0) first = term.first;
        leader[find(term.first)] = find(first);
      }
    }
  std::map<int, std::vector<int>> sets;
  for (const auto& entry : leader) sets[find(entry.first)].push_back(entry.first);
  std::vector<std::vector<int>> result;
  for (auto& entry : sets)
    if (entry.second.size() > 1) result.push_back(std::move(entry.second));
  return result;
}

}  // namespace signorini
