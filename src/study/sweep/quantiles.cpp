#include "study/sweep/quantiles.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "result/csv.hpp"

namespace signorini {
namespace {

constexpr double tail = 0.5 * (1.0 - confidence);
constexpr std::size_t most_steps = 200, even_steps = 100;

/// P(B <= k) of n draws.
double below_or_at(std::size_t k, double p, std::size_t n) {
  return gsl_cdf_binomial_P(static_cast<unsigned>(k), p, static_cast<unsigned>(n));
}

/// The least k with P(B <= k) >= q; n where there is none.
std::size_t least_count(double q, double p, std::size_t n) {
  std::size_t low = 0, high = n;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (below_or_at(middle, p, n) >= q)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/// Places among n values in order: all of few; of many some at equal distances, and towards both ends more, each
/// a third farther out than the one before, since the rare ones are what is asked for.
std::set<std::size_t> shown_of(std::size_t n) {
  std::set<std::size_t> places;
  const std::size_t even = n <= most_steps ? n : even_steps;
  for (std::size_t i = 0; i < even; ++i) places.insert(even == 1 ? 0 : i * (n - 1) / (even - 1));
  if (even == n) return places;
  for (std::size_t m = 1; m < n / even_steps; m += 1 + m / 3) {
    places.insert(m);
    places.insert(n - 1 - m);
  }
  return places;
}

/// The p at which P(B >= m) of n draws is a/2, or P(B <= m) is: by bisection, since GSL's inverse of the beta
/// distribution fails for many n.
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

void keys_of(CsvBlock& block, const SweepSpec& spec, const Sampled& s) {
  block.text(spec.responses[s.query]).text(spec.response_units[s.query]);
  for (const std::string& value : s.values) block.text(value);
}

void header(CsvBlock& block, const SweepSpec& spec, std::initializer_list<const char*> names) {
  block.text("quantity").text("unit");
  for (const Vary& vary : spec.vary)
    if (!vary.sampled) block.text(vary.path);
  for (const char* name : names) block.text(name);
  block.end_row();
}

}  // namespace

bool independent(const SweepSpec& spec) { return spec.sampling.find("sobol") == std::string::npos; }

Quantile quantile(const std::vector<double>& sorted, double probability, bool is_independent) {
  const std::size_t n = sorted.size();
  const double place = std::ceil(static_cast<double>(n) * probability);
  const std::size_t k = std::min(n, static_cast<std::size_t>(std::max(place, 1.0)));
  Quantile q{probability, sorted[k - 1], {}, {}};
  if (!is_independent) return q;
  // l: the greatest with P(B <= l - 1) <= a/2; u: the least with P(B <= u - 1) >= 1 - a/2.
  std::size_t l = least_count(tail, probability, n);
  if (below_or_at(l, probability, n) <= tail) ++l;
  if (l >= 1) q.low = sorted[l - 1];
  const std::size_t u = least_count(1.0 - tail, probability, n) + 1;
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

std::vector<Sampled> sampled_answers(const SweepSpec& spec, const SweepRows& rows) {
  std::vector<Sampled> list;
  if (spec.sampling.empty()) return list;
  for (std::size_t query = 0; query < spec.responses.size(); ++query) {
    std::map<std::vector<std::string>, std::size_t> known;
    for (const auto& [index, row] : rows) {
      std::vector<std::string> values;
      for (std::size_t i = 0; i < spec.vary.size(); ++i)
        if (!spec.vary[i].sampled) values.push_back(row.values[i]);
      const auto [found, is_new] = known.emplace(values, list.size());
      if (is_new) list.push_back({query, values, {}, 0});
      Sampled& s = list[found->second];
      if (query < row.responses.size() && std::isfinite(row.responses[query]))
        s.sorted.push_back(row.responses[query]);
      else
        ++s.missing;
    }
  }
  for (Sampled& s : list) std::sort(s.sorted.begin(), s.sorted.end());
  return list;
}

std::string quantile_table(const SweepSpec& spec, const std::vector<Sampled>& answers) {
  CsvBlock block;
  header(block, spec, {"n", "missing", "probability", "value", "low", "high"});
  for (const Sampled& s : answers) {
    if (s.sorted.empty()) continue;
    for (const double p : quantile_levels) {
      const Quantile q = quantile(s.sorted, p, independent(spec));
      keys_of(block, spec, s);
      block.number(static_cast<double>(s.sorted.size())).number(static_cast<double>(s.missing));
      block.number(p).number(q.value).number(q.low).number(q.high).end_row();
    }
  }
  return block.str();
}

std::string exceedance_table(const SweepSpec& spec, const std::vector<Sampled>& answers) {
  CsvBlock block;
  header(block, spec, {"value", "probability", "low", "high"});
  for (const Sampled& s : answers)
    for (const Exceedance& e : exceedance(s.sorted, independent(spec))) {
      keys_of(block, spec, s);
      block.number(e.value).number(e.probability).number(e.low).number(e.high).end_row();
    }
  return block.str();
}

}  // namespace signorini
