#include "study/compare/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/rounding.hpp"

namespace signorini::compare {

bool same_time(double a, double b) {
  constexpr double roundoff = 1e-13;  // relative; for time grids computed by summation
  return std::abs(a - b) <= roundoff * std::max(std::abs(a), std::abs(b));
}

bool TimeJoin::read(result::CsvReader& reader, std::size_t& count) const {
  if (!reader.next() || beyond(reader.t(), until_)) return false;
  ++count;
  return true;
}

bool TimeJoin::next() {
  bool more_a = read(a_, rows_.reference), more_b = read(b_, rows_.other);
  while (more_a && more_b) {
    const double ta = a_.t(), tb = b_.t();
    t_ = ta;
    if (same_time(ta, tb)) {
      ++rows_.compared;
      return true;
    }
    if (ta < tb)
      more_a = read(a_, rows_.reference);
    else
      more_b = read(b_, rows_.other);
  }
  while (more_a) more_a = read(a_, rows_.reference);
  while (more_b) more_b = read(b_, rows_.other);
  return false;
}

ContactRowReader::ContactRowReader(const std::filesystem::path& path)
    : reader_(path), contact_(reader_.column("contact")), N_(reader_.column("N")), T_(reader_.column("T")) {
  pending_ = reader_.next();
}

bool ContactRowReader::next() {
  if (!pending_) return false;
  t_ = reader_.t();
  forces_.clear();
  do {
    forces_[reader_.cell(contact_)] = {reader_.number(N_), reader_.number(T_)};
    pending_ = reader_.next();
  } while (pending_ && reader_.t() == t_);
  return true;
}

namespace {

bool same(const LoggedEvent& a, const LoggedEvent& b) {
  return a.contact == b.contact && a.type == b.type && a.from == b.from && a.to == b.to;
}

/// Position in one list of events: the events taken so far (paired or skipped), and the next event of each contact.
class EventCursor {
 public:
  EventCursor(const std::vector<LoggedEvent>& events, double t_end, double instant)
      : events_(events), t_end_(t_end), instant_(instant) {
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (!events[i].is_change() || events[i].contact.empty() || events[i].t > t_end + instant) continue;
      order_.push_back(i);
      of_contact_[events[i].contact].push_back(i);
    }
    taken_.assign(events.size(), false);
  }

  [[nodiscard]] const LoggedEvent& operator[](std::size_t i) const { return events_[i]; }

  /// The first event that is neither paired nor skipped.
  std::optional<std::size_t> first() {
    while (head_ < order_.size() && taken_[order_[head_]]) ++head_;
    if (head_ == order_.size()) return std::nullopt;
    return order_[head_];
  }

  std::optional<std::size_t> next_of(const std::string& contact) {
    const auto found = of_contact_.find(contact);
    if (found == of_contact_.end()) return std::nullopt;
    std::size_t& at = next_[contact];
    while (at < found->second.size() && taken_[found->second[at]]) ++at;
    if (at == found->second.size()) return std::nullopt;
    return found->second[at];
  }

  void take(std::size_t i) { taken_[i] = true; }

  /// Events before event i that are neither paired nor skipped.
  std::vector<std::size_t> passed_over(std::size_t i) {
    std::vector<std::size_t> list;
    first();
    for (std::size_t k = head_; k < order_.size() && order_[k] < i; ++k)
      if (!taken_[order_[k]]) list.push_back(order_[k]);
    return list;
  }

  [[nodiscard]] bool one_instant(std::size_t i, std::size_t j) const {
    return std::abs(events_[i].t - events_[j].t) <= instant_;
  }
  [[nodiscard]] bool undetermined(std::size_t i, std::size_t j) const {
    return std::abs(events_[i].t - events_[j].t) <=
           instant_ + events_[i].uncertainty + events_[j].uncertainty;
  }
  /// True if the event may lie beyond the end within its uncertainty, so that the other run may lack it.
  [[nodiscard]] bool at_end(std::size_t i) const {
    return events_[i].t >= t_end_ - instant_ - events_[i].uncertainty;
  }

  [[nodiscard]] std::size_t remaining() {
    first();
    return static_cast<std::size_t>(std::count_if(order_.begin() + static_cast<std::ptrdiff_t>(head_),
                                                  order_.end(), [&](std::size_t i) { return !taken_[i]; }));
  }

 private:
  const std::vector<LoggedEvent>& events_;
  double t_end_, instant_;
  std::vector<std::size_t> order_;
  std::map<std::string, std::vector<std::size_t>> of_contact_;
  std::map<std::string, std::size_t> next_;
  std::vector<bool> taken_;
  std::size_t head_ = 0;
};

enum class Order { same, one_instant, undetermined, different };

/// Decides if `event` of the reference may be paired with `partner`, although `other` has earlier events that
/// are not paired yet.
Order order_of(EventCursor& reference, EventCursor& other, std::size_t event, std::size_t partner) {
  Order order = Order::same;
  for (const std::size_t before : other.passed_over(partner)) {
    const auto later = reference.next_of(other[before].contact);
    const bool known = later && same(reference[*later], other[before]);
    if (other.one_instant(before, partner) || (known && reference.one_instant(event, *later))) {
      order = std::max(order, Order::one_instant);
    } else if (known && (other.undetermined(before, partner) || reference.undetermined(event, *later))) {
      order = std::max(order, Order::undetermined);
    } else {
      return Order::different;
    }
  }
  return order;
}

}  // namespace

std::string LoggedEvent::name() const { return contact + " " + type + ", " + from + " -> " + to; }

Alignment align(const std::vector<LoggedEvent>& reference, const std::vector<LoggedEvent>& other,
                const AlignmentSettings& settings) {
  const double roundoff = rounding::few_operations * std::abs(settings.t_end);
  const double instant = std::max(settings.instant, roundoff);
  EventCursor a(reference, settings.t_end, instant), b(other, settings.t_end, instant);
  Alignment result;
  std::optional<std::size_t> event;
  while ((event = a.first())) {
    const auto partner = b.next_of(a[*event].contact);
    if (!partner || !same(a[*event], b[*partner])) {
      if (partner || !a.at_end(*event)) break;
      a.take(*event);
      continue;
    }
    const Order order = order_of(a, b, *event, *partner);
    if (order == Order::different) break;
    const bool swapped = order == Order::undetermined;
    result.pairs.push_back({*event, *partner, swapped});
    result.swapped += swapped ? 1 : 0;
    a.take(*event);
    b.take(*partner);
  }
  std::optional<std::size_t> rest = b.first();
  while (!event && rest && b.at_end(*rest)) {
    b.take(*rest);
    rest = b.first();
  }
  if (!event && !rest) return result;
  const double never = std::numeric_limits<double>::infinity();
  result.split = Alignment::Split{std::min(event ? a[*event].t : never, rest ? b[*rest].t : never), event,
                                  rest, std::max(a.remaining(), b.remaining())};
  return result;
}

}  // namespace signorini::compare
