// Seams on matrices: boundaries by places and degrees of freedom.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Two blocks of this shape that do not match, the lower one held, the upper one pushed; turned.
std::string two_blocks(const char* shape, double degrees, const char* engine) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.02, engine = "{5}", rtol = 1e-10, output_dt = 0.001, certify = false }}
[[bodies]]
name = "low"
rectangle = {{ size = [0.4, 0.1], degrees = {0} }}
elements = [5, 2]
shape = "{6}"
E = 2.0e7
nu = 0.3
density = 2000.0
thickness = 0.1
plane = "stress"
[[bodies]]
name = "high"
rectangle = {{ from = [{1:.17g}, {2:.17g}], size = [0.3, 0.2], degrees = {0} }}
elements = [3, 2]
shape = "{6}"
E = 3.0e7
nu = 0.2
density = 2500.0
thickness = 0.1
plane = "stress"
[[supports]]
nodes = ["low.bottom", "low.left"]
fix = ["ux", "uy"]
[[loads]]
group = "high.top"
pressure = 2.0e4
[[loads]]
group = "high.left"
traction = 30000.0
direction = [{3:.17g}, {4:.17g}]
history = {{ type = "half_sine", start = 0.0, duration = 0.01 }}
)",
                     degrees, 0.05 * c - 0.1 * s, 0.05 * s + 0.1 * c, c, s, engine, shape);
}

std::string joint_seam(const char* slave, const char* master) {
  return fmt::format(R"([[seams]]
name = "joint"
slave = "{}"
master = "{}"
law = "compliant"
layer = {{ E = 1.0e7, G = 4.0e6, thickness = 0.01 }}
friction = {{ static = 0.4, kinetic = 0.3 }}
)",
                     slave, master);
}

std::string rows_of(const SparseMatrix& a) {
  std::string text = "[";
  for (int i = 0; i < a.rows(); ++i) {
    text += "[";
    for (int j = 0; j < a.cols(); ++j) text += fmt::format("{:.17g}, ", a.coeff(i, j));
    text += "],\n";
  }
  return text + "]\n";
}

/// Nodes of a group in the order of its edges, which run with the body to their left.
std::string surface_of(const Scene& scene, const Model& model, const std::string& name, const char* called) {
  const PlaneMesh::Group* group = nullptr;
  for (const BodySpec& body : scene.bodies)
    for (const PlaneMesh::Group& g : body.mesh.groups)
      if (body.name + "." + g.name == name) group = &g;
  REQUIRE(group != nullptr);
  std::vector<PlaneMesh::Edge> left = group->edges;
  std::vector<int> course;
  const auto starts = [&](int node) {
    return std::find_if(left.begin(), left.end(),
                        [&](const PlaneMesh::Edge& e) { return e.nodes[0] == node; });
  };
  const auto ends = [&](int node) {
    return std::any_of(left.begin(), left.end(),
                       [&](const PlaneMesh::Edge& e) { return e.nodes[1] == node; });
  };
  auto next =
      std::find_if(left.begin(), left.end(), [&](const PlaneMesh::Edge& e) { return !ends(e.nodes[0]); });
  course.push_back(next->nodes[0]);
  const bool quadratic = next->nodes.size() == 3;
  while (next != left.end()) {
    if (quadratic) course.push_back(next->nodes[2]);
    course.push_back(next->nodes[1]);
    left.erase(next);
    next = starts(course.back());
  }
  std::string x, y, ux, uy;
  for (const int n : course) {
    const auto i = static_cast<std::size_t>(n);
    x += fmt::format("{:.17g}, ", scene.nodes[i].x);
    y += fmt::format("{:.17g}, ", scene.nodes[i].y);
    const int* dofs = model.drawn_nodes[i].dofs;
    ux += dofs[0] < 0 ? std::string("\"\", ") : fmt::format("\"d{}\", ", dofs[0]);
    uy += dofs[1] < 0 ? std::string("\"\", ") : fmt::format("\"d{}\", ", dofs[1]);
  }
  return fmt::format(
      "[[surfaces]]\nname = \"{}\"\nx = [{}]\ny = [{}]\nux = [{}]\nuy = [{}]\nquadratic = {}\nthickness = "
      "0.1\n",
      called, x, y, ux, uy, quadratic);
}

/// The scene of bodies, as another program would hand it over.
std::string as_matrices(const Scene& scene, const Model& model, const char* engine) {
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.02, engine = "{}", rtol = 1e-10, output_dt = 0.001, certify = false }}
[matrices]
mass = {}stiffness = {})",
                                 engine, rows_of(model.mass), rows_of(model.stiffness));
  text += surface_of(scene, model, "high.bottom", "slave") + surface_of(scene, model, "low.top", "master") +
          joint_seam("slave", "master");
  for (const Load& load : model.loads) {
    text += "[[loads]]\ndirection = { ";
    for (const auto& [dof, factor] : load.direction.terms)
      text += fmt::format("d{} = {:.17g}, ", dof, factor);
    text.resize(text.size() - 2);
    const bool constant = load.history.is_constant();
    text +=
        fmt::format(" }}\namplitude = {}\nhistory = {{ {} }}\n", constant ? 2.0e4 : 30000.0,
                    constant ? "type = \"constant\"" : "type = \"half_sine\", start = 0.0, duration = 0.01");
  }
  return text;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/surfaces");

TEST_CASE("matrices and surfaces of bodies: the same events, forces and resultants as of the bodies") {
  const std::tuple<const char*, double, const char*> cases[] = {
      {"q4", 0.0, "exact"}, {"q4", 33.7, "exact"}, {"q8", -71.0, "exact"}, {"q4", 33.7, "ida"}};
  for (const auto& [shape, degrees, engine] : cases) {
    CAPTURE(shape);
    CAPTURE(degrees);
    CAPTURE(engine);
    const Scene bodies =
        parse_scene(two_blocks(shape, degrees, engine) + joint_seam("high.bottom", "low.top"), "bodies.toml");
    const Model model = build_model(bodies);
    const Scene matrices = parse_scene(as_matrices(bodies, model, engine), "matrices.toml");
    const Result a = simulate(model, bodies.run), b = simulate(matrices);
    CHECK(a.events.size() > 5);
    REQUIRE(a.events.size() == b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      CAPTURE(i);
      CHECK(a.events[i].contact == b.events[i].contact);
      CHECK(a.events[i].to == b.events[i].to);
      CHECK(std::abs(a.events[i].t - b.events[i].t) <= (std::string(engine) == "ida" ? 1e-7 : 1e-11));
    }
    REQUIRE(matrices.seams.size() == 1);
    const SeamSpec &of_bodies = bodies.seams[0], &of_matrices = matrices.seams[0];
    REQUIRE(of_matrices.nodes.size() == of_bodies.nodes.size());
    for (std::size_t k = 0; k < of_bodies.nodes.size(); ++k) {
      CHECK(of_matrices.nodes[k].length == doctest::Approx(of_bodies.nodes[k].length));
      CHECK(std::abs(of_matrices.nodes[k].at[0] - of_bodies.nodes[k].at[0]) <= 1e-15);
      CHECK(std::abs(of_matrices.nodes[k].at[1] - of_bodies.nodes[k].at[1]) <= 1e-15);
    }
    CHECK(of_matrices.thickness == of_bodies.thickness);
  }
}

TEST_CASE("surfaces that cannot be are refused, with what was found") {
  const std::string base = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 1.0 }
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[2.0, -1.0], [-1.0, 2.0]]
[[surfaces]]
name = "foot"
)";
  const std::string joint =
      "[[seams]]\nname = \"s\"\nlaw = \"compliant\"\nnormal_stiffness = 1.0\nmaster = \"ground\"\nslave = ";
  const std::pair<std::string, const char*> cases[] = {
      {"x = [0.0, 1.0]\ny = [0.0]\nux = [\"d0\", \"d1\"]\nuy = [\"\", \"\"]\n",
       "surfaces.foot.y: found 1 entry, expected 2, one"},
      {"x = [0.0, 1.0]\ny = [0.0, 0.0]\nux = [\"d0\", \"d7\"]\nuy = [\"\", \"\"]\n", "d7"},
      {"x = [0.0, 1.0]\ny = [0.0, 0.0]\nux = [\"d0\", \"d0\"]\nuy = [\"\", \"\"]\n", "at two places"},
      {"x = [0.0, 1.0]\ny = [0.0, 0.0]\nux = [\"d0\", \"d1\"]\nuy = [\"\", \"\"]\nquadratic = true\n",
       "at least 3: end, middle, end"},
      {"x = [0.0, 1.0]\ny = [0.0, 0.0]\nux = [\"d0\", \"d1\"]\nuy = [\"\", \"\"]\n" + joint + "\"toe\"\n",
       "no surface is named \"toe\"; known: 'foot'"},
      {"x = [0.0, 1.0]\ny = [0.0, 0.0]\nux = [\"d0\", \"d1\"]\nuy = [\"\", \"\"]\n" + joint +
           "\"foot\"\ncontact_mass = \"none\"\n",
       "seams.s.contact_mass: found \"none\""}};
  for (const auto& [text, message] : cases) {
    CAPTURE(message);
    try {
      static_cast<void>(parse_scene(base + text, "surfaces.toml"));
      FAIL("accepted");
    } catch (const SceneError& e) {
      CHECK_MESSAGE(std::string(e.what()).find(message) != std::string::npos, std::string(e.what()));
    }
  }
}

TEST_SUITE_END();
