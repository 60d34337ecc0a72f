// What a frictional start does at the limits of friction: the coefficient of slow slips, and what no friction could hold.
//
//   f(s) = fast + (slow - fast) exp(-s / v): loads that grow slowly slip at a rate of zero, so that |T| = slow |N|
//   a block of weight W on feet at +-b under a moment M stands for |M| < W b, whatever its friction
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>

#include "behaviour/one_mass.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::start_limits {
namespace {

using namespace parts;

struct Axes {
  double c, s;
  explicit Axes(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  [[nodiscard]] std::string at(double along, double across) const {
    return fmt::format("[{:.17g}, {:.17g}]", c * along - s * across, s * along + c * across);
  }
  [[nodiscard]] double along(double ux, double uy) const { return c * ux + s * uy; }
};

std::string load(const Axes& axes, const char* name, const char* node, double along, double across,
                 double size) {
  return fmt::format("[[loads]]\nname = \"{}\"\nnode = \"{}\"\ndirection = {}\namplitude = {}\n", name, node,
                     axes.at(along, across), size);
}

constexpr double k = 100.0, N = 20.0, slow = 0.1, P = 5.0;
constexpr const char* rising = "friction = { slow = 0.1, fast = 0.2, velocity = 0.05 }\n";
constexpr std::array angles{0.0, 0.41, 1.234, 2.75, 4.0};

/// A mass on springs along and across, rubbing on the contact; pressed and pushed.
std::string rubbing(const Axes& axes, const std::string& stages, const std::string& contact) {
  return head + run_table(1.0, 0.5, "frictional") + stages + "[nodes]\nA = [0.0, 0.0]\n" +
         point_mass("A", 2.0) + spring("A", axes.at(1.0, 0.0), k) + contact +
         load(axes, "push", "A", 1.0, 0.0, P);
}

std::string slider(const Axes& axes, const char* more) {
  return spring("A", axes.at(0.0, 1.0), 70.0) +
         fmt::format(
             "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"slider\"\ntangent = {}\nnormal_force = {}\n",
             axes.at(1.0, 0.0), N) +
         rising + more;
}

std::string pad(const Axes& axes) {
  return fmt::format(
             "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = {}\nnormal_stiffness = "
             "3e4\ntangential_stiffness = 1e3\n",
             axes.at(0.0, 1.0)) +
         rising + load(axes, "press", "A", 0.0, -1.0, N);
}

double along(const Model& model, const Axes& axes) { return axes.along(model.u0[0], model.u0[1]); }

constexpr double b = 1.0, weight = 300.0;

/// On two feet half a metre below its centre.
std::string block(const Axes& axes, const std::string& law, const std::string& loads) {
  return head + run_table(0.2, 0.1, "frictional") +
         fmt::format("[nodes]\nL = {}\nR = {}\n", axes.at(-b, -0.5), axes.at(b, -0.5)) +
         "[[rigid]]\nname = \"s\"\ncentre = [0.0, 0.0]\nnodes = [\"L\", \"R\"]\nmass = 30.0\ninertia = "
         "12.0\n[[contacts]]\nname = \"p\"\nnodes = [\"L\", \"R\"]\nnormal = " +
         axes.at(0.0, 1.0) + "\n" + law + load(axes, "weight", "s", 0.0, -1.0, weight) + loads;
}

std::string feet(double friction) {
  return fmt::format(
      "law = \"compliant\"\nnormal_stiffness = 1e5\ntangential_stiffness = 3e4\nfriction = {}\n", friction);
}

std::string moment(double size) { return fmt::format("[[loads]]\nnode = \"s\"\nmoment = {}\n", size); }

std::string refusal(const std::string& text) {
  try {
    (void)build_model(parse_scene(text, "test.toml"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

bool says(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_SUITE_BEGIN("behaviour/frictional_start_limits");

TEST_CASE(
    "slow loads see the slow coefficient of rising friction: u = (P - slow N) / k, and it stays there") {
  const double expected = (P - slow * N) / k;
  for (const double angle : angles) {
    const Axes axes(angle);
    for (const std::string& contact :
         {slider(axes, ""), slider(axes, "tangential_stiffness = 1e3\n"), pad(axes)}) {
      CAPTURE(angle);
      CAPTURE(contact);
      const std::string text = rubbing(axes, "", contact);
      const Model model = build_model(parse_scene(text, "test.toml"));
      CHECK(along(model, axes) == doctest::Approx(expected).epsilon(1e-11));
      const Result rests = run_text(text, "ida");
      CHECK(rests.rows.front().contacts[0].T == doctest::Approx(slow * N).epsilon(1e-9));
      CHECK((rests.rows.back().u - rests.rows.front().u).norm() < 1e-9);
    }
  }
}

TEST_CASE("a pendulum with rising friction begins at u = (P - slow N) / (k + N / R)") {
  for (const double angle : angles) {
    CAPTURE(angle);
    const Axes axes(angle);
    const std::string pendulum =
        spring("A", axes.at(0.0, 1.0), 70.0) +
        fmt::format(
            "[[pendulums]]\nname = \"c\"\nnode = \"A\"\nnormal = {}\nnormal_force = {}\nradius = 0.4\n",
            axes.at(0.0, 1.0), N) +
        rising;
    const Model model = build_model(parse_scene(rubbing(axes, "", pendulum), "test.toml"));
    CHECK(along(model, axes) == doctest::Approx((P - slow * N) / (k + N / 0.4)).epsilon(1e-11));
  }
}

TEST_CASE("rising friction that sticks again when its load goes back: the spring of the contact takes part") {
  const Axes axes(0.77);
  const std::string stages =
      "[[run.stages]]\nname = \"forth\"\nloads = [\"push\"]\n[[run.stages]]\nname = \"back\"\nloads = "
      "[\"pull\"]\n";
  const Model model =
      build_model(parse_scene(rubbing(axes, stages, slider(axes, "tangential_stiffness = 1e3\n")) +
                                  load(axes, "pull", "A", -1.0, 0.0, 1.1),
                              "test.toml"));
  CHECK(along(model, axes) == doctest::Approx((P - slow * N) / k - 1.1 / (k + 1e3)).epsilon(1e-11));
  CHECK(model.contacts[0].initial_shear == doctest::Approx(slow * N - 1e3 * 1.1 / (k + 1e3)).epsilon(1e-11));
}

TEST_CASE("a block that its loads overturn or lift is said to be, whatever its friction") {
  for (const double angle : angles)
    for (const double friction : {5.0, 0.05}) {
      CAPTURE(angle);
      CAPTURE(friction);
      const Axes axes(angle);
      for (const double over : {330.0, -301.0}) {
        const std::string said = refusal(block(axes, feet(friction), moment(over)));
        CHECK(
            says(said, over > 0.0 ? "contact 'p-R' would have to pull" : "contact 'p-L' would have to pull"));
        CHECK(says(said, "overturn"));
        CHECK(!says(said, "too small"));
      }
      const std::string lifted =
          refusal(block(axes, feet(friction), load(axes, "lift", "s", 0.0, 1.0, 400.0)));
      CHECK(says(lifted, "contacts 'p-L' and 'p-R' would have to pull"));
      CHECK(refusal(block(axes, feet(friction), moment(299.0))) == "none");
    }
}

TEST_CASE("a block that slides away has too little friction") {
  for (const double angle : angles) {
    CAPTURE(angle);
    const Axes axes(angle);
    const std::string push = load(axes, "push", "s", 1.0, 0.0, 20.0);
    CHECK(says(refusal(block(axes, feet(0.05), push)), "the friction there is too small for the load"));
    CHECK(refusal(block(axes, feet(0.1), push)) == "none");
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::start_limits
