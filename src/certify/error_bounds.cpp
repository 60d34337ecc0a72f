#include "certify/error_bounds.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"

namespace signorini::certify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// tol(x) of a column with this largest value. Columns after those of the model are N and T of contacts, then outputs,
/// which have only the relative tolerance.
double tolerance_of(const Model& model, std::size_t index, double greatest, const engine::Tolerance& t) {
  if (!(t.rtol > 0.0)) return rounding::few_operations * greatest;
  if (index >= model.columns.size() + forces_per_contact * model.contacts.size()) return t.rtol * greatest;
  if (index >= model.columns.size()) return t.rtol * greatest + t.force;
  const Column& column = model.columns[index];
  const bool rotation = model.is_rotation(column);
  const double atol = column.velocity ? (rotation ? t.angular_velocity : t.velocity)
                                      : (rotation ? t.rotation : t.displacement);
  return t.rtol * greatest + atol;
}

/// True for columns that may jump at an event.
bool jumps(const Model& model, std::size_t index) {
  return index >= model.columns.size() || model.columns[index].velocity;
}

/// One column of RecordedRows; the index is the row.
class ColumnOf {
 public:
  ColumnOf(const RecordedRows& rows, std::size_t column) : rows_(rows), column_(column) {}
  double operator[](std::size_t row) const { return rows_.values[row * rows_.width + column_]; }

 private:
  const RecordedRows& rows_;
  std::size_t column_;
};

/// For each row: whether it lies within the error of an event's time, so that its velocities may be those of the other side.
std::vector<bool> rows_at_events(const std::vector<double>& t, const std::vector<TimedEvent>& events,
                                 const std::vector<double>& errors) {
  std::vector<bool> at(t.size(), false);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double off = errors[i];
    if (std::isnan(off)) continue;
    for (auto row =
             static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), events[i].t - off) - t.begin());
         row < t.size() && t[row] <= events[i].t + off; ++row)
      at[row] = true;
  }
  return at;
}

std::size_t common_rows(const RecordedRun& run, const std::vector<RecordedRun>& companions) {
  std::size_t rows = run.rows->t.size();
  for (const RecordedRun& companion : companions) rows = std::min(rows, companion.rows->t.size());
  return rows;
}

class HistoryBounds {
 public:
  HistoryBounds(const Model& model, const RecordedRun& run, const std::vector<RecordedRun>& companions,
                const BoundSettings& settings)
      : model_(model), run_(run), companions_(companions), settings_(settings) {
    errors_.t.assign(run.rows->t.begin(),
                     run.rows->t.begin() + static_cast<std::ptrdiff_t>(common_rows(run, companions)));
    errors_.width = run.rows->width;
    errors_.bounds.assign(errors_.t.size() * errors_.width, infinite);
  }

  HistoryErrors bounds(const std::vector<TimedEvent>& events, const MatchResult& verdict) {
    const std::vector<bool> at_event = rows_at_events(errors_.t, events, verdict.t_errors);
    std::size_t certain = errors_.t.size();
    if (!verdict.reason.empty())
      certain = static_cast<std::size_t>(std::lower_bound(errors_.t.begin(), errors_.t.end(), verdict.until) -
                                         errors_.t.begin());
    for (std::size_t j = 0; j < errors_.width; ++j) column(j, certain, at_event);
    return std::move(errors_);
  }

 private:
  void column(std::size_t j, std::size_t certain, const std::vector<bool>& at_event) {
    const ColumnOf own(*run_.rows, j);
    double greatest = 0.0;
    for (std::size_t row = 0; row < certain; ++row) greatest = std::max(greatest, std::abs(own[row]));
    const double floor = tolerance_of(model_, j, greatest, settings_.tolerance);
    std::vector<double> last(difference_window, 0.0);
    for (std::size_t row = 0; row < certain; ++row) {
      double& off = last[row % difference_window];
      off = 0.0;
      for (const RecordedRun& companion : companions_)
        off = std::max(off, std::abs(own[row] - ColumnOf(*companion.rows, j)[row]));
      double bound = settings_.factor * *std::max_element(last.begin(), last.end()) + floor;
      if (at_event[row] && jumps(model_, j)) {
        if (row > 0) bound += std::abs(own[row] - own[row - 1]);
        if (row + 1 < certain) bound += std::abs(own[row + 1] - own[row]);
      }
      errors_.bounds[row * errors_.width + j] = bound;
    }
  }

  const Model& model_;
  const RecordedRun& run_;
  const std::vector<RecordedRun>& companions_;
  const BoundSettings& settings_;
  HistoryErrors errors_;
};

/// Error bound of one number of a report: c times its largest difference from the companions, plus one local tolerance.
class FigureBound {
 public:
  FigureBound(const BoundSettings& settings, std::size_t companions)
      : settings_(settings), companions_(companions) {}
  template <class Figure>
  double operator()(double own, double atol, const Figure& other) const {
    double off = 0.0;
    for (std::size_t i = 0; i < companions_; ++i) off = std::max(off, std::abs(own - other(i)));
    const double rtol = std::max(settings_.tolerance.rtol, rounding::few_operations);
    return settings_.factor * off + rtol * std::abs(own) + atol;
  }

 private:
  const BoundSettings& settings_;
  std::size_t companions_;
};

}  // namespace

HistoryErrors bound_history(const Model& model, const RecordedRun& run,
                            const std::vector<RecordedRun>& companions, const BoundSettings& settings,
                            const std::vector<TimedEvent>& events, const MatchResult& verdict) {
  return HistoryBounds(model, run, companions, settings).bounds(events, verdict);
}

void bound_extremes(Certificate& certificate, const RecordedRun& run,
                    const std::vector<RecordedRun>& companions, const BoundSettings& settings) {
  const Report& own = *run.report;
  const bool some = settings.tolerance.rtol > 0.0;
  const double length = some ? settings.tolerance.displacement : 0.0;
  const double force = some ? settings.tolerance.force : 0.0;
  const FigureBound bound(settings, companions.size());
  certificate.peaks.assign(own.peaks.size(), std::nullopt);
  for (std::size_t k = 0; k < own.peaks.size() && certificate.complete; ++k) {
    const auto of = [&](double Peak::*figure, double atol) {
      return bound(own.peaks[k].*figure, atol,
                   [&](std::size_t i) { return companions[i].report->peaks[k].*figure; });
    };
    certificate.peaks[k] = Peak{of(&Peak::tangential, length), of(&Peak::normal, length), of(&Peak::N, force),
                                of(&Peak::T, force)};
  }
  certificate.landings.resize(own.landings.size());
  for (std::size_t k = 0; k < own.landings.size(); ++k) {
    certificate.landings[k].assign(own.landings[k].size(), std::nullopt);
    for (std::size_t l = 0; l < own.landings[k].size(); ++l) {
      const bool known = std::all_of(companions.begin(), companions.end(), [&](const RecordedRun& companion) {
        return k < companion.report->landings.size() && l < companion.report->landings[k].size();
      });
      if (!known || !(certificate.complete || own.landings[k][l].end < certificate.until)) continue;
      const auto of = [&](double Landing::*figure, double atol) {
        return bound(own.landings[k][l].*figure, atol,
                     [&](std::size_t i) { return companions[i].report->landings[k][l].*figure; });
      };
      certificate.landings[k][l] = Landing{of(&Landing::start, 0.0), of(&Landing::end, 0.0),
                                           of(&Landing::impulse, 0.0), of(&Landing::peak_force, force)};
    }
  }
}

namespace {

/// Stiffness that converts an error of a contact's displacement to an error of its force; 0: unknown.
double stiffness_of(const Contact& contact, const ComplianceShare& share) {
  const double own = (share.normal ? contact.normal_spring() : contact.tangent_spring()).value_or(0.0);
  if (own > 0.0) return own;
  return share.compliance > 0.0 ? 1.0 / share.compliance : 0.0;
}

}  // namespace

Truncation truncation_of(const Model& model, const Reduction& reduction, const std::vector<Peak>& peaks) {
  if (peaks.size() < model.contacts.size()) return {};  // the run stopped before peaks were recorded
  std::vector<double> off(peaks.size(), reduction.ringing);
  for (const ComplianceShare& share : reduction.shares) {
    if (share.contact < 0) continue;
    const auto k = static_cast<std::size_t>(share.contact);
    const double force = share.normal ? peaks[k].N : peaks[k].T;
    off[k] = std::max(off[k], reduction.ringing + share.residual * force);
  }
  Truncation result;
  result.displacement = reduction.ringing;
  for (const ComplianceShare& share : reduction.shares) {
    if (share.contact < 0) continue;
    const auto k = static_cast<std::size_t>(share.contact);
    result.displacement = std::max(result.displacement, off[k]);
    result.force = std::max(result.force, off[k] * stiffness_of(model.contacts[k], share));
  }
  return result;
}

namespace {

constexpr std::size_t rows_beside = 3;  // number of rows compared before, and after, each near hit

/// Difference of a contact's gap between two runs, from the displacements in their rows.
class GapDifference {
 public:
  GapDifference(const Model& model, const RecordedRun& run, const RecordedRun& companion)
      : model_(model), run_(*run.rows), other_(*companion.rows) {
    if (model.is_physical()) {
      column_of_.assign(model.dofs.size(), -1);
      for (std::size_t j = 0; j < model.columns.size(); ++j)
        if (const Column& column = model.columns[j]; !column.velocity && column.dof >= 0)
          column_of_[static_cast<std::size_t>(column.dof)] = static_cast<int>(j);
    }
  }

  /// Largest |difference| of the gap in rows around t. If some displacements of the contact have no columns, an estimate:
  /// the sum of the contact's coefficients times the largest difference of all displacements.
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
  const RecordedRows &run_, &other_;
  // Column of each degree of freedom; -1: none. Empty for a reduced model, whose degrees of freedom have no columns.
  std::vector<int> column_of_;
};

}  // namespace

std::optional<EventSequence::FirstViolation> first_undecided_impact(const Model& model,
                                                                    const RecordedRun& run,
                                                                    const RecordedRun& companion,
                                                                    const std::vector<events::NearHit>& near,
                                                                    double factor) {
  const GapDifference difference(model, run, companion);
  std::optional<EventSequence::FirstViolation> first;
  for (const events::NearHit& hit : near) {
    const Contact& contact = model.contacts[static_cast<std::size_t>(hit.contact)];
    const double off = difference.around(hit.t, contact);
    if (!(hit.gap <= factor * off)) continue;
    const double since = hit.t - std::sqrt(factor * off / hit.half_curvature);
    if (first && first->t <= since) continue;
    first = EventSequence::FirstViolation{
        std::max(0.0, since),
        fmt::format("the gap of '{}' is {:.2g} {} at t = {:.9g} in the companion, and its error in the run "
                    "is {:.2g} {}: run and companion may both have missed a hit",
                    contact.name, hit.gap, model.units.length, hit.t, off, model.units.length)};
  }
  return first;
}

}  // namespace signorini::certify
