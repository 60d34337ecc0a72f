#include "study/sweep/quantiles.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "result/table.hpp"

namespace signorini::sweep {
namespace {

constexpr double tail = 0.5 * (1.0 - confidence);
constexpr std::size_t max_steps = 200, even_steps = 100;

/// P(B <= k); B: binomial distribution with n trials of probability p.
double binomial_cdf(std::size_t k, double p, std::size_t n) {
  return gsl_cdf_binomial_P(static_cast<unsigned>(k), p, static_cast<unsigned>(n));
}

/// The smallest k with P(B <= k) >= q, for the binomial distribution B of n trials; n if there is no such k.
std::size_t binomial_quantile(double q, double p, std::size_t n) {
  std::size_t low = 0, high = n;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (binomial_cdf(middle, p, n) >= q)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/// Indices of the printed values among n sorted values: all if n is small; otherwise even_steps equidistant indices, and,
/// because rare values matter most, more indices towards both ends, whose distances from the end form a geometric series.
std::set<std::size_t> shown_of(std::size_t n) {
  std::set<std::size_t> places;
  const std::size_t even = n <= max_steps ? n : even_steps;
  for (std::size_t i = 0; i < even; ++i) places.insert(even == 1 ? 0 : i * (n - 1) / (even - 1));
  if (even == n) return places;
  for (std::size_t m = 1; m < n / even_steps; m += 1 + m / 3) {
    places.insert(m);
    places.insert(n - 1 - m);
  }
  return places;
}

/// The p at which P(B >= m) (lower limit) or P(B <= m) (upper limit) is a/2, B binomial(n, p). Bisection is
/// used because GSL's inverse of the beta distribution fails for large n.
double clopper_pearson(std::size_t m, std::size_t n, bool lower) {
  double low = 0.0, high = 1.0;
  while (true) {
    const double p = 0.5 * (low + high);
    if (p <= low || p >= high) return p;
    const auto k = static_cast<unsigned>(m), size = static_cast<unsigned>(n);
    const bool beyond =
        lower ? gsl_cdf_binomial_Q(k - 1, p, size) >= tail : gsl_cdf_binomial_P(k, p, size) <= tail;
    (beyond ? high : low) = p;
  }
}

/// A row of a table, with the results from which it is computed.
template <class Figures>
struct AnswerRow {
  const SampledResults& of;
  Figures figures;
};

/// Table whose first columns are quantity, unit and the keys that are not sampled.
template <class Figures>
result::CsvTable<AnswerRow<Figures>> answer_table(const SweepSpec& spec) {
  using R = AnswerRow<Figures>;
  result::CsvTable<R> table = {{"quantity", [&spec](const R& r) { return spec.responses[r.of.query]; }},
                               {"unit", [&spec](const R& r) { return spec.response_units[r.of.query]; }}};
  std::size_t key = 0;
  for (const ParameterRange& vary : spec.vary)
    if (!vary.sampled) {
      table.add(vary.path, [key](const R& r) { return r.of.values[key]; });
      ++key;
    }
  return table;
}

}  // namespace

bool independent(const SweepSpec& spec) { return spec.sampling.find("sobol") == std::string::npos; }

Quantile quantile(const std::vector<double>& sorted, double probability, bool is_independent) {
  const std::size_t n = sorted.size();
  const double place = std::ceil(static_cast<double>(n) * probability);
  const std::size_t k = std::min(n, static_cast<std::size_t>(std::max(place, 1.0)));
  Quantile q{probability, sorted[k - 1], {}, {}};
  if (!is_independent) return q;
  // l: the largest with P(B <= l - 1) <= a/2; u: the smallest with P(B <= u - 1) >= 1 - a/2.
  std::size_t l = binomial_quantile(tail, probability, n);
  if (binomial_cdf(l, probability, n) <= tail) ++l;
  if (l >= 1) q.low = sorted[l - 1];
  const std::size_t u = binomial_quantile(1.0 - tail, probability, n) + 1;
  if (u <= n) q.high = sorted[u - 1];
  return q;
}

std::vector<Exceedance> exceedance(const std::vector<double>& sorted, bool is_independent) {
  const std::size_t n = sorted.size();
  std::vector<Exceedance> list;
  for (const std::size_t place : shown_of(n)) {
    const double x = sorted[place];
    if (!list.empty() && list.back().value == x) continue;
    const auto m = static_cast<std::size_t>(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), x));
    Exceedance e{x, static_cast<double>(m) / static_cast<double>(n), {}, {}};
    if (is_independent) {
      e.low = m > 0 ? clopper_pearson(m, n, true) : 0.0;
      e.high = m < n ? clopper_pearson(m, n, false) : 1.0;
    }
    list.push_back(e);
  }
  return list;
}

std::vector<SampledResults> sampled_results(const SweepSpec& spec, const SweepRows& rows) {
  std::vector<SampledResults> list;
  if (spec.sampling.empty()) return list;
  for (std::size_t query = 0; query < spec.responses.size(); ++query) {
    std::map<std::vector<std::string>, std::size_t> known;
    for (const auto& [index, row] : rows) {
      std::vector<std::string> values;
      for (std::size_t i = 0; i < spec.vary.size(); ++i)
        if (!spec.vary[i].sampled) values.push_back(row.values[i]);
      const auto [found, is_new] = known.emplace(values, list.size());
      if (is_new) list.push_back({query, values, {}, 0});
      SampledResults& s = list[found->second];
      if (query < row.responses.size() && std::isfinite(row.responses[query]))
        s.sorted.push_back(row.responses[query]);
      else
        ++s.missing;
    }
  }
  for (SampledResults& s : list) std::sort(s.sorted.begin(), s.sorted.end());
  return list;
}

std::string quantile_table(const SweepSpec& spec, const std::vector<SampledResults>& answers) {
  using R = AnswerRow<Quantile>;
  result::CsvTable<R> table = answer_table<Quantile>(spec);
  table.add("n", [](const R& r) { return r.of.sorted.size(); });
  table.add("missing", [](const R& r) { return r.of.missing; });
  table.add("probability", [](const R& r) { return r.figures.probability; });
  table.add("value", [](const R& r) { return r.figures.value; });
  table.add("low", [](const R& r) { return r.figures.low; });
  table.add("high", [](const R& r) { return r.figures.high; });
  std::vector<R> rows;
  for (const SampledResults& s : answers)
    if (!s.sorted.empty())
      for (const double p : quantile_levels) rows.push_back({s, quantile(s.sorted, p, independent(spec))});
  return table.text(rows);
}

const result::CsvTable<Exceedance>& exceedance_columns() {
  using E = Exceedance;
  static const result::CsvTable<E> table = {
      {"value", &E::value}, {"probability", &E::probability}, {"low", &E::low}, {"high", &E::high}};
  return table;
}

std::string exceedance_table(const SweepSpec& spec, const std::vector<SampledResults>& answers) {
  using R = AnswerRow<Exceedance>;
  result::CsvTable<R> table = answer_table<Exceedance>(spec);
  for (const auto& column : exceedance_columns().columns())
    table.add_put(column.name,
                  [&column](result::CsvBlock& block, const R& r) { column.put(block, r.figures); });
  std::vector<R> rows;
  for (const SampledResults& s : answers)
    for (const Exceedance& e : exceedance(s.sorted, independent(spec))) rows.push_back({s, e});
  return table.text(rows);
}

}  // namespace signorini::sweep
