// Static starts of meshes without support: the message names the motion at every size.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <string>

#include "signorini/error.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::tests::mechanism_check {
namespace {

std::string body(const char* name, double x, int nx, int ny) {
  return fmt::format(
      "[[bodies]]\nname = \"{}\"\nrectangle = {{ from = [{}, 0.0], size = [3.0, 2.0] }}\nelements = [{}, "
      "{}]\nE = 2e9\n"
      "nu = 0.3\ndensity = 2000.0\nplane = \"stress\"\n",
      name, x, nx, ny);
}

std::string refusal(const std::string& more) {
  const std::string head =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "run = { t_end = 0.001, initial = \"static\" }\n";
  try {
    (void)build_model(parse_scene(head + more, "test.toml"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE_BEGIN("unit/model/statics/mechanism_check");

TEST_CASE("a plane mesh without support is a mechanism at 1,700 and at 22,000 unknowns") {
  const std::string named =
      "the structure is a mechanism: nothing restrains the horizontal motion, vertical motion, rotation "
      "about (2.5, 1);";
  for (const int n : {28, 104}) {
    CAPTURE(n);
    const std::string message = refusal(body("b", 1.0, n, n));
    CAPTURE(message);
    CHECK(has(message, named));
  }
}

TEST_CASE("a plane mesh on a hinge turns about it, at every size") {
  for (const int n : {28, 104}) {
    CAPTURE(n);
    const std::string message = refusal(
        body("b", 1.0, n, n) +
        "[bodies.points]\nfoot = [1.0, 0.0]\n[[supports]]\nnode = \"foot\"\nfix = [\"ux\", \"uy\"]\n");
    CAPTURE(message);
    CHECK(has(message, "nothing restrains the rotation about (1, 0);"));
  }
}

TEST_CASE("a free body beside a supported one is named, at every size") {
  for (const int n : {12, 104}) {
    CAPTURE(n);
    const std::string message = refusal(body("held", 0.0, 4, 4) + body("free", 9.0, n, n) +
                                        "[[supports]]\nnodes = [\"held.bottom\"]\nfix = [\"ux\", \"uy\"]\n");
    CAPTURE(message);
    CHECK(has(message,
              "nothing restrains the horizontal motion of the part with node 'free.1', "
              "vertical motion of the part with node 'free.1', "
              "rotation about (10.5, 1) of the part with node 'free.1';"));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::mechanism_check
