#include <doctest/doctest.h>

#include <cmath>

#include "model/modes/frequencies.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

modes::Frequencies stuck(const Model& model, int count) {
  const std::vector<bool> all(model.contacts.size(), true);
  return modes::lowest_frequencies(model.mass, model.damping, model.stiffness,
                                   modes::constrain_contacts(model.contacts, all), count);
}

modes::Frequencies closed(const Model& model, int count) {
  return modes::lowest_frequencies(model.mass, model.damping, model.stiffness,
                                   modes::constrain_normals(model.contacts), count);
}

modes::Frequencies open(const Model& model, int count) {
  return modes::lowest_frequencies(model.mass, model.damping, model.stiffness, {}, count);
}

/// One mass of 2 on springs along x and y: 8 and nothing; a floor of kn = 50, kt = 24.
Model block() {
  Scene s = empty_scene();
  s.nodes = {{"a", 0.0, 0.0, {}}};
  s.masses = {{"a", 2.0, 0.0, {}}};
  Spring spring;
  spring.node = "a";
  spring.stiffness = 8.0;
  spring.damping = 0.4;
  s.springs = {spring};
  s.contacts = {support_contact("floor", "a", 50.0)};
  s.contacts[0].tangential_stiffness = 24.0;
  return build_model(s);
}

}  // namespace

TEST_SUITE("unit/study/check/check_frequencies") {
  TEST_CASE("an oscillator: contact open, closed, stuck") {
    const Model model = block();
    const modes::Frequencies a = open(model, 5), b = closed(model, 5), c = stuck(model, 5);
    CHECK(a.free_motions == 1);
    REQUIRE(a.modes.size() == 1);
    CHECK(a.modes[0].omega == doctest::Approx(2.0).epsilon(1e-14));
    CHECK(a.modes[0].damping_ratio == doctest::Approx(0.4 / (2.0 * 2.0 * 2.0)));
    CHECK(b.free_motions == 0);
    REQUIRE(b.modes.size() == 2);
    CHECK(b.modes[0].omega == doctest::Approx(2.0).epsilon(1e-14));
    CHECK(b.modes[1].omega == doctest::Approx(5.0).epsilon(1e-14));
    CHECK(b.modes[1].damping_ratio == 0.0);
    REQUIRE(c.modes.size() == 2);
    CHECK(c.modes[0].omega == doctest::Approx(4.0).epsilon(1e-14));
    CHECK(c.modes[0].damping_ratio == doctest::Approx(0.4 / (2.0 * 4.0 * 2.0)));
    CHECK(stuck(model, 1).modes.size() == 1);
  }

  TEST_CASE("Rayleigh damping: zeta = alpha / (2 omega) + beta omega / 2") {
    Scene s = beam(4.0, 6, 1e5, 1e3, 0.3);
    s.supports = {support("L", true, true, true)};
    s.damping.alpha = 0.7;
    s.damping.beta = 2e-4;
    const modes::Frequencies f = open(build_model(s), 5);
    REQUIRE(f.modes.size() == 5);
    for (const modes::NaturalMode& mode : f.modes)
      CHECK(mode.damping_ratio == doctest::Approx(0.35 / mode.omega + 1e-4 * mode.omega));
    // First bending mode of a cantilever: (1.875104 / L)^2 sqrt(EI / m)
    CHECK(f.modes[0].omega ==
          doctest::Approx(std::pow(1.875104 / 4.0, 2) * std::sqrt(1e3 / 0.3)).epsilon(1e-4));
  }

  TEST_CASE("a free beam: three free motions, and bending and axial modes above them, small and large") {
    // cos x cosh x = 1: x = 4.730041, 7.853205; axial: pi sqrt(EA / m) / L
    for (const int elements : {20, 90}) {
      CAPTURE(elements);
      Scene s = beam(4.0, elements, 1e5, 1e3, 0.3);
      const modes::Frequencies f = open(build_model(s), 3);
      CHECK(f.free_motions == 3);
      REQUIRE(f.modes.size() == 3);
      const double bending = std::sqrt(1e3 / 0.3) / 16.0, axial = M_PI * std::sqrt(1e5 / 0.3) / 4.0;
      CHECK(f.modes[0].omega == doctest::Approx(4.730041 * 4.730041 * bending).epsilon(1e-5));
      CHECK(f.modes[1].omega == doctest::Approx(7.853205 * 7.853205 * bending).epsilon(1e-4));
      CHECK(f.modes[2].omega ==
            doctest::Approx(std::min(10.995608 * 10.995608 * bending, axial)).epsilon(2e-3));
    }
  }

  TEST_CASE("the lowest with contacts stuck is omega1 of a structure that is closed, small and large") {
    for (const int elements : {4, 40}) {
      CAPTURE(elements);
      Scene s = pipeline();
      s.members[0].elements = {elements, 3 * elements};
      const Model model = build_model(s);
      CHECK(stuck(model, 5).modes.at(0).omega == doctest::Approx(model.omega1).epsilon(1e-8));
      CHECK(stuck(model, 5).modes.size() == 5);
      CHECK(stuck(model, 5).free_motions == 0);
      CHECK(closed(model, 5).free_motions == 1);
      CHECK(open(model, 5).free_motions == 3);
      CHECK(stuck(model, 1).modes[0].damping_ratio == doctest::Approx(0.1).epsilon(1e-6));
    }
  }

  TEST_CASE("massless degrees of freedom are condensed, those that nothing holds are no modes") {
    // d1 has no mass and hangs on d0; d2 has neither mass nor any hold but the open contact.
    Scene s = matrices({{2, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                       {{18, -6, 0}, {-6, 6, 0}, {0, 0, 0}});
    Model model;
    model.dofs.resize(3);
    s.matrices->stiffness = rows({{18, -6, 0}, {-6, 6, 0}, {0, 0, 1}});
    model = build_model(s);
    SparseMatrix k = model.stiffness;
    k.coeffRef(2, 2) = 0.0;
    k.prune(0.0);
    const modes::Frequencies f = modes::lowest_frequencies(model.mass, model.damping, k, {}, 5);
    CHECK(f.free_motions == 0);
    REQUIRE(f.modes.size() == 1);
    CHECK(f.modes[0].omega == doctest::Approx(std::sqrt(6.0)));
  }

  TEST_CASE("sliders without tangential stiffness fix their motion, twice the same one counts once") {
    Scene s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{5, -1}, {-1, 4}});
    const Direction first{"", {}, {{"d0", 1.0}}, {}};
    s.contacts = {slider("a", first, 1.0, 0.3), slider("b", first, 1.0, 0.3)};
    const modes::Frequencies f = stuck(build_model(s), 5);
    REQUIRE(f.modes.size() == 1);
    CHECK(f.modes[0].omega == doctest::Approx(2.0));
  }

  TEST_CASE("frequencies: large and small solvers agree, with fixed motions and free ones") {
    Scene s = beam(10.0, 80, 1e5, 1e3, 0.3);  // 243 degrees of freedom
    s.contacts = {slider("a", Direction{"L", {1.0, 0.0}, {}, {}}, 1.0, 0.3)};
    const modes::Frequencies large = stuck(build_model(s), 4);
    s.members[0].elements = {40};
    const modes::Frequencies small = stuck(build_model(s), 4);
    CHECK(large.free_motions == 2);
    CHECK(small.free_motions == 2);
    REQUIRE(large.modes.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(large.modes[i].omega == doctest::Approx(small.modes[i].omega).epsilon(1e-3));
  }

  TEST_CASE("members without mass have no frequencies, whatever rounding makes of their mass") {
    const std::string folder = SIGNORINI_TEST_DATA "/scenes/robust/";
    for (const char* name : {"massless-frame.toml", "massless-node-dashpot.toml"}) {
      CAPTURE(name);
      const Model model = build_model(read_scene(folder + name));
      const modes::Frequencies free = open(model, 5), resting = closed(model, 5), held = stuck(model, 5);
      // One point mass of two components: what is free has no frequency.
      CHECK(free.modes.size() + static_cast<std::size_t>(free.free_motions) <= 2);
      CHECK(resting.modes.size() + static_cast<std::size_t>(resting.free_motions) <= 2);
      for (const modes::Frequencies& found : {free, resting, held})
        for (const modes::NaturalMode& mode : found.modes) CHECK(mode.omega < 1e4);
    }
  }
}
