#include "model/massless.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "signorini/model.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/model/undamped");

// A damper across d0 - 3 d1 leaves the motion (3, 1) alone. Of it 0.1 d0 - 0.3 d1 sees 1e-17, which is rounding.
TEST_CASE("undamped: what cancels in the motion that no damper sees is no part of a contact or a load") {
  const Model model = build_model(parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
[matrices]
mass = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]]
damping = [[1.0, -3.0, 0.0], [-3.0, 9.0, 0.0], [0.0, 0.0, 0.0]]
stiffness = [[20.0, 0.0, -1.0], [0.0, 30.0, 0.0], [-1.0, 0.0, 10.0]]
[[contacts]]
name = "c"
law = "compliant"
normal = { d0 = 0.1, d1 = -0.3 }
tangent = { d0 = 1.0, d1 = 0.5 }
normal_stiffness = 1e3
tangential_stiffness = 1e3
friction = 0.4
[[loads]]
direction = { d0 = -0.1, d1 = 0.3 }
amplitude = 3.0
)",
                                              "undamped.toml"));
  REQUIRE(model.contacts.size() == 1);
  const auto parts = [](const Combination& form) { return form.terms.size(); };
  CHECK(parts(model.contacts[0].normal) == 1);
  CHECK(parts(model.loads[0].direction) == 1);
  CHECK(parts(model.contacts[0].tangent) == 2);
  // B^T K B is K in the other base: the same energy of the same motion.
  REQUIRE(model.basis);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(3), motion = *model.basis * ones;
  CHECK(ones.dot(model.stiffness * ones) ==
        doctest::Approx(20.0 * motion[0] * motion[0] + 30.0 * motion[1] * motion[1] +
                        10.0 * motion[2] * motion[2] - 2.0 * motion[0] * motion[2]));
}

TEST_SUITE_END();
