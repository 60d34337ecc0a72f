#include "linear/system_matrix.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace signorini::linear {
namespace {

/// The sparsity pattern: sets of rows, column by column.
class Pattern {
 public:
  explicit Pattern(int size) : columns_(static_cast<std::size_t>(size)) {}
  void add(int row, int column) { columns_[static_cast<std::size_t>(column)].insert(row); }
  /// Gives each of these columns the union of their rows.
  void unite(const std::vector<int>& columns) {
    std::set<int> all;
    for (const int j : columns) {
      const std::set<int>& own = columns_[static_cast<std::size_t>(j)];
      all.insert(own.begin(), own.end());
    }
    for (const int j : columns) columns_[static_cast<std::size_t>(j)] = all;
  }
  void compress(std::vector<std::int64_t>& start, std::vector<std::int64_t>& rows) const {
    start.assign(1, 0);
    rows.clear();
    for (const auto& column : columns_) {
      rows.insert(rows.end(), column.begin(), column.end());
      start.push_back(static_cast<std::int64_t>(rows.size()));
    }
  }

 private:
  std::vector<std::set<int>> columns_;
};

/// Rows and columns of contact forces in the matrix; they follow the rows and columns of the degrees of freedom.
struct ForcePlaces {
  int dofs;
  const ForceLayout& layout;

  [[nodiscard]] int normal(std::size_t contact) const {
    return dofs + static_cast<int>(layout.normal(contact));
  }
  [[nodiscard]] int tangent(std::size_t contact) const {
    return dofs + static_cast<int>(layout.tangent(contact));
  }
  [[nodiscard]] std::array<int, 2> of(std::size_t contact) const {
    return {normal(contact), tangent(contact)};
  }
  /// Rows of those places of the layout that have no force.
  [[nodiscard]] std::vector<int> unused() const {
    std::vector<int> result;
    for (std::size_t place = 0; place < layout.size(); ++place)
      if (!layout.is_used(place)) result.push_back(dofs + static_cast<int>(place));
    return result;
  }
};

std::size_t position(const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& rows, int row,
                     int column) {
  const auto begin = rows.begin() + start[static_cast<std::size_t>(column)];
  const auto end = rows.begin() + start[static_cast<std::size_t>(column) + 1];
  return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows.begin());
}

std::vector<int> touched(const Contact& contact) {
  std::set<int> dofs;
  for (const auto& term : contact.normal.terms) dofs.insert(term.first);
  for (const auto& term : contact.tangent.terms) dofs.insert(term.first);
  return {dofs.begin(), dofs.end()};
}

Pattern pattern_of(const Model& model, const SystemMatrices& structure, const RedundantRows& shared) {
  const ForcePlaces at{structure.size, model.layout};
  Pattern pattern(structure.size + static_cast<int>(model.force_count()));
  for (int j = 0; j < structure.size; ++j) {
    const auto begin = static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p) pattern.add(static_cast<int>(structure.row[p]), j);
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    for (const int force : at.of(c)) {
      for (const int dof : touched(model.contacts[c])) {
        pattern.add(force, dof);
        pattern.add(dof, force);
      }
      for (const int other : at.of(c)) pattern.add(force, other);
    }
  for (const int place : at.unused()) pattern.add(place, place);
  for (const std::vector<std::size_t>& group : shared.groups())
    for (const std::size_t a : group)
      for (const std::size_t b : group)
        for (const int row : at.of(a))
          for (const int column : at.of(b)) pattern.add(row, column);
  for (const std::vector<int>& together : joint_undamped_dofs(dof_kinds(model, structure), model))
    pattern.unite(together);
  return pattern;
}

std::vector<std::int64_t> starts_of(const Pattern& pattern) {
  std::vector<std::int64_t> start, rows;
  pattern.compress(start, rows);
  return start;
}

std::vector<std::int64_t> rows_of_pattern(const Pattern& pattern) {
  std::vector<std::int64_t> start, rows;
  pattern.compress(start, rows);
  return rows;
}

}  // namespace

double component(const Combination& combination, int dof) {
  double sum = 0.0;
  for (const auto& [index, factor] : combination.terms)
    if (index == dof) sum += factor;
  return sum;
}

std::vector<Rows> rows_of(const Model& model, const contact::ContactStates& states) {
  std::vector<Rows> result;
  for (std::size_t k = 0; k < states.size(); ++k)
    result.push_back(contact::rows(model.contacts[k], states[k]));
  return result;
}

SystemMatrix::SystemMatrix(const Model& model, const SystemMatrices& structure)
    : size_(structure.size + static_cast<int>(model.force_count())),
      layout_(model.layout),
      structure_(structure),
      shared_(model, structure),
      has_united_columns_(!joint_undamped_dofs(dof_kinds(model, structure), model).empty()),
      column_start_(starts_of(pattern_of(model, structure, shared_))),
      row_(rows_of_pattern(pattern_of(model, structure, shared_))),
      values_(row_.size(), 0.0),
      klu_(column_start_, row_) {
  const auto at = [&](int row, int column) { return position(column_start_, row_, row, column); };
  for (int j = 0; j < structure.size; ++j) {
    const auto begin = static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(structure.column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p)
      structure_slot_.push_back(at(static_cast<int>(structure.row[p]), j));
  }
  const ForcePlaces places{structure.size, layout_};
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const int N = places.normal(c), T = places.tangent(c);
    ContactSlots slots;
    slots.dof = touched(contact);
    for (int dof : slots.dof) {
      slots.n.push_back(component(contact.normal, dof));
      slots.t.push_back(component(contact.tangent, dof));
      slots.normal_row.push_back(at(N, dof));
      slots.tangent_row.push_back(at(T, dof));
      slots.N_column.push_back(at(dof, N));
      slots.T_column.push_back(at(dof, T));
    }
    slots.NN = at(N, N);
    slots.NT = at(N, T);
    slots.TN = at(T, N);
    slots.TT = at(T, T);
    contacts_.push_back(std::move(slots));
  }
  for (const int place : places.unused()) unused_.push_back(at(place, place));
}

std::size_t SystemMatrix::slot(int row, int column) const {
  return position(column_start_, row_, row, column);
}

void SystemMatrix::add_column(int to, int from, double factor, const Weights& w,
                              const std::vector<Rows>& rows) {
  const auto begin = static_cast<std::size_t>(structure_.column_start[static_cast<std::size_t>(from)]);
  const auto end = static_cast<std::size_t>(structure_.column_start[static_cast<std::size_t>(from) + 1]);
  for (std::size_t p = begin; p < end; ++p)
    values_[slot(structure_.row[p], to)] +=
        factor *
        (w.acceleration * structure_.m[p] + w.velocity * structure_.c[p] + w.displacement * structure_.k[p]);
  const ForcePlaces at{structure_.size, layout_};
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    for (std::size_t i = 0; i < contacts_[k].dof.size(); ++i) {
      if (contacts_[k].dof[i] != from) continue;
      const double n = contacts_[k].n[i], t = contacts_[k].t[i];
      values_[slot(at.normal(k), to)] += factor * entry_of(rows[k].normal, n, t, w);
      values_[slot(at.tangent(k), to)] += factor * entry_of(rows[k].tangent, n, t, w);
    }
}

void SystemMatrix::add_shared(const std::vector<Rows>& rows) {
  const int n = structure_.size;
  const ForcePlaces at{n, layout_};
  for (const std::vector<std::size_t>& group : shared_.groups())
    for (const std::size_t a : group)
      for (const std::size_t b : group)
        for (const int row : at.of(a))
          for (const int column : at.of(b))
            if (a != b) values_[slot(row, column)] = 0.0;
  in_force_ = shared_.in_force(rows);
  for (const SharedForces& shared : in_force_)
    for (std::size_t i = 0; i < shared.rows.size(); ++i)
      for (std::size_t j = 0; j < shared.rows.size(); ++j)
        values_[slot(n + static_cast<int>(shared.rows[i]), n + static_cast<int>(shared.rows[j]))] +=
            shared.entries(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

bool SystemMatrix::set(const std::vector<Rows>& rows, const std::vector<Weights>& weights, bool fresh,
                       const std::vector<UndampedMotion>& undamped) {
  if (has_united_columns_) std::fill(values_.begin(), values_.end(), 0.0);  // clears entries of other states
  for (int j = 0; j < structure_.size; ++j) {
    const Weights& w = weights[static_cast<std::size_t>(j)];
    const auto begin = static_cast<std::size_t>(structure_.column_start[static_cast<std::size_t>(j)]);
    const auto end = static_cast<std::size_t>(structure_.column_start[static_cast<std::size_t>(j) + 1]);
    for (std::size_t p = begin; p < end; ++p)
      values_[structure_slot_[p]] =
          w.acceleration * structure_.m[p] + w.velocity * structure_.c[p] + w.displacement * structure_.k[p];
  }
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const ContactSlots& slots = contacts_[k];
    const Rows& r = rows[k];
    for (std::size_t i = 0; i < slots.dof.size(); ++i) {
      const Weights& w = weights[static_cast<std::size_t>(slots.dof[i])];
      values_[slots.normal_row[i]] = entry_of(r.normal, slots.n[i], slots.t[i], w);
      values_[slots.tangent_row[i]] = entry_of(r.tangent, slots.n[i], slots.t[i], w);
      values_[slots.N_column[i]] = slots.n[i];
      values_[slots.T_column[i]] = slots.t[i];
    }
    values_[slots.NN] = r.normal.N;
    values_[slots.NT] = r.normal.T;
    values_[slots.TN] = r.tangent.N;
    values_[slots.TT] = r.tangent.T;
  }
  for (const std::size_t place : unused_) values_[place] = 1.0;
  add_shared(rows);
  for (const UndampedMotion& motion : undamped)
    for (const auto& [other, factor] : motion.others)
      add_column(motion.dof, other, factor, weights[static_cast<std::size_t>(motion.dof)], rows);
  return fresh ? klu_.factor(values_) : klu_.refactor(values_);
}

}  // namespace signorini::linear
