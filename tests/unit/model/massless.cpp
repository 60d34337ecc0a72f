// What holds a motion without mass, and what is said where nothing does.
#include "model/massless.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

std::string refusal_of_matrices(const std::string& stiffness, const std::string& damping) {
  const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 1.0
[matrices]
mass = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
damping = {}
stiffness = {}
[[contacts]]
name = "c"
law = "compliant"
normal = {{ d0 = 1.0 }}
normal_stiffness = 1e3
gap = 0.1
)",
                                       damping, stiffness);
  try {
    static_cast<void>(build_model(parse_scene(text, "test.toml")));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

const char* const no_damping = "[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]";

}  // namespace

TEST_SUITE_BEGIN("unit/model/massless");

TEST_CASE("a negative stiffness without mass is unstable, not free") {
  const std::string said =
      refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, -50.0, 0.0], [0.0, 0.0, 7.0]]", no_damping);
  CHECK(said.find("test.toml:8") == 0);
  CHECK(said.find("matrices.stiffness: the motion of d1.u is unstable") != std::string::npos);
  CHECK(said.find("its stiffness, including contacts, is -50") != std::string::npos);
  CHECK(said.find("is undetermined") == std::string::npos);
  // x1 = x2 gives 2 k - 2 * 60 < 0, though both diagonals are positive.
  CHECK(refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, 50.0, -60.0], [0.0, -60.0, 50.0]]", no_damping)
            .find("unstable") != std::string::npos);
}

TEST_CASE("no stiffness at all is free") {
  CHECK(refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, 50.0, -50.0], [0.0, -50.0, 50.0]]", no_damping)
            .find(" is undetermined: ") != std::string::npos);
  CHECK(
      refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, 50.0, -10.0], [0.0, -10.0, 50.0]]", no_damping).empty());
}

TEST_CASE("a damper decides a motion that its spring drives away") {
  // c u' = 50 u: it grows, and is known.
  CHECK(refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, -50.0, 0.0], [0.0, 0.0, 7.0]]",
                            "[[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]")
            .empty());
  CHECK(refusal_of_matrices("[[100.0, 0.0, 0.0], [0.0, -50.0, 0.0], [0.0, 0.0, 50.0]]",
                            "[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]")
            .empty());
}

TEST_SUITE_END();
