#include "engine/newmark/step_guards.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "motion/state_systems.hpp"
#include "unit/linear/rubbing_row.hpp"

using namespace signorini;

namespace {

/// A decision as far as guards ask for it.
decide::Decision decided(const Model& model, motion::StateSystems& systems,
                         const contact::ContactStates& contact_states, std::size_t waiting) {
  decide::Decision decision;
  decision.states = contact_states;
  decision.layout = model.layout;
  decision.system = systems.system_of(contact_states);
  decision.forms = decide::GuardForms(contact_states.size());
  for (std::size_t k = 0; k < contact_states.size(); ++k) {
    decision.forms.set(k, contact::guards(model.contacts[k], contact_states[k]));
    for (const GuardForm& guard : decision.forms[k])
      decision.guards.push_back({guard.kind, false, 0, 1e-9 * static_cast<double>(k)});
  }
  decide::GuardStart& first = decision.guards[model.layout.guard(waiting)];
  first.at_zero = first.kind != Guard::none;
  return decision;
}

/// Motions that let some guards fall and others not.
motion::Point moving(const Model& model, double t) {
  const Eigen::Index n = model.size();
  const auto wave = [&](double amplitude, double omega) -> Vector {
    return amplitude * (omega * t + Vector::LinSpaced(n, 0.0, 40.0).array()).sin();
  };
  const auto forces = [&](double omega) -> Vector {
    return 5.0 * (omega * t + Vector::LinSpaced(2 * n / 2, 0.0, 90.0).array()).cos() - 4.0;
  };
  return {wave(0.02, 3.0), wave(0.4, 5.0), forces(7.0), wave(6.0, 2.0)};
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/newmark/step_guards");

TEST_CASE(
    "values, rates and what is noticed are those of every guard by itself, also where some states change") {
  Model model = rubbing_row(60);
  Piece drift;
  drift.coefficients = {0.01, 0.3};
  model.contacts[20].surface_motion = History(drift);
  model.contacts[21].surface_motion = History::constant(0.004);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  newmark::StepGuards seen(model);
  contact::ContactStates contact_states = rubbing_mode(model, 1234567);
  const double h = 0.03;
  double t = 0.0;
  int dips = 0, falls = 0, at_rest = 0;
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    for (std::size_t k = 0; round > 0 && k < 3; ++k)
      contact_states[(7 * static_cast<std::size_t>(round) + 11 * k) % contact_states.size()].state =
          k == 0   ? State::stick
          : k == 1 ? State::open
                   : State::slip_plus;
    const auto waiting = static_cast<std::size_t>(5 * round) % contact_states.size();
    const decide::Decision decision = decided(model, systems, contact_states, waiting);
    seen.start({10.0, &decision, &forcing, round > 0});
    seen.evaluate(moving(model, t), t);
    for (int step = 0; step < 3; ++step, t += h) {
      seen.begin_next_step();
      const motion::Point points[] = {moving(model, t - h), moving(model, t), moving(model, t + h)};
      seen.evaluate(points[2], t + h);
      const double h_before = step == 0 ? 0.0 : h;
      const std::vector<std::size_t> noticed = seen.candidate_slots(h, h_before);
      for (std::size_t slot = 0; slot < decision.guards.size(); ++slot) {
        CAPTURE(slot);
        const decide::GuardStart& guard = decision.guards[slot];
        const bool listed = std::find(noticed.begin(), noticed.end(), slot) != noticed.end();
        if (guard.kind == Guard::none) {
          CHECK_FALSE(listed);
          continue;
        }
        const std::size_t k = model.layout.contact_of_guard(slot);
        double value[3];
        for (int i = 0; i < 3; ++i)
          value[i] = decision.form(slot).value(
              motion::motion_of(model.contacts[k], k, forcing, t + (i - 1) * h, points[i]));
        const events::GuardCubic path = seen.path(slot, h);
        CHECK(path.g0 == doctest::Approx(value[1]).epsilon(1e-13).scale(10.0));
        CHECK(path.g1 == doctest::Approx(value[2]).epsilon(1e-13).scale(10.0));
        if (seen.has_rate(slot)) {
          // The law of a closed contact, by hand: N' = kn g' (+ cn g''), T' = kt ut' or -s f N'.
          const ContactMotion m = motion::motion_of(model.contacts[k], k, forcing, t + h, points[2]);
          const Rows rows = signorini::contact::rows(model.contacts[k], contact_states[k]);
          ContactMotion d;
          d.gap = m.vn;
          d.ut = m.vt;
          d.vn = m.an;
          d.vt = m.at;
          d.N = -rows.normal.gap * m.vn - rows.normal.vn * m.an;
          d.T = -rows.tangent.N * d.N - rows.tangent.ut * m.vt;
          CHECK(path.r1 == doctest::Approx(h * decision.form(slot).rate(d)).epsilon(1e-12).scale(10.0));
        }
        const bool waits = slot == model.layout.guard(waiting) && !seen.active_guards().armed(slot);
        const auto dip = seen.dip(slot, h, h_before);
        if (waits) CHECK(listed);
        if (path.g1 <= 0.0 || dip) CHECK(listed);
        dips += path.g1 > 0.0 && dip ? 1 : 0;
        falls += path.g1 <= 0.0 ? 1 : 0;
        at_rest += listed ? 0 : 1;
      }
      seen.update_active_guards(t + h, points[2]);
      const std::size_t slot = model.layout.guard(waiting);
      if (decision.guards[slot].at_zero && seen.path(slot, h).g1 > seen.level(slot, t + h, points[2]))
        CHECK(seen.active_guards().armed(slot));
    }
  }
  CHECK(dips > 20);
  CHECK(falls > 100);
  CHECK(at_rest > 500);
}

TEST_CASE("what was dismissed dips no more, until the next step") {
  const Model model = rubbing_row(2);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  const contact::ContactStates contact_states(2, ContactState{State::open, 0.0});
  const decide::Decision decision = decided(model, systems, contact_states, 0);
  newmark::StepGuards seen(model);
  seen.start({10.0, &decision, &forcing, false});
  motion::Point point{Vector::Zero(4), Vector::Zero(4), Vector::Zero(4), Vector::Zero(4)};
  const Combination& normal = model.contacts[1].normal;
  for (const auto& [dof, factor] : normal.terms) {
    point.u[dof] = 0.02 * factor;  // the gap is 0.01
    point.v[dof] = -1.0 * factor;
  }
  seen.evaluate(point, 0.0);
  seen.begin_next_step();
  point.v = -point.v;
  seen.evaluate(point, 0.1);
  const std::size_t slot = model.layout.guard(1);
  REQUIRE(seen.dip(slot, 0.1, 0.0));
  CHECK(*seen.dip(slot, 0.1, 0.0) == doctest::Approx(0.5));
  seen.dismiss(slot);
  CHECK_FALSE(seen.dip(slot, 0.1, 0.0));
  seen.begin_next_step();
  seen.evaluate(point, 0.2);
  CHECK_FALSE(seen.dip(slot, 0.1, 0.0));  // it rises all along
}

TEST_SUITE_END();
