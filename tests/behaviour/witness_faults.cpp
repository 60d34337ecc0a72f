// Errors that are planted in a run: each that changes the result is noticed by the run's witness, with every engine; on
// scenes with rigid impacts, with sliders, and with compliant contacts alone, none along an axis.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "behaviour/witness_scenes.hpp"
#include "contact/motion.hpp"

using namespace signorini;
using namespace signorini::tests::witnessed;

TEST_SUITE_BEGIN("behaviour/witness_faults");

namespace {

/// Changes the first decision that it can.
class Once : public run::FaultInjector {
 public:
  bool done = false;
  bool change(const contact::ContactStates& states, const Vector& v, decide::Decision& decided) override {
    if (done || decided.jet.t < 0.05) return false;
    return done = plant(states, v, decided);
  }

 protected:
  virtual bool plant(const contact::ContactStates& states, const Vector& v, decide::Decision& decided) = 0;
};

class Nothing final : public run::FaultInjector {};

/// The hit happens, and leaves no impulse in the record.
class ImpulseLeftOut final : public Once {
  bool plant(const contact::ContactStates&, const Vector&, decide::Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    decided.impulses.clear();
    decided.single_impacts.clear();
    return true;
  }
};

/// The hit is swallowed: it is held at rest.
class HitSwallowed final : public Once {
  bool plant(const contact::ContactStates&, const Vector& v, decide::Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    decided.impulses.clear();
    decided.single_impacts.clear();
    decided.v = v;
    decided.states[0] = {State::slip_plus, 0.0};
    return true;
  }
};

class RestitutionIgnored final : public run::FaultInjector {
 public:
  void correct(Model& model) override { model.contacts[0].restitution = 0.8; }
};

class WrongSign final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    if (before[1].state != State::stick) return false;
    State& state = decided.states[1].state;
    if (state != State::slip_plus && state != State::slip_minus) return false;
    state = state == State::slip_plus ? State::slip_minus : State::slip_plus;
    return true;
  }
};

/// What slides sticks at a hit of the other.
class NeighbourStuck final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    if (before[1].state != State::slip_plus && before[1].state != State::slip_minus) return false;
    if (decided.states[1].state != before[1].state) return false;
    decided.states[1] = {State::stick, decided.before[1].ut - decided.before[1].T / 2e4};
    return true;
  }
};

/// An event of the compliant foot is found too late. In the units that are computed in.
class Late final : public run::FaultInjector {
 public:
  double at = 0.0, by = 0.0;
  double late(const engine::Step& step, const decide::Decision&) override {
    return !step.triggered.empty() && step.triggered[0].contact == 1 && std::abs(step.end - at) < 1e-6 * at
               ? by
               : 0.0;
  }
};

class AnchorReset final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    if (before[1].is_open() || decided.states[1].state != State::stick || before[1].state == State::stick)
      return false;
    decided.states[1].anchor = decided.before[1].ut;
    return true;
  }
};

class Skipped final : public run::FaultInjector {
 public:
  void watch(std::vector<decide::GuardStart>& guards) override {
    for (std::size_t i = 3; i < guards.size(); ++i) guards[i].kind = Guard::none;
  }
};

class PeaksAtEnds final : public run::FaultInjector {
  bool skips_interior_peaks() override { return true; }
};

// Of scenes without impacts.

/// What slides sticks, for nothing.
class Stuck final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    for (std::size_t k = 0; k < before.size(); ++k) {
      const State now = decided.states[k].state;
      if ((now != State::slip_plus && now != State::slip_minus) || before[k].state != now) continue;
      decided.states[k] = {State::stick, decided.before[k].ut};
      return true;
    }
    return false;
  }
};

/// The first slip of any goes the other way.
class OtherWay final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    for (std::size_t k = 0; k < before.size(); ++k) {
      State& now = decided.states[k].state;
      if (before[k].state != State::stick || (now != State::slip_plus && now != State::slip_minus)) continue;
      now = now == State::slip_plus ? State::slip_minus : State::slip_plus;
      return true;
    }
    return false;
  }
};

/// The guards of the second contact are not seen.
class SecondSkipped final : public run::FaultInjector {
 public:
  void watch(std::vector<decide::GuardStart>& guards) override {
    for (std::size_t i = 3; i < 6; ++i) guards[i].kind = Guard::none;
  }
};

/// Where the second contact comes to stick it forgets its force.
class SecondAnchorReset final : public Once {
  bool plant(const contact::ContactStates& before, const Vector&, decide::Decision& decided) override {
    if (before[1].is_open() || decided.states[1].state != State::stick || before[1].state == State::stick)
      return false;
    decided.states[1].anchor = decided.before[1].ut;
    return true;
  }
};

constexpr const char* without_impacts[] = {sliders_text, feet_text};

}  // namespace

TEST_CASE("planted faults: none without a fault") {
  for (const char* text : {scene_text, sliders_text, feet_text})
    for (const Way& way : ways) {
      CAPTURE(text);
      CAPTURE(to_string(way.engine));
      CAPTURE(static_cast<int>(way.flow));
      Nothing nothing;
      const Result run = run_of(text, way, nothing);
      CHECK(run.report.outcome.reason == "");
      CHECK(run.events.size() > 20);
      CHECK(run.report.law_checks.checked > 40);
      CHECK(run.report.law_checks.violated == 0);
      tell(run.report.law_checks);
    }
}

TEST_CASE_TEMPLATE("planted faults: noticed by every engine", Fault, ImpulseLeftOut, HitSwallowed,
                   RestitutionIgnored, WrongSign, NeighbourStuck, AnchorReset, Skipped) {
  for (const Way& way : ways) {
    CAPTURE(to_string(way.engine));
    CAPTURE(static_cast<int>(way.flow));
    Fault fault;
    const Report report = run_with(way, fault);
    CHECK(report.law_checks.violated > 0);
  }
}

TEST_CASE_TEMPLATE("planted faults: noticed where nothing hits", Fault, Stuck, OtherWay, SecondSkipped,
                   SecondAnchorReset) {
  for (const char* text : without_impacts)
    for (const Way& way : ways) {
      if (text == feet_text && std::is_same_v<Fault, SecondAnchorReset>)
        continue;  // a dashpot: p is an unknown
      CAPTURE(text);
      CAPTURE(to_string(way.engine));
      CAPTURE(static_cast<int>(way.flow));
      Fault fault;
      const Report report = run_of(text, way, fault).report;
      CHECK(report.law_checks.violated > 0);
    }
}

TEST_CASE("planted faults: late by ten times what the event says of its time") {
  for (const Way& way : ways) {
    CAPTURE(to_string(way.engine));
    CAPTURE(static_cast<int>(way.flow));
    Nothing nothing;
    const Result run = run_of(scene_text, way, nothing);
    const double unit = build_model(parse_scene(scene_text, "planted.toml")).internal_units.time;
    int tried = 0;
    for (const Event& event : run.events) {
      if (event.t < 0.05 || event.contact != 1 || event.type != EventType::slip || !event.t_uncertainty)
        continue;
      // Limits of sums over modes grow with the way that the free blocks have gone.
      if (way.flow == Flow::modal && event.t > 0.6) continue;
      CAPTURE(event.t);
      Late late;
      late.at = event.t / unit;
      // Of series and sums ten roundings are less than what a solve is known to: there by what moves T by 2e-6 N, a
      // hundred times 1000 eps of the spring's terms. Sums over modes are known to 1e-12 of the energy in the lowest one:
      // by a hundred thousandth of T.
      const double moved = way.flow == Flow::modal ? 1e-4 : 2e-6;
      late.by =
          std::max(10.0 * *event.t_uncertainty, moved / std::abs(event.guard_rate.value_or(1.0))) / unit;
      CHECK(run_of(scene_text, way, late).report.law_checks.violated > 0);
      ++tried;
    }
    CHECK(tried > 1);
  }
}

TEST_CASE("planted faults: peaks from ends of steps") {
  int changed = 0;
  for (const char* text : {scene_text, sliders_text, feet_text})
    for (const Way& way : ways) {
      CAPTURE(text);
      CAPTURE(to_string(way.engine));
      CAPTURE(static_cast<int>(way.flow));
      Nothing nothing;
      PeaksAtEnds at_ends;
      const Report whole = run_of(text, way, nothing).report, ends = run_of(text, way, at_ends).report;
      double lost = 0.0;
      for (std::size_t k = 0; k < whole.peaks.size(); ++k)
        for (double Peak::*one : {&Peak::tangential, &Peak::normal, &Peak::N, &Peak::T})
          lost = std::max(lost,
                          (whole.peaks[k].*one - ends.peaks[k].*one) / std::max(1e-300, whole.peaks[k].*one));
      if (lost < 1e-9) continue;
      ++changed;
      CHECK(ends.law_checks.violated > 0);
    }
  CHECK(changed > 3);
}

TEST_SUITE_END();
