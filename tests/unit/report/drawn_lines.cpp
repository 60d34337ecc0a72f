#include "report/mesh_motion.hpp"

#include <doctest/doctest.h>

#include "result/frames.hpp"

using namespace signorini;

TEST_SUITE("unit/report/drawn_lines") {
  TEST_CASE("drawn lines: straight ones have two places, bent ones eleven, from end to end") {
    const base::Json shapes = report::shapes_json();
    REQUIRE(shapes.size() == 4);
    CHECK(shapes[0] ==
          base::parse_json(std::string("[[0.0, 1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0, 0.0]]")));
    for (const std::size_t k : {1, 2, 3}) {
      REQUIRE(shapes[k].size() == 11);
      CHECK(shapes[k][0] == shapes[0][0]);
      CHECK(shapes[k][10] == shapes[0][1]);
      CHECK(shapes[k][3][0].get<double>() == 0.3);
    }
  }

  TEST_CASE("drawn lines: a beam of the page is the beam of the pictures") {
    const result::Frame::Element beam{"beam", {1.0, 2.0, 0.03, -0.04, 0.11}, {4.0, -1.0, 0.01, 0.05, -0.07}};
    const base::Json shapes = report::shapes_json();  // a name: what is looped over must outlive the loop
    for (const base::Json& row : shapes[1]) {
      const double s = row[0].get<double>();
      const result::FrameEnd expected = result::between(beam, s),
                             p = result::between(beam.a, beam.b, s, report::across_of(row));
      CHECK(p.ux == expected.ux);
      CHECK(p.uy == expected.uy);
    }
  }

  TEST_CASE("drawn lines: which shape a piece has, hinged at one end, at both, or no beam") {
    CHECK(report::shape_of({"A", "B", false}) == 0);
    CHECK(report::shape_of({"A", "B", true}) == 1);
    CHECK(report::shape_of({"A", "B", true, true, false}) == 2);
    CHECK(report::shape_of({"A", "B", true, false, true}) == 3);
    CHECK(report::shape_of({"A", "B", true, true, true}) == 0);
    // A hinge at a: a turn there moves nothing, one at b does.
    for (const std::size_t i : {2, 5, 8}) {
      CHECK(report::shapes_json()[2][i][2] == 0.0);
      CHECK(report::shapes_json()[2][i][4] != 0.0);
      CHECK(report::shapes_json()[3][i][2] != 0.0);
      CHECK(report::shapes_json()[3][i][4] == 0.0);
    }
  }

  TEST_CASE(
      "drawn lines: the greatest displacement is an eighth of the structure, to 1, 2 or 5 times a power of "
      "ten") {
    base::Json nodes = base::parse_json(
        std::string(R"([{"x": 1.0, "y": 0.0, "u": [0, -1, 2]}, {"x": 4.0, "y": 9.0, "u": [-1, 1, -1]}])"));
    base::Json curve = base::parse_json(
        std::string(R"({"columns": [{"u": [0.0, 1e-3]}, {"u": [null, -2e-3]}, {"u": [0.0, 7.0]}]})"));
    CHECK(report::fitting_magnification(nodes, curve) ==
          500.0);  // 9 / 8 / 2e-3 = 562.5; rotations do not count
    curve["columns"][1]["u"][1] = 40.0;
    CHECK(report::fitting_magnification(nodes, curve) == 0.02);  // what goes far is drawn smaller
    curve["columns"][0]["u"][1] = curve["columns"][1]["u"][1] = 0.0;
    CHECK(report::fitting_magnification(nodes, curve) == 1.0);
    nodes.erase(1);  // one node has an extent of one
    curve["columns"][0]["u"][1] = 0.01;
    CHECK(report::fitting_magnification(nodes, curve) == 10.0);
  }
}
