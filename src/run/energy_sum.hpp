// energy_sum.hpp: energies of parts that run apart, added up for pictures as they come.
//
//   s(t) = sum_i y_i(t)     y_i: straight between the rows of part i; two of one time are a jump, a jump of s, too
//
// A part's rows are as close as its own energies bend (curve_record.hpp). What they add up to is thinned, not they: a peak of a sum
// need not be one of its terms. Sums begin anew with every piece, so that what is left of steep slopes does not add up.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "base/thinned.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Every energy, then the balance.
using EnergyValues = std::array<double, energy_columns.size() + 1>;
[[nodiscard]] EnergyValues values_of(const Energy& energy);

/// In any units; one part's ascend in t.
struct EnergyRow {
  double t = 0.0;
  EnergyValues values{};
};
using EnergyLine = std::deque<EnergyRow>;

class EnergySum {
 public:
  /// In the units of `whole`, t_end too; curves are in those of its scene. most: rows a curve.
  EnergySum(const Model& whole, double t_end, std::size_t most);

  /// Adds up to `until`, or to where the first of the lines ends, and takes what was added from the lines, but for a
  /// row each at that time. Lines begin at one time.
  void take(const std::vector<EnergyLine*>& lines, double until);
  /// Appends the curves. The sum ends.
  void write(Curves& curves);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  void add(double t, const EnergyValues& values);

  double time_, energy_;  // units
  std::vector<Thinned<CurvePoint, 1, ValueOf>> curves_;
};

}  // namespace signorini
