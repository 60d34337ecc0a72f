#include "run/summed_curves.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/run/drawn.hpp"

using namespace signorini;

namespace {

using Points = std::vector<CurvePoint>;

tests::drawn::Line line_of(const Points& points) {
  tests::drawn::Line line;
  for (const CurvePoint& p : points) line.add(p.t, p.value);
  return line;
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/summed_curves");

TEST_CASE("the sum of lines: slopes, jumps, and lines that end before others") {
  const Points a{{0.0, 1.0}, {1.0, 3.0}, {1.0, -1.0}, {3.0, 0.0}};  // a jump of -4 at 1
  const Points b{{0.0, 0.5}, {0.0, 2.5}, {2.0, 2.5}};  // one of 2 at 0, then level; nothing after 2
  const Points sum = summed({&a, &b}, 8000);
  const tests::drawn::Line line = line_of(sum);
  CHECK(sum.front().t == 0.0);
  CHECK(sum.front().value == 1.5);
  CHECK(sum.back().t == 3.0);
  for (const auto& [t, y] :
       {std::pair{0.0, 3.5}, {0.5, 4.5}, {0.999999, 5.5}, {1.0, 1.5}, {2.0, 2.0}, {3.0, 2.5}})
    CHECK(tests::drawn::at(line, t) == doctest::Approx(y).epsilon(1e-5));
}

TEST_CASE("no lines, and lines without points") {
  const Points none, one{{0.5, 7.0}};
  CHECK(summed({}, 8000).empty());
  CHECK(summed({&none}, 8000).empty());
  const Points sum = summed({&none, &one}, 8000);
  REQUIRE(sum.size() == 1);
  CHECK(sum[0].value == 7.0);
}

TEST_CASE("many lines: as few points as are wanted, within a hundredth of the sum's range") {
  std::vector<Points> lines(40);
  std::vector<const Points*> pointers;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto shift = static_cast<double>(i);
    for (int k = 0; k <= 3000; ++k) {
      const double t = 1e-3 * (k + (k == 0 || k == 3000 ? 0.0 : 0.02 * shift));
      lines[i].push_back({t, std::sin(3.0 * t + shift)});
    }
    pointers.push_back(&lines[i]);
  }
  const Points sum = summed(pointers, 500);
  CHECK(sum.size() <= 600);
  tests::drawn::Line motion;
  for (int k = 0; k <= 1000; ++k) {
    const double t = 3e-3 * k;
    double y = 0.0;
    for (int i = 0; i < 40; ++i) y += std::sin(3.0 * t + i);
    motion.add(t, y);
  }
  CHECK(tests::drawn::off(line_of(sum), motion) <= 0.01);
}

TEST_SUITE_END();
