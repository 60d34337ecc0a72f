#include "run/event_order.hpp"

#include <fmt/core.h>

#include "model/said.hpp"

namespace signorini {
namespace {

constexpr int most_warnings = 5;  // limit for pairs of events of unknown order

}  // namespace

std::string EventOrder::told(const Event& event) const {
  return fmt::format("'{}' at {:.12g}", model_.contacts[static_cast<std::size_t>(event.contact)].name,
                     said_time(model_, event.t));
}

void EventOrder::event(const Event& event, double resolution) {
  if (last_.contact >= 0 && last_.contact != event.contact && event.t - last_.t > resolution &&
      event.t - last_.t < *last_.t_uncertainty + *event.t_uncertainty)
    warn(fmt::format("the events of {} and of {}", told(last_), told(event)));
  last_ = event;
}

void EventOrder::load_jump(double t) {
  if (last_.contact >= 0 && t - last_.t < *last_.t_uncertainty)
    warn(fmt::format("the event of {} and the jump of a load at {:.12g}", told(last_), said_time(model_, t)));
}

void EventOrder::warn(const std::string& which) {
  if (++unordered_ <= most_warnings)
    report_.warnings.push_back(
        fmt::format("the order of {} is not determined at this precision ({} in "
                    "events.csv)",
                    which, event_column(&Event::t_uncertainty)));
}

void EventOrder::finish() {
  if (unordered_ > most_warnings)
    report_.warnings.push_back(
        fmt::format("{} more pairs of events whose order is not determined", unordered_ - most_warnings));
}

}  // namespace signorini
