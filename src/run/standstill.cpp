#include "run/standstill.hpp"

#include <fmt/core.h>

#include <utility>

namespace signorini {
namespace {

// A bouncing ball with e = 0.99 passes its accumulation point with 2000 events; one with e = 0.999 needs 20000, in a
// longer time.
constexpr int watched_events = 10000;
constexpr double least_progress = 1e-5;          // fraction of the run, for this number of events
constexpr double resolutions_of_instant = 10.0;  // largest distance of events of one instant from the first

}  // namespace

std::optional<std::string> Standstill::count(double t, double resolution,
                                             const std::vector<std::size_t>& contacts) {
  after_mark_.insert(contacts.begin(), contacts.end());
  if (auto reason = crawl(t)) return reason;
  if (at_once_ == 0 || t - cluster_ > resolutions_of_instant * resolution) {
    cluster_ = t;
    at_once_ = 0;
    in_cluster_.clear();
  }
  in_cluster_.insert(contacts.begin(), contacts.end());
  if (++at_once_ <= most_at_once_) return std::nullopt;
  contacts_ = in_cluster_;
  return fmt::format("{} events at one instant; time does not advance", most_at_once_);
}

std::optional<std::string> Standstill::crawl(double t) {
  if (++since_mark_ < watched_events) return std::nullopt;
  const double advanced = t - mark_;
  since_mark_ = 0;
  mark_ = t;
  contacts_ = std::exchange(after_mark_, {});
  if (advanced >= least_progress * t_end_) return std::nullopt;
  return fmt::format("{} events within {:.3g} of time; the motion does not get on", watched_events,
                     advanced * unit_);
}

}  // namespace signorini
