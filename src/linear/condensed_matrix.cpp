#include "linear/condensed_matrix.hpp"

#include <algorithm>
#include <cstring>
#include <set>

#include "linear/unknowns.hpp"

namespace signorini::linear {
namespace {

using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours_of(const Model& model, const SystemMatrices& structure) {
  std::vector<std::set<int>> sets(static_cast<std::size_t>(structure.size));
  const auto couple = [&](int i, int j) {
    if (i == j) return;
    sets[static_cast<std::size_t>(i)].insert(j);
    sets[static_cast<std::size_t>(j)].insert(i);
  };
  for (int j = 0; j < structure.size; ++j)
    for (auto p = structure.column_start[static_cast<std::size_t>(j)];
         p < structure.column_start[static_cast<std::size_t>(j) + 1]; ++p)
      couple(structure.row[static_cast<std::size_t>(p)], j);
  for (const Contact& contact : model.contacts) {
    std::vector<int> dofs;
    for (const Combination* form : {&contact.normal, &contact.tangent})
      for (const auto& term : form->terms) dofs.push_back(term.first);
    for (const int i : dofs)
      for (const int j : dofs) couple(i, j);
  }
  Neighbours result;
  for (const std::set<int>& set : sets) result.emplace_back(set.begin(), set.end());
  return result;
}

/// Members of the connected component of `first`, level by level; sets `seen` for each of them.
std::vector<int> breadth_first_order(int first, const Neighbours& neighbours, std::vector<bool>& seen) {
  std::vector<int> order{first};
  seen[static_cast<std::size_t>(first)] = true;
  for (std::size_t next = 0; next < order.size(); ++next) {
    const std::size_t begin = order.size();
    for (const int j : neighbours[static_cast<std::size_t>(order[next])]) {
      if (seen[static_cast<std::size_t>(j)]) continue;
      seen[static_cast<std::size_t>(j)] = true;
      order.push_back(j);
    }
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(), [&](int a, int b) {
      return neighbours[static_cast<std::size_t>(a)].size() < neighbours[static_cast<std::size_t>(b)].size();
    });
  }
  return order;
}

}  // namespace

BandOrder band_order(const Model& model, const SystemMatrices& structure) {
  const Neighbours neighbours = neighbours_of(model, structure);
  const std::size_t n = neighbours.size();
  BandOrder result{std::vector<int>(n, 0), 0};
  std::vector<bool> placed(n, false);
  int next = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (placed[i]) continue;
    int end = static_cast<int>(i);
    for (int turn = 0; turn < 2; ++turn) {
      std::vector<bool> seen = placed;
      end = breadth_first_order(end, neighbours, seen).back();
    }
    for (const int j : breadth_first_order(end, neighbours, placed))
      result.place[static_cast<std::size_t>(j)] = next++;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (const int j : neighbours[i]) {
      const int apart = result.place[i] - result.place[static_cast<std::size_t>(j)];
      result.width = std::max(result.width, static_cast<std::size_t>(std::max(apart, -apart)));
    }
  return result;
}

namespace {

/// Largest number of recorded changes; after more changes, factoring all rows costs less than updating the factors.
constexpr std::size_t max_recorded_changes = 64;

CondensedRows::ContactCoefficients contact_coefficients(const Rows& rows) {
  const Form &normal = rows.normal, &tangent = rows.tangent;
  const auto moves = [](const Form& f) { return f.gap != 0.0 || f.ut != 0.0 || f.vn != 0.0 || f.vt != 0.0; };
  const bool accelerates = normal.an != 0.0 || normal.at != 0.0 || tangent.an != 0.0 || tangent.at != 0.0;
  CondensedRows::ContactCoefficients held{normal.N,   tangent.N, tangent.T,   normal.gap, normal.ut,
                                          normal.vn,  normal.vt, tangent.gap, tangent.ut, tangent.vn,
                                          tangent.vt, false,     false};
  held.on_motion = moves(normal) || moves(tangent);
  // N follows from the normal row alone, then T from the tangent row, so no elimination can lose digits.
  held.known = !accelerates && normal.T == 0.0 && normal.N != 0.0 && tangent.T != 0.0;
  return held;
}

}  // namespace

std::optional<CondensedRows> CondensedRows::create(const Model& model, const SystemMatrices& structure,
                                                   std::size_t most_width) {
  const BandOrder order = band_order(model, structure);
  if (order.width > most_width) return std::nullopt;
  CondensedRows result;
  const auto n = static_cast<std::size_t>(structure.size);
  result.width_ = order.width;
  result.layout_ = model.layout;
  result.dof_at_.resize(n);
  std::vector<std::vector<Entry>> rows(n);
  std::vector<std::vector<std::uint32_t>> touching(n);
  const auto place_of = [&](auto dof) {
    return static_cast<std::size_t>(order.place[static_cast<std::size_t>(dof)]);
  };
  for (std::size_t j = 0; j < n; ++j) {
    result.dof_at_[place_of(j)] = j;
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p) {
      const std::size_t row = place_of(structure.row[p]);
      rows[row].push_back({static_cast<std::uint32_t>(order.width + place_of(j) - row),
                           static_cast<std::uint32_t>(j), structure.m[p], structure.c[p], structure.k[p]});
    }
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    std::set<int> dofs;
    for (const Combination* form : {&contact.normal, &contact.tangent})
      for (const auto& term : form->terms) dofs.insert(term.first);
    for (const int dof : dofs) {
      touching[place_of(dof)].push_back(static_cast<std::uint32_t>(result.contact_dofs_.size()));
      result.contact_dofs_.push_back(
          {static_cast<std::uint32_t>(dof), static_cast<std::uint32_t>(place_of(dof)),
           static_cast<std::uint32_t>(c), component(contact.normal, dof), component(contact.tangent, dof)});
    }
    result.contact_dofs_end_.push_back(result.contact_dofs_.size());
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::sort(rows[i].begin(), rows[i].end(), [](const Entry& a, const Entry& b) { return a.at < b.at; });
    result.entries_.insert(result.entries_.end(), rows[i].begin(), rows[i].end());
    result.entries_end_.push_back(result.entries_.size());
    result.at_place_.insert(result.at_place_.end(), touching[i].begin(), touching[i].end());
    result.at_place_end_.push_back(result.at_place_.size());
  }
  result.coefficients_.resize(model.contacts.size());
  result.undetermined_count_ = result.coefficients_.size();
  return result;
}

void CondensedRows::set_rows(std::size_t c, const Rows& rows) {
  undetermined_count_ -= coefficients_[c].known ? 0 : 1;
  coefficients_[c] = contact_coefficients(rows);
  undetermined_count_ += coefficients_[c].known ? 0 : 1;
  if (changed_.size() == max_recorded_changes) {  // discards the earlier half of the record
    constexpr std::size_t half = max_recorded_changes / 2;
    changed_.erase(changed_.begin(), changed_.begin() + half);
    dropped_changes_ += half;
  }
  changed_.push_back(c);
}

void CondensedRows::set_rows(const std::vector<Rows>& rows) {
  for (std::size_t c = 0; c < rows.size(); ++c) set_rows(c, rows[c]);
}

std::optional<std::span<const std::size_t>> CondensedRows::changed_since(long version) const {
  if (version < dropped_changes_) return std::nullopt;
  return std::span(changed_).subspan(static_cast<std::size_t>(version - dropped_changes_));
}

void CondensedRows::force_coefficients(std::size_t c, const Weights& w, double* by_N, double* by_T) const {
  const ContactCoefficients& h = coefficients_[c];
  const double of_gap = h.normal_gap * w.displacement + h.normal_vn * w.velocity,
               of_ut = h.normal_ut * w.displacement + h.normal_vt * w.velocity,
               to_gap = h.tangent_gap * w.displacement + h.tangent_vn * w.velocity,
               to_ut = h.tangent_ut * w.displacement + h.tangent_vt * w.velocity;
  for (std::size_t i = contact_dofs_end_[c]; i < contact_dofs_end_[c + 1]; ++i) {
    const ContactDof& at = contact_dofs_[i];
    by_N[i] = (at.n * of_gap + at.t * of_ut) / h.normal_N;
    by_T[i] = (at.n * to_gap + at.t * to_ut - h.tangent_N * by_N[i]) / h.tangent_T;
  }
}

void CondensedRows::fill(std::size_t place, const Weights& w, const double* by_N, const double* by_T,
                         double* out) const {
  for (const Entry& e : entries(place))
    out[e.at] = w.acceleration * e.m + w.velocity * e.c + w.displacement * e.k;
  for (const std::uint32_t i : contact_dofs_at(place)) {
    const ContactDof& at = contact_dofs_[i];
    if (!coefficients_[at.contact].on_motion) continue;
    for (std::size_t j = contact_dofs_end_[at.contact]; j < contact_dofs_end_[at.contact + 1]; ++j)
      out[width_ + contact_dofs_[j].place - place] -= at.n * by_N[j] + at.t * by_T[j];
  }
}

namespace {

/// Smallest number of rows that refactor() factors before it compares them with the old ones: a few widths of a narrow band.
constexpr std::size_t min_refactored_rows = 32;

}  // namespace

bool saves_factorisations(const Model& model, const SystemMatrices& structure, const RedundantRows& shared) {
  return !has_massless(model) && shared.groups().empty() &&
         structure.size + static_cast<int>(model.force_count()) >= min_condensed_size;
}

CondensedMatrix::CondensedMatrix(const CondensedRows& rows)
    : rows_(rows),
      band_(rows.size(), rows.width()),
      by_N_(rows.contacts() > 0 ? rows.end_of_contact_dofs(rows.contacts() - 1) : 0),
      by_T_(by_N_.size()),
      x_(rows.size()) {}

void CondensedMatrix::fill(std::size_t begin, std::size_t end) {
  band_.clear(begin, end);
  for (std::size_t i = begin; i < end; ++i) rows_.fill(i, weights_, by_N_.data(), by_T_.data(), band_.row(i));
}

bool CondensedMatrix::factor() {
  ++factorisations;
  for (std::size_t c = 0; c < rows_.contacts(); ++c)
    if (rows_.coefficients(c).on_motion) rows_.force_coefficients(c, weights_, by_N_.data(), by_T_.data());
  fill(0, rows_.size());
  return band_.factor();
}

/// Factors rows again, from `begin` on, until rows of the factors equal the old ones. Returns the first unchanged row;
/// nullopt: factoring loses too many digits.
std::optional<std::size_t> CondensedMatrix::refactor(std::size_t begin) {
  const std::size_t stride = band_.stride(), count = std::max(min_refactored_rows, 2 * rows_.width());
  before_.resize(count * stride);
  for (std::size_t next = 0; begin < rows_.size(); begin = next) {
    next = std::min(rows_.size(), begin + count);
    std::copy(band_.row(begin), band_.row(begin) + (next - begin) * stride, before_.begin());
    fill(begin, next);
    if (!band_.factor(begin, next)) return std::nullopt;
    refactored_rows += static_cast<long>(next - begin);
    const std::size_t last = next - std::min(next - begin, rows_.width());
    const bool same = std::memcmp(band_.row(last), before_.data() + (last - begin) * stride,
                                  (next - last) * stride * sizeof(double)) == 0;
    if (same) return next;
  }
  return begin;
}

bool CondensedMatrix::refactor(std::span<const std::size_t> contacts) {
  touched_.clear();
  for (const std::size_t c : contacts) {
    rows_.force_coefficients(c, weights_, by_N_.data(), by_T_.data());
    for (std::size_t i = rows_.first_contact_dof(c); i < rows_.end_of_contact_dofs(c); ++i)
      touched_.push_back(rows_.contact_dof(i).place);
  }
  std::sort(touched_.begin(), touched_.end());
  std::size_t done = 0;
  for (const std::size_t place : touched_) {
    if (place < done) continue;
    const auto end = refactor(place);
    if (!end) return false;
    done = *end;
  }
  return true;
}

bool CondensedMatrix::set(const Weights& weights) {
  const auto changed = rows_.changed_since(version_);
  version_ = rows_.version();
  const bool at_them = is_factored_at(weights) && changed;
  weights_ = weights;
  set_ = true;
  if (at_them && changed->empty()) return has_factors_;
  has_factors_ = rows_.is_determined() && (at_them && has_factors_ ? refactor(*changed) : factor());
  return has_factors_;
}

void CondensedMatrix::solve(double* x) {
  const std::size_t n = rows_.size();
  double* forces = x + n;
  for (std::size_t c = 0; c < rows_.contacts(); ++c) {
    const CondensedRows::ContactCoefficients& held = rows_.coefficients(c);
    double &N = forces[rows_.layout().normal(c)], &T = forces[rows_.layout().tangent(c)];
    N /= held.normal_N;
    T = (T - held.tangent_N * N) / held.tangent_T;
    if (N == 0.0 && T == 0.0) continue;
    for (std::size_t i = rows_.first_contact_dof(c); i < rows_.end_of_contact_dofs(c); ++i) {
      const CondensedRows::ContactDof& at = rows_.contact_dof(i);
      x[at.dof] -= at.n * N + at.t * T;
    }
  }
  for (std::size_t i = 0; i < n; ++i) x_[i] = x[rows_.dof_at(i)];
  band_.solve(x_.data());
  for (std::size_t i = 0; i < n; ++i) x[rows_.dof_at(i)] = x_[i];
  for (std::size_t c = 0; c < rows_.contacts(); ++c) {
    if (!rows_.coefficients(c).on_motion) continue;
    double N = 0.0, T = 0.0;
    for (std::size_t i = rows_.first_contact_dof(c); i < rows_.end_of_contact_dofs(c); ++i) {
      N += by_N_[i] * x[rows_.contact_dof(i).dof];
      T += by_T_[i] * x[rows_.contact_dof(i).dof];
    }
    forces[rows_.layout().normal(c)] -= N;
    forces[rows_.layout().tangent(c)] -= T;
  }
}

}  // namespace signorini::linear
