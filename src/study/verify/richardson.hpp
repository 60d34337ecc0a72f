// richardson.hpp: three computations at h, h/2, h/4 and what they tend to.
//
//   x_h = x + C h^2 + O(h^3)
//   order p = log2( rms(x_h - x_h/2) / rms(x_h/2 - x_h/4) )
//
//   R  = x_h/4 + (x_h/4 - x_h/2) / 3      the second order is gone
//   R' = x_h/2 + (x_h/2 - x_h) / 3
//   bar = greatest of 2 |R - R'| + |x_h/2 - x_h/4| / 50, so far and soon after
//
// What is left of R is of third order, a h^3 / 8; R' has a h^3, so |R - R'| is seven times what is left,
// where a is smooth. It is not at events, whose place within a step is chance: R and R' may then be off
// alike, for which the fiftieth of the last difference stands (measured: a thousandth, case 02b), and what
// they leave stays, so the bar forgets nothing. Where the order that is seen is not yet two, it is the whole
// difference |x_h/2 - x_h/4|. Soon after: five values, since a difference may vanish by chance. Rounding
// grows with the square root of the steps.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace signorini {

/// A quantity at one instant, by the three steps: h, h/2, h/4.
using Thrice = std::array<double, 3>;

/// What the values tend to, and how far off that may be.
struct Extrapolated {
  std::vector<double> value, bar;
};

/// Sums of squares of what the steps differ by, over series of one unit.
class ObservedOrder {
 public:
  /// negligible: differences below need no order, as where IDA's own error is far greater.
  void add(const std::vector<Thrice>& series, double negligible = 0.0);
  /// Nothing where the differences are rounding or negligible, as where the method is exact.
  [[nodiscard]] std::optional<double> value() const;

 private:
  double coarse_ = 0.0, fine_ = 0.0, rounding_ = 0.0;
};

/// Is the order that of the method, within a tenth?
[[nodiscard]] bool settled(const std::optional<double>& order);
/// Is it near enough to two for differences to bound errors?
[[nodiscard]] bool usable(const std::optional<double>& order);

/// Of a kind of quantities, which share a unit.
struct KindOfSeries {
  std::optional<double> order;
  double scale = 0.0;  ///< the greatest magnitude
  double steps = 1.0;  ///< of the finest run
};

/// `series` in the order of time.
[[nodiscard]] Extrapolated extrapolate(const std::vector<Thrice>& series, const KindOfSeries& kind);

}  // namespace signorini
