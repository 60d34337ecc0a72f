// quantiles.hpp: quantiles and exceedance probabilities of samples, with confidence intervals.
//
//   x_(1) <= ... <= x_(n)            sorted results; rows without a result are left out
//   quantile of p      x_(k), k = ceil(n p), at least 1
//   its interval       [x_(l), x_(u)]:  P(B < l) <= a/2,  P(B >= u) <= a/2,  B binomial(n, p), a = 0.05
//   exceedance of x    m/n, m the number of x_i > x;  its interval is that of Clopper and Pearson
//
// No distribution is assumed. If n samples cannot determine a limit of an interval, this limit is absent. The
// intervals are valid for independent draws; Sobol points are not independent, so they have no intervals.
// Sources: David and Nagaraja, Order Statistics (2003), section 7.1; Clopper and Pearson, Biometrika 26 (1934) 404.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/table.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini::sweep {

inline constexpr double confidence = 0.95;
inline constexpr double quantile_levels[] = {0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99};

struct Quantile {
  double probability = 0.0, value = 0.0;
  std::optional<double> low, high;
};
/// Quantile of at least one value, sorted ascending. independent: false for Sobol points, which have no interval.
[[nodiscard]] Quantile quantile(const std::vector<double>& sorted, double probability, bool independent);

struct Exceedance {
  double value = 0.0, probability = 0.0;  ///< probability: of results above `value`
  std::optional<double> low, high;
};
/// Columns of exceedance tables.
[[nodiscard]] const result::CsvTable<Exceedance>& exceedance_columns();
/// Exceedance probabilities of the values, or of at most 200 of them. sorted: ascending.
[[nodiscard]] std::vector<Exceedance> exceedance(const std::vector<double>& sorted, bool independent);

/// The results of one query for one combination of the keys that are not sampled.
struct SampledResults {
  std::size_t query = 0;
  std::vector<std::string> values;  ///< values of the keys that are not sampled
  std::vector<double> sorted;
  std::size_t missing = 0;  ///< rows without a result
};
/// Results of all queries for all combinations, query by query; empty if no key is sampled.
[[nodiscard]] std::vector<SampledResults> sampled_results(const SweepSpec& spec, const SweepRows& rows);

/// Text of quantiles.csv: quantity,unit,PATH,...,n,missing,probability,value,low,high.
[[nodiscard]] std::string quantile_table(const SweepSpec& spec, const std::vector<SampledResults>& answers);
/// Text of exceedance.csv: quantity,unit,PATH,...,value,probability,low,high.
[[nodiscard]] std::string exceedance_table(const SweepSpec& spec, const std::vector<SampledResults>& answers);
/// True if the samples of a sweep are independent draws.
[[nodiscard]] bool independent(const SweepSpec& spec);

}  // namespace signorini::sweep
