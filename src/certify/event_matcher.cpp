#include "certify/event_matcher.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"

namespace signorini::certify {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Relative rounding error of an event time: two rounding errors of a sum.
constexpr double relative_clock_rounding = 2.0 * rounding::eps;

/// End of the certified sequence and its reason; at() keeps the earliest end.
struct CertifiedSpan {
  double t = never;
  std::string reason;
  void at(double time, const std::string& why) {
    if (time < t) *this = {time, why};
  }
};

using Rows = std::vector<std::size_t>;

/// Data of a contact from its previous events.
struct Past {
  double off = 0.0;  // t' - t of the previous event
  // Differences R (event_matcher.hpp) of the last events, in a ring buffer.
  std::vector<double> speeds = std::vector<double>(difference_window, 0.0);
  std::size_t next = 0;
};

/// For each contact, the indices of the events that change its state.
std::vector<Rows> by_contact(const std::vector<TimedEvent>& events, std::size_t contacts) {
  std::vector<Rows> rows(contacts);
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].is_change()) rows[static_cast<std::size_t>(events[i].contact)].push_back(i);
  return rows;
}

bool same(const TimedEvent& a, const TimedEvent& b) {
  return a.type == b.type && a.from == b.from && a.to == b.to;
}

class EventMatcher {
 public:
  EventMatcher(const EventSequence& run, const std::vector<EventSequence>& companions, double factor,
               const std::vector<std::string>& names, bool rounded)
      : run_(run), companions_(companions), factor_(factor), names_(names), rounded_(rounded) {}

  MatchResult verdict() {
    deviation_.assign(run_.events.size(), 0.0);
    uncertainty_.clear();
    for (const TimedEvent& event : run_.events) uncertainty_.push_back(event.uncertainty);
    const std::vector<Rows> own = by_contact(run_.events, names_.size());
    for (const EventSequence& companion : companions_) pair(own, companion);
    share();
    grow();
    MatchResult result;
    settle(result);
    count_unordered(result);
    return result;
  }

 private:
  /// Pairs the i-th events of each contact in both runs, computes their time differences, and finds the times at which
  /// the certified sequence must end.
  void pair(const std::vector<Rows>& own, const EventSequence& companion) {
    const std::vector<Rows> other = by_contact(companion.events, names_.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::size_t longest = std::max(own[k].size(), other[k].size());
      Past past;
      for (std::size_t i = 0; i < longest && pair(own[k], other[k], i, companion, past); ++i) {
      }
    }
    for (const EventSequence* track : {&run_, &companion})
      if (track->first_undecided_t)
        certified_until_.at(*track->first_undecided_t,
                            fmt::format("at t = {:.9g} rounding left several contact states possible",
                                        *track->first_undecided_t));
    for (const EventSequence* track : {&run_, &companion})
      if (track->first_violation)
        certified_until_.at(track->first_violation->t, track->first_violation->sentence);
    if (const auto& graze = companion.graze)
      certified_until_.at(
          graze->t,
          fmt::format("the {} of '{}' is zero within the companion's tolerance at t = {:.9g}, but there "
                      "is no event; a smaller rtol, or engine exact, decides whether zero was crossed",
                      graze->guard, names_[static_cast<std::size_t>(graze->contact)], graze->t));
    if (companion.reached < run_.reached)
      certified_until_.at(companion.reached,
                          companion.stop.empty() ? "the companion has ended" : companion.stop);
  }

  bool pair(const Rows& own, const Rows& other, std::size_t i, const EventSequence& companion, Past& past) {
    const TimedEvent* a = i < own.size() ? &run_.events[own[i]] : nullptr;
    const TimedEvent* b = i < other.size() ? &companion.events[other[i]] : nullptr;
    if (a == nullptr || b == nullptr) {
      const TimedEvent& alone = a != nullptr ? *a : *b;
      if (alone.t <= std::min(run_.reached, companion.reached))
        // The event without a partner may occur earlier by its uncertainty, which is large if a guard grazes.
        certified_until_.at(std::max(0.0, alone.t - factor_ * static_cast<double>(alone.uncertainty)),
                            a != nullptr ? describe(*a) + " has no matching event in the companion"
                                         : "the companion has one more event, " + describe(*b));
      return false;
    }
    const double off = b->t - a->t, change = std::abs(off - past.off);
    past.off = off;
    // An error that is common to both events does not change the interval since the contact's previous event.
    const double since = i > 0 ? a->t - run_.events[own[i - 1]].t : never;
    // Rounding errors of the two event times are added, unless both events are changes at one instant.
    const double apart = i > 0 && since > 0.0 ? interval_rounding(own, other, i, companion) : 0.0;
    const double shift = factor_ * change + apart;
    if (same(*a, *b) && shift <= 0.5 * since) {
      if (!rebound_is_decided(*a, *b, past)) return false;
      deviation_[own[i]] = std::max(deviation_[own[i]], std::abs(off));
      uncertainty_[own[i]] = std::max(uncertainty_[own[i]], b->uncertainty);
      return true;
    }
    if (same(*a, *b)) {
      certified_until_.at(std::min(a->t, b->t),
                          fmt::format("{} follows the contact's previous event after {:.2g}, and this "
                                      "interval has an error of {:.2g}",
                                      describe(*a), since, shift));
      return false;
    }
    certified_until_.at(std::min(a->t, b->t),
                        fmt::format("{} differs from the companion's event, {}", describe(*a), describe(*b)));
    return false;
  }

  /// Sum of the rounding errors of two successive event times: of the run if its engine has rounding errors only, else of
  /// a companion with such an engine, which cannot certify shorter intervals than it resolves.
  [[nodiscard]] double interval_rounding(const Rows& own, const Rows& other, std::size_t i,
                                         const EventSequence& companion) const {
    if (!rounded_ && !companion.rounded) return 0.0;
    const std::vector<TimedEvent>& events = rounded_ ? run_.events : companion.events;
    const Rows& rows = rounded_ ? own : other;
    return static_cast<double>(events[rows[i]].uncertainty) +
           static_cast<double>(events[rows[i - 1]].uncertainty);
  }

  /// Returns false if the decision between rest and rebound depends on less than the error of the speed.
  bool rebound_is_decided(const TimedEvent& a, const TimedEvent& b, Past& past) {
    const double r = a.departure, other = b.departure;
    if (std::isnan(r) || std::isnan(other)) return true;
    past.speeds[past.next++ % difference_window] = std::abs(r - other) / std::max({r, other, 1.0});
    const double off = factor_ * *std::max_element(past.speeds.begin(), past.speeds.end()) * std::max(r, 1.0);
    if (off < std::abs(r - 1.0)) return true;
    certified_until_.at(
        std::min(a.t, b.t),
        fmt::format(
            "{} ends with {:.6g} times the least rebound speed, and this ratio has an error of {:.2g}",
            describe(a), r, off));
    return false;
  }

  [[nodiscard]] std::string describe(const TimedEvent& event) const {
    return fmt::format("{} of '{}' at t = {:.9g}, {} -> {}", to_string(event.type),
                       names_[static_cast<std::size_t>(event.contact)], event.t, to_string(event.from),
                       to_string(event.to));
  }

  /// Gives all changes at one instant the largest uncertainty among them, because they have the same time.
  void share() {
    const std::vector<TimedEvent>& events = run_.events;
    for (std::size_t begin = 0, end = 0; begin < events.size(); begin = end) {
      float greatest = 0.0F;
      for (end = begin; end < events.size() && events[end].t == events[begin].t; ++end)
        if (events[end].is_change()) greatest = std::max(greatest, uncertainty_[end]);
      for (std::size_t i = begin; i < end; ++i)
        if (events[i].is_change()) uncertainty_[i] = greatest;
    }
  }

  /// Computes t_error of each event before the end, in the order of time.
  void grow() {
    errors_.assign(run_.events.size(), none);
    std::vector<double> last(difference_window, 0.0);
    std::size_t next = 0;
    for (std::size_t i = 0; i < run_.events.size(); ++i) {
      const TimedEvent& event = run_.events[i];
      if (event.t >= certified_until_.t) break;
      errors_[i] = relative_clock_rounding * event.t;
      if (!event.is_change() || (!event.is_located && deviation_[i] == 0.0)) continue;
      last[next++ % difference_window] = deviation_[i];
      const double error = factor_ * *std::max_element(last.begin(), last.end());
      spread_ = error;
      errors_[i] += error + static_cast<double>(uncertainty_[i]);
    }
  }

  /// Sets the end of the certified part. Events that may be later than the end are not certified; the certified part ends
  /// before the earliest possible time of these events, so that it contains no row after one of them.
  void settle(MatchResult& result) {
    result.until = run_.reached;
    if (certified_until_.t < never) {
      const double end = std::max(0.0, certified_until_.t - spread_);
      result.until = end;
      result.reason = certified_until_.reason;
      for (std::size_t i = 0; i < errors_.size(); ++i) {
        const double t = run_.events[i].t;
        if (t + errors_[i] < end) continue;
        if (t < end) result.until = std::min(result.until, std::max(0.0, t - errors_[i]));
        errors_[i] = none;
      }
    }
    const auto first = std::find_if(errors_.begin(), errors_.end(), [](double e) { return std::isnan(e); });
    if (first != errors_.end()) result.first_uncertain = static_cast<std::size_t>(first - errors_.begin());
    result.t_errors = std::move(errors_);
    result.spread = spread_;
  }

  void count_unordered(MatchResult& result) const {
    std::size_t before = run_.events.size();
    for (std::size_t i = 0; i < run_.events.size() && !std::isnan(result.t_errors[i]); ++i) {
      const TimedEvent& event = run_.events[i];
      if (!event.is_change()) continue;
      if (before < i && run_.events[before].contact != event.contact) {
        const double apart = event.t - run_.events[before].t;
        if (apart > relative_clock_rounding * event.t && apart < result.t_errors[before] + result.t_errors[i])
          ++result.unordered;
      }
      before = i;
    }
  }

  const EventSequence& run_;
  const std::vector<EventSequence>& companions_;
  double factor_;
  const std::vector<std::string>& names_;
  bool rounded_;
  CertifiedSpan certified_until_;
  std::vector<double> deviation_, errors_;
  std::vector<float> uncertainty_;  // for each event: largest uncertainty in the run and in companions
  double spread_ = 0.0;             // c D at the end of the certified sequence
};

/// The smallest float that is not below x.
float rounded_up(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) < x ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

}  // namespace

TimedEvent timed_event(const Event& event) {
  return {event.t,
          rounded_up(event.t_uncertainty.value_or(0.0)),
          event.contact,
          event.type,
          event.from,
          event.to,
          event.guard_rate.has_value(),
          event.departure.value_or(none)};
}

MatchResult match_events(const EventSequence& run, const std::vector<EventSequence>& companions,
                         double factor, const std::vector<std::string>& names, bool rounded) {
  return EventMatcher(run, companions, factor, names, rounded).verdict();
}

}  // namespace signorini::certify
