// turning_points.hpp: finds extreme values inside a step, which evaluations at the ends of the step would miss.
//
//   f'(x) = 0 for f = N, T, g and the body's ut, where f exceeds its earlier range
//
// Turning points near an end of the step are also found if the values at the samples are monotone.
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

  /// Extends the ranges to the values after a decision. The values may have jumped at the decision.
  void start(const decide::Decision& decision);
  /// Ends of the interval at which an observer evaluates the motion. observed: both ends (a whole step); first_part: only the
  /// beginning; part: neither end.
  enum class Ends : unsigned char { observed, first_part, part };
  /// Finds turning points of all contacts on [x_begin, x_end] of a series of degree max_root_degree at most.
  void find(const std::vector<motion::ContactSeries>& contacts, const motion::Series& series, double x_begin,
            double x_end, Ends ends = Ends::observed);
  /// Finds the turning points of one quantity, a_0 + a_1 x + ... on [0, x_end] with t = begin + scale x. Call it between
  /// open() and close().
  void open();
  void find(std::size_t contact, motion::ContactSeries::Field field, const double* a, std::size_t degree,
            double x_end, double begin, double scale);
  void close();
  /// Smallest and largest value so far of one field of a contact.
  struct Range {
    double least = 0.0, greatest = 0.0;
    void extend(double value);
    /// Width of the range after an extension to this value.
    [[nodiscard]] double width(double value) const {
      return std::max(greatest, value) - std::min(least, value);
    }
    /// True if the value exceeds the range by more than its rounding and the rate points back to the range:
    /// so a turning point lies before this place.
    [[nodiscard]] bool is_exceeded(double value, double rate, double rounding) const {
      return (value - rounding > greatest && rate < 0.0) || (value + rounding < least && rate > 0.0);
    }
    /// True if all values from value - change to value + change are inside the range, even with this rounding error.
    [[nodiscard]] bool contains(double value, double change, double rounding) const {
      return value + change + rounding < greatest && value - change - rounding > least;
    }
  };
  /// Range of the values of a watched field so far.
  [[nodiscard]] const Range& range(std::size_t contact, motion::ContactSeries::Field field) const {
    return ranges_[range_index(contact, field)];
  }
  /// Ranges of all contacts: for each contact the fields in the order of watched_fields.
  [[nodiscard]] const Range* ranges() const { return ranges_.data(); }
  /// Extends the range to the value at the end of a step without a turning point.
  void extend_range(std::size_t contact, motion::ContactSeries::Field field, double value) {
    ranges_[range_index(contact, field)].extend(value);
  }
  static constexpr std::array<motion::ContactSeries::Field, 4> watched_fields{
      motion::ContactSeries::N, motion::ContactSeries::T, motion::ContactSeries::gap,
      motion::ContactSeries::slide};
  /// A turning point of the last step. kind: index made of contact, field, and minimum (even) or maximum (odd). If several
  /// turning points have the same kind, the last one is the most extreme.
  struct TurningPoint {
    std::size_t kind = 0;
    double time = 0.0;
    [[nodiscard]] std::size_t contact() const { return kind / (2 * watched_fields.size()); }
  };
  [[nodiscard]] const std::vector<TurningPoint>& turning_points() const { return turning_points_; }
  /// Times of the turning points of the last step, ascending.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// Turning point at the beginning of a part of a step, where the field has the given value and rate. nullopt, unless the
  /// value exceeds the earlier range and the rate points back to the range.
  std::optional<TurningPoint> find_at_start(std::size_t contact, motion::ContactSeries::Field field,
                                            double value, double rate, double time);

 private:
  // The phase angle of a step is below 4 rad for all modes with significant amplitudes, so samples are at most 0.5 rad apart.
  static constexpr std::size_t sample_intervals = 8;
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
  /// Records the turning points of one polynomial, sampled at the places x. place: index of its quantity in ranges_.
  void find_on_path(const Path& path, std::size_t place, const Samples& x, Ends ends);
  void find_near_end(std::size_t end, const Path& path, std::size_t place, const Samples& x,
                     const Samples& value, Ends ends);
  /// Records a turning point if it exceeds the earlier range.
  void record(const Path& path, std::size_t place, double at);

  std::vector<Range> ranges_;   // ranges of the values so far
  std::vector<double> values_;  // values at the last decision; empty once the motion has advanced
  std::vector<TurningPoint> turning_points_;
  std::vector<double> times_;
  bool began_ = false;
};

}  // namespace signorini::events
