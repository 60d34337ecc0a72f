// A beam on many contacts, of which each event touches few: decisions near them beside decisions of the whole structure.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <map>
#include <utility>

#include "behaviour/halves.hpp"
#include "behaviour/scene_parts.hpp"
#include "run/run_listener.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::long_beam {
namespace {

constexpr int nodes = 420;  // 1260 unknowns: four neighbourhoods and more

/// The same beam in another way.
struct Seen {
  double turn = 0.0;
  bool mirrored = false;                              // x for -x
  bool backwards = false;                             // contacts and loads the other way round
  double metre = 1.0, kilonewton = 1.0, tonne = 1.0;  // in other units; those of time follow
};

/// On compliant contacts with friction, thrown up by pulses that come from left to right; turned as a whole.
std::string scene_text(const Seen& seen) {
  const double m = seen.metre, kN = seen.kilonewton, t = seen.tonne, s = std::sqrt(t * m / kN);
  const double c = std::cos(seen.turn), sine = std::sin(seen.turn), sign = seen.mirrored ? -1.0 : 1.0;
  const auto vector = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", sign * (c * x - sine * y), sine * x + c * y);
  };
  const auto along_x = [&](double x) { return vector(x * m, 0.0); };
  std::string text = parts::head + "gravity = " + vector(0.0, -9.81 * m / (s * s)) +
                     fmt::format(
                         "\n[run]\nt_end = {:.17g}\noutput_dt = {:.17g}\ninitial = \"static\"\n[damping]\n"
                         "ratios = [0.02, 0.02]\nfrequencies = [{:.17g}, {:.17g}]\n",
                         0.012 * s, 0.004 * s, 1.0 / s, 30.0 / s) +
                     parts::section(2.1e6 * kN, 2.1e4 * kN * m * m, 0.1 * t / m) + "[nodes]\n";
  std::string names;
  for (int i = 0; i < nodes; ++i) {
    text += fmt::format("b{} = {}\n", i, along_x(2.0 * i));
    names += fmt::format("{}\"b{}\"", i > 0 ? ", " : "", i);
  }
  text += "[[members]]\nnodes = [" + names + "]\nsection = \"s\"\nelements = 1\n";
  const auto number = [&](int i) { return seen.backwards ? nodes - 1 - i : i; };
  for (int i = 0; i < nodes; ++i)
    text += fmt::format(
        "[[contacts]]\nname = \"c{0}\"\nnode = \"b{0}\"\nlaw = \"compliant\"\nnormal = {1}\nnormal_stiffness "
        "= {2:.17g}\ntangential_stiffness = {2:.17g}\nfriction = {{ static = 0.35, kinetic = 0.3 }}\n",
        number(i), vector(0.0, 1.0), 1e4 * kN / m);
  for (int k = 0; k < nodes; ++k) {
    const int i = number(k);
    if (i % 9 != 3) continue;
    text += fmt::format(
        "[[loads]]\nnode = \"b{}\"\ndirection = {}\namplitude = {:.17g}\nhistory = {{ type = \"half_sine\", "
        "start "
        "= {:.17g}, duration = {:.17g} }}\n",
        i, vector(0.3 * std::sin(1.7 * i), 1.0), (40.0 + 5.0 * (i % 7)) * kN, 2e-5 * i * s, 0.006 * s);
  }
  return text;
}

/// Asks for whole jets, as whoever observes a run does.
class Onlooker final : public run::RunListener {};

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/long_beam");

TEST_CASE("decisions near the contacts that change are those of the whole structure") {
  for (const char* engine : {"exact", "newmark", "ida"})
    for (const double turn : {0.0, 0.3}) {
      CAPTURE(std::string(engine));
      CAPTURE(turn);
      const Scene read = parse_scene(
          scene_text({turn}), "test.toml",
          {{"run.engine", engine}, {"run.flow", "taylor"}, {"run.dt", "1e-4"}, {"run.certify", "false"}});
      const Model model = build_model(read);
      Result near, whole;
      near.report = simulate(model, read.run, near);
      Onlooker onlooker;
      whole.report = run::simulate(model, read.run, whole, onlooker);
      REQUIRE(near.report.outcome.kind == Outcome::Kind::done);
      CHECK(near.report.law_checks.violations.empty());
      CHECK(near.report.audit.energy.value < 1e-9 * near.report.audit.energy_scale);
      REQUIRE(near.events.size() == whole.events.size());
      CHECK(near.events.size() > 100);
      for (std::size_t i = 0; i < near.events.size(); ++i) {
        CHECK(near.events[i].contact == whole.events[i].contact);
        CHECK(near.events[i].from == whole.events[i].from);
        CHECK(near.events[i].to == whole.events[i].to);
        CHECK(std::abs(near.events[i].t - whole.events[i].t) <= 1e-12);
      }
      // What an event does not reach is not expanded again, and its peaks, works and losses are the same.
      if (std::string(engine) == "exact") CHECK(near.report.counters.solves < whole.report.counters.solves);
      const Audit &a = near.report.audit, &b = whole.report.audit;
      const auto same = [&](double x, double y, double size) { CHECK(std::abs(x - y) <= 1e-10 * size); };
      same(a.final.friction, b.final.friction, b.energy_scale);
      same(a.final.damping, b.final.damping, b.energy_scale);
      same(a.final.loads, b.final.loads, b.energy_scale);
      for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        same(near.report.peaks[c].N, whole.report.peaks[c].N, b.force_scale);
        same(near.report.peaks[c].T, whole.report.peaks[c].T, b.force_scale);
        same(near.report.peaks[c].normal, whole.report.peaks[c].normal, b.length_scale);
      }
    }
}

TEST_CASE("turned, mirrored, numbered backwards and in other units the beam has the same events") {
  const auto run = [](const Seen& seen) {
    const Scene read =
        parse_scene(scene_text(seen), "test.toml",
                    {{"run.engine", "exact"}, {"run.flow", "taylor"}, {"run.certify", "false"}});
    const Model model = build_model(read);
    Result result;
    result.report = simulate(model, read.run, result);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    // By name, in the order of time; mirrored, slip to the right is slip to the left.
    std::map<std::pair<std::string, int>, double> times;
    std::map<std::string, int> count;
    for (const Event& e : result.events) {
      const std::string& name = model.contacts[static_cast<std::size_t>(e.contact)].name;
      times[{name, count[name]++}] = e.t / read.run.t_end;
    }
    return times;
  };
  const auto upright = run({0.4});
  CHECK(upright.size() > 100);
  for (const Seen& seen :
       {Seen{-1.1}, Seen{0.4, true}, Seen{0.4, false, true}, Seen{0.4, false, false, 1e3, 1e3, 1e3},
        Seen{2.2, true, true, 39.37, 0.2248, 2.2}}) {
    const auto other = run(seen);
    CAPTURE(seen.turn);
    CAPTURE(seen.metre);
    CAPTURE(seen.backwards);
    REQUIRE(other.size() == upright.size());
    for (const auto& [which, t] : upright) {
      REQUIRE(other.count(which) == 1);
      CHECK(std::abs(other.at(which) - t) <= 1e-11);
    }
  }
}

TEST_CASE("what a companion would take counts the events that it has to decide") {
  const Scene read =
      parse_scene(scene_text({0.1}), "test.toml", {{"run.engine", "newmark"}, {"run.dt", "1e-4"}});
  Result result;
  const CertifiedReport run = simulate_certified(build_model(read), read.run, result);
  REQUIRE_FALSE(run.certificate);
  CHECK(run.reason.find("a companion run (exact) would take") != std::string::npos);
  CHECK(run.reason.find("less than 0.1 s") == std::string::npos);  // its steps alone
}

TEST_CASE("in two halves the beam has the events of the whole run") {
  const halves::Difference d = halves::split_text(
      scene_text({0.7}), {{"run.engine", "exact"}, {"run.flow", "taylor"}, {"run.certify", "false"}}, 0.437);
  CAPTURE(d.first);
  CHECK(d.events_agree);
  CHECK(d.events > 30);
  CHECK(d.time <= 1e-11);
  CHECK(d.state <= 1e-9);
}

TEST_CASE("series of exact are no longer than events let them be") {
  const Scene read = parse_scene(scene_text({0.2}), "test.toml",
                                 {{"run.engine", "exact"}, {"run.flow", "taylor"}, {"run.certify", "false"}});
  Result result;
  result.report = simulate(build_model(read), read.run, result);
  const auto events = static_cast<double>(result.events.size());
  REQUIRE(events > 100.0);
  // 30 levels a step reach as far as a series goes; events come before it has gone half of that.
  CHECK(static_cast<double>(result.report.counters.solves) <
        25.0 * static_cast<double>(result.report.counters.steps));
}

TEST_SUITE_END();

}  // namespace signorini::tests::long_beam
