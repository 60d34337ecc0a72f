// swept_axis.hpp: which key of a sweep is the axis of its pictures, and which rows are one curve over it.
//
//   x of a row = value of the key on the axis, or its number where values are no numbers
#pragma once

#include <string>
#include <vector>

#include "study/sweep/sweep_table.hpp"

namespace signorini {

struct SweptAxis {
  std::size_t key = 0;  ///< of SweepSpec::vary
  bool numbers = true;  ///< all of its values
  const Vary* vary = nullptr;

  [[nodiscard]] std::string x(const SweepRow& row) const;
};
/// The first key, or the `last`, with more than one value. `spec` must outlive it.
[[nodiscard]] SweptAxis axis_of(const SweepSpec& spec, bool last = false);

/// Rows that have all values in common but that on the axis.
struct SweptCurve {
  std::string name;  ///< their values in common
  std::vector<const SweepRow*> rows;
};
/// Of the rows that ran, in their order.
[[nodiscard]] std::vector<SweptCurve> swept_curves(const SweepSpec& spec, const SweepRows& rows,
                                                   const SweptAxis& axis);
/// What the values in names of curves are: "; curves: PATH, PATH".
[[nodiscard]] std::string other_keys(const SweepSpec& spec, const SweptAxis& axis);
/// "set xrange [a:b]" around all values, also where no run began: a hole at an end is seen.
[[nodiscard]] std::string x_range(const SweptAxis& axis);

}  // namespace signorini
