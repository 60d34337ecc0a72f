#include "engine/exact/modal/unconstrained_modes.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/one_mass.hpp"

namespace signorini::tests::open_bases {
namespace {

Model two_masses(const std::string& applied, const std::string& surface, const std::string& load) {
  return build_model(parse_scene(
      matrix_scene("t_end = 1.0",
                   "mass = [[2.0, 0.5], [0.5, 1.0]]\nstiffness = [[30.0, -10.0], [-10.0, 20.0]]",
                   fmt::format("law = \"slider\"\ntangent = {{ d0 = 0.3, d1 = -2.0 }}\nfriction = 0.3\n"
                               "normal_force = {}\nsurface_velocity = {}",
                               applied, surface),
                   fmt::format("[[loads]]\ndirection = {{ d1 = 1.0 }}\namplitude = 3.0\n{}", load)),
      "test.toml"));
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/unconstrained_basis");

TEST_CASE(
    "forcing stands still where loads, compressions and surfaces all do; jumps between constants are no "
    "motion") {
  const std::string shakes = "{ type = \"harmonic\", amplitude = 0.5, omega = 3.0 }",
                    steps = "history = { type = \"step\", start = 0.3 }",
                    ramp = "history = { type = \"triangle\", start = 0.0, end = 0.6 }";
  CHECK(modal::has_constant_excitation(two_masses("2.0", "0.0", "")));
  CHECK(modal::has_constant_excitation(two_masses("2.0", "0.0", steps)));
  CHECK_FALSE(modal::has_constant_excitation(two_masses("2.0", "0.0", ramp)));
  CHECK_FALSE(modal::has_constant_excitation(two_masses("2.0", "0.4", "")));
  CHECK_FALSE(modal::has_constant_excitation(two_masses("2.0", shakes, "")));
  CHECK_FALSE(modal::has_constant_excitation(
      two_masses("{ type = \"harmonic\", offset = 2.0, amplitude = 0.5, omega = 3.0 }", "0.0", "")));
}

TEST_CASE("amplitudes of open modes: frequencies of the pencil, and the way there and back") {
  const Model model = two_masses("2.0", "0.0", "");
  const modal::UnconstrainedBasis basis(model);
  REQUIRE(basis.failure().empty());
  // det (K - l M) = (30 - 2 l)(20 - l) - (10 + l / 2)^2 = 1.75 l^2 - 80 l + 500
  const double root = std::sqrt(80.0 * 80.0 - 4.0 * 1.75 * 500.0);
  CHECK(basis.omega_squared()[0] == doctest::Approx((80.0 - root) / 3.5).epsilon(1e-13));
  CHECK(basis.omega_squared()[1] == doctest::Approx((80.0 + root) / 3.5).epsilon(1e-13));
  Vector u(2);
  u << 0.7, -1.9;
  const Vector q = basis.amplitudes(u);
  CHECK((basis.shapes() * q - u).norm() < 1e-14);
  CHECK(q.squaredNorm() == doctest::Approx(u.dot(model.mass * u)).epsilon(1e-13));
  // A form's amplitudes are what the modes show of it.
  CHECK(basis.amplitudes_of(model.contacts[0].tangent).dot(q) ==
        doctest::Approx(0.3 * 0.7 + 2.0 * 1.9).epsilon(1e-13));
  CHECK(modal::is_symmetric(model.stiffness));
  SparseMatrix skew = model.stiffness;
  skew.coeffRef(0, 1) += 1e-6;
  CHECK_FALSE(modal::is_symmetric(skew));
}

TEST_SUITE_END();

}  // namespace signorini::tests::open_bases
