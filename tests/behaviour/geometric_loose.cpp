// run.geometric beside a rotation that no element feels (a node with inertia at a hinged end): forces of statics.
//
//   a strut A-C under a weight W at C, which a spring along s carries, too:  N a + S s = W    (a, s: unit vectors)
//   a beam on two feet under P at both ends along it:                        N = -P
//
// Contacts are there, open or closed, and none of them may hold such a rotation: no contact feels it.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "behaviour/scene_parts.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::tests::geometric_loose {
namespace {

using namespace parts;

struct Axes {
  double c, s;
  explicit Axes(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  [[nodiscard]] std::string at(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  }
};

/// With P-delta; the start is given.
std::string begun() {
  return head +
         "[run]\nt_end = 1.0\noutput_dt = 0.5\nengine = \"exact\"\ngeometric = true\n"
         "initial = { C = { wz = 0.1 } }\n";
}

std::string pushed(const Axes& axes, const char* node, double x, double y, double size) {
  return fmt::format("[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = {:.17g}\n", node, axes.at(x, y),
                     size);
}

std::string foot(const Axes& axes, const char* name, const char* node, double x, double y, const char* law) {
  return fmt::format("[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nnormal = {}\n{}", name, node, axes.at(x, y),
                     law);
}

constexpr const char* far_off = "law = \"rigid\"\ngap = 1.0\n";
constexpr const char* hard = "law = \"rigid\"\nfriction = 0.3\n";
constexpr const char* springy =
    "law = \"compliant\"\nnormal_stiffness = 3e4\nfriction = 0.3\ntangential_stiffness = 2e4\n";

/// Of each element, the mean; tension is positive.
std::vector<double> axial(const std::string& text) {
  const Model model = build_model(parse_scene(text, "test.toml"));
  REQUIRE(model.geometric);
  std::vector<double> forces;
  for (const Prestress::Element& e : model.geometric->forces.elements)
    forces.push_back(0.5 * (e.at_from + e.at_to));
  return forces;
}

constexpr double W = 7.0, P = 11.0;
constexpr std::array angles{0.0, 0.3, 0.7213, 1.9, 2.4190, 4.1, -0.6435};

/// Pinned at A in the origin; hinged at C, whose rotation has inertia and nothing else.
std::string strut(const Axes& axes, int elements, const std::string& contact) {
  return begun() + fmt::format("[nodes]\nA = [0.0, 0.0]\nC = {}\n", axes.at(2.0, 1.5)) +
         section(1e6, 1e3, 1e-9) +
         member("A, C", fmt::format("release = [\"C\"]\nelements = {}\n", elements)) +
         point_mass("C", 0.5, 0.1) + fixed("A", "ux, uy") +
         spring("C", axes.at(-5.0 / 13.0, 12.0 / 13.0), 4e4) + pushed(axes, "C", 0.0, -1.0, W) + contact;
}

/// On feet at B and C, which nothing holds along it but their friction; hinged at both ends, `elements` between.
std::string on_feet(const Axes& axes, const char* law, int elements, const std::string& more = "") {
  return begun() + fmt::format("[nodes]\nB = {}\nC = {}\n", axes.at(0.4, -0.3), axes.at(3.4, -0.3)) +
         section(1e5, 1e3, 1e-3) +
         member("B, C", fmt::format("release = [\"B\", \"C\"]\nelements = {}\n", elements)) +
         point_mass("B", 0.5, 0.1) + point_mass("C", 0.7, 0.2) + pushed(axes, "B", 0.0, -1.0, W) +
         pushed(axes, "C", 0.0, -1.0, W) + pushed(axes, "B", 1.0, 0.0, P) + pushed(axes, "C", -1.0, 0.0, P) +
         foot(axes, "b", "B", 0.0, 1.0, law) + foot(axes, "c", "C", 0.0, 1.0, law) + more;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/geometric_loose");

TEST_CASE("a strut that a spring props: its force is that of statics, with a contact far off and without") {
  // N (0.8, 0.6) + S (-5, 12) / 13 = (0, -W)
  const double N = -5.0 * W / (0.8 * 12.0 + 0.6 * 5.0);
  for (const double angle : angles)
    for (const int elements : {1, 2, 4}) {
      const Axes axes(angle);
      for (const std::string& contact : {std::string(), foot(axes, "n", "C", 0.6, 0.8, far_off),
                                         foot(axes, "n", "C", 0.28, -0.96, far_off)}) {
        CAPTURE(angle);
        CAPTURE(elements);
        CAPTURE(contact);
        for (const double found : axial(strut(axes, elements, contact)))
          CHECK(found == doctest::Approx(N).epsilon(1e-8));
      }
    }
}

TEST_CASE("a beam hinged at both ends on feet, which hold it by friction alone, under loads along it") {
  for (const double angle : angles)
    for (const int elements : {1, 4})
      for (const char* law : {springy, hard}) {
        CAPTURE(angle);
        CAPTURE(elements);
        CAPTURE(std::string(law));
        const std::vector<double> forces = axial(on_feet(Axes(angle), law, elements));
        REQUIRE(forces.size() == static_cast<std::size_t>(elements));
        for (const double N : forces) CHECK(N == doctest::Approx(-P).epsilon(1e-9));
      }
}

TEST_CASE("the same where a rotational spring joins the two that are loose: together they are") {
  const std::string joined = "[[springs]]\nnode = \"B\"\nagainst = \"C\"\nrotation_stiffness = 40.0\n";
  for (const double angle : angles) {
    CAPTURE(angle);
    for (const double N : axial(on_feet(Axes(angle), springy, 3, joined)))
      CHECK(N == doctest::Approx(-P).epsilon(1e-9));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::geometric_loose
