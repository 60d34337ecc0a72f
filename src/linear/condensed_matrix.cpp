#include "linear/condensed_matrix.hpp"

#include <algorithm>
#include <set>

#include "linear/band_order.hpp"
#include "linear/dof_kinds.hpp"

namespace signorini {

bool is_economical(const Model& model, const Structure& structure, const SharedRows& shared) {
  return !has_massless(model) && shared.groups().empty() &&
         structure.size + 2 * static_cast<int>(model.contacts.size()) >= economical_from;
}

CondensedMatrix::CondensedMatrix(const Model& model, const Structure& structure, std::size_t most_width)
    : structure_(structure) {
  const BandOrder order = band_order(model, structure);
  if (order.width > most_width) return;
  const auto n = static_cast<std::size_t>(structure.size);
  band_ = std::make_unique<BandFactors>(n, order.width);
  for (const int place : order.place) place_.push_back(static_cast<std::size_t>(place));
  for (std::size_t j = 0; j < n; ++j)
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p)
      slot_.push_back(band_->slot(place_[static_cast<std::size_t>(structure.row[p])], place_[j]));
  for (const Contact& contact : model.contacts) {
    std::set<int> dofs;
    for (const Combination* form : {&contact.normal, &contact.tangent})
      for (const auto& term : form->terms) dofs.insert(term.first);
    for (const int dof : dofs) {
      const auto i = static_cast<std::size_t>(dof);
      touches_.push_back({i, place_[i], component(contact.normal, dof), component(contact.tangent, dof)});
    }
    end_.push_back(touches_.size());
  }
  held_.resize(model.contacts.size());
  by_N_.resize(touches_.size());
  by_T_.resize(touches_.size());
  x_.resize(n);
}

/// What the forces of a contact add.
void CondensedMatrix::add(const Rows& rows, const Weights& weights, std::size_t c) {
  const Held& held = held_[c];
  const std::size_t begin = c == 0 ? 0 : end_[c - 1], end = end_[c];
  for (std::size_t i = begin; i < end; ++i) {
    const Touch& at = touches_[i];
    by_N_[i] = entry_of(rows.normal, at.n, at.t, weights) / held.normal_N;
    by_T_[i] = (entry_of(rows.tangent, at.n, at.t, weights) - held.tangent_N * by_N_[i]) / held.tangent_T;
  }
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t j = begin; j < end; ++j)
      band_->at(band_->slot(touches_[i].place, touches_[j].place)) -=
          touches_[i].n * by_N_[j] + touches_[i].t * by_T_[j];
}

bool CondensedMatrix::set(const std::vector<Rows>& rows, const Weights& w) {
  const auto moves = [](const Form& f) { return f.gap != 0.0 || f.ut != 0.0 || f.vn != 0.0 || f.vt != 0.0; };
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const Form &normal = rows[c].normal, &tangent = rows[c].tangent;
    // N from its own row, then T: no elimination that could lose digits.
    const bool accelerates = normal.an != 0.0 || normal.at != 0.0 || tangent.an != 0.0 || tangent.at != 0.0;
    if (accelerates || normal.T != 0.0 || normal.N == 0.0 || tangent.T == 0.0) return false;
    held_[c] = {normal.N, tangent.N, tangent.T, moves(normal) || moves(tangent)};
  }
  ++factorisations;
  band_->clear();
  for (std::size_t p = 0; p < slot_.size(); ++p)
    band_->at(slot_[p]) =
        w.acceleration * structure_.m[p] + w.velocity * structure_.c[p] + w.displacement * structure_.k[p];
  for (std::size_t c = 0; c < rows.size(); ++c)
    if (held_[c].on_motion) add(rows[c], w, c);
  return band_->factor();
}

void CondensedMatrix::solve(double* x) {
  const std::size_t n = place_.size();
  double* forces = x + n;
  for (std::size_t c = 0, i = 0; c < held_.size(); ++c) {
    const Held& held = held_[c];
    double &N = forces[2 * c], &T = forces[2 * c + 1];
    N /= held.normal_N;
    T = (T - held.tangent_N * N) / held.tangent_T;
    const bool acts = N != 0.0 || T != 0.0;
    for (; i < end_[c]; ++i)
      if (acts) x[touches_[i].dof] -= touches_[i].n * N + touches_[i].t * T;
  }
  for (std::size_t i = 0; i < n; ++i) x_[place_[i]] = x[i];
  band_->solve(x_.data());
  for (std::size_t i = 0; i < n; ++i) x[i] = x_[place_[i]];
  for (std::size_t c = 0, i = 0; c < held_.size(); ++c) {
    if (!held_[c].on_motion) {
      i = end_[c];
      continue;
    }
    double N = 0.0, T = 0.0;
    for (; i < end_[c]; ++i) {
      N += by_N_[i] * x[touches_[i].dof];
      T += by_T_[i] * x[touches_[i].dof];
    }
    forces[2 * c] -= N;
    forces[2 * c + 1] -= T;
  }
}

}  // namespace signorini
