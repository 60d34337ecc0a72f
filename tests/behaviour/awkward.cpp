// Scenes of an unfriendly size or without mass where others have it, through the engines.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Result run_scene(const std::string& name, const std::string& engine, const std::vector<Override>& more = {}) {
  std::vector<Override> changes = more;
  changes.push_back({"run.engine", engine});
  const Scene scene =
      read_scene(std::string(SIGNORINI_TEST_DATA) + "/scenes/awkward/" + name + ".toml", changes);
  return simulate(build_model(scene), scene.run);
}

/// Both feet do the same to the end, and more than `least` things.
void check_feet(const Result& result, std::size_t least) {
  std::vector<Event> feet[2];
  for (const Event& event : result.events)
    if (event.contact >= 0) feet[event.contact].push_back(event);
  REQUIRE(feet[0].size() == feet[1].size());
  CHECK(feet[0].size() > least);
  for (std::size_t i = 0; i < feet[0].size(); ++i) {
    const Event &left = feet[0][i], &right = feet[1][i];
    CAPTURE(left.t);
    CHECK(left.type == right.type);
    if (left.type == EventType::impact)  // together: one after the other they would end otherwise
      CHECK(left.t == right.t);
    else
      CHECK(std::abs(left.t - right.t) < 1e-12);
  }
}

/// The same events, at times that differ by so much at most.
void check_events(const Result& reference, const Result& other, double off) {
  CHECK(other.report.outcome.reason == "");
  REQUIRE(other.events.size() == reference.events.size());
  for (std::size_t i = 0; i < reference.events.size(); ++i) {
    CAPTURE(i);
    CAPTURE(reference.events[i].t);
    CHECK(other.events[i].contact == reference.events[i].contact);
    CHECK(other.events[i].from == reference.events[i].from);
    CHECK(other.events[i].to == reference.events[i].to);
    CHECK(std::abs(other.events[i].t - reference.events[i].t) < off);
  }
}

void check_energy(const Result& result) {
  const Audit& audit = result.report.audit;
  CHECK(audit.energy.value < 1e-6 * audit.energy_scale);
}

}  // namespace

TEST_SUITE("behaviour/awkward") {
  TEST_CASE("a belt in micrometres: friction says how far it goes") {
    const Result result = run_scene("belt-micrometre", "ida", {{"run.rtol", "1e-8"}});
    std::vector<double> slips;
    for (const Event& event : result.events)
      if (event.type == EventType::slip) slips.push_back(event.t);
    REQUIRE(slips.size() >= 3);
    // It slips back until sin t = 0.2, then rides with the belt until the spring holds the static limit.
    const double first = std::asin(0.2) + (0.5 + std::sqrt(0.96)) / 0.2;
    CHECK(std::abs(slips[0] - first) < 1e-6);
    const double period = std::numbers::pi + 2.0 * std::atan(0.4) + 5.0;
    for (std::size_t i = 1; i < slips.size(); ++i) CHECK(std::abs(slips[i] - slips[i - 1] - period) < 1e-6);
  }

  TEST_CASE("a million tonnes on a rigid floor") {
    // Rebounds rest below a velocity that follows rtol, in exact, too.
    const Result exact = run_scene("point-1e9kg", "exact", {{"run.rtol", "1e-10"}});
    CHECK(exact.events.size() > 10);
    check_events(exact, run_scene("point-1e9kg", "ida", {{"run.rtol", "1e-10"}}), 1e-6);
  }

  TEST_CASE(
      "an oscillator that sticks at its limit, on its own spring: it touches the limit and does not slip") {
    for (const char* rtol : {"1e-9", "1e-10", "1e-11", "1e-12"}) {
      CAPTURE(rtol);
      const Scene scene = read_scene(std::string(SIGNORINI_MODELS) + "/oscillator.toml",
                                     {{"run.engine", "ida"}, {"run.rtol", rtol}});
      CHECK(simulate(build_model(scene), scene.run).events.size() == 12);
    }
  }

  TEST_CASE("a symmetric trestle: both feet do the same to the end") {
    const Result result = run_scene("symmetric-trestle", "exact");
    check_feet(result, 50);
    // What `ida` finds: nothing but rounding stood between the feet.
    check_events(result, run_scene("symmetric-trestle", "ida"), 1e-6);
  }

  // Its landings are known to the rounding of a sum over modes, and flights shorter than that end there: half as
  // many hits as in series, whose flights begin with g = 0.
  TEST_CASE("a symmetric trestle in complex modes: both feet do the same, and hits say how sharp they are") {
    const Result modes = run_scene("symmetric-trestle", "exact", {{"run.flow", "modal"}});
    CHECK(modes.report.outcome.reason == "");
    check_feet(modes, 20);
    const Result series = run_scene("symmetric-trestle", "exact", {{"run.flow", "taylor"}});
    double sharpest = 1.0;
    for (std::size_t i = 0; i < modes.events.size() && modes.events[i].t < 0.0302; ++i) {
      const Event &one = modes.events[i], &other = series.events[i];
      CAPTURE(other.t);
      REQUIRE(one.type == other.type);
      const double uncertainty = one.t_uncertainty.value_or(0.0);
      CHECK(std::abs(one.t - other.t) <= 2.0 * uncertainty + 1e-12);
      if (one.type == EventType::impact) sharpest = std::min(sharpest, uncertainty);
    }
    CHECK(sharpest > 1e-11);
    CHECK(sharpest < 1e-9);
  }

  TEST_CASE("massless members with beta K: their rotation as one body has no damper") {
    for (const char* name : {"massless-frame", "massless-truss"}) {
      CAPTURE(name);
      const Result exact = run_scene(name, "exact");
      CHECK(exact.report.outcome.reason == "");
      CHECK(exact.events.size() > 2);
      check_energy(exact);
      const Result ida = run_scene(name, "ida", {{"run.rtol", "1e-10"}});
      check_events(exact, ida, 1e-6);
      check_energy(ida);
      const Result newmark = run_scene(name, "newmark", {{"run.dt", "1e-4"}});
      check_events(exact, newmark, 1e-4);
    }
  }
}
