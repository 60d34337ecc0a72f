#include "run/curve_record.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

class CurveKeeper : public Result {
 public:
  [[nodiscard]] bool wants_motion() const override { return true; }
  void curves(const Curves& curves) override { kept = curves; }
  Curves kept;

  [[nodiscard]] std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(kept.names.begin(), kept.names.end(), name) -
                                    kept.names.begin());
  }
  /// Greatest magnitude in a column.
  [[nodiscard]] double greatest(const std::string& name) const {
    double most = 0.0;
    for (const auto& row : kept.rows) most = std::max(most, std::abs(row[column(name)]));
    return most;
  }
};

CurveKeeper curves_of(const std::string& model, const std::vector<Override>& changes) {
  const Scene scene = read_scene(SIGNORINI_MODELS "/" + model + ".toml", changes);
  CurveKeeper keeper;
  keeper.report = simulate(build_model(scene), scene.run, keeper);
  return keeper;
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
    CHECK(few.greatest("block.ux") == doctest::Approx(u).epsilon(1e-4));
    CHECK(few.greatest("kinetic") == doctest::Approx(kinetic).epsilon(1e-3));
    CHECK(few.greatest("surface") == doctest::Approx(surface).epsilon(1e-6));
    CHECK(few.kept.rows.front()[0] == 0.0);
    CHECK(few.kept.rows.back()[0] == 20.0);
  }
}

TEST_CASE("energies inside of steps balance like those at output times") {
  const CurveKeeper run = curves_of("pipeline", {{"run.engine", "exact"}, {"run.t_end", "0.2"}});
  const std::size_t balance = run.column("balance");
  REQUIRE(balance + 1 == run.kept.names.size());
  for (const auto& row : run.kept.rows)
    CHECK(std::abs(row[balance] - run.kept.rows.front()[balance]) < 1e-9 * run.greatest("loads"));
}

TEST_CASE("curves of a long run are bounded, and as high as the motion") {
  const std::vector<Override> changes{
      {"run.engine", "exact"}, {"run.t_end", "5000.0"}, {"run.output_dt", "0.5"}};
  const CurveKeeper run = curves_of("belt", changes);
  CHECK(run.kept.rows.size() <= 8000);
  CHECK(run.kept.rows.size() > 1000);
  double u = 0.0;
  for (const Result::Row& row : run.rows) u = std::max(u, row.u[0]);
  // A slip takes 2 s of 5000: two rows, which find 1 + 0.54 cos x to within the tenth of its swing.
  CHECK(run.greatest("block.ux") <= 1.0001 * u);
  CHECK(run.greatest("block.ux") >= 1.0 + 0.9 * (u - 1.0));
}

TEST_SUITE_END();
