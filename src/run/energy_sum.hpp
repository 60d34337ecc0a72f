// energy_sum.hpp: energies of parts that run separately, summed for pictures during the run.
//
//   s(t) = sum_i y_i(t)     y_i: linear between the rows of part i; two rows at one time are a jump, and a jump of s
//
// The rows of a part are as close as its own energies need (curve_record.hpp). The sum is thinned, not its terms: a
// peak of a sum need not be a peak of a term. Sums restart with every piece, so that rounding of steep slopes does not
// accumulate.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "base/thinned.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// All energies, then the balance.
using EnergyValues = std::array<double, energy_columns.size() + 1>;
[[nodiscard]] EnergyValues values_of(const Energy& energy);

/// Energies at one time, in any units; times of one part ascend.
struct EnergyRow {
  double t = 0.0;
  EnergyValues values{};
};
using EnergyLine = std::deque<EnergyRow>;

class EnergySum {
 public:
  /// Arguments are in the units of `whole`; curves are in those of its scene. most: rows per curve.
  EnergySum(const Model& whole, double t_end, std::size_t most);

  /// Adds the lines up to `until`, or to the end of the shortest line, and removes the added rows except one per line
  /// at that time. All lines begin at the same time.
  void take(const std::vector<EnergyLine*>& lines, double until);
  /// Appends the curves and ends the sum.
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
