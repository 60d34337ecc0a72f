#include <doctest/doctest.h>

#include <cmath>

#include "differential/generator.hpp"
#include "differential/random.hpp"
#include "differential/transform.hpp"
#include "model/statics/mechanisms.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

Scene point_mass(double gap, double weight) {
  Scene s = empty_scene();
  s.nodes = {{"P", 0.0, 0.0, {}}};
  s.masses = {{"P", weight / 9.81, 0.0, {}}};
  s.gravity = {0.0, -9.81};
  s.initial.is_static = true;
  s.contacts = {support_contact("ground", "P", 1e6)};
  s.contacts[0].gap = gap;
  return s;
}

/// A beam on contacts at both ends.
Scene two_supports(int elements) {
  Scene s = beam(8.0, elements, 9e6, 2e6, 0.4);
  s.gravity = {0.0, -9.81};
  s.initial.is_static = true;
  s.contacts = {support_contact("left", "L", 1e5), support_contact("right", "R", 3e5)};
  return s;
}

}  // namespace

TEST_SUITE("unit/model/statics/statics") {
  TEST_CASE("a beam on two springy supports: half the weight each, and the closed form's deflection") {
    for (int elements : {2, 40, 150}) {
      CAPTURE(elements);
      const Model model = build_model(two_supports(elements));
      const double q = 0.4 * 9.81, reaction = q * 4.0;
      // EI / h^3 of a fine mesh times the roundoff of u is what doubles leave of a reaction.
      const double digits = elements > 100 ? 1e-7 : 1e-9;
      CHECK(model.statics.reactions[0] == doctest::Approx(reaction).epsilon(digits));
      CHECK(model.statics.reactions[1] == doctest::Approx(reaction).epsilon(digits));
      CHECK(model.u0[dof(model, "L.uy")] == doctest::Approx(-reaction / 1e5).epsilon(digits));
      const int middle = dof(model, "L-R." + std::to_string(elements / 2) + ".uy");
      const double sag = 5.0 * q * std::pow(8.0, 4) / (384.0 * 2e6);
      CHECK(model.u0[middle] ==
            doctest::Approx(-sag - 0.5 * reaction * (1.0 / 1e5 + 1.0 / 3e5)).epsilon(1e-8));
      REQUIRE(model.statics.free_motions.size() == 1);
      CHECK(model.statics.free_motions[0] == "horizontal motion held at contacts 'left' and 'right'");
      CHECK(std::abs(model.u0[dof(model, "L.ux")]) <= 1e-12);
      CHECK(model.static_start);
    }
  }

  TEST_CASE("a point mass above the ground falls until it is carried") {
    const Model model = build_model(point_mass(0.2, 50.0));
    CHECK(model.u0[dof(model, "P.uy")] == doctest::Approx(-0.2 - 50.0 / 1e6).epsilon(1e-12));
    CHECK(model.statics.reactions[0] == doctest::Approx(50.0).epsilon(1e-9));
    CHECK(model.statics.free_motions.at(0) == "horizontal motion of node 'P' held at contact 'ground'");
  }

  TEST_CASE("a support that is lifted off opens") {
    // A beam clamped at the left; a lifting load at the right end opens the right contact.
    Scene s = two_supports(8);
    s.supports = {support("L", true, true, true)};
    s.contacts.erase(s.contacts.begin());
    const double down = build_model(s).statics.reactions[0];
    CHECK(down > 0.0);
    s.loads = {node_load("R", {0.0, 1.0}, 20.0)};
    const Model model = build_model(s);
    CHECK(model.statics.reactions[0] == 0.0);
    CHECK(model.u0[dof(model, "R.uy")] > 0.0);
  }

  TEST_CASE("of three supports the middle one opens when it is too low") {
    Scene s = two_supports(8);
    s.nodes.push_back({"M", 4.0, 0.0, {}});
    s.members = {member({"L", "M", "R"}, "s", {4, 4})};
    ContactSpec middle = support_contact("middle", "M", 1e6);
    s.contacts.push_back(middle);
    CHECK(build_model(s).statics.reactions[2] > 0.0);
    s.contacts[2].gap = 1.0;
    const Model model = build_model(s);
    CHECK(model.statics.reactions[2] == 0.0);
    CHECK(model.statics.reactions[0] == doctest::Approx(0.4 * 9.81 * 4.0));
  }

  TEST_CASE("the closed contacts of a chain of supports satisfy every condition of contact") {
    // A wavy bed under a long beam: gaps of both signs, and some contacts carry nothing.
    Scene s = two_supports(1);
    s.nodes.clear();
    s.members = {member({}, "s", {1})};
    s.contacts.clear();
    for (int i = 0; i <= 30; ++i) {
      const std::string name = "n" + std::to_string(i);
      s.nodes.push_back({name, 3.0 * i, 0.0, {}});
      s.members[0].nodes.push_back(name);
      s.contacts.push_back(support_contact("c" + std::to_string(i), name, 1e5));
      s.contacts.back().gap = 2e-3 * std::sin(1.7 * i);
    }
    const Model model = build_model(s);
    int open = 0;
    double sum = 0.0;
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      const double g = model.contacts[k].gap + model.contacts[k].normal.dot(model.u0);
      const double r = model.statics.reactions[k];
      CHECK(r >= 0.0);
      CHECK(r == doctest::Approx(1e5 * std::max(0.0, -g)).epsilon(1e-9));
      if (r == 0.0) CHECK(g >= 0.0);
      open += r == 0.0;
      sum += r;
    }
    CHECK(open > 3);
    CHECK(sum == doctest::Approx(0.4 * 9.81 * 90.0).epsilon(1e-8));
  }

  TEST_CASE("a support that would have to pull is refused by name") {
    Scene s = two_supports(8);
    s.nodes.push_back({"M", 3.0, 0.0, {}});
    s.members = {member({"L", "M", "R"}, "s", {3, 5})};
    s.contacts[1].normal->node = "M";
    s.contacts[0].name = "anchor";
    const std::string message = refusal(s);
    CHECK(contains(message, "contact 'anchor' would have to pull with 10.46 kN"));
    CHECK(contains(message, "rotation about"));
    CHECK_FALSE(contains(message, "'right' would"));  // it is pressed
  }

  TEST_CASE("what flies up moves vertically, whatever else is free with it") {
    Scene s = pipeline();
    s.gravity = {0.0, 9.81};
    CHECK(contains(refusal(s), "contacts cannot pull, so the static loads drive the vertical motion"));
    s.gravity = {0.0, 0.0};
    s.contacts.clear();
    CHECK(
        contains(refusal(s),
                 "nothing restrains the horizontal motion, vertical motion, rotation about (6.882, 5.118)"));
  }

  TEST_CASE("a mesh whose own roundoff hides its supports is refused with that as the cause") {
    Scene s = beam(8.0, 12000, 9e6, 2e6, 0.4);
    s.initial.is_static = true;
    s.supports = {support("L", true, true, true)};
    const std::string message = refusal(s);
    CHECK(
        contains(message, "with 36000 degrees of freedom the stiffness is so ill-conditioned that roundoff"));
    CHECK(contains(message, "use fewer elements"));
    CHECK(contains(message, "hides whether anything restrains the motion of "));
  }

  TEST_CASE("a free motion that the loads drive is refused with its force") {
    Scene s = two_supports(8);
    s.gravity = {0.1, -9.81};
    const std::string message = refusal(s);
    CHECK(contains(message, "horizontal motion"));
    CHECK(contains(message, "0.32 kN"));
    CHECK(contains(message, "only friction at contacts 'left' and 'right' could prevent"));
    s.gravity = {1e-7, -9.81};
    CHECK_FALSE(refusal(s).empty());
  }

  TEST_CASE("a mass on a slope would slide off") {
    Scene s = point_mass(0.0, 50.0);
    s.contacts[0].normal->vector = {-0.6, 0.8};
    const std::string message = refusal(s);
    CHECK(contains(message, "motion along (0.8, 0.6) of node 'P' with 30 kN"));
    CHECK(contains(message, "contact 'ground'"));
    s.loads = {node_load("P", {0.8, 0.6}, 30.0)};
    CHECK(build_model(s).statics.reactions[0] == doctest::Approx(40.0));
  }

  TEST_CASE("a mechanism that no contact holds is refused by name") {
    Scene s = point_mass(0.0, 1.0);
    s.contacts.clear();
    CHECK(contains(refusal(s), "mechanism"));
    CHECK(contains(refusal(s), "of node 'P'"));
    Scene pendulum = beam(2.0, 4, 9e6, 2e6, 0.4);
    pendulum.supports = {support("L", true, true, false)};
    pendulum.initial.is_static = true;
    CHECK(contains(refusal(pendulum), "nothing restrains the rotation about (0, 0)"));
  }

  TEST_CASE("sliders carry nothing, but hold a free motion") {
    Scene s = two_supports(4);
    s.contacts.insert(s.contacts.begin(), slider("pad", Direction{"R", {1.0, 0.0}, {}, {}}, 3.0, 0.2));
    s.contacts[0].tangential_stiffness = 1e4;
    const Model model = build_model(s);
    CHECK(model.statics.reactions[0] == 0.0);
    CHECK(model.statics.free_motions.at(0) == "horizontal motion held at contacts 'pad', 'left' and 'right'");
    CHECK(std::abs(model.u0[dof(model, "R.ux")]) <= 1e-12);
  }

  TEST_CASE("two separate bodies have two free motions, each held at its own contact") {
    Scene s = point_mass(0.0, 50.0);
    s.nodes.push_back({"Q", 3.0, 0.0, {}});
    s.masses.push_back({"Q", 1e-3, 0.0, {}});
    s.contacts.push_back(support_contact("soft", "Q", 1.0));
    const Model model = build_model(s);
    REQUIRE(model.statics.free_motions.size() == 2);
    CHECK(contains(model.statics.free_motions[0], "held at contact 'ground'"));
    CHECK(contains(model.statics.free_motions[1], "held at contact 'soft'"));
    CHECK(model.statics.reactions[1] == doctest::Approx(9.81e-3));
  }

  TEST_CASE("contact springs of any stiffness find the same reactions") {
    for (double kn : {1e2, 1e6, 1e10, 1e14}) {
      CAPTURE(kn);
      Scene s = two_supports(8);
      for (ContactSpec& c : s.contacts) c.normal_stiffness = kn;
      const Model model = build_model(s);
      CHECK(model.statics.reactions[0] == doctest::Approx(0.4 * 9.81 * 4.0).epsilon(1e-6));
      CHECK(model.statics.reactions[1] == doctest::Approx(0.4 * 9.81 * 4.0).epsilon(1e-6));
    }
  }

  TEST_CASE("nothing loads the structure: it stays where it is") {
    Scene s = two_supports(4);
    s.gravity = {0.0, 0.0};
    const Model model = build_model(s);
    CHECK(model.u0.cwiseAbs().maxCoeff() == 0.0);
    CHECK(model.statics.reactions[0] == 0.0);
  }

  TEST_CASE("static start of a matrix scene needs constant loads") {
    Scene s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{0, 0}, {0, 0}});
    s.initial.is_static = true;
    ContactSpec c = support_contact("p", "", 1e6, 0.4);
    c.normal = Direction{"", {}, {{"d1", 1.0}}, {}};
    c.tangent = Direction{"", {}, {{"d0", 1.0}}, {}};
    s.contacts = {c};
    CHECK(contains(refusal(s), "constant history"));
    LoadSpec load;
    load.direction.dofs = {{"d1", 1.0}};
    load.amplitude = -9.81;
    s.loads = {load};
    const Model model = build_model(s);
    CHECK(model.u0[1] == doctest::Approx(-9.81e-6));
    CHECK(model.statics.free_motions.at(0) == "motion of d0.u held at contact 'p'");
  }

  TEST_CASE("null motions are found to roundoff, dense and sparse, and none of a fine but held mesh") {
    for (int elements : {1, 30, 400}) {
      CAPTURE(elements);
      Scene s = beam(8.0, elements, 9e6, 2e6, 0.4);
      s.nodes[1].y = 3.0;
      const Model free = build_model(s);
      CHECK(statics::null_motions(free.stiffness).cols() == 3);
      s.supports = {support("L", true, true, true)};
      CHECK(statics::null_motions(build_model(s).stiffness).cols() == 0);
    }
  }

  TEST_CASE("a motion that only the rounding of many entries holds is free") {
    // K = 1 1^T holds one motion; each of its entries is off by one rounding, all of them against a second
    // one, whose energy is that rounding times the number of its terms.
    const int n = 100;
    Eigen::MatrixXd k(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) k(i, j) = 1.0 + ((i + j) % 2 == 0 ? 1.0 : -1.0) * 0x1p-52;
    CHECK(statics::null_motions(SparseMatrix(k.sparseView())).cols() == n - 1);
  }

  TEST_CASE("a body that nothing holds is free, whatever else is there and in any place") {
    differential::Random draw(3);
    for (int n = 2; n <= 24; ++n)
      for (int place = 0; place < n; ++place) {
        Eigen::MatrixXd factor(n, n);
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            factor(i, j) = std::pow(10.0, draw.integer(-1, 1)) * draw.real(-1.0, 1.0);
        factor.row(place).setZero();
        const Eigen::MatrixXd k = factor * factor.transpose() + 0.01 * Eigen::MatrixXd::Identity(n, n);
        Eigen::MatrixXd bare = k;
        bare.row(place).setZero();
        bare.col(place).setZero();
        CAPTURE(n);
        CAPTURE(place);
        CHECK(statics::null_motions(SparseMatrix(bare.sparseView())).cols() == 1);
      }
  }

  // A ball that flies over a frame: where its free motion was not seen, a factorisation without an answer told the
  // scale of displacements, 5e-310 m.
  TEST_CASE("a ball in flight leaves the scales of a frame, in any order") {
    for (const std::uint64_t seed : {160U, 336U}) {
      const Scene scene = parse_scene(differential::draw_whole_scene(seed), "ball.toml");
      const Scales scales = build_model(scene).scales;
      CHECK(scales.displacement > 1e-5);
      CHECK(scales.displacement < 1.0);
      for (std::uint64_t order = 1; order <= 12; ++order) {
        const Scales other = build_model(differential::permuted(scene, order).scene).scales;
        CHECK(other.displacement == doctest::Approx(scales.displacement).epsilon(1e-9));
        CHECK(other.velocity == doctest::Approx(scales.velocity).epsilon(1e-9));
      }
    }
  }
}
