#include "study/verify/verification_runs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::verify {
namespace {

const char* const event_time = "event_time";
/// settled(): newmark's sequences must agree up to this fraction of the time in which IDA's sequence is certain.
constexpr double nearly = 0.99;
/// Error bound of an extreme / largest error bound of the rows: above 1, because an extreme lies between rows.
constexpr double between_rows = 2.0;
/// Differences between newmark's runs are ignored below this fraction of IDA's error.
constexpr double negligible = 0.1;

/// Difference relative to the allowed difference; 0 without a difference.
double excess(const Observation& o) {
  return o.difference() > 0.0 ? o.difference() / std::max(o.allowed(), std::numeric_limits<double>::min())
                              : 0.0;
}

}  // namespace

VerificationRuns::VerificationRuns(const Model& model, double t_end)
    : model_(model), t_end_(t_end), columns_(observed_columns(model)) {
  for (const Contact& contact : model.contacts) names_.push_back(contact.name);
}

void VerificationRuns::add(double dt_of_run, ObservedRun run) {
  if (newmark.size() == runs) {
    newmark.erase(newmark.begin());
    dt.erase(dt.begin());
  }
  newmark.push_back(std::move(run));
  dt.push_back(dt_of_run);
}

VerificationRuns::Sequence VerificationRuns::sequence() const {
  Sequence result;
  const certify::MatchResult steps =
      signorini::certify::match_events(newmark[2].track, {newmark[1].track, newmark[0].track}, 1.0, names_);
  const certify::MatchResult pair =
      signorini::certify::match_events(ida.track, {newmark[2].track}, 1.0, names_);
  result.exact_until =
      exact ? signorini::certify::match_events(ida.track, {exact->track}, 1.0, names_).until : 0.0;
  result.until = std::min({certificate->until, steps.until, pair.until});
  if (!pair.reason.empty() && pair.until + 2.0 * pair.spread < std::min(certificate->until, steps.until)) {
    result.differs = true;
    result.reason = pair.reason;
  } else if (result.until < t_end_) {
    result.reason = certificate->until <= steps.until && !certificate->complete
                        ? "IDA's sequence is certified only up to this time: " + certificate->reason
                    : !steps.reason.empty() ? "newmark's sequence changes with its step: " + steps.reason
                    : !pair.reason.empty()  ? pair.reason
                                            : "a run has stopped: " + newmark[2].report.outcome.reason;
  }
  return result;
}

std::vector<std::optional<double>> VerificationRuns::times_in(const certify::EventSequence& track) const {
  std::vector<std::vector<double>> times(names_.size());
  for (const certify::TimedEvent& event : track.events)
    if (event.is_change()) times[static_cast<std::size_t>(event.contact)].push_back(event.t);
  std::vector<std::size_t> next(names_.size(), 0);
  std::vector<std::optional<double>> result(ida.track.events.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const certify::TimedEvent& event = ida.track.events[i];
    if (!event.is_change()) continue;
    const auto k = static_cast<std::size_t>(event.contact);
    if (const std::size_t number = next[k]++; number < times[k].size()) result[i] = times[k][number];
  }
  return result;
}

VerificationRuns::Kind VerificationRuns::event_times(double until) const {
  Kind kind{event_time, model_.units.time, {}, {}, t_end_};
  Series& series = kind.series.emplace_back();
  std::array<std::vector<std::optional<double>>, runs> times;
  for (std::size_t i = 0; i < runs; ++i) times[i] = times_in(newmark[i].track);
  for (std::size_t row = 0; row < ida.track.events.size(); ++row) {
    const certify::TimedEvent& event = ida.track.events[row];
    if (!event.is_change() || !certificate->certain(row) || event.t >= until) continue;
    if (!times[0][row] || !times[1][row] || !times[2][row]) continue;
    series.values.push_back({*times[0][row], *times[1][row], *times[2][row]});
    series.rows.push_back(row);
  }
  double error = 0.0;
  for (const std::size_t row : series.rows) error = std::max(error, certificate->t_errors[row]);
  kind.order.add(series.values, negligible * error);
  return kind;
}

/// True for output times that may be before an event in one run and after it in another run.
std::vector<bool> VerificationRuns::rows_at_events(double until) const {
  std::vector<bool> at(ida.rows.t.size(), false);
  std::vector<std::vector<std::optional<double>>> times;
  for (const ObservedRun& run : newmark) times.push_back(times_in(run.track));
  for (std::size_t i = 0; i < ida.track.events.size(); ++i) {
    const certify::TimedEvent& event = ida.track.events[i];
    if (event.t > until || !event.is_change()) continue;
    const double off = certificate->certain(i) ? certificate->t_errors[i] : 0.0;
    double from = event.t - off, to = event.t + off;
    for (const auto& list : times)
      if (list[i]) {
        from = std::min(from, *list[i]);
        to = std::max(to, *list[i]);
      }
    for (std::size_t row = 0; row < at.size(); ++row)
      if (ida.rows.t[row] >= from && ida.rows.t[row] <= to) at[row] = true;
  }
  return at;
}

void VerificationRuns::add_column_series(double until, std::vector<Kind>& kinds) const {
  std::size_t rows = std::min(ida.rows.t.size(), certificate->history.t.size());
  for (const ObservedRun& run : newmark) rows = std::min(rows, run.rows.t.size());
  const std::vector<bool> left_out = rows_at_events(until);
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == columns_[j].kind; });
    if (kind == kinds.end())
      kind = kinds.insert(kinds.end(), Kind{columns_[j].kind, columns_[j].unit, {}, {}, 0.0});
    Series series{columns_[j].name, {}, {}};
    for (std::size_t row = 0; row < rows && ida.rows.t[row] <= until; ++row) {
      if (left_out[row] || !std::isfinite(certificate->history.at(row, j))) continue;
      const StepTriple values{newmark[0].at(row, j), newmark[1].at(row, j), newmark[2].at(row, j)};
      if (!std::isfinite(ida.at(row, j) + values[0] + values[1] + values[2])) continue;
      series.values.push_back(values);
      series.rows.push_back(row);
      kind->scale = std::max(kind->scale, std::abs(series.values.back()[2]));
    }
    double error = 0.0;
    for (const std::size_t row : series.rows) error = std::max(error, certificate->history.at(row, j));
    kind->order.add(series.values, negligible * error);
    kind->series.push_back(std::move(series));
  }
}

std::vector<VerificationRuns::Kind> VerificationRuns::kinds(double until) const {
  std::vector<Kind> list = {event_times(until)};
  add_column_series(until, list);
  return list;
}

bool VerificationRuns::settled() {
  const Sequence here = sequence();
  const double wanted = std::min(certificate->until, t_end_);
  if (here.differs) return here.exact_until <= here.until;
  if (here.until < nearly * wanted) return false;
  const std::vector<Kind> list = kinds(here.until);
  return std::all_of(list.begin(), list.end(),
                     [](const Kind& k) { return signorini::verify::is_second_order(k.order.value()); });
}

/// Counts one comparison in `kind`, and updates its worst and its first disagreeing observation.
void VerificationRuns::count(const Observation& o, const std::string& where, VerifiedKind& kind) {
  ++kind.compared;
  kind.disagreeing += o.agrees() || o.exact_agrees() ? 0 : 1;
  kind.exact_agreements += o.exact_agrees() ? 1 : 0;
  if (!o.agrees() && !o.exact_agrees() && (!kind.first || o.t < kind.first->t)) {
    kind.first = o;
    kind.first_where = where;
  }
  kind.greatest_bar = std::max(kind.greatest_bar, o.bar);
  if (kind.compared > 1 && excess(o) <= excess(kind.worst)) return;
  kind.worst = o;
  kind.where = where;
}

Observation VerificationRuns::observation(const Series& series, std::size_t i, bool is_event,
                                          const Extrapolation& extrapolated, std::size_t column) const {
  Observation o;
  const std::size_t row = series.rows[i];
  o.richardson = extrapolated.value[i];
  o.bar = extrapolated.error_bound[i];
  if (is_event) {
    o.t = o.ida = ida.track.events[row].t;
    o.ida_error = certificate->t_errors[row];
  } else {
    o.t = ida.rows.t[row];
    o.ida = ida.at(row, column);
    o.ida_error = certificate->history.at(row, column);
    if (exact && row < exact->rows.t.size()) o.exact = exact->at(row, column);
  }
  return o;
}

VerifiedKind VerificationRuns::verified(const Kind& kind, Verification& result) const {
  const bool is_event = kind.name == event_time;
  VerifiedKind summary;
  summary.name = kind.name;
  summary.unit = kind.unit;
  summary.order = kind.order.value();
  const auto exact_times = exact ? times_in(exact->track) : std::vector<std::optional<double>>();
  const SeriesKind of{summary.order, kind.scale, t_end_ / dt.back()};
  for (const Series& series : kind.series) {
    const Extrapolation extrapolated = extrapolate(series.values, of);
    const auto column = static_cast<std::size_t>(
        std::find_if(columns_.begin(), columns_.end(), [&](const auto& c) { return c.name == series.name; }) -
        columns_.begin());
    for (std::size_t i = 0; i < series.rows.size(); ++i) {
      Observation o = observation(series, i, is_event, extrapolated, column);
      if (is_event) {
        const std::size_t row = series.rows[i];
        if (exact && ida.track.events[row].t < result.until) o.exact = exact_times[row];
        const certify::TimedEvent& event = ida.track.events[row];
        result.events.push_back({event.contact, event.type, event.from, event.to, o});
      }
      count(o, series.name, summary);
    }
  }
  return summary;
}

/// The distance of the nearest step from an extreme is random, so extremes have no order of convergence. The bar
/// is the largest difference between newmark's runs, each of which also has rows at the times of IDA's extremes.
void VerificationRuns::add_extremes(Verification& result) const {
  if (!certificate->complete || result.until < t_end_) return;
  const std::size_t first = columns_.size() - model_.outputs.size();
  for (std::size_t i = 0; i < model_.outputs.size(); ++i) {
    const std::size_t column = first + i;
    Observation o;
    for (std::size_t row = 0; row < certificate->history.t.size(); ++row)
      if (const double bound = certificate->history.at(row, column); std::isfinite(bound))
        o.ida_error = std::max(o.ida_error, between_rows * bound);
    const std::string name = "extremes [" + columns_[column].unit + "]";
    auto kind = std::find_if(result.kinds.begin(), result.kinds.end(),
                             [&](const VerifiedKind& k) { return k.name == name; });
    if (kind == result.kinds.end()) {
      kind = result.kinds.emplace(result.kinds.end());
      kind->name = name;
      kind->unit = columns_[column].unit;
    }
    const auto compare = [&](double OutputExtremes::*value, double t, const char* which) {
      const auto of = [&](const ObservedRun& run) { return run.report.response.at(i).*value; };
      o.t = t;
      o.ida = of(ida);
      o.richardson = of(newmark[2]);
      o.bar =
          std::max(std::abs(of(newmark[0]) - of(newmark[1])), std::abs(of(newmark[1]) - o.richardson)) +
          rounding::many_operations * std::sqrt(std::max(1.0, t_end_ / dt.back())) * std::abs(o.richardson);
      if (exact && exact->report.outcome.kind == Outcome::Kind::done) o.exact = of(*exact);
      count(o, columns_[column].name + which, *kind);
    };
    const OutputExtremes& own = ida.report.response.at(i);
    compare(&OutputExtremes::maximum, own.t_maximum, " maximum");
    compare(&OutputExtremes::minimum, own.t_minimum, " minimum");
  }
}

std::string VerificationRuns::differences(const Verification& result) const {
  const VerifiedKind* first = nullptr;
  for (const VerifiedKind& kind : result.kinds)
    if (kind.first && (first == nullptr || kind.first->t < first->first->t)) first = &kind;
  if (first == nullptr) return "";
  const Observation& o = *first->first;
  return fmt::format(
      "{}{} at t = {:.9g}: ida {:.12g}, newmark's limit {:.12g}, difference {:.2g} {}, allowed {:.2g}",
      first->name, first->first_where.empty() ? "" : " of " + first->first_where, o.t, o.ida, o.richardson,
      o.difference(), first->unit, o.allowed());
}

void VerificationRuns::conclude(const Sequence& here, Verification& result) const {
  const auto any = [&](const auto& test) {
    return std::any_of(result.kinds.begin(), result.kinds.end(), test);
  };
  const bool off = any([](const VerifiedKind& k) { return k.disagreeing > 0 && usable(k.order); });
  const bool rough = any([](const VerifiedKind& k) { return !usable(k.order); });
  const bool short_bars = any([](const VerifiedKind& k) { return k.exact_agreements > 0; });
  const std::string finer = fmt::format("--set run.dt={:.3g}", 0.25 * dt.front());
  if (here.differs && here.exact_until <= here.until) {
    result.verdict = Agreement::differ;
    result.sentence = "the sequences of events differ: " + here.reason;
  } else if (off) {
    result.verdict = Agreement::differ;
    result.sentence = differences(result);
  } else if (here.differs) {
    result.sentence = fmt::format(
        "the sequences of events of newmark and ida differ, while exact agrees with ida: {}; use {}",
        here.reason, finer);
  } else if (rough) {
    result.sentence =
        "newmark's time steps are too long: the observed orders of convergence differ too much from two; "
        "use " +
        finer;
  } else if (here.until < t_end_) {
    result.sentence = fmt::format("ida and newmark agree until t = {:.9g} {}; {}", here.until,
                                  model_.units.time, here.reason);
  } else if (short_bars) {
    result.sentence = "newmark's error bars are too small: exact agrees with ida; use " + finer;
  } else {
    result.verdict = Agreement::agree;
    result.sentence = fmt::format("ida and newmark agree to the end, on {} events and {} output times",
                                  result.events.size(), ida.rows.t.size());
  }
}

void VerificationRuns::evaluate(Verification& result) {
  const Sequence here = sequence();
  result.until = here.until;
  for (const Kind& kind : kinds(here.until)) result.kinds.push_back(verified(kind, result));
  add_extremes(result);
  conclude(here, result);
  if (!exact) {
    result.exact_result = "exact cannot compute the scene";
    return;
  }
  double off = 0.0;
  for (const VerifiedEvent& event : result.events)
    if (event.time.exact) off = std::max(off, std::abs(event.time.ida - *event.time.exact));
  result.exact_result =
      fmt::format("exact and ida have the same sequence of events until t = {:.9g}, times within {:.2g} {}",
                  here.exact_until, off, model_.units.time);
}

}  // namespace signorini::verify
