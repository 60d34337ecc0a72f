// A cutoff that a tolerance finds, for every structure that takes a cutoff: the full model lies within what it promises.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <random>

#include "differential/transform.hpp"
#include "signorini/simulate.hpp"
#include "study/reduction/find_cutoff.hpp"

using namespace signorini;

namespace signorini::tests::reduction_tolerance {
namespace {

Result run_scene(const Scene& scene) {
  Result result = simulate(build_model(scene), scene.run);
  INFO(result.report.outcome.reason);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  return result;
}

/// Greatest difference of the displacements of named nodes, of the greatest one.
double apart(const Scene& scene, const Result& a, const Result& b) {
  Scene whole = scene;
  whole.reduction.reset();
  const Model model = build_model(whole);
  REQUIRE(a.rows.size() == b.rows.size());
  double scale = 0.0, off = 0.0;
  for (const Column& column : model.columns) {
    if (column.velocity || column.dof < 0 || model.is_rotation(column)) continue;
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
      scale = std::max(scale, std::abs(a.rows[i].u[column.dof]));
      off = std::max(off, std::abs(a.rows[i].u[column.dof] - b.rows[i].u[column.dof]));
    }
  }
  REQUIRE(scale > 0.0);
  return off / scale;
}

/// With the tolerance, with the cutoff that it found, and with all modes. Contacts without a name of their own in the columns have a
/// part in what is told, and none in what is compared: told may be more than the error, never less.
ReductionSpec check_promise(Scene scene, double tolerance) {
  scene.reduction.emplace().tolerance = tolerance;
  const Scene found = reduction::find_cutoff(scene);
  const ReductionSpec spec = *found.reduction;
  REQUIRE_FALSE(spec.trials.empty());
  const double told = spec.trials.back().error;
  CHECK(told <= tolerance);
  const Result asked = run_scene(found);
  scene.reduction.emplace().cutoff_omega = spec.cutoff_omega;
  CHECK(apart(scene, run_scene(scene), asked) == 0.0);
  scene.reduction.reset();
  CHECK(apart(scene, run_scene(scene), asked) <= 1.1 * told + 1e-8);
  return spec;
}

Scene written(const std::string& text, const char* engine) {
  return parse_scene(text, "test.toml", {{"run.engine", engine}});
}

/// Numbers that are the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double between(double a, double b) { return a + (b - a) * (static_cast<double>(bits_()) / 4294967296.0); }
  bool coin() { return between(0.0, 1.0) < 0.5; }

 private:
  std::mt19937 bits_;
};

std::string head_of(double t_end) {
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [0.0, -9.81]
[run]
t_end = {}
output_dt = {}
rtol = 1e-9
initial = "static"
certify = false
[damping]
alpha = 3.0
)",
                     t_end, t_end / 50.0);
}

/// A portal on a rigid foot and a contact that slides, with a rigid body at a corner; its dashpots, its foot without mass.
std::string random_portal(unsigned seed) {
  Random random(seed);
  const double dashpot = random.coin() ? random.between(1.0, 50.0) : 0.0;
  return head_of(0.2) + fmt::format(R"([sections]
s = {{ EA = 2e7, EI = 3e4, mass_per_length = 15.0 }}
[nodes]
A = [0.0, 0.0]
foot = [{}, -0.2]
B = [0.0, 3.0]
C = [4.0, 3.1]
D = [4.0, 0.0]
arm = [4.5, {}]
[[members]]
nodes = ["A", "B", "C", "D"]
section = "s"
elements = 3
[[rigid]]
name = "base"
centre = "A"
nodes = ["foot"]
mass = {}
inertia = {}
[[rigid]]
name = "corner"
centre = "C"
nodes = ["arm"]
mass = {}
inertia = 2.0
[[supports]]
node = "foot"
fix = ["ux", "uy"]
[[contacts]]
name = "slide"
node = "D"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = {}
tangential_stiffness = 2e5
tangential_damping = {}
friction = 0.3
[[loads]]
node = "arm"
direction = [1.0, -0.5]
amplitude = {}
history = {{ type = "half_sine", duration = 0.05 }}
)",
                                    random.between(-0.5, 0.5), random.between(3.0, 3.5),
                                    random.coin() ? 0.0 : 20.0, random.coin() ? 0.0 : 1.0,
                                    random.between(5.0, 80.0), random.between(3e5, 3e6), dashpot,
                                    random.between(500.0, 4000.0));
}

/// Two meshes, one tied to the other, the upper one on the lower one; `fine`: more of them than have all modes computed.
std::string tied_blocks(unsigned seed, int fine) {
  Random random(seed);
  return head_of(0.02) + fmt::format(R"([[bodies]]
name = "low"
rectangle = {{ from = [0.0, 0.0], size = [1.0, 0.3] }}
elements = [{}, {}]
E = 2e8
nu = 0.3
density = 2000.0
thickness = 0.1
plane = "stress"
points = {{ end = [1.0, 0.3] }}
[[bodies]]
name = "high"
rectangle = {{ from = [{}, 0.3], size = [0.4, 0.3] }}
elements = [{}, {}]
E = 2e8
nu = 0.3
density = 2000.0
thickness = 0.1
plane = "stress"
points = {{ top = [{}, 0.6] }}
[[seams]]
name = "glue"
slave = "high.bottom"
master = "low.top"
law = "tied"
[[seams]]
name = "bed"
slave = "low.bottom"
master = "ground"
law = "compliant"
normal_stiffness = {}
tangential_stiffness = 1e8
friction = 0.4
[[loads]]
node = "top"
direction = [1.0, 0.0]
amplitude = {}
history = {{ type = "half_sine", duration = 0.01 }}
)",
                                     4 * fine, 2 * fine, 0.1 + 0.01 * seed, 3 * fine, 2 * fine,
                                     0.1 + 0.01 * seed, random.between(5e8, 5e9),
                                     random.between(300.0, 900.0));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/reduction_tolerance");

TEST_CASE("a tolerance with a rigid body: the portal that ended the program") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/reduction/foot-of-a-portal.toml");
  for (const Engine engine : {Engine::exact, Engine::ida}) {
    Scene other = scene;
    other.run.engine = engine;
    check_promise(other, 1e-3);
  }
}

TEST_CASE(
    "a tolerance with rigid bodies, dashpots, and feet without mass: random portals, turned and in other "
    "units") {
  for (unsigned seed = 0; seed < 8; ++seed) {
    CAPTURE(seed);
    const Scene scene = written(random_portal(seed), seed % 2 == 0 ? "exact" : "ida");
    const ReductionSpec spec = check_promise(scene, 1e-2);
    if (seed > 2) continue;
    check_promise(differential::turned(scene, 33.0)->scene, 1e-2);
    Factors units;
    units.force = 1e3;
    units.length = 10.0;
    units.time = 0.1;
    const ReductionSpec other = check_promise(differential::in_units(scene, units)->scene, 1e-2);
    CHECK(other.trials.back().modes == spec.trials.back().modes);
    CHECK(other.cutoff_omega == doctest::Approx(10.0 * spec.cutoff_omega).epsilon(1e-9));
  }
}

TEST_CASE("a tolerance with meshes that are tied") {
  check_promise(written(tied_blocks(1, 1), "exact"), 1e-3);
  check_promise(written(tied_blocks(2, 1), "ida"), 1e-3);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/behaviour/reduction_tolerance");
TEST_CASE("a tolerance with tied meshes of which not all modes are computed") {
  const ReductionSpec spec = check_promise(written(tied_blocks(3, 4), "exact"), 1e-3);
  CHECK(spec.trials.back().modes < 400);
}
TEST_SUITE_END();

}  // namespace signorini::tests::reduction_tolerance
