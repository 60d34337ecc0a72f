#include "report/paraview.hpp"

#include <doctest/doctest.h>

#include "report/mesh_motion.hpp"
#include "unit/report/vtu_array.hpp"

using namespace signorini;

namespace {

/// A column of 2 on a support, a beam of 4 to its right; its end moves up at 1 a second, and there is a contact.
base::Json two_nodes() {
  base::Json data = base::parse_json(std::string(R"({
    "nodes": [{"name": "A", "x": 0.0, "y": 0.0, "u": [-1, -1, -1]}, {"name": "B", "x": 4.0, "y": 0.0, "u": [-1, 0, 1]}],
    "pieces": [{"a": 0, "b": 1, "bar": false, "shape": 1}],
    "springs": [{"a": 0, "b": 1, "dx": 1.0, "dy": 0.0}, {"a": 1, "b": -1, "dx": 0.0, "dy": 1.0}],
    "loads": [{"name": "load 1", "node": 1, "dx": 0.6, "dy": 0.8, "t": [0.0, 1.0, 1.0, 2.0], "f": [10.0, 10.0, 0.0, 0.0]}],
    "contacts": [{"name": "c", "node": 1, "nx": 0.0, "ny": 1.0, "against": [], "slider": false, "gap": 0.0,
                  "motion": {"t": [0.0, 1.0, 1.0, 2.0], "state": [0, 0, 4, 4], "N": [-8.0, -4.0, 0.0, 0.0],
                             "T": [2.0, 2.0, 0.0, 0.0], "gap": [0.0, 0.0, 0.0, null]}}],
    "curve": {"times": [[0.0, 2.0]], "columns": [{"t": 0, "u": [0.0, 2.0]}, {"t": 0, "u": [0.0, 0.75]}]},
    "events": [[1.0, 0, "separation", "stick", "open"], [1.0, -1, "time", "", ""]]})"));
  data["shapes"] = report::shapes_json();
  return data;
}

}  // namespace

TEST_SUITE("unit/report/paraview") {
  TEST_CASE("paraview: as many points, offsets and data as the file says") {
    const std::string text = report::vtu_frame(two_nodes(), 0.5);
    // 11 of the beam, 2 of the spring between nodes, 2 nodes, a contact, a load
    CHECK(text.find("NumberOfPoints=\"17\" NumberOfCells=\"6\"") != std::string::npos);
    CHECK(test::array_of(text, "points").size() == 3 * 17);
    CHECK(test::array_of(text, "displacement").size() == 3 * 17);
    CHECK(test::array_of(text, "connectivity").size() == 17);
    CHECK(test::array_of(text, "offsets") == std::vector<double>{11, 13, 14, 15, 16, 17});
    CHECK(test::array_of(text, "types") == std::vector<double>{4, 3, 1, 1, 1, 1});
    CHECK(test::array_of(text, "kind") == std::vector<double>{0, 2, 3, 3, 4, 5});
    CHECK(test::array_of(text, "item") == std::vector<double>{-1, -1, -1, -1, 0, 0});
  }

  TEST_CASE("paraview: displacements between rows and along the cubic of a beam") {
    const std::vector<double> u = test::array_of(report::vtu_frame(two_nodes(), 1.5), "displacement");
    CHECK(u[3 * 10 + 1] == doctest::Approx(1.5));  // its end
    CHECK(u[3 * 14 + 1] == doctest::Approx(1.5));  // node B
    // v(s) = v (3 s^2 - 2 s^3) + L r (s^3 - s^2) in the middle, r = 0.75 * 0.75
    CHECK(u[3 * 5 + 1] == doctest::Approx(1.5 * 0.5 + 4.0 * 0.5625 * -0.125));
  }

  TEST_CASE("paraview: forces on the structure are -N n - T t and f d, after a jump those after it") {
    const base::Json data = two_nodes();
    const std::vector<double> before = test::array_of(report::vtu_frame(data, 0.5), "force");
    CHECK(before[3 * 15] == doctest::Approx(-2.0));     // t = [1, 0]
    CHECK(before[3 * 15 + 1] == doctest::Approx(6.0));  // -N n
    CHECK(before[3 * 16] == doctest::Approx(6.0));
    CHECK(before[3 * 16 + 1] == doctest::Approx(8.0));
    const std::string after = report::vtu_frame(data, 1.0);
    CHECK(test::array_of(after, "force")[3 * 15 + 1] == 0.0);
    CHECK(test::array_of(after, "force")[3 * 16] == 0.0);
    CHECK(test::array_of(after, "state") == std::vector<double>{-1, -1, -1, -1, 4, -1});
    CHECK(test::array_of(report::vtu_frame(data, 0.999), "state")[4] == 0);
  }

  TEST_CASE("paraview: as many times as asked for, at equal distances; those of events where asked for") {
    const base::Json data = two_nodes();
    CHECK(report::frame_times(data, 2, false) == std::vector<double>{0.0, 2.0});
    CHECK(report::frame_times(data, 2, true) == std::vector<double>{0.0, 1.0, 2.0});
    CHECK(report::frame_times(data, 3, true) == std::vector<double>{0.0, 1.0, 2.0});
    CHECK(report::frame_times(data, 1, false) == std::vector<double>{0.0});
    CHECK(report::frame_times(
              base::parse_json(std::string(R"({"curve": {"times": [], "columns": []}, "events": []})")), 5,
              true)
              .empty());
  }
}
