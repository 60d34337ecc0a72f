// Series near a contact that has changed beside those of the whole structure.
#include "motion/local_series.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/exact/patched_series.hpp"
#include "unit/motion/lively_row.hpp"

using namespace signorini;

namespace {

constexpr int masses = 300, levels = 18;
constexpr double begin = 0.37, scale = 0.05, from = 0.31;  // of the series; where the state changes, in it

/// A series of the whole row, and the states of one contact that change within it.
struct Changing {
  explicit Changing(Model row, std::size_t contact, double at = from)
      : model(std::move(row)),
        structure(model),
        systems(model, structure),
        taylor(systems),
        motion(model),
        x(at) {
    contact::ContactStates states = rubbing_mode(model, 77);
    const motion::StateSystemPtr before = systems.system_of(states);
    taylor.expand(before, forcing(), begin, model.u0, model.v0, levels, scale, motion.whole);
    motion.set_complete(levels);
    motion.evaluate_at(x, there);
    states[contact].state = states[contact].state == State::open ? State::stick : State::open;
    after = systems.system_of(states);
    taylor.expand(after, forcing(), time(), there.u, there.v, levels, scale, whole);
  }
  [[nodiscard]] double time() const { return begin + scale * x; }
  [[nodiscard]] motion::Forcing forcing() const { return {model, begin, motion::Side::after}; }
  std::optional<motion::LocalSeries::LocalExpansion> expand(motion::LocalSeries& near,
                                                            const std::vector<std::size_t>& changed,
                                                            double reach, double least) {
    return near.expand(changed, after, forcing(), time(), there.u, there.v, levels, scale, reach,
                       {weights, least},
                       {[&](int dof, double* out) { motion.displacement(dof, x, out); },
                        [&](std::size_t slot, double* out) { motion.force(slot, x, out); }});
  }

  Model model;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  motion::Taylor taylor;
  exact::PatchedSeries motion;
  double x;
  motion::Point there;
  motion::StateSystemPtr after;
  motion::Series whole;
  std::vector<double> weights = std::vector<double>(2 * masses, 1.0);
};

/// Greatest difference of two values, over the greatest of them.
double apart(const Vector& a, const Vector& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE_BEGIN("unit/motion/local_series");

TEST_CASE("after a change of state the motion put together from pieces is that of a series of the whole") {
  for (const std::size_t contact : {std::size_t{0}, std::size_t{142}, std::size_t{151}, std::size_t{299}}) {
    CAPTURE(contact);
    Changing row(lively_row(masses), contact);
    motion::LocalSeries near(row.systems);
    const auto made = row.expand(near, {contact}, 1.0 - from, 0.0);
    REQUIRE(made);
    CHECK(std::binary_search(made->where->contacts.begin(), made->where->contacts.end(), contact));
    CHECK(4 * made->where->dofs.size() <= row.weights.size());
    row.motion.patch(*made, from, 1.0 - from);
    CHECK(row.motion.contacts()[contact].origin() == from);
    exact::PatchedSeries anew(row.model);
    anew.whole = row.whole;
    anew.set_complete(levels);
    for (const double x : {from, 0.5, 0.83, 1.0}) {
      CAPTURE(x);
      motion::Point pieces, whole;
      row.motion.evaluate_at(x, pieces);
      anew.evaluate_at(x - from, whole);
      CHECK(apart(pieces.u, whole.u) <= 4.0 * rounding::many_operations);
      CHECK(apart(pieces.v, whole.v) <= 4.0 * rounding::many_operations);
      CHECK(apart(pieces.a, whole.a) <= 16.0 * rounding::many_operations);
      CHECK(apart(pieces.forces, whole.forces) <= 16.0 * rounding::many_operations);
      motion::Point one;
      row.motion.evaluate_without_accelerations(x, contact, one);
      for (const auto& term : row.model.contacts[contact].normal.terms) {
        CHECK(one.u[term.first] == doctest::Approx(pieces.u[term.first]).epsilon(1e-14));
        CHECK(one.v[term.first] == doctest::Approx(pieces.v[term.first]).epsilon(1e-13));
      }
      CHECK(one.N(row.model.layout, contact) ==
            doctest::Approx(pieces.N(row.model.layout, contact)).epsilon(1e-13));
      CHECK(row.motion.contacts()[contact].value(motion::ContactSeries::N, x) ==
            doctest::Approx(pieces.N(row.model.layout, contact)).epsilon(1e-13));
    }
  }
}

TEST_CASE(
    "a second change beside the first goes on from it, also where its neighbourhood reaches into that") {
  constexpr std::size_t first = 142, second = 170;
  constexpr double later = 0.62;
  Changing row(lively_row(masses), first);
  motion::LocalSeries near(row.systems);
  const auto made = row.expand(near, {first}, 1.0 - from, 0.0);
  REQUIRE(made);
  row.motion.patch(*made, from, 1.0 - from);
  contact::ContactStates states = row.after->states();
  states[second].state = states[second].state == State::open ? State::stick : State::open;
  row.after = row.systems.system_of(states);
  row.x = later;
  row.motion.evaluate_at(later, row.there);
  const auto then = row.expand(near, {second}, 1.0 - later, 0.0);
  REQUIRE(then);
  CHECK(std::binary_search(then->where->contacts.begin(), then->where->contacts.end(), second));
  row.motion.patch(*then, later, 1.0 - later);
  exact::PatchedSeries anew(row.model);
  row.taylor.expand(row.after, row.forcing(), row.time(), row.there.u, row.there.v, levels, scale,
                    anew.whole);
  anew.set_complete(levels);
  motion::Point pieces, whole;
  row.motion.evaluate_at(1.0, pieces);
  anew.evaluate_at(1.0 - later, whole);
  CHECK(apart(pieces.u, whole.u) <= 4.0 * rounding::many_operations);
  CHECK(apart(pieces.v, whole.v) <= 4.0 * rounding::many_operations);
  CHECK(apart(pieces.forces, whole.forces) <= 16.0 * rounding::many_operations);
}

TEST_CASE("what changes in two places, or is felt beyond the neighbourhood, is made anew of the whole") {
  Changing row(lively_row(masses), 150);
  motion::LocalSeries near(row.systems);
  CHECK_FALSE(row.expand(near, {10, 290}, 1.0 - from, 0.0));
  // The states of another contact, far away, changed without a word.
  Changing other(lively_row(masses), 150);
  motion::LocalSeries beside(other.systems);
  const auto made = other.expand(beside, {150}, 1.0 - from, 0.0);
  REQUIRE(made);
  contact::ContactStates states = other.after->states();
  const std::size_t edge = made->where->contacts.front() + 1;
  states[edge].state = states[edge].state == State::open ? State::stick : State::open;
  other.after = other.systems.system_of(states);
  CHECK_FALSE(other.expand(beside, {150}, 1.0 - from, 0.0));
  // Motions so much greater elsewhere that all of this is rounding.
  CHECK(other.expand(beside, {150}, 1.0 - from, 1e20));
}

TEST_CASE("a row no longer than its neighbourhoods has none, and is not asked for ever") {
  Model small = lively_row(40);
  const linear::SystemMatrices structure(small);
  motion::StateSystems systems(small, structure);
  const motion::StateSystemPtr system = systems.system_of(rubbing_mode(small, 7));
  motion::Neighbourhoods near(systems, 12);
  for (const std::size_t c : {3U, 11U, 24U, 38U}) {
    CHECK_FALSE(near.found_none());
    CHECK(near.around(c, *system) == nullptr);
  }
  CHECK(near.found_none());
}
