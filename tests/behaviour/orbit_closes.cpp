// An orbit is a motion that closes: the run of its period, by either engine, ends where it begins, shears included.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Two masses on damped springs; the second has two sliders on springs, one of them on a belt. One of them sticks at the
/// section and slips 0.0012 of a period later, so that a guess may begin with it slipping. Turned by `degrees`.
std::string two_sliders(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  const std::string along = fmt::format("[{:.17g}, {:.17g}]", c, s);
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 100, engine = "exact" }}
nodes = {{ A = [0.0, 0.0], B = {0} }}
masses = [{{ node = "A", mass = 1.9553075943614044 }}, {{ node = "B", mass = 1.6914724083585488 }}]
loads = [{{ node = "A", direction = {0}, amplitude = 1.0978664884941947, history = {{ type = "harmonic", omega = 2.132, phase = 0.51622304317151 }} }}]
springs = [
  {{ node = "A", direction = {0}, stiffness = 0.7134861866989735, damping = 0.051910989667215204 }},
  {{ node = "A", against = "B", direction = {0}, stiffness = 3.0696982202087946, damping = 0.18786996006797133 }},
  {{ node = "B", direction = {0}, stiffness = 1.6937181325015782, damping = 0.11731709799393458 }},
  {{ node = "A", direction = {1}, stiffness = 3.0, damping = 0.2 }},
  {{ node = "B", direction = {1}, stiffness = 5.0, damping = 0.3 }},
]
[[contacts]]
name = "c0"
node = "B"
law = "slider"
tangent = {0}
normal_force = 0.30507901929540415
friction = 0.3814025790936459
surface_velocity = 0.2
tangential_stiffness = 17.511197580264255
[[contacts]]
name = "c1"
node = "B"
law = "slider"
tangent = {0}
normal_force = 0.587669792327405
friction = 0.12928485827831115
surface_velocity = 0.0
tangential_stiffness = 10.55659343797134
)",
                     along, fmt::format("[{:.17g}, {:.17g}]", -s, c));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit closes");

TEST_CASE(
    "a contact that sticks at the section and slips just after it: the run of a period closes, its shear "
    "too") {
  for (const double degrees : {0.0, 29.0}) {
    CAPTURE(degrees);
    const std::string text = two_sliders(degrees);
    const Orbit orbit = find_orbit(reader_of_text(text));
    REQUIRE(orbit.found);
    CHECK(orbit.sequence.size() == 8);
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(engine);
      Scene scene = orbit_scene(reader_of_text(text), orbit);
      scene.run.engine = std::string(engine) == "ida" ? Engine::ida : Engine::exact;
      scene.run.rtol = 1e-11;
      const Result run = simulate(scene);
      const Result::Row &first = run.rows.front(), &last = run.rows.back();
      const double part = std::string(engine) == "exact" ? 1e-13 : 1e-8;
      CHECK((last.u - first.u).lpNorm<Eigen::Infinity>() < part * orbit.amplitude);
      CHECK((last.v - first.v).lpNorm<Eigen::Infinity>() < 10.0 * part * orbit.amplitude);
      for (std::size_t c = 0; c < first.contacts.size(); ++c) {
        CHECK(std::abs(last.contacts[c].T - first.contacts[c].T) < 10.0 * part);
        CHECK(last.contacts[c].state == first.contacts[c].state);
      }
    }
    CHECK(std::abs(orbit.cycle.contact) < 1e-13);
  }
}

TEST_SUITE_END();
