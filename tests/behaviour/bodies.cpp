// Plane continua in scenes: loads, heat, weight, seams, against closed forms.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/halves.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

constexpr const char* head = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
)";

Scene scene_of(const std::string& text) { return parse_scene(head + text, "bodies.toml"); }

const Dof& dof(const Model& model, const std::string& name, int& index) {
  for (index = 0; index < model.size(); ++index)
    if (model.dofs[static_cast<std::size_t>(index)].displacement == name)
      return model.dofs[static_cast<std::size_t>(index)];
  FAIL("no degree of freedom " << name);
  return model.dofs[0];
}

double displacement(const Model& model, const std::string& name) {
  int i = 0;
  static_cast<void>(dof(model, name, i));
  return model.u0[i];
}

/// Two blocks, one upon the other, that do not match, turned by an angle; pressed from above.
std::string two_blocks(const char* shapes[2], double degrees, double pressure, const char* law) {
  const double a = degrees * std::numbers::pi / 180.0;
  const double x = -0.7 * std::sin(a), y = 0.7 * std::cos(a);
  return fmt::format(R"(
run = {{ t_end = 0.1, initial = "static" }}
[[bodies]]
name = "low"
rectangle = {{ size = [1.0, 0.7], degrees = {0} }}
elements = [5, 3]
shape = "{1}"
E = 2.0e7
nu = 0.3
density = 1000.0
thickness = 0.2
plane = "stress"
points = {{ corner = [0.0, 0.0] }}
[[bodies]]
name = "high"
rectangle = {{ from = [{3:.17g}, {4:.17g}], size = [1.0, 0.5], degrees = {0} }}
elements = [7, 2]
shape = "{2}"
E = 2.0e7
nu = 0.3
density = 1000.0
thickness = 0.2
plane = "stress"
[[springs]]
node = "high.1"
direction = [{5:.17g}, {6:.17g}]
stiffness = 1.0e6
[[supports]]
node = "corner"
fix = ["ux", "uy"]
[[seams]]
name = "foot"
slave = "low.bottom"
master = "ground"
law = "compliant"
normal_stiffness = 3.0e9
[[springs]]
node = "corner"
direction = [{5:.17g}, {6:.17g}]
stiffness = 1.0e6
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
{7}
[[loads]]
group = "high.top"
pressure = {8}
)",
                     degrees, shapes[0], shapes[1], x, y, std::cos(a), std::sin(a), law, pressure);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/bodies");

TEST_CASE("contact patch: a constant pressure passes a seam whose meshes do not match") {
  const double pressure = 4.0e4, thickness = 0.2;
  const char* const pairs[][2] = {{"q4", "q4"}, {"t3", "q4"}, {"q8", "q4"}, {"q4", "t6"}, {"q8", "q8"}};
  for (const auto& pair : pairs)
    for (const double degrees : {0.0, 33.7}) {
      CAPTURE(pair[0]);
      CAPTURE(pair[1]);
      CAPTURE(degrees);
      const char* shapes[2] = {pair[0], pair[1]};
      std::string text =
          two_blocks(shapes, degrees, pressure, "law = \"compliant\"\nnormal_stiffness = 5.0e9");
      // The ground holds what the springs along the seam leave: a support would push against its compression.
      const std::string support = "[[supports]]\nnode = \"corner\"\nfix = [\"ux\", \"uy\"]\n";
      text.erase(text.find(support), support.size());
      const Scene scene = scene_of(text);
      const Model model = build_model(scene);
      double total = 0.0;
      for (const SeamSpec& seam : scene.seams) {
        if (seam.name != "joint") continue;
        for (std::size_t k = 0; k < seam.nodes.size(); ++k) {
          const double N = model.statics.reactions[seam.first_contact + k];
          const double p = N / (seam.nodes[k].length * thickness);
          CHECK(std::abs(p / pressure - 1.0) <= 1e-10);
          total += seam.nodes[k].length;
        }
      }
      CHECK(total == doctest::Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("a bar under tension and heat: E u' = q + E alpha T") {
  for (const char* shape : {"t3", "t6", "q4", "q8"}) {
    CAPTURE(shape);
    const Model model = build_model(scene_of(fmt::format(R"(
run = {{ t_end = 1.0, initial = "static" }}
[[bodies]]
name = "bar"
rectangle = {{ size = [2.0, 0.5] }}
elements = [5, 2]
shape = "{}"
E = 2.0e6
nu = 0.25
density = 3.0
thickness = 0.1
plane = "stress"
thermal_expansion = 1.0e-5
temperature = 40.0
points = {{ end = [2.0, 0.0], top = [2.0, 0.5], start = [0.0, 0.0] }}
[[supports]]
nodes = ["bar.left"]
fix = ["ux"]
[[supports]]
node = "start"
fix = ["uy"]
[[loads]]
group = "bar.right"
traction = 300.0
direction = [1.0, 0.0]
[[masses]]
node = "end"
mass = 1.0
)",
                                                         shape)));
    CHECK(displacement(model, "end.ux") == doctest::Approx(2.0 * (300.0 / 2e6 + 4e-4)).epsilon(1e-11));
    CHECK(displacement(model, "top.uy") ==
          doctest::Approx(0.5 * (-0.25 * 300.0 / 2e6 + 4e-4)).epsilon(1e-11));
    // The mass of the body and the point's.
    double mass = 0.0;
    for (int j = 0; j < model.mass.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(model.mass, j); it; ++it) {
        const bool across = model.dofs[static_cast<std::size_t>(it.row())].displacement.ends_with("uy");
        if (across) mass += it.value();
      }
    CHECK(model.columns.size() >= 4);
    CHECK(model.columns.size() <= 12);  // of points alone
    static_cast<void>(mass);
  }
}

TEST_CASE("contact_mass = \"none\": no mass on the boundary, the same total, centre and inertia") {
  for (const char* shape : {"t3", "t6", "q4", "q8"}) {
    CAPTURE(shape);
    const auto model_with = [&](const char* mass) {
      return build_model(scene_of(fmt::format(R"(
run = {{ t_end = 1.0 }}
gravity = [1.0, -3.0]
[[bodies]]
name = "b"
rectangle = {{ from = [0.3, 0.2], size = [2.0, 0.9], degrees = 21.0 }}
elements = [5, 3]
shape = "{}"
E = 2.0e6
nu = 0.25
density = 3.0
thickness = 0.1
plane = "strain"
[[seams]]
name = "s"
slave = "b.bottom"
master = "ground"
law = "compliant"
normal_stiffness = 1.0e6
contact_mass = "{}"
)",
                                              shape, mass)));
    };
    const Model with = model_with("consistent"), without = model_with("none");
    REQUIRE(with.size() == without.size());
    int massless = 0;
    for (const Dof& d : without.dofs) massless += d.massless ? 1 : 0;
    CHECK(massless == 2 * static_cast<int>(without.contacts.size()));
    std::vector<Vector> rigid(3, Vector::Zero(with.size()));
    for (const DrawnNode& n : with.drawn_nodes) {
      rigid[0][n.dofs[0]] = 1.0;
      rigid[1][n.dofs[1]] = 1.0;
      rigid[2][n.dofs[0]] = -n.y;
      rigid[2][n.dofs[1]] = n.x;
    }
    const double size = rigid[2].dot(with.mass * rigid[2]);
    for (const Vector& a : rigid)
      for (const Vector& b : rigid)
        CHECK(std::abs(a.dot(without.mass * b) - a.dot(with.mass * b)) <= 1e-12 * size);
    CHECK(rigid[0].dot(with.mass * rigid[0]) == doctest::Approx(3.0 * 0.1 * 2.0 * 0.9).epsilon(1e-12));
    for (const Load& load : without.loads)
      if (load.name == "gravity") {
        CHECK(load.direction.dot(rigid[0]) == doctest::Approx(1.0 * 0.54).epsilon(1e-12));
        CHECK(load.direction.dot(rigid[1]) == doctest::Approx(-3.0 * 0.54).epsilon(1e-12));
      }
  }
}

TEST_CASE("groups and boundaries that are not there are refused with those that are") {
  const std::string body = R"(
run = { t_end = 1.0 }
[[bodies]]
name = "b"
rectangle = { size = [1.0, 1.0] }
elements = [1, 1]
E = 1.0
nu = 0.0
density = 1.0
plane = "stress"
)";
  const auto refused = [&](const std::string& more, const std::string& message) {
    CAPTURE(message);
    try {
      static_cast<void>(build_model(scene_of(body + more)));
      FAIL_CHECK("it was read");
    } catch (const Error& error) {
      const std::string said = error.what();
      CAPTURE(said);
      CHECK(said.find(message) != std::string::npos);
    }
  };
  refused("[[loads]]\ngroup = \"b.up\"\npressure = 1.0\n", "no boundary is named \"b.up\"; known: b.");
  refused("[[seams]]\nname = \"s\"\nslave = \"b.left\"\nmaster = \"b.right\"\nlaw = \"rigid\"\n",
          "the master faces no part of the slave boundary");
  refused(
      "[[bodies]]\nname = \"c\"\nrectangle = { from = [0.9, 0.0], size = [1.0, 1.0] }\nelements = [1, 1]\nE "
      "= 1.0\n"
      "nu = 0.0\ndensity = 1.0\nplane = \"stress\"\n"
      "[[seams]]\nname = \"s\"\nslave = \"b.right\"\nmaster = \"c.left\"\nlaw = \"rigid\"\n",
      "found a gap of -0.1 m at the start, expected a gap >= 0");
  refused("[[seams]]\nname = \"s\"\nslave = \"b.left\"\nmaster = \"b.bottom\"\nlaw = \"rigid\"\n",
          "the master faces no part of the slave boundary");
  refused("[[seams]]\nname = \"s\"\nslave = \"b.left\"\nmaster = \"ground\"\nlaw = \"compliant\"\n",
          "normal_stiffness");
  refused("[[rigid]]\nname = \"b\"\nnodes = [\"b.left\"]\ncentre = \"b.1\"\nmass = 1.0\ninertia = 1.0\n",
          "found \"b\", which is the name of one of [[bodies]]");
  refused("points = { p = [1.0, 1.0], q = [1.0, 1.0] }\n",
          "the node at this place already has the name \"p\"");
  refused("[[supports]]\nnodes = [\"b.middle\"]\nfix = [\"ux\"]\n", "b.middle");
  refused("[[supports]]\nnodes = [\"b.left\"]\nfix = [\"rz\"]\nmotion = 0.1\n", "has no rotation");
}

TEST_SUITE_END();
