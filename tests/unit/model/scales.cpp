#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/scene_parts.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

TEST_SUITE("unit/model/scales") {
  TEST_CASE("scales do not depend on where the structure stands") {
    Scene s = beam(8.0, 4, 9e6, 2e6, 0.4);
    s.nodes[1].y = 3.0;
    s.gravity = {0.0, -9.81};
    s.initial.is_static = true;
    s.contacts = {support_contact("left", "L", 1e5), support_contact("right", "R", 3e5)};
    const Scales here = build_model(s).scales;
    for (Node& node : s.nodes) {
      node.x += 1024.0;
      node.y -= 512.0;
    }
    const Scales there = build_model(s).scales;
    CHECK(there.rotation == doctest::Approx(here.rotation));
    CHECK(there.angular_velocity == doctest::Approx(here.angular_velocity));
    CHECK(there.displacement == doctest::Approx(here.displacement));
  }

  /// A mass of 4 on a spring of 100: w = 5.
  Scales under(const std::string& history, const std::string& amplitude = "10.0",
               const std::string& run = "") {
    return build_model(
               parse_scene(tests::parts::head + "[run]\nt_end = 1.0\n" + run +
                               tests::parts::nodes({{"A", 0, 0}}) + tests::parts::point_mass("A", 4.0) +
                               tests::parts::fixed("A", "uy, rz") +
                               tests::parts::spring("A", "[1.0, 0.0]", 100.0) +
                               "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = " + amplitude +
                               "\nhistory = " + history + "\n",
                           "test.toml"))
        .scales;
  }

  TEST_CASE("a body that can only turn counts with its inertia over the length of the structure squared") {
    for (const double angle : {0.0, 0.7}) {
      CAPTURE(angle);
      const double c = std::cos(angle), s = std::sin(angle);
      const Scales scales =
          build_model(parse_scene(tests::parts::head + "[run]\nt_end = 100.0\n" +
                                      tests::parts::nodes({{"A", 0, 0}, {"B", 2 * c, 2 * s}, {"P", c, s}}) +
                                      fmt::format("[[rigid]]\nname = \"body\"\nnodes = [\"B\"]\n"
                                                  "centre = \"A\"\nmass = 5.0\ninertia = 12.0\n") +
                                      tests::parts::point_mass("P", 0.01) +
                                      tests::parts::fixed("A", "ux, uy") +
                                      tests::parts::fixed("P", "uy, rz") +
                                      tests::parts::spring("B", fmt::format("[{}, {}]", -s, c), 100.0) +
                                      tests::parts::spring("P", "[1.0, 0.0]", 1.0) +
                                      "[[loads]]\nnode = \"P\"\ndirection = [1.0, 0.0]\namplitude = 10.0\n",
                                  "test.toml"))
              .scales;
      CHECK(scales.displacement == doctest::Approx(10.0).epsilon(1e-12));
      // The energy 10 kN 10 m in the greatest mass, 12 / 2^2; omega1 u would be 58 m/s.
      CHECK(scales.velocity == doctest::Approx(std::sqrt(10.0 * 10.0 / 3.0)).epsilon(1e-12));
    }
  }

  TEST_CASE("a load that lasts counts with its amplitude, whatever its history") {
    for (const char* history :
         {"{ type = \"constant\" }", "{ type = \"step\", start = 0.9999 }",
          "{ type = \"rectangle\", start = 0.5, end = 0.55 }", "{ type = \"half_sine\", duration = 0.05 }",
          "{ type = \"harmonic\", omega = 300.0, start = 0.1 }",
          "{ type = \"rectangle\", start = 0.0, end = 0.003, period = 0.02 }",
          "{ type = \"table\", times = [0.0, 0.02, 0.04, 0.06], values = [0.0, 1.0, -1.0, 0.0] }"}) {
      CAPTURE(history);
      const Scales s = under(history);
      CHECK(s.displacement == doctest::Approx(0.1).epsilon(1e-13));
      CHECK(s.force == doctest::Approx(10.0).epsilon(1e-13));
    }
  }

  TEST_CASE("of a load on several degrees of freedom the greatest part counts, whichever way it acts") {
    for (const std::string direction :
         {"{ d0 = 1.0, d1 = -3.0 }", "{ d0 = -1.0, d1 = 3.0 }", "{ d0 = -3.0, d1 = -1.0 }"}) {
      CAPTURE(direction);
      const Scene s = parse_scene(
          "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end "
          "= 1.0\n"
          "[matrices]\nmass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[40.0, 0.0], [0.0, 40.0]]\n"
          "[[loads]]\ndirection = " +
              direction + "\namplitude = 10.0\n",
          "test.toml");
      CHECK(build_model(s).scales.force == doctest::Approx(30.0).epsilon(1e-13));
    }
  }

  TEST_CASE("a compression that is short counts with its impulse, too") {
    const auto force = [](double duration, double amplitude) {
      return build_model(
                 parse_scene(
                     tests::parts::head + tests::parts::run_table(1.0, 0.1) +
                         tests::parts::nodes({{"A", 0, 0}}) + tests::parts::point_mass("A", 4.0) +
                         tests::parts::fixed("A", "uy, rz") + tests::parts::spring("A", "[1.0, 0.0]", 100.0) +
                         fmt::format(
                             "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"slider\"\ntangent = "
                             "[1.0, 0.0]\nfriction = 0.2\nnormal_force = {{ type = \"rectangle\", start = "
                             "0.5, end = {}, amplitude = {} }}\n",
                             0.5 + duration, amplitude),
                     "test.toml"))
          .scales.force;
    };
    CHECK(force(0.25, 3.0) == doctest::Approx(3.0).epsilon(1e-13));
    CHECK(force(1e-9, 1e9) == doctest::Approx(80.0).epsilon(1e-6));  // 16 w J, w = 5
  }

  TEST_CASE("what the run sees nothing of the swing of is free: a thousandth of the run counts in full") {
    const auto of = [](double duration) {
      return build_model(
                 parse_scene(
                     tests::parts::head + tests::parts::run_table(3.0, 0.1) +
                         tests::parts::nodes({{"A", 0, 0}}) + tests::parts::point_mass("A", 4.0) +
                         tests::parts::fixed("A", "uy, rz") + tests::parts::spring("A", "[1.0, 0.0]", 4e-6) +
                         fmt::format("[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = 30.0\n"
                                     "history = {{ type = \"half_sine\", start = 0.5, duration = {} }}\n",
                                     duration),
                     "test.toml"))
          .scales;
    };
    CHECK(of(0.1).force == doctest::Approx(30.0).epsilon(1e-13));
    CHECK(of(0.003).force == doctest::Approx(30.0).epsilon(1e-13));
    // 16 w J = 16 (64 / 3) (30 1e-6)
    CHECK(of(1e-6).force == doctest::Approx(0.01024).epsilon(1e-9));
    // thrown by 16 J / t_end for t_end: 8 J t_end / m
    CHECK(of(1e-6).displacement == doctest::Approx(8.0 * 30e-6 * 3.0 / 4.0).epsilon(1e-9));
  }

  TEST_CASE("a short pulse counts with 16 times the swing that its impulse leaves, however strong it is") {
    // J / (m w) = 0.05, m w = 20
    for (const double duration : {1e-3, 1e-6, 1e-9, 1e-13}) {
      CAPTURE(duration);
      const Scales s = under(fmt::format("{{ type = \"rectangle\", start = 0.0, end = {} }}", duration),
                             fmt::format("{}", 1.0 / duration));
      CHECK(s.displacement == doctest::Approx(0.8).epsilon(1e-9));
      CHECK(s.velocity == doctest::Approx(4.0).epsilon(1e-9));
      CHECK(s.force == doctest::Approx(80.0).epsilon(1e-9));
    }
    const auto twice = under("{ type = \"rectangle\", start = 0.0, end = 1e-6, period = 1e-3 }", "1e6");
    CHECK(twice.displacement > 50.0);  // 200 of them in the time of 1/w
    const auto alone = under("{ type = \"rectangle\", start = 0.0, end = 1e-6, period = 0.5 }", "1e6");
    CHECK(alone.displacement == doctest::Approx(0.8).epsilon(1e-6));
  }
}
