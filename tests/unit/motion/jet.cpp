// The noise of a jet: what rounding has left of sums that cancel is below it, at every angle.
#include "motion/jet.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "base/rounding.hpp"
#include "contact/contact_states.hpp"
#include "unit/linear/rubbing_row.hpp"

using namespace signorini;

namespace {

constexpr double friction = 0.3, stiffness = 100.0;

/// Two masses 1 and 2 on rigid floors, turned, each pushed by its limit of friction; a spring between them.
Model at_limit(double degrees) {
  const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
  Model model;
  model.mass.resize(4, 4);
  model.damping.resize(4, 4);
  model.stiffness.resize(4, 4);
  const double t[2] = {c, s};
  for (int body = 0; body < 2; ++body) {
    for (int i = 0; i < 2; ++i) {
      model.mass.insert(2 * body + i, 2 * body + i) = 1.0 + body;
      for (int other = 0; other < 2; ++other)
        for (int j = 0; j < 2; ++j)
          model.stiffness.insert(2 * body + i, 2 * other + j) =
              (body == other ? stiffness : -stiffness) * t[i] * t[j];
      model.dofs.push_back({"d" + std::to_string(2 * body + i), "v", false, false});
    }
    Contact contact;
    contact.name = std::to_string(body);
    contact.law = Law::rigid;
    contact.normal.terms = {{2 * body, -s}, {2 * body + 1, c}};
    contact.tangent.terms = {{2 * body, c}, {2 * body + 1, s}};
    contact.friction.static_ = contact.friction.kinetic = friction;
    model.contacts.push_back(contact);
    model.layout = contact::layout_of(model.contacts);
    Load load;  // weight 1 a mass, and the limit
    const double m = 1.0 + body;
    load.direction.terms = {{2 * body, m * (s + friction * c)}, {2 * body + 1, m * (-c + friction * s)}};
    load.history = History::constant(1.0);
    model.loads.push_back(load);
  }
  model.u0 = model.v0 = Vector::Zero(4);
  return model;
}

std::vector<MotionJet> motions_in(const Model& model, State first, State second) {
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  motion::JetMaker jets(systems);
  std::vector<MotionJet> motions;
  const motion::StateSystemPtr system = systems.system_of({{first, 0.0}, {second, 0.0}});
  REQUIRE(system);
  (void)jets.make(system, motion::Forcing(model, 0.0, motion::Side::after), 0.0, model.u0, model.v0, motions);
  return motions;
}

}  // namespace

TEST_SUITE_BEGIN("unit/motion/jet");

TEST_CASE("orders that contacts are asked for are the same to the last bit, whatever others are asked for") {
  const Model model = rubbing_row(17);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  motion::JetMaker jets(systems);
  const motion::StateSystemPtr system = systems.system_of(rubbing_mode(model, 5));
  REQUIRE(system);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  std::vector<MotionJet> all, some;
  const motion::Jet whole = jets.make(system, forcing, 0.0, model.u0, model.v0, all);
  const auto same = [](const ContactMotion& a, const ContactMotion& b) {
    return a.N == b.N && a.T == b.T && a.gap == b.gap && a.ut == b.ut && a.vn == b.vn && a.vt == b.vt &&
           a.an == b.an && a.at == b.at;
  };
  for (const std::size_t greatest : {1U, 2U, 3U, 5U}) {
    CAPTURE(greatest);
    const auto asked = [&](std::size_t c) { return 1 + c % greatest; };
    const motion::Jet jet =
        jets.make(system, forcing, 0.0, model.u0, model.v0, some,
                  [&](std::size_t c, const MotionJet&, std::size_t orders) { return orders >= asked(c); });
    CHECK(jet.u == whole.u);
    CHECK(jet.forces == whole.forces);
    for (std::size_t c = 0; c < all.size(); ++c) {
      for (std::size_t k = 0; k < asked(c); ++k) CHECK(same(some[c].noise[k], all[c].noise[k]));
      const std::size_t known = asked(c) == 1 ? 2 : MotionJet::orders;
      for (std::size_t k = 0; k < known; ++k) CHECK(same(some[c].motion[k], all[c].motion[k]));
    }
  }
}

TEST_CASE(
    "an acceleration that is a difference of forces is zero within its noise, which is some roundings") {
  for (int degrees = 0; degrees < 360; ++degrees) {
    CAPTURE(degrees);
    const auto motions = motions_in(at_limit(degrees), State::slip_plus, State::slip_plus);
    for (const MotionJet& jet : motions) {
      // Exactly 0.
      CHECK(std::abs(jet.motion[0].at) <= jet.noise[0].at);
      CHECK(jet.noise[0].at >= friction * rounding::many_operations);
      CHECK(jet.noise[0].at <= 50.0 * rounding::many_operations);
    }
  }
}

TEST_CASE("what a rounding of an acceleration does through a spring is within the noise of the derivatives") {
  for (int degrees = 0; degrees < 360; ++degrees) {
    CAPTURE(degrees);
    // The first slips by nothing but rounding; the second sticks at its limit and feels the spring.
    const auto motions = motions_in(at_limit(degrees), State::slip_plus, State::stick);
    const MotionJet& jet = motions[1];
    CHECK(std::abs(jet.motion[2].T) <= jet.noise[2].T);
    CHECK(jet.noise[2].T >= stiffness * friction * rounding::eps);
    CHECK(jet.noise[2].T <= 50.0 * stiffness * rounding::many_operations);
  }
}

TEST_CASE("the noise of places and velocities does not turn with the scene") {
  for (int degrees = 0; degrees < 360; degrees += 5) {
    CAPTURE(degrees);
    Model model = at_limit(degrees);
    const double c = std::cos((degrees + 20.0) * M_PI / 180.0), s = std::sin((degrees + 20.0) * M_PI / 180.0);
    model.u0 << 2.0 * c, 2.0 * s, 0.0, 0.0;
    model.v0 << 3.0 * s, -3.0 * c, 0.0, 0.0;
    const auto motions = motions_in(model, State::open, State::open);
    CHECK(motions[0].noise[0].gap == doctest::Approx(4.0 * rounding::many_operations).epsilon(1e-9));
    CHECK(motions[0].noise[0].vn == doctest::Approx(6.0 * rounding::many_operations).epsilon(1e-9));
  }
}

TEST_CASE("what sticks stands still exactly, at every angle") {
  for (int degrees = 0; degrees < 360; ++degrees) {
    CAPTURE(degrees);
    const auto motions = motions_in(at_limit(degrees), State::stick, State::stick);
    for (const MotionJet& jet : motions)
      for (std::size_t k = 0; k < MotionJet::orders; ++k) {
        CHECK(jet.motion[k].at == 0.0);
        CHECK(jet.motion[k].an == 0.0);
        if (k > 0) CHECK(jet.motion[k].T == 0.0);
      }
  }
}

TEST_SUITE_END();
