// turning_points.hpp: extreme values between the ends of a step, which an observer at its ends would not see.
//
//   f'(x) = 0 for f = N, T, g and the body's ut, where f exceeds all that it was before
#pragma once

#include <array>

#include "decide/decision.hpp"
#include "motion/contact_series.hpp"

namespace signorini {

class TurningPoints {
 public:
  explicit TurningPoints(std::size_t contacts) : ranges_(watched.size() * contacts) {}

  /// After an instant, where the values may have jumped.
  void start(const Decision& decision);
  /// On [0, x_end] of a series.
  void find(const std::vector<ContactSeries>& contacts, const Series& series, double x_end);
  /// Ascending, of the last step.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  static constexpr std::array<ContactSeries::Field, 4> watched{ContactSeries::N, ContactSeries::T,
                                                               ContactSeries::gap, ContactSeries::slide};
  struct Range {
    double least = 0.0, greatest = 0.0;
  };
  std::vector<Range> ranges_;  // so far
  std::vector<double> times_;
  bool began_ = false;
};

}  // namespace signorini
