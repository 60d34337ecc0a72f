// turning_points.hpp: extreme values between the ends of a step, which an observer at its ends would not see.
//
//   f'(x) = 0 for f = N, T, g and the body's ut, where f exceeds all that it was before
//
// A turn that lies beside an end of the step, where the values at the samples go one way only, counts as well.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "decide/decision.hpp"
#include "motion/contact_series.hpp"

namespace signorini {

class TurningPoints {
 public:
  explicit TurningPoints(std::size_t contacts) : ranges_(watched.size() * contacts) {}

  /// After an instant, where the values may have jumped.
  void start(const Decision& decision);
  /// observed: somebody looks at the values at the ends of a step. At those of its parts nobody does, but where the first
  /// one begins.
  enum class Ends : unsigned char { observed, first_part, part };
  /// On [x_begin, x_end] of a series, of degree most_fall_degree at most.
  void find(const std::vector<ContactSeries>& contacts, const Series& series, double x_begin, double x_end,
            Ends ends = Ends::observed);
  /// The same, quantity by quantity: a_0 + a_1 x + ... on [0, x_end], t = begin + scale x. Between open() and close().
  void open();
  void find(std::size_t contact, ContactSeries::Field field, const double* a, std::size_t degree,
            double x_end, double begin, double scale);
  void close();
  struct Range {
    double least = 0.0, greatest = 0.0;
    void see(double value);
    /// Its width with this value.
    [[nodiscard]] double width(double value) const {
      return std::max(greatest, value) - std::min(least, value);
    }
    /// Beyond all before by more than its rounding, and on its way back: it has turned.
    [[nodiscard]] bool is_left(double value, double rate, double rounding) const {
      return (value - rounding > greatest && rate < 0.0) || (value + rounding < least && rate > 0.0);
    }
    /// Whatever lies within `change` of the value, this known to `rounding`.
    [[nodiscard]] bool holds(double value, double change, double rounding) const {
      return value + change + rounding < greatest && value - change - rounding > least;
    }
  };
  /// So far, of a field that is watched.
  [[nodiscard]] const Range& range(std::size_t contact, ContactSeries::Field field) const {
    return ranges_[place_of(contact, field)];
  }
  /// Of all contacts, field by field as they are watched.
  [[nodiscard]] const Range* ranges() const { return ranges_.data(); }
  /// Its value at the end of a step, on which it does not turn.
  void see(std::size_t contact, ContactSeries::Field field, double value) {
    ranges_[place_of(contact, field)].see(value);
  }
  static constexpr std::array<ContactSeries::Field, 4> watched{ContactSeries::N, ContactSeries::T,
                                                               ContactSeries::gap, ContactSeries::slide};
  /// Turns of the last step: of which quantity of which contact, upwards or downwards, and when. Those of one
  /// kind exceed each other, so the last one counts.
  struct Turn {
    std::size_t kind = 0;
    double time = 0.0;
    [[nodiscard]] std::size_t contact() const { return kind / (2 * watched.size()); }
  };
  [[nodiscard]] const std::vector<Turn>& turns() const { return turns_; }
  /// Ascending, of the last step.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// Where a part of a step begins with this value and rate: a turn, if it exceeds all before and goes back.
  std::optional<Turn> begins(std::size_t contact, ContactSeries::Field field, double value, double rate,
                             double time);

 private:
  static constexpr std::size_t turn_samples = 8;  // a step turns by less than 4 rad of any mode that matters
  using Samples = std::array<double, turn_samples + 1>;
  [[nodiscard]] static std::size_t place_of(std::size_t contact, ContactSeries::Field field) {
    const auto place = std::find(watched.begin(), watched.end(), field) - watched.begin();
    return watched.size() * contact + static_cast<std::size_t>(place);
  }
  [[nodiscard]] static Samples samples_of(double x_begin, double x_end);
  /// A polynomial on a step, t = begin + scale x.
  struct Path {
    const double* a;
    std::size_t degree;
    double begin, scale;
  };
  [[nodiscard]] static bool stays(const Path& path, const Range& range, const Samples& x);
  /// place: of the range.
  void find_of(const Path& path, std::size_t place, const Samples& x, Ends ends);
  void find_beside(std::size_t end, const Path& path, std::size_t place, const Samples& x,
                   const Samples& value, Ends ends);
  /// A turn, if it exceeds all before.
  void record(const Path& path, std::size_t place, double at);

  std::vector<Range> ranges_;   // so far
  std::vector<double> values_;  // at the last instant; empty: the motion has gone on
  std::vector<Turn> turns_;
  std::vector<double> times_;
  bool began_ = false;
};

}  // namespace signorini
