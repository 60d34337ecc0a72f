// Branches with corners: the sequence of events changes every few hundredths of rad/s.
#include <doctest/doctest.h>

#include <cmath>

#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

void passes_changes(int points, std::size_t sequences) {
  const SceneReader read = reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml",
                                     {{"run.engine", "exact"},
                                      {"damping.alpha_over_omega1", "0.02"},
                                      {"loads.1.amplitude", "20.0"},
                                      {"loads.1.history", "{ type = \"harmonic\", omega = 130.0 }"}});
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 130.0;
  options.to = 15.0;
  options.orbit.transient = 40;
  options.most_points = points;
  const Branch branch = continue_branch(read, options);
  CAPTURE(branch.end);
  REQUIRE(branch.points.size() >= static_cast<std::size_t>(points));
  CHECK(branch.sequences.size() >= sequences);
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint& p = branch.points[i];
    CAPTURE(p.parameter);
    CHECK(p.special.find("restart") == std::string::npos);
    CHECK(p.parameter < branch.points[i - 1].parameter);  // before: from 129.71 back to 129.50
  }
}

}  // namespace

TEST_SUITE_BEGIN("slow/orbit corners");

TEST_CASE("a branch of the lightly damped pipeline passes changes of its sequence and never meets itself") {
  passes_changes(15, 3);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/orbit corners");

TEST_CASE("the branch of the lightly damped pipeline goes on through further changes of its sequence") {
  passes_changes(45, 5);
}

TEST_SUITE_END();
