// clock.hpp: CPU time of the process, s; a recorder that keeps event times alone.
#pragma once

#include <ctime>
#include <utility>
#include <vector>

#include "signorini/result.hpp"

namespace signorini::benchmarks {

[[nodiscard]] inline double cpu() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class EventTimes : public Recorder {
 public:
  void event(const Event& e) override {
    if (e.contact >= 0) events.push_back(e);
  }
  void sample(const Sample&) override {}
  std::vector<Event> events;
};

}  // namespace signorini::benchmarks
