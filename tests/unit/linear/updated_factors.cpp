#include "linear/mass_factors.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cstdint>

#include "linear/klu.hpp"

using namespace signorini;

namespace {

/// A band of width 5, not symmetric.
Eigen::MatrixXd band(Eigen::Index n) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - 2); j < std::min(n, i + 3); ++j)
      a(i, j) = i == j ? 4.0 + 0.01 * static_cast<double>(i) : 1.0 / static_cast<double>(1 + i + 2 * j) - 0.4;
  return a;
}

std::shared_ptr<const linear::TriangularFactors> factors_of(const Eigen::MatrixXd& a) {
  std::vector<std::int64_t> start(1, 0), row;
  std::vector<double> value;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      if (a(i, j) != 0.0) {
        row.push_back(i);
        value.push_back(a(i, j));
      }
    start.push_back(static_cast<std::int64_t>(row.size()));
  }
  linear::Klu klu(start, row);
  REQUIRE(klu.factor(value));
  return std::make_shared<const linear::TriangularFactors>(klu.factors());
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/updated_factors");

TEST_CASE("rows change, change again, and go back: solutions are those of the changed matrix") {
  const Eigen::Index n = 61;
  const Eigen::MatrixXd base = band(n);
  linear::WoodburyFactors updated;
  updated.set_base(factors_of(base));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1.0, -2.0);
  for (const std::size_t count : {0U, 1U, 3U, 16U, 5U, 0U}) {
    CAPTURE(count);
    Eigen::MatrixXd a = base;
    std::vector<linear::ChangedRow> rows;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t r = 3 * k + 2;
      linear::ChangedRow row{r, {{r, 0.7 + 0.1 * static_cast<double>(k)}, {r + 1, -0.5}, {r, 0.2}}};
      for (const auto& [column, value] : row.entries)
        a(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(column)) += value;
      rows.push_back(row);
    }
    REQUIRE(updated.set(rows));
    Eigen::VectorXd x = b, work(n);
    updated.solve(x.data(), work.data());
    CHECK((a * x - b).cwiseAbs().maxCoeff() < 1e-13);
    CHECK(updated.numbers() == count * static_cast<std::size_t>(n));
  }
  CHECK(updated.solves() == 16);  // a column costs one, once
}

TEST_CASE("too many rows, and rows that make the matrix singular, are refused") {
  const Eigen::Index n = 40;
  const Eigen::MatrixXd base = band(n);
  linear::WoodburyFactors updated;
  CHECK_FALSE(updated.set({}));  // no matrix yet
  updated.set_base(factors_of(base));
  std::vector<linear::ChangedRow> many;
  for (std::size_t r = 0; r <= linear::WoodburyFactors::max_rows; ++r) many.push_back({r, {{r, 0.1}}});
  CHECK_FALSE(updated.set(many));
  // Regular, but what the row says would be a difference of numbers ten thousand times as great.
  CHECK_FALSE(updated.set({{5, {{5, 1e5}}}}));
  CHECK(updated.set({{5, {{5, 1e2}}}}));
  // Row 7 becomes row 8.
  linear::ChangedRow same{7, {}};
  for (Eigen::Index j = 0; j < n; ++j)
    if (base(8, j) != base(7, j)) same.entries.emplace_back(j, base(8, j) - base(7, j));
  CHECK_FALSE(updated.set({same}));
}

TEST_SUITE_END();
