#include "linear/undamped_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/rounding.hpp"

namespace signorini::linear {
namespace {

/// Solution for one degree of freedom: x_dof = (normal r + tangent q)/divisor.
struct Share {
  int dof = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// Solves n . x = r, t . x = q for two degrees of freedom. nullopt: the forms do not consist of the same two degrees of
/// freedom, or they are linearly dependent.
std::optional<std::array<Share, 2>> shares(const Combination& n, const Combination& t) {
  if (n.terms.size() != 2 || t.terms.size() != 2) return std::nullopt;
  const auto [i, ni] = n.terms[0];
  const auto [j, nj] = n.terms[1];
  const bool same = t.terms[0].first == i && t.terms[1].first == j;
  if (!same && !(t.terms[0].first == j && t.terms[1].first == i)) return std::nullopt;
  const double ti = t.terms[same ? 0 : 1].second, tj = t.terms[same ? 1 : 0].second;
  const double det = ni * tj - nj * ti;
  if (det == 0.0) return std::nullopt;
  return std::array<Share, 2>{{{i, tj, -nj, det}, {j, -ti, ni, det}}};
}

}  // namespace

std::vector<PrescribedDof> prescribed_dofs(const Model& model, const std::vector<Rows>& rows) {
  std::vector<PrescribedDof> result;
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const bool held = rows[c].normal.an != 0.0 && rows[c].normal.N == 0.0, sticks = rows[c].tangent.at != 0.0;
    if (held && contact.normal.terms.size() == 1) {
      const auto [dof, factor] = contact.normal.terms[0];
      result.push_back({static_cast<std::size_t>(dof), c, 1.0, 0.0, factor});
    }
    if (sticks && contact.tangent.terms.size() == 1) {
      const auto [dof, factor] = contact.tangent.terms[0];
      result.push_back({static_cast<std::size_t>(dof), c, 0.0, 1.0, factor});
    }
    if (!held || !sticks) continue;
    if (const auto both = shares(contact.normal, contact.tangent))
      for (const Share& share : *both)
        result.push_back(
            {static_cast<std::size_t>(share.dof), c, share.normal, share.tangent, share.divisor});
  }
  return result;
}

void set_exactly(const Combination& form, double value, Vector& x) {
  if (form.terms.size() == 1) x[form.terms[0].first] = value / form.terms[0].second + 0.0;  // + 0.0 avoids -0
}

void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x) {
  set_exactly(n, r, x);
  set_exactly(t, q, x);
  if (const auto both = shares(n, t))
    for (const Share& share : *both)
      x[share.dof] = (share.normal * r + share.tangent * q) / share.divisor + 0.0;
}

namespace {

using SparseRow = std::map<int, double>;

/// a += factor b. Entries that cancel up to rounding are removed.
void add_row(SparseRow& a, double factor, const SparseRow& b) {
  for (const auto& [dof, value] : b) {
    double& entry = a[dof];
    const double change = factor * value, size = std::abs(entry) + std::abs(change);
    entry += change;
    if (std::abs(entry) <= rounding::many_operations * size) a.erase(dof);
  }
}

/// Velocity on which the row depends, as a form restricted to degrees of freedom with neither mass nor damper.
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

/// Linearly independent rows in reduced form: each row is one in its pivot column, where all other rows are zero.
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
  std::map<int, SparseRow> rows_;  // rows by pivot column
};

/// Forms of all velocities on which rows of the contact depend in some state.
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

MotionKinds kinds_in_states(const std::vector<DofKind>& own, const Model& model,
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

std::vector<std::vector<int>> joint_undamped_dofs(const std::vector<DofKind>& own, const Model& model) {
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

}  // namespace signorini::linear
