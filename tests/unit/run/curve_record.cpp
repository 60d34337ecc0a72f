#include "run/curve_record.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "signorini/simulate.hpp"
#include "unit/run/drawn.hpp"

using namespace signorini;

namespace {

class CurveKeeper : public Result {
 public:
  [[nodiscard]] bool wants_motion() const override { return true; }
  void curves(const Curves& curves) override { kept = curves; }
  Curves kept;

  [[nodiscard]] const std::vector<CurvePoint>& curve(const std::string& name) const {
    return kept.points[static_cast<std::size_t>(std::find(kept.names.begin(), kept.names.end(), name) -
                                                kept.names.begin())];
  }
  /// Greatest magnitude of a curve.
  [[nodiscard]] double greatest(const std::string& name) const {
    double most = 0.0;
    for (const CurvePoint& point : curve(name)) most = std::max(most, std::abs(point.value));
    return most;
  }
};

CurveKeeper curves_of(const std::string& model, const std::vector<Override>& changes) {
  const Scene scene = read_scene(SIGNORINI_MODELS "/" + model + ".toml", changes);
  CurveKeeper keeper;
  keeper.report = simulate(build_model(scene), scene.run, keeper);
  return keeper;
}

/// Every curve of a run beside its rows at 20000 times.
void check_pictures(const std::string& model) {
  CAPTURE(model);
  const std::string file = SIGNORINI_MODELS "/" + model + ".toml";
  const double t_end = read_scene(file).run.t_end;
  const std::vector<Override> changes{{"run.output_dt", std::to_string(t_end / 20000.0)}};
  const Scene scene = read_scene(SIGNORINI_MODELS "/" + model + ".toml", changes);
  const Model built = build_model(scene);
  CurveKeeper run;
  run.report = simulate(built, scene.run, run);
  const auto motion = [&](const auto& value) {
    tests::drawn::Line line;
    for (const Result::Row& row : run.rows) line.add(row.t, value(row));
    return line;
  };
  const auto look = [&](const std::string& name, const auto& value) {
    if (std::find(run.kept.names.begin(), run.kept.names.end(), name) == run.kept.names.end()) return;
    tests::drawn::Line line;
    for (const CurvePoint& point : run.curve(name)) line.add(point.t, point.value);
    CAPTURE(name);
    CHECK(tests::drawn::off(line, motion(value)) <= 0.01);
  };
  for (const Column& column : built.columns)
    if (!column.velocity && column.dof >= 0)
      look(column.name, [&](const Result::Row& row) { return row.u[column.dof]; });
  for (const EnergyColumn& column : energy_columns)
    look(column.name, [&](const Result::Row& row) { return row.energy.*column.value; });
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/curve_record");

TEST_CASE("displacements and energies of pictures do not depend on the output times") {
  for (const char* engine : {"exact", "ida", "newmark"}) {
    CAPTURE(engine);
    const std::vector<Override> changes{{"run.engine", engine}, {"run.dt", "1e-3"}, {"run.t_end", "20.0"}};
    std::vector<Override> coarse = changes, fine = changes;
    coarse.push_back({"run.output_dt", "20.0"});
    fine.push_back({"run.output_dt", "0.01"});
    const CurveKeeper few = curves_of("belt", coarse), many = curves_of("belt", fine);
    double u = 0.0, kinetic = 0.0, surface = 0.0;
    for (const Result::Row& row : many.rows) {
      u = std::max(u, std::abs(row.u[0]));
      kinetic = std::max(kinetic, row.energy.kinetic);
      surface = std::max(surface, std::abs(row.energy.surface));
    }
    CHECK(few.greatest("block.ux") == doctest::Approx(u).epsilon(1e-3));
    CHECK(few.greatest("kinetic") == doctest::Approx(kinetic).epsilon(1e-3));
    CHECK(few.greatest("surface") == doctest::Approx(surface).epsilon(1e-3));
    CHECK(few.curve("block.ux").front().t == 0.0);
    CHECK(few.curve("block.ux").back().t == 20.0);
  }
}

TEST_CASE("energies inside of steps balance like those at output times") {
  const CurveKeeper run = curves_of("pipeline", {{"run.engine", "exact"}, {"run.t_end", "0.2"}});
  REQUIRE(run.kept.names.back() == "balance");
  const std::vector<CurvePoint>& balance = run.curve("balance");
  for (const CurvePoint& point : balance)
    CHECK(std::abs(point.value - balance.front().value) < 1e-9 * run.greatest("loads"));
}

TEST_CASE("curves of a long run are bounded, and as high as the motion") {
  const std::vector<Override> changes{
      {"run.engine", "exact"}, {"run.t_end", "5000.0"}, {"run.output_dt", "0.5"}};
  const CurveKeeper run = curves_of("belt", changes);
  CHECK(run.curve("block.ux").size() <= 8000);
  CHECK(run.curve("block.ux").size() > 1000);
  double u = 0.0;
  for (const Result::Row& row : run.rows) u = std::max(u, row.u[0]);
  // A slip takes 2 s of 5000: two rows, which find 1 + 0.54 cos x to within the tenth of its swing.
  CHECK(run.greatest("block.ux") <= 1.001 * u);
  CHECK(run.greatest("block.ux") >= 1.0 + 0.9 * (u - 1.0));
}

TEST_CASE("what pictures draw is the motion, within 1 % or a pixel: every displacement and energy") {
  check_pictures("oscillator");
  check_pictures("matrices");
  check_pictures("pipeline");
  check_pictures("rigid-frame");
  check_pictures("chain");
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/run/curve_record");

TEST_CASE("what pictures draw is the motion, within 1 % or a pixel: a rack in an earthquake") {
  check_pictures("piping");
}

TEST_SUITE_END();
