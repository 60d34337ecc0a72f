// Ritz vectors against what they stand for: static answers of all modes left out, and all modes themselves.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>

#include "model/build.hpp"
#include "model/statics/mechanisms.hpp"
#include "signorini/scene.hpp"
#include "study/reduction/excited_modes.hpp"

using namespace signorini;

namespace {

/// A beam of twelve elements at an odd angle on two contacts, pushed at its end.
const char* const beam = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
[run]
t_end = 1.0
[nodes]
A = [0.0, 0.0]
B = [3.1, 1.7]
C = [6.4, 2.9]
[sections.s]
EA = 9000.0
EI = 70.0
mass_per_length = 0.11
[[members]]
nodes = ["A", "B", "C"]
section = "s"
elements = 6
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[contacts]]
name = "foot"
node = "B"
law = "compliant"
normal = [0.3, 1.0]
normal_stiffness = 500.0
tangential_stiffness = 200.0
friction = 0.3
[[loads]]
node = "C"
direction = [1.0, -2.0]
amplitude = 1.0
history = { type = "rectangle", start = 0.1, end = 0.2 }
)";

}  // namespace

TEST_SUITE_BEGIN("unit/study/reduction/excited_modes");

TEST_CASE(
    "static answers to contacts and loads are those of all modes left out, and so is the first term after "
    "them") {
  const Model model = build_model(parse_scene(beam, "beam.toml"));
  const Eigen::MatrixXd none = statics::null_motions(model.stiffness);
  const reduce::KeptModes all =
      reduce::modes_up_to(std::numeric_limits<double>::max(), model.mass, model.stiffness, none);
  for (const Eigen::Index kept : {2, 5, 9}) {
    CAPTURE(kept);
    const double cutoff = std::sqrt(0.5 * (all.squares[kept - 1] + all.squares[kept]));
    const reduce::KeptModes low = reduce::modes_up_to(cutoff, model.mass, model.stiffness, none);
    REQUIRE(low.squares.size() == kept);
    const reduction::ExcitedModes others = reduction::excited_modes(model, low);
    const auto left = all.squares.size() - kept;
    REQUIRE(others.squares.size() > 0);
    REQUIRE(others.squares.size() <= left);
    for (const Combination* form : {&model.contacts[0].normal, &model.contacts[0].tangent}) {
      const Vector f = assembly::dense_vector(*form, model.size());
      for (const double power : {1.0, 2.0}) {  // sum of psi psi.f / omega^(2 power)
        const auto answer = [&](const Eigen::MatrixXd& shapes, const Eigen::VectorXd& squares) {
          return Vector(shapes * squares.array().pow(-power).matrix().cwiseProduct(shapes.transpose() * f));
        };
        const Vector expected = answer(all.shapes.rightCols(left), all.squares.tail(left));
        CHECK((answer(others.shapes, others.squares) - expected).norm() <= 1e-8 * expected.norm());
      }
    }
    CHECK(others.squares[0] == doctest::Approx(all.squares[kept]).epsilon(1e-3));
    CHECK((low.shapes.transpose() * (model.mass * others.shapes)).cwiseAbs().maxCoeff() < 1e-8);
  }
}

TEST_SUITE_END();
