#include "decide/guard_signs.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

using namespace signorini;

namespace {

/// A gap with the given derivatives, each known to `noise`.
MotionJet gap_of(std::array<double, MotionJet::orders> derivatives, double noise) {
  MotionJet jet;
  for (std::size_t k = 0; k < derivatives.size(); ++k) {
    jet.motion[k].gap = derivatives[k];
    jet.noise[k].gap = noise;
  }
  return jet;
}

GuardForm gap() { return {Guard::closing, {.gap = 1.0}}; }

}  // namespace

TEST_SUITE_BEGIN("unit/decide/guard_signs");

TEST_CASE(
    "of guards that fail at the same order separation counts, not the friction limit that ends with it") {
  Model model;
  Contact contact;
  contact.law = Law::rigid;
  contact.name = "c";
  contact.friction.static_ = contact.friction.kinetic = 0.5;
  model.contacts.push_back(contact);
  model.layout = contact::layout_of(model.contacts);
  MotionJet
      jet;  // N = t^2, T = t^2: compression ends and the limit is exceeded, both in the second derivative
  for (std::size_t k = 0; k < jet.motion.size(); ++k) jet.noise[k].N = jet.noise[k].T = 1e-12;
  jet.motion[2].N = jet.motion[2].T = 2.0;
  const std::vector<decide::FailedGuard> failed = decide::find_failed_guards(
      model, {jet}, {{State::stick}}, decide::Instant{}, false, std::vector<decide::KnownGuards>(1), {}, {0});
  REQUIRE(failed.size() == 1);
  CHECK(failed[0].guard == Guard::separation);
  CHECK(failed[0].sign.order == 2);
}

TEST_CASE("the first derivative that is not zero decides, and says how clearly") {
  const decide::Instant instant;
  const decide::Sign falls =
      decide::leading_sign(gap(), gap_of({0.5, -30.0, 9.0, 0.0, 0.0}, 1.0), instant, 0);
  CHECK(falls.sign == -1);
  CHECK(falls.order == 1);
  CHECK(falls.excess == doctest::Approx(30.0));
  CHECK(decide::leading_sign(gap(), gap_of({0.5, -0.3, 9.0, 0.0, 0.0}, 1.0), instant, 0).sign == 1);
  CHECK(decide::leading_sign(gap(), gap_of({0.5, -0.3, 0.1, 0.0, 0.0}, 1.0), instant, 0).sign == 0);
}

TEST_CASE(
    "a guard starts at zero within its noise and what it changes in the resolution of time, on either side") {
  decide::Instant instant;
  instant.noise_factor = 2.0;
  instant.resolution = 1e-3;
  const auto starts = [&](double value, double rate) {
    return decide::starts_at_zero(gap(), gap_of({value, rate, 0.0, 0.0, 0.0}, 0.25), instant);
  };
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    CHECK(starts(0.49 * side, 0.0));
    CHECK_FALSE(starts(0.51 * side, 0.0));
    for (const double rate : {100.0, -100.0}) {
      CHECK(starts(0.59 * side, rate));
      CHECK_FALSE(starts(0.61 * side, rate));
    }
  }
}

TEST_CASE("what was set to zero is not asked; what was found to rise only whether it clearly falls") {
  const decide::Instant instant;
  const MotionJet jet = gap_of({-7.0, -5.0, 0.4, -50.0, 0.0}, 1.0);
  CHECK(decide::sign_of_guard(gap(), jet, instant, {}).sign == -1);
  CHECK(decide::sign_of_guard(gap(), jet, instant, {1, false}).order == 1);
  // g'' was found positive with a sharper noise; g''' says nothing then
  CHECK(decide::sign_of_guard(gap(), jet, instant, {2, false}).sign == -1);
  CHECK(decide::sign_of_guard(gap(), jet, instant, {2, true}).sign == 1);
  CHECK(decide::sign_of_guard(gap(), jet, instant, {3, true}).sign == -1);
}

TEST_CASE("a guard is told by the first order from which it is asked, though zeros be blurred") {
  const auto told = [](std::array<double, MotionJet::orders> derivatives, std::size_t orders,
                       std::size_t zeros, const decide::Instant& instant = {}, Guard kind = Guard::sliding) {
    decide::GuardsOfState all{};
    all[0] = {kind, {.gap = 1.0}};
    decide::KnownGuards known;
    known.sliding.zeros = zeros;
    return decide::signs_are_decided(all, 0, gap_of(derivatives, 1.0), orders, instant, known, 16.0);
  };
  CHECK(told({17.0, 0.0, 0.0, 0.0, 0.0}, 1, 0));
  CHECK_FALSE(told({15.0, 0.0, 0.0, 0.0, 0.0}, 1, 0));
  CHECK_FALSE(told({-17.0, 0.0, 0.0, 0.0, 0.0}, 1, 0));  // it fails: all that follows is asked for
  CHECK(told({-17.0, 0.0, 0.0, 0.0, 0.0}, 2, 0));
  // A slip rate that is zero is asked from its rate on, whatever rounding has made of it.
  CHECK_FALSE(told({17.0, 0.0, 0.0, 0.0, 0.0}, 1, 1));
  CHECK_FALSE(told({17.0, 15.0, 90.0, 0.0, 0.0}, 2, 1));
  CHECK(told({17.0, 15.0, 90.0, 0.0, 0.0}, 3, 1));
  CHECK(told({0.0, 0.0, 0.0, 0.0, 0.0}, MotionJet::orders, 0));
  // After a limit that has rested differences to another motion count, of that limit and of the slip that left it.
  decide::Instant rested;
  rested.resting_limits = {{0, Guard::slip_plus}};
  CHECK_FALSE(told({17.0, 90.0, 0.0, 0.0, 0.0}, 2, 0, rested));
  CHECK_FALSE(told({17.0, 90.0, 0.0, 0.0, 0.0}, 2, 0, rested, Guard::slip_plus));
  rested.resting_limits = {{1, Guard::slip_plus}};
  CHECK(told({17.0, 90.0, 0.0, 0.0, 0.0}, 2, 0, rested));
  rested.resting_limits = {{0, Guard::slip_minus}};
  CHECK_FALSE(told({17.0, 90.0, 0.0, 0.0, 0.0}, 2, 0, rested));
}

TEST_CASE("forgiveness is the greatest negative derivative before a positive one, in roundings") {
  const decide::Instant instant;
  CHECK(decide::relative_violation(gap(), gap_of({3.0, -9.0, 0.0, 0.0, 0.0}, 1.0), instant, 0) == 0.0);
  CHECK(decide::relative_violation(gap(), gap_of({-4.0, 0.0, 8.0, -100.0, 0.0}, 1.0), instant, 0) ==
        doctest::Approx(4.0));
  CHECK(decide::relative_violation(gap(), gap_of({-4.0, -6.0, 0.0, 0.0, 0.0}, 1.0), instant, 0) ==
        doctest::Approx(6.0));
  CHECK(decide::relative_violation(gap(), gap_of({-4.0, -6.0, 0.0, 0.0, 0.0}, 1.0), instant, 2) == 0.0);
}

TEST_SUITE_END();
