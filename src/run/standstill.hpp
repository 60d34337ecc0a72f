// standstill.hpp: many events are no fault, many events in no time are.
//
//   at one instant   at most max_events_at_once, an instant being ten resolutions of the clock
//   altogether       10 000 events take at least 1e-5 of the run
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace signorini {

class Standstill {
 public:
  /// unit: what one of the times here is where they are said.
  Standstill(double t_end, int most_at_once, double unit = 1.0)
      : t_end_(t_end), most_at_once_(most_at_once), unit_(unit) {}

  /// Counts an instant; times do not decrease. Why the run must not go on, or nothing. contacts: whose guards
  /// fell, or whose states an engine has changed.
  [[nodiscard]] std::optional<std::string> count(double t, double resolution,
                                                 const std::vector<std::size_t>& contacts = {});
  /// Those of the instants that were counted too often, ascending.
  [[nodiscard]] std::vector<std::size_t> contacts() const { return {contacts_.begin(), contacts_.end()}; }

 private:
  using Contacts = std::set<std::size_t>;
  [[nodiscard]] std::optional<std::string> crawl(double t);

  double t_end_;
  int most_at_once_;
  double unit_;
  double cluster_ = 0.0;  // time of the first event of those at one instant
  int at_once_ = 0;
  double mark_ = 0.0;  // time of the last look at progress
  int since_mark_ = 0;
  Contacts in_cluster_, after_mark_, contacts_;
};

}  // namespace signorini
