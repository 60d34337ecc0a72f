// Jets near the contacts that ask beside those of the whole structure.
#include "motion/local_derivatives.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "unit/motion/lively_row.hpp"

using namespace signorini;

namespace {

constexpr int long_row = 300;

struct Bench {
  explicit Bench(Model row)
      : model(std::move(row)), structure(model), systems(model, structure), whole(systems) {}

  Model model;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  motion::JetMaker whole;
};

void check_same(const ContactMotion& near, const ContactMotion& whole, const ContactMotion& noise) {
  const auto same = [](double a, double b, double zero) { CHECK(std::abs(a - b) <= zero); };
  same(near.N, whole.N, noise.N);
  same(near.T, whole.T, noise.T);
  same(near.gap, whole.gap, noise.gap);
  same(near.ut, whole.ut, noise.ut);
  same(near.vn, whole.vn, noise.vn);
  same(near.vt, whole.vt, noise.vt);
  same(near.an, whole.an, noise.an);
  same(near.at, whole.at, noise.at);
}

}  // namespace

TEST_SUITE_BEGIN("unit/motion/local_derivatives");

TEST_CASE("what contacts ask for near them is what the whole structure says, within its rounding") {
  Bench bench(lively_row(long_row));
  motion::LocalDerivatives jets(bench.systems, 400);
  REQUIRE(jets.possible());
  for (const int seed : {5, 77, 1234}) {
    const motion::StateSystemPtr system = bench.systems.system_of(rubbing_mode(bench.model, seed));
    REQUIRE(system);
    for (const double t : {0.0, 0.37}) {
      const motion::Forcing forcing(bench.model, t, motion::Side::after);
      std::vector<MotionJet> whole, near;
      const motion::Jet all = bench.whole.make(system, forcing, t, bench.model.u0, bench.model.v0, whole);
      // Four contacts ask for three orders, at both ends, where a load acts, and beside it.
      const std::vector<std::size_t> asking = {0, 150, 153, long_row - 1};
      const auto told = [&](std::size_t c, const MotionJet&, std::size_t orders) {
        return orders >= 3 || std::find(asking.begin(), asking.end(), c) == asking.end();
      };
      const auto made = jets.make(system, forcing, t, bench.model.u0, bench.model.v0, near, told);
      REQUIRE(made);
      // Besides: those whose slip rate contains an acceleration, by a dashpot.
      CHECK(std::includes(made->open.begin(), made->open.end(), asking.begin(), asking.end()));
      CHECK((made->jet.u.col(2) - all.u.col(2)).cwiseAbs().maxCoeff() <=
            rounding::many_operations * all.u.col(2).cwiseAbs().maxCoeff());
      for (Eigen::Index i = 0; i < made->jet.forces.rows(); ++i)
        for (Eigen::Index k = 0; k < 2; ++k)
          CHECK(made->jet.forces(i, k) == doctest::Approx(all.forces(i, k)).epsilon(1e-12));
      for (std::size_t c = 0; c < near.size(); ++c) {
        CAPTURE(c);
        check_same(near[c].motion[0], whole[c].motion[0], whole[c].noise[0]);
        const ContactMotion &bound = near[c].noise[0], &noise = whole[c].noise[0];
        if (std::binary_search(made->open.begin(), made->open.end(), c)) continue;
        // The bound is one: no less than a sample of rounding, and no more than four times what the terms give.
        CHECK(bound.N >= noise.N * (1.0 - 1e-12));
        CHECK(bound.T >= noise.T * (1.0 - 1e-12));
        CHECK(bound.N <= 4.0 * noise.N + std::numeric_limits<double>::min());
        CHECK(bound.gap >= noise.gap * (1.0 - 1e-12));
        CHECK(bound.ut >= noise.ut * (1.0 - 1e-12));
        CHECK(bound.vn >= noise.vn * (1.0 - 1e-12));
        CHECK(bound.vt >= noise.vt * (1.0 - 1e-12));
      }
      for (const std::size_t c : asking)
        for (std::size_t k = 1; k < 3; ++k) {
          CAPTURE(c);
          CAPTURE(k);
          check_same(near[c].motion[k], whole[c].motion[k], whole[c].noise[k]);
          CHECK(near[c].noise[k].N >= 0.25 * whole[c].noise[k].N);
          CHECK(near[c].noise[k].N <= 4.0 * whole[c].noise[k].N);
        }
    }
  }
}

TEST_CASE(
    "in other states at the same place accelerations change near the contacts that have others, and as they "
    "should") {
  Bench bench(lively_row(long_row));
  const double t = 0.37;
  const motion::Forcing forcing(bench.model, t, motion::Side::after);
  const auto told = [](std::size_t c, const MotionJet&, std::size_t orders) {
    return orders >= 3 || c != 153;
  };
  contact::ContactStates contact_states = rubbing_mode(bench.model, 77);
  for (const std::size_t other : {0U, 150U, 153U}) {
    CAPTURE(other);
    motion::LocalDerivatives jets(bench.systems, 400), again(bench.systems, 400);
    std::vector<MotionJet> motions, alone;
    const auto before = jets.make(bench.systems.system_of(contact_states), forcing, t, bench.model.u0,
                                  bench.model.v0, motions, told);
    REQUIRE(before);
    contact_states[other].state = contact_states[other].state == State::stick ? State::open : State::stick;
    contact_states[other + 2].state = State::slip_plus;
    const motion::StateSystemPtr system = bench.systems.system_of(contact_states);
    const auto beside = jets.make(system, forcing, t, bench.model.u0, bench.model.v0, motions, told,
                                  motion::LocalDerivatives::PreviousJet{before->jet, before->open});
    const auto made = again.make(system, forcing, t, bench.model.u0, bench.model.v0, alone, told);
    REQUIRE(beside);
    REQUIRE(made);
    const Vector was = before->jet.u.col(2), now = beside->jet.u.col(2), whole = made->jet.u.col(2);
    CHECK((now - was).cwiseAbs().maxCoeff() > 1e-3 * whole.cwiseAbs().maxCoeff());
    CHECK((now - whole).cwiseAbs().maxCoeff() <= rounding::many_operations * whole.cwiseAbs().maxCoeff());
    CHECK((now.array() == was.array()).count() > long_row);  // more than half of them
    CHECK(beside->jet.system == system);
    CHECK(beside->open == made->open);
    const double force = made->jet.forces.cwiseAbs().maxCoeff();
    CHECK((beside->jet.forces - made->jet.forces).cwiseAbs().maxCoeff() <= rounding::many_operations * force);
    for (std::size_t c = 0; c < motions.size(); ++c) {
      CAPTURE(c);
      ContactMotion m = motions[c].motion[0];
      m.an = alone[c].motion[0].an;  // accelerations are compared above, their rounding is nobody's here
      m.at = alone[c].motion[0].at;
      check_same(m, alone[c].motion[0], alone[c].noise[0]);
      CHECK(motions[c].noise[0].N == doctest::Approx(alone[c].noise[0].N).epsilon(1e-6));
      CHECK(motions[c].noise[0].T == doctest::Approx(alone[c].noise[0].T).epsilon(1e-6));
    }
  }
}

TEST_CASE(
    "a row that is no longer than its neighbourhoods, and one that asks everywhere, take the whole "
    "structure") {
  const auto asks = [](std::size_t, const MotionJet&, std::size_t orders) { return orders > 2; };
  const auto one_asks = [](std::size_t c, const MotionJet&, std::size_t orders) {
    return c != 3 || orders > 2;
  };
  const auto made = [](Bench& bench, const motion::JetMaker::StopCriterion& told) {
    motion::LocalDerivatives jets(bench.systems, 20);
    REQUIRE(jets.possible());
    std::vector<MotionJet> motions;
    return jets
        .make(bench.systems.system_of(rubbing_mode(bench.model, 7)),
              motion::Forcing(bench.model, 0.0, motion::Side::after), 0.0, bench.model.u0, bench.model.v0,
              motions, told)
        .has_value();
  };
  Bench brief(lively_row(40)), large(lively_row(long_row));
  CHECK_FALSE(made(brief, one_asks));
  CHECK(made(large, one_asks));
  CHECK_FALSE(made(large, asks));
}

TEST_CASE("who is told by nothing but the last order takes the whole structure") {
  Bench bench(lively_row(long_row));
  motion::LocalDerivatives jets(bench.systems, 400);
  std::vector<MotionJet> motions;
  const auto never = [](std::size_t c, const MotionJet&, std::size_t orders) {
    return c != 40 || orders == MotionJet::orders;
  };
  CHECK_FALSE(jets.make(bench.systems.system_of(rubbing_mode(bench.model, 7)),
                        motion::Forcing(bench.model, 0.0, motion::Side::after), 0.0, bench.model.u0,
                        bench.model.v0, motions, never));
}

TEST_CASE("small, rigid and massless models, and friction that varies, are none for this") {
  const auto possible = [](const auto& change) {
    Model model = rubbing_row(long_row);
    change(model);
    Bench bench(std::move(model));
    return motion::LocalDerivatives(bench.systems, 400).possible();
  };
  CHECK(possible([](Model&) {}));
  CHECK_FALSE(possible([](Model& m) { m.contacts[200].law = Law::rigid; }));
  CHECK_FALSE(possible([](Model& m) {
    m.contacts[0].friction.stribeck_velocity = 0.1, m.contacts[0].friction.static_ = 0.5;
  }));
  Bench row(rubbing_row(long_row));
  CHECK_FALSE(motion::LocalDerivatives(row.systems, 2 * long_row + 1).possible());
}
