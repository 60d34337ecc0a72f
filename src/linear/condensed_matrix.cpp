#include "linear/condensed_matrix.hpp"

#include <algorithm>
#include <cstring>

#include "linear/dof_kinds.hpp"

namespace signorini {
namespace {

/// Number of rows renewed at once: a few widths of a narrow band.
constexpr std::size_t rows_at_once = 32;

}  // namespace

bool is_economical(const Model& model, const Structure& structure, const SharedRows& shared) {
  return !has_massless(model) && shared.groups().empty() &&
         structure.size + static_cast<int>(model.force_count()) >= economical_from;
}

CondensedMatrix::CondensedMatrix(const CondensedRows& rows)
    : rows_(rows),
      band_(rows.size(), rows.width()),
      by_N_(rows.contacts() > 0 ? rows.end_of_touches(rows.contacts() - 1) : 0),
      by_T_(by_N_.size()),
      x_(rows.size()) {}

void CondensedMatrix::fill(std::size_t begin, std::size_t end) {
  band_.clear(begin, end);
  for (std::size_t i = begin; i < end; ++i) rows_.fill(i, weights_, by_N_.data(), by_T_.data(), band_.row(i));
}

bool CondensedMatrix::factor() {
  ++factorisations;
  for (std::size_t c = 0; c < rows_.contacts(); ++c)
    if (rows_.held(c).on_motion) rows_.share(c, weights_, by_N_.data(), by_T_.data());
  fill(0, rows_.size());
  return band_.factor();
}

/// Renews rows from `begin` on until they equal the old ones. nullopt: the factors lose digits; else the first
/// unchanged row.
std::optional<std::size_t> CondensedMatrix::renew(std::size_t begin) {
  const std::size_t stride = band_.stride(), count = std::max(rows_at_once, 2 * rows_.width());
  before_.resize(count * stride);
  for (std::size_t next = 0; begin < rows_.size(); begin = next) {
    next = std::min(rows_.size(), begin + count);
    std::copy(band_.row(begin), band_.row(begin) + (next - begin) * stride, before_.begin());
    fill(begin, next);
    if (!band_.factor(begin, next)) return std::nullopt;
    renewed_rows += static_cast<long>(next - begin);
    const std::size_t last = next - std::min(next - begin, rows_.width());
    const bool same = std::memcmp(band_.row(last), before_.data() + (last - begin) * stride,
                                  (next - last) * stride * sizeof(double)) == 0;
    if (same) return next;
  }
  return begin;
}

bool CondensedMatrix::renew(std::span<const std::size_t> contacts) {
  touched_.clear();
  for (const std::size_t c : contacts) {
    rows_.share(c, weights_, by_N_.data(), by_T_.data());
    for (std::size_t i = rows_.first_touch(c); i < rows_.end_of_touches(c); ++i)
      touched_.push_back(rows_.touch(i).place);
  }
  std::sort(touched_.begin(), touched_.end());
  std::size_t done = 0;
  for (const std::size_t place : touched_) {
    if (place < done) continue;
    const auto end = renew(place);
    if (!end) return false;
    done = *end;
  }
  return true;
}

bool CondensedMatrix::set(const Weights& weights) {
  const auto changed = rows_.changed_since(version_);
  version_ = rows_.version();
  const bool at_them = is_at(weights) && changed;
  weights_ = weights;
  set_ = true;
  if (at_them && changed->empty()) return holds_;
  holds_ = rows_.tell() && (at_them && holds_ ? renew(*changed) : factor());
  return holds_;
}

void CondensedMatrix::solve(double* x) {
  const std::size_t n = rows_.size();
  double* forces = x + n;
  for (std::size_t c = 0; c < rows_.contacts(); ++c) {
    const CondensedRows::Held& held = rows_.held(c);
    double &N = forces[rows_.layout().normal(c)], &T = forces[rows_.layout().tangent(c)];
    N /= held.normal_N;
    T = (T - held.tangent_N * N) / held.tangent_T;
    if (N == 0.0 && T == 0.0) continue;
    for (std::size_t i = rows_.first_touch(c); i < rows_.end_of_touches(c); ++i) {
      const CondensedRows::Touch& at = rows_.touch(i);
      x[at.dof] -= at.n * N + at.t * T;
    }
  }
  for (std::size_t i = 0; i < n; ++i) x_[i] = x[rows_.dof_at(i)];
  band_.solve(x_.data());
  for (std::size_t i = 0; i < n; ++i) x[rows_.dof_at(i)] = x_[i];
  for (std::size_t c = 0; c < rows_.contacts(); ++c) {
    if (!rows_.held(c).on_motion) continue;
    double N = 0.0, T = 0.0;
    for (std::size_t i = rows_.first_touch(c); i < rows_.end_of_touches(c); ++i) {
      N += by_N_[i] * x[rows_.touch(i).dof];
      T += by_T_[i] * x[rows_.touch(i).dof];
    }
    forces[rows_.layout().normal(c)] -= N;
    forces[rows_.layout().tangent(c)] -= T;
  }
}

}  // namespace signorini
