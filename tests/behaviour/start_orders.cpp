// Starts at rest that do not know the order of tables, the axes or a mirror: the same displacements and forces to rounding;
// and certificates that cover the errors that a start has all the same.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "behaviour/scene_parts.hpp"
#include "certify/data_perturbation.hpp"
#include "differential/transform.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::start_orders {
namespace {

using differential::mirrored;
using differential::permuted;
using differential::turned;

Scene scene_of(const std::string& name, std::vector<Override> overrides = {}) {
  return read_scene(std::string(SIGNORINI_TEST_DATA) + "/scenes/" + name + ".toml", overrides);
}

std::size_t named(const Model& model, const std::string& name) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].name == name) return k;
  REQUIRE(false);
  return 0;
}

double slip(const Model& model, const std::string& name) {
  return model.contacts[named(model, name)].tangent.dot(model.u0);
}

std::string refusal(const Scene& scene) {
  try {
    static_cast<void>(build_model(scene));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// Two bars that meet at the ridge C, tied at their feet A and B by a spring: the feet spread under the weight of C.
std::string spreading(bool reversed, const std::string& of_foot_A = "") {
  const std::string A = of_foot_A.empty()
                            ? "[[contacts]]\nname = \"A\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = [0.0, "
                              "1.0]\nnormal_stiffness = 4e4\nfriction = 0.5\ntangential_stiffness = 1e4\n"
                            : of_foot_A;
  const std::string B =
      "[[contacts]]\nname = \"B\"\nnode = \"B\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\n"
      "normal_stiffness = 7e4\nfriction = 0.2\ntangential_stiffness = 1e4\n";
  return parts::head +
         "gravity = [0.0, -10.0]\n[run]\nt_end = 0.1\ninitial = \"static\"\n"
         "[sections.bar]\nEA = 1e5\nmass_per_length = 1e-9\n[nodes]\nA = [0.0, 0.0]\nB = [2.0, 0.0]\nC = "
         "[0.5, 1.0]\n[[masses]]\nnode = \"C\"\nmass = 8.0\n[[masses]]\nnode = \"A\"\nmass = 4.0\n"
         "[[members]]\nnodes = [\"A\", \"C\"]\nsection = \"bar\"\ntype = \"bar\"\n"
         "[[members]]\nnodes = [\"B\", \"C\"]\nsection = \"bar\"\ntype = \"bar\"\n"
         "[[springs]]\nnode = \"B\"\nagainst = \"A\"\ndirection = [1.0, 0.0]\nstiffness = 5e3\n" +
         (reversed ? B + A : A + B);
}

// Each bar pushes along its line, so the tie carries H = 1.5 N_B. A has a mass of its own.
constexpr double weight_C = 80.0, N_B = weight_C * 0.5 / 2.0, N_A = weight_C - N_B + 40.0;
constexpr double spread = N_B * 1.5 / 5e3;  // H / k

}  // namespace

TEST_SUITE_BEGIN("behaviour/start_orders");

TEST_CASE("contacts share a free motion by their forces, in every order, mirrored and turned") {
  // ut_B - ut_A = spread; least N_A ut_A^2 + N_B ut_B^2.
  const double own_A = -spread * N_B / (N_A + N_B), own_B = spread * N_A / (N_A + N_B);
  for (const bool reversed : {false, true}) {
    const Scene scene = parse_scene(spreading(reversed), "spread.toml");
    std::vector<Scene> ways{scene, mirrored(scene)->scene};
    for (const double degrees : {33.0, 90.0, 211.0}) ways.push_back(turned(scene, degrees)->scene);
    for (std::uint64_t seed = 1; seed < 6; ++seed) ways.push_back(permuted(scene, seed).scene);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      CAPTURE(reversed);
      CAPTURE(i);
      const Model model = build_model(ways[i]);
      const double sign = i == 1 ? -1.0 : 1.0;
      CHECK(model.statics.reactions[named(model, "A")] == doctest::Approx(N_A).epsilon(1e-6));
      CHECK(slip(model, "A") == doctest::Approx(sign * own_A).epsilon(1e-6));
      CHECK(slip(model, "B") == doctest::Approx(sign * own_B).epsilon(1e-6));
      const Model first = build_model(scene);
      CHECK(slip(model, "A") == doctest::Approx(sign * slip(first, "A")).epsilon(1e-12));
    }
  }
}

TEST_CASE("two halves of a contact share a free motion as the whole") {
  const auto part = [](const char* name, double share) {
    return fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\n"
        "normal_stiffness = {}\nfriction = 0.5\ntangential_stiffness = {}\n",
        name, 4e4 * share, 1e4 * share);
  };
  const Model whole = build_model(parse_scene(spreading(false), "whole.toml"));
  const Model split =
      build_model(parse_scene(spreading(false, part("A", 0.25) + part("other", 0.75)), "split.toml"));
  REQUIRE(split.contacts.size() == 3);
  CHECK((whole.u0 - split.u0).cwiseAbs().maxCoeff() < 1e-13 * whole.u0.cwiseAbs().maxCoeff());
}

TEST_CASE("a motion that nothing holds is zero to rounding, not to the digits of a weak support") {
  // A spring along (2, 1); nothing acts across it.
  const std::string text = parts::head +
                           "[run]\nt_end = 0.1\ninitial = \"static\"\n[nodes]\na = [0.0, 0.0]\n[[masses]]\n"
                           "node = \"a\"\nmass = 3.0\n[[springs]]\nnode = \"a\"\ndirection = [2.0, 1.0]\n"
                           "stiffness = 500.0\n[[contacts]]\nname = \"floor\"\nnode = \"a\"\nlaw = "
                           "\"compliant\"\nnormal = [-1.0, 2.0]\nnormal_stiffness = 1e5\ngap = 0.3\n"
                           "[[loads]]\nnode = \"a\"\ndirection = [2.0, 1.0]\namplitude = 5.0\n";
  const Model model = build_model(parse_scene(text, "across.toml"));
  CHECK(model.u0.norm() == doctest::Approx(0.01).epsilon(1e-14));
  CHECK(std::abs(2.0 * model.u0[1] - model.u0[0]) < 1e-16);
}

TEST_CASE("a block beside a frame: forces at rest have their closed form in every order of tables") {
  // The spring to the frame has no force, so the feet carry the weight alone: -sum N = m g, sum T = 0, no moment about the
  // centre, least sum of squares of N_L, T_L, N_R, T_R.
  const Eigen::Vector2d centre(12.54648, 0.5445), l = Eigen::Vector2d(12.0435, -0.566) - centre,
                                                  r = Eigen::Vector2d(13.2885, -0.47) - centre;
  Eigen::Matrix<double, 3, 4> a;
  a << 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, -l[0], l[1], -r[0], r[1];
  const Eigen::Vector4d x =
      a.transpose() * (a * a.transpose()).ldlt().solve(Eigen::Vector3d(-3.6898 * 9.81, 0.0, 0.0));
  for (std::uint64_t seed = 0; seed < 9; ++seed) {
    CAPTURE(seed);
    Scene scene = scene_of("starts/block-beside-frame", {{"run.t_end", "0.01"}, {"run.certify", "false"}});
    if (seed > 0) scene = permuted(scene, seed).scene;
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    REQUIRE(!result.rows.empty());
    const auto& contacts = result.rows.front().contacts;
    CHECK(contacts[named(model, "b2cL")].T == doctest::Approx(x[1]).epsilon(1e-12));
    CHECK(contacts[named(model, "b2cR")].T == doctest::Approx(x[3]).epsilon(1e-12));
  }
}

TEST_CASE("a frictional start has the same forces at every angle") {
  const auto forces = [](const Scene& scene) {
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    REQUIRE(!result.rows.empty());
    std::vector<double> T;
    for (const ContactSample& contact : result.rows.front().contacts) T.push_back(contact.T);
    return T;
  };
  const Scene scene =
      scene_of("starts/sliders-beside-block", {{"run.t_end", "0.01"}, {"run.certify", "false"}});
  const std::vector<double> own = forces(scene);
  const double size = std::abs(*std::max_element(
      own.begin(), own.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (const double degrees : {17.0, 33.0, 90.0, 143.0, 261.0}) {
    CAPTURE(degrees);
    const std::vector<double> other = forces(turned(scene, degrees)->scene);
    for (std::size_t k = 0; k < own.size(); ++k) CHECK(std::abs(other[k] - own[k]) < 1e-12 * size);
  }
}

TEST_CASE("an error of the start shows in the companions, which start from equilibria of their own") {
  for (const char* name : {"starts/block-beside-frame", "starts/sliders-beside-block"}) {
    CAPTURE(std::string(name));
    const Scene scene = scene_of(name);
    Model model = build_model(scene);
    const Vector right = model.u0;
    // Less than what counts as a load that acts from t = 0 on, more than the perturbation of K makes.
    const double error = 1e-10 * right.cwiseAbs().maxCoeff();
    for (int i = 0; i < model.size(); ++i) model.u0[i] += (i % 3 == 0 ? 1.0 : -0.7) * error;
    const Model near = certify::perturbed(model, 1);
    // The springs are stretched as by the equilibrium, not as by the start, up to the perturbation of K.
    const Vector forces = model.stiffness * (near.u0 - right), wrong = model.stiffness * (model.u0 - right);
    CHECK(forces.cwiseAbs().maxCoeff() < 0.1 * wrong.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a start that turns a column far beyond the structure is refused with the mechanism's name") {
  const std::string message = refusal(scene_of("starts/hanging-column"));
  CAPTURE(message);
  CHECK(message.find("the structure is a mechanism") != std::string::npos);
  CHECK(message.find("f1A") != std::string::npos);
}

TEST_CASE("a block may fall farther than it is large: its gap says how far") {
  const std::string text =
      parts::head +
      "gravity = [0.0, -10.0]\n[run]\nt_end = 0.1\ninitial = \"static\"\n[nodes]\na = "
      "[0.0, 0.0]\nb = [0.1, 0.0]\n[[rigid]]\nname = \"B\"\ncentre = [0.05, 0.05]\nnodes "
      "= [\"a\", \"b\"]\nmass = 2.0\ninertia = 0.1\n" +
      "[[contacts]]\nname = \"l\"\nnode = \"a\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\n"
      "gap = 3.0\nfriction = 0.3\n[[contacts]]\nname = \"r\"\nnode = \"b\"\nlaw = "
      "\"rigid\"\nnormal = [0.0, 1.0]\ngap = 3.0\nfriction = 0.3\n";
  const Model model = build_model(parse_scene(text, "fall.toml"));
  CHECK(std::abs(model.contacts[0].gap_at(model.u0)) < 1e-15);
  CHECK(model.statics.reactions[0] == doctest::Approx(10.0));
}

TEST_SUITE_END();

}  // namespace signorini::tests::start_orders
