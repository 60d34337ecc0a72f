// How meshes move, for the page: body_motion.csv.
#include "result/body_frames.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>

#include "result/run_directory.hpp"
#include "signorini/simulate.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

namespace {

/// Two elements; the left edge follows a ramp along x, the right one is free.
Scene dragged_strip(double output_dt) {
  return parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0, output_dt = {}, engine = "exact" }}
[[bodies]]
name = "strip"
rectangle = {{ size = [2.0, 1.0] }}
elements = [2, 1]
E = 1.0e3
nu = 0.0
density = 1.0
plane = "stress"
[[supports]]
nodes = ["strip.left"]
fix = ["uy"]
[[supports]]
nodes = ["strip.left"]
fix = ["ux"]
motion = {{ type = "polynomial", coefficients = [0.0, 0.0, 0.25] }}
)",
                                 output_dt),
                     "strip.toml");
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_SUITE_BEGIN("unit/result/body_frames");

TEST_CASE(
    "body motion: nodes and supports of a mesh at output times, evenly left out, never without pictures") {
  for (const auto& [output_dt, rows] : {std::pair{0.25, 5u}, std::pair{0.001, 251u}}) {
    CAPTURE(output_dt);
    const Scene scene = dragged_strip(output_dt);
    const Model model = build_model(scene);
    const Folder folder;
    for (const bool pictures : {true, false}) {
      result::RunDirectoryOptions options;
      options.pictures = pictures;
      result::RunDirectory directory(folder / (pictures ? "with" : "without"), scene, model, options);
      directory.finish(simulate(model, scene.run, directory));
    }
    CHECK_FALSE(std::filesystem::exists(folder / "without" / "body_motion.csv"));
    const std::string text = slurp(folder / "with" / "body_motion.csv");
    CHECK(text.starts_with("t,strip.1.ux,strip.1.uy,strip.2.ux,"));
    CHECK(lines_of(text) == rows + 1);
    // The last row is the end; the support has gone 0.25 m.
    const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
    CHECK(last.starts_with("1,0.25,0,"));
  }
}

TEST_SUITE_END();
