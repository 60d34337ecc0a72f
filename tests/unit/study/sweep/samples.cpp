// Draws from distributions, and what is said about them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "study/sweep/parameter_range.hpp"
#include "study/sweep/quantiles.hpp"

using namespace signorini;

namespace {

std::vector<double> draw(const std::string& distribution, std::size_t count, unsigned long seed = 1,
                         sweep::Sequence sequence = sweep::Sequence::random) {
  const std::vector<sweep::ParameterRange> drawn =
      sweep::draw_samples({"a.b=" + distribution}, {count, seed, sequence});
  std::vector<double> values;
  for (const std::string& text : drawn[0].values) values.push_back(*base::parse_number(text));
  return values;
}

std::vector<double> ascending(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

double mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}
double deviation(const std::vector<double>& x) {
  const double m = mean(x);
  double sum = 0.0;
  for (const double v : x) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// P(B <= k), by the sum.
double binomial(int k, double p, int n) {
  double sum = 0.0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/sweep/samples");

TEST_CASE("samples: distributions have their means, deviations and shapes") {
  // Sobol's points are even: 4096 of them leave errors of a thousandth, where as many draws leave a hundredth.
  struct Law {
    const char* text;
    double mean, deviation, median;
  };
  const double width = std::sqrt((0.5 * 0.5 + 1.0 + 4.0 - 0.5 - 1.0 - 2.0) / 18.0);
  for (const Law& law :
       {Law{"normal(3, 0.5)", 3.0, 0.5, 3.0}, Law{"lognormal(2, 0.6)", 2.0, 0.6, 2.0 / std::sqrt(1.0 + 0.09)},
        Law{"uniform(-1,3)", 1.0, 4.0 / std::sqrt(12.0), 1.0},
        Law{"triangular( 0.5 , 1, 2)", 3.5 / 3.0, width, 2.0 - std::sqrt(0.75)}}) {
    CAPTURE(law.text);
    for (const sweep::Sequence sequence : {sweep::Sequence::random, sweep::Sequence::sobol}) {
      const std::vector<double> x = draw(law.text, 4096, 7, sequence);
      const double error = (sequence == sweep::Sequence::sobol ? 2e-3 : 5.0 / 64.0) * law.deviation;
      CHECK(std::abs(mean(x) - law.mean) < error);
      CHECK(std::abs(deviation(x) - law.deviation) < 2.0 * error + 2e-3 * law.deviation);
      CHECK(std::abs(ascending(x)[2047] - law.median) < 2.0 * error);
    }
  }
}

TEST_CASE("samples: a row depends on seed and number alone") {
  for (const sweep::Sequence sequence : {sweep::Sequence::random, sweep::Sequence::sobol}) {
    const std::vector<double> few = draw("normal(0,1)", 10, 3, sequence);
    std::vector<double> many = draw("normal(0,1)", 1000, 3, sequence);
    many.resize(10);
    CHECK(few == many);
    CHECK(few != draw("normal(0,1)", 10, 4, sequence));
    const std::vector<sweep::ParameterRange> two =
        sweep::draw_samples({"a=uniform(0,1)", "b=uniform(0,1)"}, {2000, 3, sequence});
    CHECK(two[0].group == two[1].group);
    CHECK(sweep::points(two).size() == 2000);
    double together = 0.0;
    for (std::size_t i = 0; i < 2000; ++i)
      together +=
          (*base::parse_number(two[0].values[i]) - 0.5) * (*base::parse_number(two[1].values[i]) - 0.5);
    CHECK(std::abs(together / 2000.0) <
          4.0 / 12.0 / std::sqrt(2000.0));  // the keys know nothing of each other
  }
}

TEST_CASE("samples: what is no distribution is refused") {
  for (const char* text : {"a", "a=", "a=normal", "a=normal(1)", "a=normal(1,0)", "a=normal(1,-1)",
                           "a=normal(1,x)", "a=uniform(2,1)", "a=lognormal(-1,1)", "a=triangular(1,0,2)",
                           "a=gauss(0,1)", "a=normal(0,inf)", "=normal(0,1)"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)sweep::draw_samples({text}, {}), UsageError);
  }
  CHECK_THROWS_AS((void)sweep::draw_samples({"a=normal(0,1)"}, {0, 1, sweep::Sequence::random}), UsageError);
  CHECK_THROWS_AS((void)sweep::points(sweep::draw_samples({"a=normal(0,1)", "a=normal(0,1)"}, {})),
                  UsageError);
}

TEST_CASE("samples: draws beyond the range of numbers are refused") {
  CHECK_THROWS_WITH_AS(draw("lognormal(1e-300,1e300)", 20), doctest::Contains("is not a finite number"),
                       UsageError);
  CHECK_THROWS_WITH_AS(draw("uniform(-1e308,1e308)", 20), doctest::Contains("--sample a.b=uniform"),
                       UsageError);
}

TEST_CASE("samples: keys in step count as one range") {
  std::vector<sweep::ParameterRange> varied{
      {"a", "1,2", {"1", "2"}, 1}, {"b", "x,y,z", {"x", "y", "z"}}, {"c", "3,4", {"3", "4"}, 1}};
  const auto list = sweep::points(varied);
  REQUIRE(list.size() == 6);
  CHECK(list[1][0].value == "1");
  CHECK(list[1][1].value == "y");
  CHECK(list[1][2].value == "3");
  CHECK(list[3][2].value == "4");
  CHECK(list[3][2].path == "c");
  varied[2].values = {"3"};
  CHECK_THROWS_AS((void)sweep::points(varied), UsageError);
}

TEST_CASE("samples: intervals of quantiles are those of the binomial law") {
  for (const int n : {1, 5, 10, 40, 100, 333}) {
    std::vector<double> ranks;
    for (int i = 1; i <= n; ++i) ranks.push_back(i);
    for (const double p : sweep::quantile_levels) {
      CAPTURE(n);
      CAPTURE(p);
      const sweep::Quantile q = sweep::quantile(ranks, p, true);
      CHECK(q.value == std::max(1.0, std::ceil(n * p)));
      const int low = q.low ? static_cast<int>(*q.low) : 0;
      const int high = q.high ? static_cast<int>(*q.high) : n + 1;
      // x_(low) is above the quantile with P(B < low), and low is the greatest such rank; the same of high.
      if (low > 0) CHECK(binomial(low - 1, p, n) <= 0.025);
      CHECK(binomial(low, p, n) > 0.025);
      if (high <= n) CHECK(binomial(high - 1, p, n) >= 0.975 - 1e-12);
      if (high <= n && high > 1) CHECK(binomial(high - 2, p, n) < 0.975);
      if (high > n) CHECK(binomial(n - 1, p, n) < 0.975);
      CHECK_FALSE(sweep::quantile(ranks, p, false).low);
    }
  }
  // The table of the median, known to statisticians: the 40th and the 61st of 100.
  std::vector<double> hundred;
  for (int i = 1; i <= 100; ++i) hundred.push_back(i);
  CHECK(*sweep::quantile(hundred, 0.5, true).low == 40.0);
  CHECK(*sweep::quantile(hundred, 0.5, true).high == 61.0);
}

TEST_CASE("samples: intervals hold the true quantile as often as they say") {
  int held = 0, all = 0;
  for (unsigned long seed = 1; seed <= 300; ++seed) {
    const std::vector<double> x = ascending(draw("uniform(0,1)", 80, seed));
    for (const double p : {0.1, 0.5, 0.9}) {
      const sweep::Quantile q = sweep::quantile(x, p, true);
      ++all;
      held += q.low.value_or(-1.0) <= p && p <= q.high.value_or(2.0) ? 1 : 0;
    }
  }
  CHECK(held >= 0.93 * all);
  CHECK(held < all);
}

TEST_CASE("samples: exceedance with Clopper and Pearson's interval") {
  std::vector<double> x;
  for (int i = 1; i <= 20; ++i) x.push_back(i);
  const std::vector<sweep::Exceedance> list = sweep::exceedance(x, true);
  REQUIRE(list.size() == 20);
  CHECK(list.back().probability == 0.0);
  CHECK(*list.back().low == 0.0);
  CHECK(*list.back().high == doctest::Approx(1.0 - std::pow(0.025, 1.0 / 20.0)));  // none of twenty
  for (const sweep::Exceedance& e : list) {
    const int m = static_cast<int>(std::lround(20.0 * e.probability));
    CHECK(m == 20 - static_cast<int>(e.value));
    if (m > 0) CHECK(1.0 - binomial(m - 1, *e.low, 20) == doctest::Approx(0.025));
    if (m < 20) CHECK(binomial(m, *e.high, 20) == doctest::Approx(0.025));
  }
  CHECK(sweep::exceedance(std::vector<double>(50, 1.0), true).size() == 1);
  for (const int n : {500, 1000, 10000}) {  // where GSL's inverse of the beta distribution gives up
    CAPTURE(n);
    std::vector<double> ranks;
    for (int i = 1; i <= n; ++i) ranks.push_back(i);
    const std::vector<sweep::Exceedance> all = sweep::exceedance(ranks, true);
    REQUIRE(all.size() >= 100);
    REQUIRE(all.size() <= 200);
    CHECK(all.back().value == n);
    CHECK(all[all.size() - 2].probability == doctest::Approx(1.0 / n));  // the rare ones, too
    for (std::size_t i = 0; i < all.size(); i += 30) {
      const int m = static_cast<int>(std::lround(n * all[i].probability));
      if (m > 0) CHECK(1.0 - binomial(m - 1, *all[i].low, n) == doctest::Approx(0.025).epsilon(1e-6));
      if (m < n) CHECK(binomial(m, *all[i].high, n) == doctest::Approx(0.025).epsilon(1e-6));
    }
  }
  std::vector<double> many(5000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
  CHECK(sweep::exceedance(many, false).size() <= 200);
  CHECK(sweep::exceedance(many, false).back().value == 4999.0);
  CHECK_FALSE(sweep::exceedance(many, false)[0].low);
}

TEST_SUITE_END();
