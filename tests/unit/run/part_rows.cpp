#include "run/part_rows.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "unit/run/drawn.hpp"

using namespace signorini;

namespace {

constexpr double unit_of_time = 0.5;  // the model's, in the scene's

Model units() {
  Model model;
  model.unit.time = unit_of_time;
  model.unit.length = 2.0;
  model.unit.force = 3.0;
  return model;
}

constexpr double unit_of_energy = 3.0 * 2.0;

run::EnergyRow kinetic(double t, double value) {
  Energy energy;
  energy.kinetic = value;
  return {t, run::values_of(energy)};
}

/// The curve of that name, in the model's units.
tests::drawn::Line curve(const Curves& curves, const std::string& name) {
  tests::drawn::Line line;
  for (std::size_t i = 0; i < curves.names.size(); ++i)
    if (curves.names[i] == name)
      for (const CurvePoint& p : curves.points[i]) line.add(p.t / unit_of_time, p.value / unit_of_energy);
  return line;
}

Curves curves_of(run::EnergySum& sum) {
  Curves curves;
  sum.write(curves);
  return curves;
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/part_rows");

TEST_CASE("the sum of lines: slopes, jumps, in pieces that end anywhere") {
  for (const std::vector<double>& ends :
       {std::vector{3.0}, {0.25, 1.0, 1.75, 3.0}, {1.0, 1.0, 2.0, 9.0}, {0.0, 0.5, 0.999, 1.001, 3.0}}) {
    CAPTURE(ends.size());
    run::EnergyLine a{kinetic(0.0, 1.0), kinetic(1.0, 3.0), kinetic(1.0, -1.0),
                      kinetic(3.0, 0.0)};  // a jump of -4 at 1
    run::EnergyLine b{kinetic(0.0, 0.5), kinetic(0.0, 2.5), kinetic(2.0, 2.5),
                      kinetic(3.0, 4.5)};  // one of 2 at 0
    run::EnergySum sum(units(), 3.0, 8000);
    for (const double end : ends) sum.take({&a, &b}, end);
    CHECK(a.size() == 1);
    CHECK(a.front().t == 3.0);
    CHECK(b.front().values[0] == 4.5);
    const Curves curves = curves_of(sum);
    REQUIRE(curves.names.size() == energy_columns.size() + 1);
    CHECK(curves.names.back() == balance_column);
    const tests::drawn::Line line = curve(curves, "kinetic");
    CHECK(line.t.front() == 0.0);
    CHECK(line.y.front() == 1.5);
    CHECK(line.t.back() == 3.0);
    for (const auto& [t, y] :
         {std::pair{0.0, 3.5}, {0.5, 4.5}, {0.999999, 5.5}, {1.0, 1.5}, {2.0, 2.0}, {3.0, 4.5}})
      CHECK(tests::drawn::at(line, t) == doctest::Approx(y).epsilon(1e-5));
  }
}

TEST_CASE("every energy is added up by itself, and the balance is theirs") {
  Energy one;
  double value = 0.0;
  for (const EnergyColumn& column : energy_columns) one.*column.value = value += 1.0;
  run::EnergyLine a{{0.0, run::values_of(one)}, {1.0, run::values_of(one)}}, b = a;
  run::EnergySum sum(units(), 1.0, 8000);
  sum.take({&a, &b}, 1.0);
  const Curves curves = curves_of(sum);
  value = 0.0;
  for (const EnergyColumn& column : energy_columns)
    CHECK(curve(curves, column.name).y.back() == doctest::Approx(2.0 * (value += 1.0)));
  CHECK(curve(curves, balance_column).y.back() == doctest::Approx(2.0 * one.balance()));
}

TEST_CASE("what one line has not come to waits in the others, and is there when it comes") {
  run::EnergyLine a{kinetic(0.0, 0.0), kinetic(1.0, 1.0), kinetic(2.0, 4.0)},
      b{kinetic(0.0, 0.0), kinetic(0.5, 5.0)};
  run::EnergySum sum(units(), 2.0, 8000);
  sum.take({&a, &b}, 1.5);
  CHECK(a.front().t == 0.5);
  CHECK(a.front().values[0] == 0.5);
  CHECK(a.size() == 3);
  CHECK(b.size() == 1);
  b.push_back(kinetic(2.0, 5.0));
  sum.take({&a, &b}, 2.0);
  const tests::drawn::Line line = curve(curves_of(sum), "kinetic");
  for (const auto& [t, y] : {std::pair{0.25, 2.75}, {0.5, 5.5}, {1.0, 6.0}, {1.5, 7.5}, {2.0, 9.0}})
    CHECK(tests::drawn::at(line, t) == doctest::Approx(y).epsilon(1e-12));
  run::EnergyLine none;
  run::EnergySum nothing(units(), 2.0, 8000);
  nothing.take({&a, &none}, 2.0);  // refused at the start
  nothing.take({}, 2.0);
  CHECK(curves_of(nothing).points.front().empty());
}

TEST_CASE("many lines: a narrow peak of the sum is none of its terms, and is drawn") {
  // Waves of three frequencies beside each other add up to beats; each alone has level peaks.
  constexpr int rows = 60000;
  constexpr double omega = 2.0 * std::numbers::pi * 2000.0, beat = 2.0 * std::numbers::pi * 1.5;
  std::vector<run::EnergyLine> lines(3);
  std::vector<run::EnergyLine*> pointers;
  tests::drawn::Line motion;
  const auto wave = [&](int i, double t) { return std::cos((omega + beat * (i - 1)) * t); };
  for (int i = 0; i < 3; ++i) pointers.push_back(&lines[static_cast<std::size_t>(i)]);
  run::EnergySum sum(units(), 1.0, 8000);
  for (int k = 0; k <= rows; ++k) {
    const double t = static_cast<double>(k) / rows;
    for (int i = 0; i < 3; ++i) lines[static_cast<std::size_t>(i)].push_back(kinetic(t, wave(i, t)));
    motion.add(t, wave(0, t) + wave(1, t) + wave(2, t));
    if (k % 1000 == 0) sum.take(pointers, t);
  }
  const tests::drawn::Line line = curve(curves_of(sum), "kinetic");
  CHECK(line.t.size() < 20000);
  CHECK(tests::drawn::off(line, motion) <= 0.01);
}

TEST_SUITE_END();
