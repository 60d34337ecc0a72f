// Who is asked first where several contacts change at one instant.
#include "contact/contact_states.hpp"
#include "decide/cycle_fallback.hpp"

#include <doctest/doctest.h>

namespace signorini::tests::own_first {
namespace {

/// Sliders 0, 1 and 2; 3 has a spring along its surface; 4 is rigid, and takes impulses. 2 is of another block.
Model sliders() {
  Model model;
  model.contacts.resize(5);
  model.layout = contact::layout_of(model.contacts);
  for (Contact& c : model.contacts) {
    c.law = Law::slider;
    c.friction.static_ = c.friction.kinetic = 0.3;
  }
  model.contacts[3].tangential_stiffness = 1e6;
  model.contacts[4].law = Law::rigid;
  return model;
}

decide::FailedGuard failing(std::size_t contact, Guard guard, int order = 0) {
  decide::FailedGuard f{contact, guard};
  f.sign.order = order;
  return f;
}

using Contacts = std::vector<std::size_t>;

/// Contacts that are asked now, where `visited` were asked before.
Contacts asked(std::vector<decide::FailedGuard> failed, const Contacts& visited) {
  std::vector<bool> before(5, false);
  for (const std::size_t c : visited) before[c] = true;
  decide::defer_pushed_failures(sliders(), before, {0, 0, 1, 0, 0}, failed);
  return decide::contacts_of(failed);
}

}  // namespace

TEST_SUITE_BEGIN("unit/decide/own_first");

TEST_CASE("what a slider pushes that does not stick waits for its next state") {
  for (const Guard limit : {Guard::slip_plus, Guard::slip_minus}) {
    const decide::FailedGuard turns = failing(1, limit);
    for (const std::size_t c : {0U, 3U, 4U}) {
      CHECK(asked({failing(c, Guard::slip_plus), turns}, {1}) == Contacts{1});
      CHECK(asked({turns, failing(c, Guard::separation)}, {1}) == Contacts{1});
    }
  }
}

TEST_CASE("what has a reason of its own does not wait") {
  const decide::FailedGuard turns = failing(1, Guard::slip_plus);
  CHECK(asked({failing(0, Guard::slip_minus), turns}, {0, 1}) == Contacts{0, 1});  // both came to rest
  CHECK(asked({failing(0, Guard::slip_minus, 1), turns}, {1}) == Contacts{0, 1});  // by its rate
  CHECK(asked({failing(2, Guard::slip_minus), turns}, {1}) == Contacts{2, 1});     // nothing couples them
  // The other was not asked before, goes on sliding, fails by its rate, or its T does not jump.
  CHECK(asked({failing(0, Guard::slip_minus), turns}, {}) == Contacts{0, 1});
  CHECK(asked({failing(0, Guard::slip_minus), failing(1, Guard::sliding)}, {1}) == Contacts{0, 1});
  CHECK(asked({failing(0, Guard::slip_minus), failing(1, Guard::slip_plus, 1)}, {1}) == Contacts{0, 1});
  CHECK(asked({failing(0, Guard::slip_minus), failing(3, Guard::slip_plus)}, {3}) == Contacts{0, 3});
  CHECK(asked({failing(0, Guard::slip_minus), failing(4, Guard::slip_plus)}, {4}) == Contacts{0, 4});
}

TEST_SUITE_END();

}  // namespace signorini::tests::own_first
