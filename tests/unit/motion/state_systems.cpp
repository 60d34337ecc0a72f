// The cache of factorised modes: bounded, and nothing depends on what it holds.
#include "motion/state_systems.hpp"

#include <doctest/doctest.h>

#include <utility>

#include "contact/contact_states.hpp"
#include "motion/taylor.hpp"

using namespace signorini;

namespace {

/// Masses in a row on springs, each on a slider; of more than three the last one sticks rigidly, so that its states are
/// factorised.
Model row_of_masses(int n) {
  Model model;
  model.mass.resize(n, n);
  model.damping.resize(n, n);
  model.stiffness.resize(n, n);
  for (int i = 0; i < n; ++i) {
    model.mass.insert(i, i) = 1.0 + 0.1 * i;
    model.damping.insert(i, i) = 0.02;
    model.stiffness.insert(i, i) = 20.0;
    if (i > 0) model.stiffness.insert(i, i - 1) = -5.0;
    if (i + 1 < n) model.stiffness.insert(i, i + 1) = -5.0;
    const std::string name = "d" + std::to_string(i);
    model.dofs.push_back({name + ".u", name + ".v", false, false});
    Contact c;
    c.name = name;
    c.law = Law::slider;
    c.tangent.terms = {{i, 1.0}};
    c.normal_force = History::constant(1.0);
    c.friction.static_ = c.friction.kinetic = 0.3;
    c.tangential_stiffness = 50.0;
    model.contacts.push_back(c);
    model.layout = contact::layout_of(model.contacts);
  }
  if (n > 3) model.contacts.back().tangential_stiffness.reset();
  model.u0 = model.v0 = Vector::LinSpaced(n, 0.1, 1.0);
  return model;
}

/// Mode number i in a count to the base of stick and slip in both directions.
contact::ContactStates mode_number(std::size_t contacts, int i) {
  constexpr State states[] = {State::stick, State::slip_plus, State::slip_minus};
  contact::ContactStates contact_states(contacts);
  for (ContactState& s : contact_states) {
    s = {states[i % 3], 0.01 * i};
    i /= 3;
  }
  return contact_states;
}

motion::Series series_in(motion::StateSystems& systems, const contact::ContactStates& contact_states) {
  const Model& model = systems.model();
  const motion::StateSystemPtr system = systems.system_of(contact_states);
  REQUIRE(system);
  motion::Series series;
  motion::Taylor(systems).expand(system, motion::Forcing(model, 0.0, motion::Side::after), 0.0, model.u0,
                                 model.v0, 8, 0.1, series);
  return series;
}

}  // namespace

TEST_SUITE_BEGIN("unit/motion/state_systems");

TEST_CASE("what is known is not factorised again; another anchor is the same matrix") {
  const Model model = row_of_masses(3);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const contact::ContactStates contact_states = mode_number(3, 5);
  contact::ContactStates moved = contact_states;
  for (ContactState& s : moved) s.anchor += 1.0;
  const motion::StateSystemPtr first = systems.system_of(contact_states), second = systems.system_of(moved);
  CHECK(systems.created_count() == 1);
  CHECK(&first->factorised() == &second->factorised());
  const auto stuck =
      static_cast<std::size_t>(std::find_if(contact_states.begin(), contact_states.end(),
                                            [](const ContactState& s) { return s.state == State::stick; }) -
                               contact_states.begin());
  REQUIRE(stuck < contact_states.size());
  CHECK(second->rows()[stuck].tangent.constant == 50.0 * moved[stuck].anchor);
}

TEST_CASE("count and bytes are bounded, whatever number of modes a run visits") {
  for (const int masses : {3, 20}) {  // dense and sparse
    CAPTURE(masses);
    const Model model = row_of_masses(masses);
    const linear::SystemMatrices structure(model);
    motion::StateSystems one(model, structure);
    (void)one.system_of(mode_number(model.contacts.size(), 0));
    const std::size_t each = one.bytes();
    CHECK(each > 0);
    motion::StateSystems by_count(model, structure, {4, 100 * each});
    motion::StateSystems by_bytes(model, structure, {100, 4 * each + each / 2});
    for (int i = 0; i < 27; ++i)
      for (motion::StateSystems* systems : {&by_count, &by_bytes}) {
        (void)systems->system_of(mode_number(model.contacts.size(), i));
        CHECK(systems->cached_count() <= 4 + (systems == &by_bytes ? 1 : 0));
        CHECK(systems->bytes() <= 5 * each);
      }
    CHECK(by_count.cached_count() == 4);
    CHECK(by_count.created_count() == 27);
  }
}

TEST_CASE("states whose forces follow from places and velocities are not held, and are the same each time") {
  Model model = row_of_masses(20);
  model.contacts.back().tangential_stiffness = 50.0;
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const auto mode = [&](int i) { return mode_number(model.contacts.size(), i); };
  const motion::Series first = series_in(systems, mode(7));
  REQUIRE(systems.system_of(mode(7))->factorised().by_mass);
  (void)systems.system_of(mode(12));
  const motion::Series again = series_in(systems, mode(7));
  CHECK((first.u.array() == again.u.array()).all());
  CHECK((first.forces.array() == again.forces.array()).all());
  CHECK(systems.created_count() == 3);
  CHECK(systems.cached_count() == 0);
}

TEST_CASE("a system greater than all bounds is held until the next one comes") {
  const Model model = row_of_masses(3);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure, {10, 1});
  const motion::StateSystemPtr first = systems.system_of(mode_number(3, 0));
  CHECK(systems.cached_count() == 1);
  (void)systems.system_of(mode_number(3, 0));
  CHECK(systems.created_count() == 1);
  (void)systems.system_of(mode_number(3, 1));
  CHECK(systems.cached_count() == 1);
  CHECK(first->rows().size() == 3);  // who carries one keeps it
}

TEST_CASE("what was used least recently goes") {
  const Model model = row_of_masses(3);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure, {2, std::size_t{1} << 20});
  const auto visit = [&](int i) {
    const long before = systems.created_count();
    (void)systems.system_of(mode_number(3, i));
    return systems.created_count() > before;
  };
  CHECK(visit(0));
  CHECK(visit(1));
  CHECK_FALSE(visit(0));
  CHECK(visit(2));  // in place of 1
  CHECK_FALSE(visit(0));
  CHECK(visit(1));
}

TEST_CASE("a series is the same to the last bit after its mode was dropped and made again") {
  for (const int masses : {3, 20}) {
    CAPTURE(masses);
    const Model model = row_of_masses(masses);
    const linear::SystemMatrices structure(model);
    motion::StateSystems large(model, structure), tiny(model, structure, {1, 1});
    for (const int i : {0, 7, 12, 7, 0}) {
      const contact::ContactStates contact_states = mode_number(model.contacts.size(), i);
      const motion::Series a = series_in(large, contact_states), b = series_in(tiny, contact_states);
      CHECK((a.u.array() == b.u.array()).all());
      CHECK((a.forces.array() == b.forces.array()).all());
    }
    CHECK(large.created_count() == 3);
    CHECK(tiny.created_count() == 5);
  }
}

TEST_CASE("dependent rows are no system, and that is remembered too") {
  Model model = row_of_masses(1);
  Contact twin = model.contacts[0];
  twin.law = Law::rigid;
  twin.normal = std::exchange(twin.tangent, {});
  twin.friction = {};
  twin.tangential_stiffness.reset();
  model.contacts[0] = twin;
  twin.name = "twin";
  model.contacts.push_back(twin);
  model.layout = contact::layout_of(model.contacts);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  for (int i = 0; i < 2; ++i)
    CHECK(systems.system_of({{State::closed, 0.0}, {State::closed, 0.0}}) == nullptr);
  CHECK(systems.created_count() == 1);
  CHECK(systems.system_of({{State::closed, 0.0}, {State::open, 0.0}}) != nullptr);
}

TEST_SUITE_END();
