// turning_points.hpp: extreme values between the ends of a step, which an observer at its ends would miss.
//
//   f'(x) = 0 for f = N, T, g and the body's ut, where f exceeds its earlier range
//
// A turning point beside an end of the step, where the values at the samples are monotone, counts as well.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "decide/decision.hpp"
#include "motion/contact_series.hpp"

namespace signorini::events {

class TurningPointDetector {
 public:
  explicit TurningPointDetector(std::size_t contacts) : ranges_(watched_fields.size() * contacts) {}

  /// Called after an instant at which the values may have jumped.
  void start(const decide::Decision& decision);
  /// observed: an observer sees the values at the ends of a step. The ends of a part of a step are not observed, except
  /// the beginning of the first part.
  enum class Ends : unsigned char { observed, first_part, part };
  /// Finds turning points on [x_begin, x_end] of a series of degree max_root_degree at most.
  void find(const std::vector<motion::ContactSeries>& contacts, const motion::Series& series, double x_begin,
            double x_end, Ends ends = Ends::observed);
  /// Same, for one quantity: a_0 + a_1 x + ... on [0, x_end], t = begin + scale x. Called between open() and close().
  void open();
  void find(std::size_t contact, motion::ContactSeries::Field field, const double* a, std::size_t degree,
            double x_end, double begin, double scale);
  void close();
  struct Range {
    double least = 0.0, greatest = 0.0;
    void extend(double value);
    /// Width of the range extended to this value.
    [[nodiscard]] double width(double value) const {
      return std::max(greatest, value) - std::min(least, value);
    }
    /// True if the value exceeds the range by more than its rounding and the rate points back: a turning point was
    /// passed.
    [[nodiscard]] bool is_exceeded(double value, double rate, double rounding) const {
      return (value - rounding > greatest && rate < 0.0) || (value + rounding < least && rate > 0.0);
    }
    /// True if all values within `change` of the value, known to `rounding`, are in the range.
    [[nodiscard]] bool contains(double value, double change, double rounding) const {
      return value + change + rounding < greatest && value - change - rounding > least;
    }
  };
  /// Range so far of a watched field.
  [[nodiscard]] const Range& range(std::size_t contact, motion::ContactSeries::Field field) const {
    return ranges_[range_index(contact, field)];
  }
  /// Ranges of all contacts, field by field in the order of `watched`.
  [[nodiscard]] const Range* ranges() const { return ranges_.data(); }
  /// Takes the value at the end of a step without a turning point.
  void extend_range(std::size_t contact, motion::ContactSeries::Field field, double value) {
    ranges_[range_index(contact, field)].extend(value);
  }
  static constexpr std::array<motion::ContactSeries::Field, 4> watched_fields{
      motion::ContactSeries::N, motion::ContactSeries::T, motion::ContactSeries::gap,
      motion::ContactSeries::slide};
  /// Turning points of the last step: quantity and contact, upwards or downwards, and time. Those of the same kind
  /// exceed each other, so the last one counts.
  struct TurningPoint {
    std::size_t kind = 0;
    double time = 0.0;
    [[nodiscard]] std::size_t contact() const { return kind / (2 * watched_fields.size()); }
  };
  [[nodiscard]] const std::vector<TurningPoint>& turning_points() const { return turning_points_; }
  /// Times of the turning points of the last step, ascending.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// A part of a step begins with this value and rate: a turning point if the value exceeds the earlier range and the
  /// rate points back.
  std::optional<TurningPoint> find_at_start(std::size_t contact, motion::ContactSeries::Field field,
                                            double value, double rate, double time);

 private:
  static constexpr std::size_t sample_intervals =
      8;  // a step turns by less than 4 rad of any mode that matters
  using Samples = std::array<double, sample_intervals + 1>;
  [[nodiscard]] static std::size_t range_index(std::size_t contact, motion::ContactSeries::Field field) {
    const auto place =
        std::find(watched_fields.begin(), watched_fields.end(), field) - watched_fields.begin();
    return watched_fields.size() * contact + static_cast<std::size_t>(place);
  }
  [[nodiscard]] static Samples samples_of(double x_begin, double x_end);
  /// A polynomial on a step, t = begin + scale x.
  struct Path {
    const double* a;
    std::size_t degree;
    double begin, scale;
  };
  [[nodiscard]] static bool stays_in_range(const Path& path, const Range& range, const Samples& x);
  /// place: index of the range.
  void find_on_path(const Path& path, std::size_t place, const Samples& x, Ends ends);
  void find_near_end(std::size_t end, const Path& path, std::size_t place, const Samples& x,
                     const Samples& value, Ends ends);
  /// Records a turning point if it exceeds the earlier range.
  void record(const Path& path, std::size_t place, double at);

  std::vector<Range> ranges_;   // ranges so far
  std::vector<double> values_;  // values at the last instant; empty: the motion has advanced since
  std::vector<TurningPoint> turning_points_;
  std::vector<double> times_;
  bool began_ = false;
};

}  // namespace signorini::events
