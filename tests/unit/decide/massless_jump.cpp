// Parts without mass that move at once: what they touch first, what waits until they arrive, where they stop.
#include "decide/massless_jump.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

namespace signorini::tests::at_once {
namespace {

Contact leaning(double nx, double ny, double gap) {
  Contact contact;
  contact.law = Law::compliant;
  contact.normal.terms = {{0, nx}, {1, ny}};
  contact.tangent.terms = {{0, -ny}, {1, nx}};
  contact.gap = gap;
  return contact;
}

/// Two degrees of freedom of one point, the third of another.
Model point_between_walls() {
  Model model;
  model.dofs.resize(3);
  model.dofs[0].massless = model.dofs[1].massless = true;
  model.contacts = {leaning(0.6, 0.8, 0.5), leaning(0.8, -0.6, 0.1), leaning(0.0, 1.0, 3.0)};
  Contact heavy = leaning(0.0, 0.0, 0.0);
  heavy.normal.terms = heavy.tangent.terms = {{2, 1.0}};
  model.contacts.push_back(heavy);
  model.layout = contact::layout_of(model.contacts);
  return model;
}

decide::FailedGuard failing(std::size_t contact, Guard guard, int order = 0) {
  decide::FailedGuard f{contact, guard};
  f.sign.order = order;
  return f;
}

Vector at(double x, double y) { return Vector{{x, y, 0.0}}; }

using Contacts = std::vector<std::size_t>;

}  // namespace

TEST_SUITE_BEGIN("unit/decide/massless_jump");

TEST_CASE("of walls on the way the first is touched, and what comes later is another way") {
  const Model model = point_between_walls();
  // Gaps go from 0.5, 0.1 and 3 to -0.5, -0.4 and 2.5.
  const Vector from = at(0.0, 0.0), to = at(-1.0, -0.5);
  std::vector<decide::FailedGuard> failed = {failing(0, Guard::closing), failing(1, Guard::closing),
                                             failing(2, Guard::sliding), failing(0, Guard::sliding)};
  const auto touch = decide::first_touch(model, {from, to}, failed);
  REQUIRE(touch);
  REQUIRE(touch->landings.size() == 1);
  CHECK(touch->landings[0].contact == 1);
  CHECK(touch->fraction == doctest::Approx(0.1 / 0.5).epsilon(1e-15));  // 0.1 (1 - x) - 0.4 x = 0
  // t . (u(x) - u_to), t = (0.6, 0.8)
  CHECK(touch->landings[0].ut == doctest::Approx((0.6 * 1.0 + 0.8 * 0.5) * 0.8).epsilon(1e-15));
  CHECK(decide::contacts_of(failed) ==
        Contacts{1, 2, 0});  // that wall 0 is touched comes later, that it slides is no touch
}

TEST_CASE("a wall that is touched already is touched where the way begins; others are not on it") {
  const Model model = point_between_walls();
  const Vector inside = at(-0.5, -0.5), deeper = at(-0.7, -0.6),
               back = at(-0.3, -0.5);  // wall 0: -0.2, -0.4, -0.08
  std::vector<decide::FailedGuard> failed = {failing(0, Guard::closing)};
  const auto touch = decide::first_touch(model, {inside, deeper}, failed);
  REQUIRE(touch);
  CHECK(touch->fraction == 0.0);
  CHECK_FALSE(decide::first_touch(model, {inside, back}, failed));  // it leaves
  std::vector<decide::FailedGuard> later = {failing(0, Guard::closing, 1), failing(2, Guard::closing)};
  CHECK_FALSE(decide::first_touch(model, {at(0.0, 0.0), deeper}, later));  // by its rate; 3 - 0.6 is open
  CHECK(later.size() == 2);
}

TEST_CASE("slip of what is on its way is told where it arrives") {
  const Model model = point_between_walls();
  std::vector<decide::FailedGuard> failed = {failing(0, Guard::sliding), failing(1, Guard::separation),
                                             failing(3, Guard::sliding)};
  decide::defer_slip_failures(model, failed);
  CHECK(decide::contacts_of(failed) == Contacts{1, 3});
  // Nothing is on a way: the other fails by its rate only, or has mass, or slides itself.
  for (const decide::FailedGuard& other :
       {failing(1, Guard::separation, 1), failing(3, Guard::separation), failing(1, Guard::sliding)}) {
    std::vector<decide::FailedGuard> both = {failing(0, Guard::sliding), other};
    decide::defer_slip_failures(model, both);
    CHECK(both.size() == 2);
  }
}

TEST_CASE("what slid at once along its slip stops on its way") {
  Contact contact = leaning(0.6, 0.8, 0.0);
  const Vector from = at(0.1, 0.2), ahead = at(0.1 - 0.8e-3, 0.2 + 0.6e-3);  // ut by 1e-3
  const auto stops = [&](Guard guard, State slip, double noise) {
    return decide::stops_on_path(contact, failing(0, guard), slip, {from, ahead}, noise);
  };
  CHECK_FALSE(stops(Guard::sliding, State::slip_plus, 1e-9));  // it does not slide at once
  contact.shear.emplace();
  CHECK(stops(Guard::sliding, State::slip_plus, 1e-9));
  CHECK(stops(Guard::sliding, State::slip_plus, 0.49e-3));
  CHECK_FALSE(stops(Guard::sliding, State::slip_plus, 0.51e-3));  // by no more than rounding
  CHECK_FALSE(stops(Guard::sliding, State::slip_minus, 1e-9));
  CHECK_FALSE(stops(Guard::closing, State::slip_plus, 1e-9));
}

TEST_SUITE_END();

}  // namespace signorini::tests::at_once
