#include "base/curves.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

using namespace signorini;

namespace {

struct Row {
  double t = 0.0, a = 0.0, b = 0.0;
};
struct Both {
  std::array<double, 2> operator()(const Row& row) const { return {row.a, row.b}; }
};
using Record = base::Downsampled<Row, 2, Both>;

/// The greatest distance of rows that were given from lines between those that were kept, of a range of two.
double off(const std::vector<Row>& given, const std::vector<Row>& kept) {
  double worst = 0.0;
  std::size_t j = 0;
  for (const Row& row : given) {
    while (j + 2 < kept.size() && kept[j + 1].t <= row.t) ++j;
    const double part = (row.t - kept[j].t) / (kept[j + 1].t - kept[j].t);
    worst = std::max({worst, std::abs(kept[j].a + part * (kept[j + 1].a - kept[j].a) - row.a),
                      std::abs(kept[j].b + part * (kept[j + 1].b - kept[j].b) - row.b)});
  }
  return worst / 2.0;
}

std::vector<Row> rows_of(std::size_t count, const std::function<Row(double)>& at) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < count; ++i)
    rows.push_back(at(static_cast<double>(i) / static_cast<double>(count - 1)));
  return rows;
}

Record record(const std::vector<Row>& rows, std::size_t most, bool limits_rows) {
  Record r(1.0, {.max_rows = most, .limits_rows = limits_rows});
  for (const Row& row : rows) r.add(row);
  r.close({0.0, 0.0});
  return r;
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/thinned");

TEST_CASE("thinned: two swings of unlike frequencies stay within 0.3 % of their range") {
  const std::vector<Row> rows = rows_of(50000, [](double t) {
    return Row{t, std::sin(97.0 * t), std::cos(61.3 * t + 0.4)};
  });
  for (const std::size_t most : {300UL, 1000UL, 8000UL}) {
    const Record kept = record(rows, most, false);
    CAPTURE(most);
    CHECK(kept.rows().size() < 8000);
    CHECK(off(rows, kept.rows()) <= 0.003);
    CHECK(kept.rows().front().t == 0.0);
    CHECK(kept.rows().back().t == 1.0);
  }
}

TEST_CASE("thinned: a straight line is two rows, a jump keeps both sides") {
  const Record line = record(rows_of(1000, [](double t) { return Row{t, 2.0 * t, 1.0 - t}; }), 8000, false);
  CHECK(line.rows().size() == 2);
  std::vector<Row> rows = rows_of(101, [](double t) { return Row{t, t < 0.5 ? 0.0 : 1.0, 0.0}; });
  rows.insert(rows.begin() + 50, Row{0.5, 0.0, 0.0});
  const Record jump = record(rows, 8000, false);
  REQUIRE(jump.rows().size() == 4);
  CHECK(jump.rows()[1].t == 0.5);
  CHECK(jump.rows()[1].a == 0.0);
  CHECK(jump.rows()[2].t == 0.5);
  CHECK(jump.rows()[2].a == 1.0);
}

TEST_CASE("thinned: both sides of an instant stay where they are wanted, and no gap is too wide") {
  std::vector<Row> rows = rows_of(101, [](double t) { return Row{t, t, -t}; });
  rows.insert(rows.begin() + 51, rows[50]);
  Record r(1.0, {.both_sides = true, .widest = 0.1});
  for (const Row& row : rows) r.add(row);
  r.close({0.0, 0.0});
  CHECK(std::count_if(r.rows().begin(), r.rows().end(), [](const Row& row) { return row.t == 0.5; }) == 2);
  for (std::size_t i = 1; i < r.rows().size(); ++i) CHECK(r.rows()[i].t - r.rows()[i - 1].t <= 0.1);
  CHECK(r.rows().size() < 20);
}

TEST_CASE("thinned: of motions faster than a pixel each bin keeps the extremes of each") {
  const std::vector<Row> rows = rows_of(200000, [](double t) {
    return Row{t, std::sin(40000.0 * t), (1.0 - t) * std::cos(33333.0 * t)};
  });
  const Record kept = record(rows, 1000, false);
  CHECK(kept.width() <= 1.0 / 1250.0 * 1.6);  // doubled once more at most
  CHECK(kept.rows().size() <= 4 * 1250 * 2);
  for (int i = 0; i < 100; ++i) {
    const double from = i / 100.0, to = from + 0.01;
    double a = 0.0, b = 0.0, kept_a = 0.0, kept_b = 0.0;
    for (const Row& row : rows)
      if (row.t >= from && row.t <= to) a = std::max(a, row.a), b = std::max(b, row.b);
    for (const Row& row : kept.rows())
      if (row.t >= from && row.t <= to) kept_a = std::max(kept_a, row.a), kept_b = std::max(kept_b, row.b);
    CHECK(kept_a >= a - 0.012);
    CHECK(kept_b >= b - 0.012);
  }
  CHECK(record(rows, 1000, true).rows().size() <= 1001);
}

TEST_CASE("thinned: what follows a burst is not drawn from the burst's extremes") {
  // After each swing 1 -> 0 within a bin a plateau of three bins: its line begins at the last row of the bin.
  std::vector<Row> rows;
  for (int i = 0; i < 300; ++i) {
    const double t = i / 300.0;
    for (int j = 0; j < 60; ++j)
      rows.push_back({t + j * 1e-5, j % 2 == 0 ? 0.0 : 1.0, j % 2 == 0 ? 1.0 : -1.0});
    rows.push_back({t + 60e-5, 0.5, 0.5});
    rows.push_back({t + 290e-5, 0.5, 0.5});
  }
  rows.push_back({1.0, 0.5, 0.5});
  const Record kept = record(rows, 1000, false);
  REQUIRE(kept.width() > 0.0);
  CHECK(kept.rows().size() < rows.size() / 4);
  for (std::size_t i = 1; i < kept.rows().size(); ++i) {
    const Row &from = kept.rows()[i - 1], &to = kept.rows()[i];
    if (to.t - from.t < 1.0 / 1250.0) continue;
    CHECK(from.a == doctest::Approx(0.5));
    CHECK(to.a == doctest::Approx(0.5));
    CHECK(from.b == doctest::Approx(0.5));
  }
}

TEST_SUITE_END();
