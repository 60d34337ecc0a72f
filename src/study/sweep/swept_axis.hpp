// swept_axis.hpp: the key of a sweep that is the axis of its pictures, and the rows of each curve over it.
//
//   x of a row = value of the key on the axis, or its number if values are not numbers
#pragma once

#include <string>
#include <vector>

#include "study/sweep/sweep_table.hpp"

namespace signorini {

struct SweptAxis {
  std::size_t key = 0;  ///< index into SweepSpec::vary
  bool numbers = true;  ///< all of its values are numbers
  const Vary* vary = nullptr;

  [[nodiscard]] std::string x(const SweepRow& row) const;
};
/// The first key, or with `last` the last one, with more than one value. `spec` must outlive the result.
[[nodiscard]] SweptAxis axis_of(const SweepSpec& spec, bool last = false);

/// Rows with equal values of all keys except the axis.
struct SweptCurve {
  std::string name;  ///< the common values
  std::vector<const SweepRow*> rows;
};
/// Curves of the rows that ran, in their order.
[[nodiscard]] std::vector<SweptCurve> swept_curves(const SweepSpec& spec, const SweepRows& rows,
                                                   const SweptAxis& axis);
/// Explanation of the values in names of curves: "; curves: PATH, PATH".
[[nodiscard]] std::string other_keys(const SweepSpec& spec, const SweptAxis& axis);
/// "set xrange [a:b]" around all values, including those without a run, so that a gap at an end is visible.
[[nodiscard]] std::string x_range(const SweptAxis& axis);

}  // namespace signorini
