#include "linear/condensed_rows.hpp"

#include <algorithm>
#include <set>

#include "linear/band_order.hpp"

namespace signorini {
namespace {

/// Number of changes that are remembered: new factors cost less than more of them.
constexpr std::size_t most_remembered = 64;

CondensedRows::Held held_by(const Rows& rows) {
  const Form &normal = rows.normal, &tangent = rows.tangent;
  const auto moves = [](const Form& f) { return f.gap != 0.0 || f.ut != 0.0 || f.vn != 0.0 || f.vt != 0.0; };
  const bool accelerates = normal.an != 0.0 || normal.at != 0.0 || tangent.an != 0.0 || tangent.at != 0.0;
  CondensedRows::Held held{normal.N,    tangent.N,  tangent.T,  normal.gap, normal.ut, normal.vn, normal.vt,
                           tangent.gap, tangent.ut, tangent.vn, tangent.vt, false,     false};
  held.on_motion = moves(normal) || moves(tangent);
  // N from its own row, then T: no elimination that could lose digits.
  held.told = !accelerates && normal.T == 0.0 && normal.N != 0.0 && tangent.T != 0.0;
  return held;
}

}  // namespace

std::optional<CondensedRows> CondensedRows::of(const Model& model, const Structure& structure,
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
      touching[place_of(dof)].push_back(static_cast<std::uint32_t>(result.touches_.size()));
      result.touches_.push_back({static_cast<std::uint32_t>(dof), static_cast<std::uint32_t>(place_of(dof)),
                                 static_cast<std::uint32_t>(c), component(contact.normal, dof),
                                 component(contact.tangent, dof)});
    }
    result.touches_end_.push_back(result.touches_.size());
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::sort(rows[i].begin(), rows[i].end(), [](const Entry& a, const Entry& b) { return a.at < b.at; });
    result.entries_.insert(result.entries_.end(), rows[i].begin(), rows[i].end());
    result.entries_end_.push_back(result.entries_.size());
    result.at_place_.insert(result.at_place_.end(), touching[i].begin(), touching[i].end());
    result.at_place_end_.push_back(result.at_place_.size());
  }
  result.held_.resize(model.contacts.size());
  result.untold_ = result.held_.size();
  return result;
}

void CondensedRows::put(std::size_t c, const Rows& rows) {
  untold_ -= held_[c].told ? 0 : 1;
  held_[c] = held_by(rows);
  untold_ += held_[c].told ? 0 : 1;
  if (changed_.size() == most_remembered) {  // discards the earlier half
    constexpr std::size_t half = most_remembered / 2;
    changed_.erase(changed_.begin(), changed_.begin() + half);
    forgotten_ += half;
  }
  changed_.push_back(c);
}

void CondensedRows::put(const std::vector<Rows>& rows) {
  for (std::size_t c = 0; c < rows.size(); ++c) put(c, rows[c]);
}

std::optional<std::span<const std::size_t>> CondensedRows::changed_since(long version) const {
  if (version < forgotten_) return std::nullopt;
  return std::span(changed_).subspan(static_cast<std::size_t>(version - forgotten_));
}

void CondensedRows::share(std::size_t c, const Weights& w, double* by_N, double* by_T) const {
  const Held& h = held_[c];
  const double of_gap = h.normal_gap * w.displacement + h.normal_vn * w.velocity,
               of_ut = h.normal_ut * w.displacement + h.normal_vt * w.velocity,
               to_gap = h.tangent_gap * w.displacement + h.tangent_vn * w.velocity,
               to_ut = h.tangent_ut * w.displacement + h.tangent_vt * w.velocity;
  for (std::size_t i = touches_end_[c]; i < touches_end_[c + 1]; ++i) {
    const Touch& at = touches_[i];
    by_N[i] = (at.n * of_gap + at.t * of_ut) / h.normal_N;
    by_T[i] = (at.n * to_gap + at.t * to_ut - h.tangent_N * by_N[i]) / h.tangent_T;
  }
}

void CondensedRows::fill(std::size_t place, const Weights& w, const double* by_N, const double* by_T,
                         double* out) const {
  for (const Entry& e : entries(place))
    out[e.at] = w.acceleration * e.m + w.velocity * e.c + w.displacement * e.k;
  for (const std::uint32_t i : touches_at(place)) {
    const Touch& at = touches_[i];
    if (!held_[at.contact].on_motion) continue;
    for (std::size_t j = touches_end_[at.contact]; j < touches_end_[at.contact + 1]; ++j)
      out[width_ + touches_[j].place - place] -= at.n * by_N[j] + at.t * by_T[j];
  }
}

}  // namespace signorini
