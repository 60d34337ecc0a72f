#include "motion/local_derivatives.hpp"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace signorini;

TEST_SUITE_BEGIN("unit/motion/column_lanes");

TEST_CASE("column lanes: two products at once, digit by digit those of a plain loop, at any size") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::size_t rows = 1; rows < 40; ++rows)
    for (const std::size_t columns : {std::size_t(1), std::size_t(2), std::size_t(7), rows}) {
      std::vector<double> a(rows * columns), b(a.size()), u(columns), w(columns), y(rows + 1, 7.0);
      for (std::vector<double>* list : {&a, &b, &u, &w})
        for (double& value : *list) value = uniform(random);
      motion::fused_products(a.data(), b.data(), rows, columns, u.data(), w.data(), 1.7, y.data());
      for (std::size_t i = 0; i < rows; ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < columns; ++j) {
          const double v = 1.7 * w[j];
          sum += a[j * rows + i] * u[j] + b[j * rows + i] * v;
        }
        CHECK(y[i] == sum);
      }
      CHECK(y[rows] == 7.0);
    }
}
