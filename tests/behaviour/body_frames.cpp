// Stresses of bodies and pressures of seams at the times of frames, in files and for ParaView.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "report/paraview.hpp"
#include "result/csv.hpp"
#include "result/run_directory.hpp"
#include "signorini/simulate.hpp"
#include "unit/report/vtu_array.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

namespace {

/// A block that stands pressed on the ground, turned; beside it a strip that a support has stretched.
std::string pressed_and_stretched(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format(R"(schema = 1
units = {{ force = "kN", mass = "kg", length = "mm", time = "ms" }}
run = {{ t_end = 0.1, initial = "static", engine = "exact", frames = [0.0, 0.07], output_dt = 0.05 }}
damping = {{ alpha = 0.0, beta = 0.01 }}
[[bodies]]
name = "block"
rectangle = {{ size = [3.0, 2.0], degrees = {0} }}
elements = [3, 2]
shape = "t6"
E = 2000.0
nu = 0.3
density = 1.0
thickness = 4.0
plane = "strain"
points = {{ corner = [0.0, 0.0] }}
[[springs]]
node = "corner"
direction = [{1:.17g}, {2:.17g}]
stiffness = 100.0
[[seams]]
name = "foot"
slave = "block.bottom"
master = "ground"
law = "compliant"
normal_stiffness = 500.0
tangential_stiffness = 300.0
friction = 0.5
[[loads]]
group = "block.top"
pressure = 7.0
[[bodies]]
name = "strip"
rectangle = {{ from = [10.0, 0.0], size = [4.0, 1.0] }}
elements = [4, 1]
E = 1000.0
nu = 0.25
density = 1.0
plane = "stress"
points = {{ foot = [10.0, 0.0] }}
[[supports]]
nodes = ["strip.left"]
fix = ["ux"]
[[supports]]
node = "foot"
fix = ["uy"]
[[supports]]
nodes = ["strip.right"]
fix = ["ux"]
motion = 0.02
)",
                     degrees, c, s);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/body_frames");

TEST_CASE("frames have stresses of all nodes and pressures along seams, also where a support moves") {
  const made_up::Folder folder;
  const double degrees = 23.0, a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  const Scene scene = parse_scene(pressed_and_stretched(degrees), "frames.toml");
  const Model model = build_model(scene);
  {
    result::RunDirectory directory(folder / "run", scene, model, {true, {"test"}});
    static_cast<void>(simulate(model, scene.run, directory));
  }
  int blocks = 0, strips = 0;
  result::CsvReader bodies(folder / "run" / "frame_bodies.csv");
  const auto column = [&](const char* name) { return bodies.number(bodies.column(name)); };
  while (bodies.next()) {
    const bool block = bodies.cell(bodies.column("body")) == "block";
    ++(block ? blocks : strips);
    // -7 across the block, 0.02 E / L along the strip; plane strain: sigma_z = nu sigma.
    const double xx = block ? -7.0 * s * s : 5.0, yy = block ? -7.0 * c * c : 0.0,
                 xy = block ? 7.0 * c * s : 0.0;
    CHECK(std::abs(column("xx") - xx) <= 1e-7);
    CHECK(std::abs(column("yy") - yy) <= 1e-7);
    CHECK(std::abs(column("xy") - xy) <= 1e-7);
    CHECK(column("mises") == doctest::Approx(block ? 7.0 * std::sqrt(1.0 - 0.3 + 0.09) : 5.0).epsilon(1e-7));
  }
  CHECK(blocks == 2 * 35);
  CHECK(strips == 2 * 10);
  result::CsvReader seams(folder / "run" / "frame_seams.csv");
  int rows = 0;
  while (seams.next()) {
    CHECK(seams.number(seams.column("s")) == doctest::Approx(0.5 * (rows % 7)).epsilon(1e-12));
    CHECK(seams.number(seams.column("pressure")) == doctest::Approx(7.0).epsilon(1e-8));
    CHECK(seams.number(seams.column("opening")) == doctest::Approx(-7.0 / 500.0).epsilon(1e-8));
    CHECK(seams.cell(seams.column("state")) == "stick");
    ++rows;
  }
  CHECK(rows == 2 * 7);
}

TEST_CASE("frames for ParaView: cells, tractions on the slave, states of the seam") {
  const made_up::Folder folder;
  const Scene scene = parse_scene(pressed_and_stretched(0.0), "frames.toml");
  const Model model = build_model(scene);
  {
    result::RunDirectory directory(folder / "run", scene, model, {true, {"test"}});
    static_cast<void>(simulate(model, scene.run, directory));
  }
  std::filesystem::create_directory(folder / "run" / "paraview");
  const auto list = report::write_paraview_bodies(folder / "run", scene);
  REQUIRE(list);
  CHECK(made_up::slurp(*list).find("timestep=\"0.07\" file=\"body-0002.vtu\"") != std::string::npos);
  const std::string text = made_up::slurp(folder / "run" / "paraview" / "body-0002.vtu");
  CHECK(text.find("NumberOfPoints=\"45\" NumberOfCells=\"23\"") != std::string::npos);  // 12 + 4 + 7
  const std::vector<double> types = test::array_of(text, "types"), body = test::array_of(text, "body"),
                            state = test::array_of(text, "state"),
                            pressure = test::array_of(text, "pressure");
  REQUIRE(types.size() == 23);
  CHECK(types[0] == 22.0);
  CHECK(types[12] == 9.0);
  CHECK(types[22] == 1.0);
  CHECK(body[11] == 0.0);
  CHECK(body[12] == 1.0);
  CHECK(state[0] == -1.0);
  CHECK(state[22] == 0.0);
  CHECK(pressure[16] == doctest::Approx(7.0));
  CHECK(test::array_of(text, "connectivity").size() == 12 * 6 + 4 * 4 + 7);
  const std::vector<double> traction = test::array_of(text, "traction"),
                            stress = test::array_of(text, "stress");
  REQUIRE(traction.size() == 3 * 45);
  REQUIRE(stress.size() == 3 * 45);
  double up = 0.0;
  for (std::size_t i = 1; i < traction.size(); i += 3) up += traction[i];
  CHECK(up == doctest::Approx(7.0 * 7.0));
  CHECK(stress[1] == doctest::Approx(-7.0));
}

TEST_SUITE_END();
