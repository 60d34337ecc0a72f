// The floor that matrices in double leave: closed forms, and what rounding does to a beam's lowest frequency.
#include "model/modes/modes.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE_BEGIN("unit/model/modes/modes");

TEST_CASE("one mass: eps/4") {
  const Model model = build_model(parse_scene(R"(schema = 1
title = "one"
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1
output_dt = 1
[matrices]
dofs = ["a"]
mass = [[2.0]]
stiffness = [[50.0]]
)",
                                              "one.toml"));
  CHECK(modes::rounding_floor(model) == doctest::Approx(std::ldexp(1.0, -54)).epsilon(1e-12));
}

TEST_CASE("the pipeline: what random roundings of K do to omega1, by the mesh") {
  double last = 0.0;
  for (const char* elements : {"[2,6]", "[4,12]", "[8,24]"}) {
    const Model model = build_model(read_scene(SIGNORINI_MODELS "/pipeline.toml",
                                               {{"members.1.elements", elements}, {"run.t_end", "1e-3"}}));
    const double floor = modes::rounding_floor(model);
    CAPTURE(elements);
    CHECK(floor > 3.0 * last);  // n^3 and more
    last = floor;
  }
  CHECK(last > 3e-14);  // 3.5e-13 was seen against quadruple precision at 99 unknowns
  CHECK(last < 3e-12);
}

TEST_SUITE_END();
