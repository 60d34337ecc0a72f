#include "certify/open_hits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr std::size_t rows_beside = 3;  // before and after each near hit

/// Difference of a contact's gap between two runs, from the columns of their rows.
class GapDifference {
 public:
  GapDifference(const Model& model, const Kept& run, const Kept& companion)
      : model_(model), run_(*run.rows), other_(*companion.rows) {
    if (model.is_physical()) {
      column_of_.assign(model.dofs.size(), -1);
      for (std::size_t j = 0; j < model.columns.size(); ++j)
        if (const Column& column = model.columns[j]; !column.velocity && column.dof >= 0)
          column_of_[static_cast<std::size_t>(column.dof)] = static_cast<int>(j);
    }
  }

  /// The largest difference around t; if a contact's displacements have no columns, the largest possible effect of all
  /// differences on its gap.
  [[nodiscard]] double around(double t, const Contact& contact) const {
    const std::size_t rows = std::min(run_.t.size(), other_.t.size());
    const auto at = static_cast<std::size_t>(
        std::lower_bound(run_.t.begin(), run_.t.begin() + static_cast<std::ptrdiff_t>(rows), t) -
        run_.t.begin());
    double greatest = 0.0;
    for (std::size_t row = at - std::min(at, rows_beside); row < std::min(rows, at + rows_beside); ++row)
      greatest = std::max(greatest, at_row(row, contact));
    return greatest;
  }

 private:
  [[nodiscard]] double off(std::size_t row, std::size_t column) const {
    return run_.values[row * run_.width + column] - other_.values[row * other_.width + column];
  }
  [[nodiscard]] double at_row(std::size_t row, const Contact& contact) const {
    double sum = 0.0, sizes = 0.0;
    bool known = !column_of_.empty();
    for (const auto& [dof, factor] : contact.normal.terms) {
      sizes += std::abs(factor);
      const int column = known ? column_of_[static_cast<std::size_t>(dof)] : -1;
      known = known && column >= 0;
      if (known) sum += factor * off(row, static_cast<std::size_t>(column));
    }
    if (known) return std::abs(sum);
    double greatest = 0.0;
    for (std::size_t j = 0; j < model_.columns.size(); ++j)
      if (!model_.columns[j].velocity) greatest = std::max(greatest, std::abs(off(row, j)));
    return sizes * greatest;
  }

  const Model& model_;
  const KeptRows &run_, &other_;
  std::vector<int>
      column_of_;  // column of each displacement; -1: none; empty: columns do not match the degrees of
                   // freedom
};

}  // namespace

std::optional<Track::Objection> first_open_hit(const Model& model, const Kept& run, const Kept& companion,
                                               const std::vector<NearHit>& near, double factor) {
  const GapDifference difference(model, run, companion);
  std::optional<Track::Objection> first;
  for (const NearHit& hit : near) {
    const Contact& contact = model.contacts[static_cast<std::size_t>(hit.contact)];
    const double off = difference.around(hit.t, contact);
    if (!(hit.gap <= factor * off)) continue;
    const double since = hit.t - std::sqrt(factor * off / hit.bend);
    if (first && first->t <= since) continue;
    first = Track::Objection{
        std::max(0.0, since),
        fmt::format(
            "the gap of '{}' is {:.2g} {} at t = {:.9g} in the companion, and {:.2g} {} off in the run: both "
            "may have missed a hit",
            contact.name, hit.gap, model.units.length, hit.t, off, model.units.length)};
  }
  return first;
}

}  // namespace signorini
