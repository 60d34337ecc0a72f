// Decisions that must not depend on angle, size or luck: scenes that were once refused or decided wrongly.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

Result run_scene(const std::string& name, const std::string& engine, const char* rtol = "1e-10") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/" + name + ".toml",
                                 {{"run.engine", engine}, {"run.rtol", rtol}});
  return simulate(build_model(scene), scene.run);
}

/// The frame of models/rigid-frame.toml, turned about A; the mesh is the coarsest.
std::string turned_frame(double degrees) {
  const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
  const auto turned = [&](double x, double y) {
    return fmt::format("[{}, {}]", c * x - s * y, s * x + c * y);
  };
  std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }}\n"
      "gravity = {}\n[run]\nt_end = 0.5\ninitial = \"static\"\noutput_dt = 0.5\n[damping]\n"
      "alpha = 7.328956257220504\n[sections.pipe]\nEA = 9.0e6\nEI = 2.0e6\nmass_per_length = 0.4\n"
      "[nodes]\nA = {}\nB = {}\nC = {}\nD = {}\n[[members]]\nnodes = [\"A\", \"B\", \"C\", \"D\"]\n"
      "section = \"pipe\"\nelements = [1, 1, 1]\n[[supports]]\nnode = \"D\"\nfix = [\"ux\", \"uy\"]\n"
      "[[loads]]\nnode = \"A\"\ndirection = {}\namplitude = 100.0\n"
      "history = {{ type = \"half_sine\", start = 0.0, duration = 0.1 }}\n",
      turned(0.0, -9.81), turned(0.0, 0.0), turned(19.0, 0.0), turned(19.0, -6.0), turned(38.0, -6.0),
      turned(0.5, 0.8660254037844386));
  for (const char* node : {"A", "B"})
    text += fmt::format(
        "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nnormal = {1}\nlaw = \"rigid\"\n"
        "friction = 0.3\nrestitution = 0.0\n",
        node, turned(0.0, 1.0));
  return text;
}

Result run_frame(double degrees, const std::string& engine) {
  const Scene scene = parse_scene(turned_frame(degrees), "frame.toml",
                                  {{"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.dt", "1e-4"}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/decisions");

TEST_CASE("a frame on rigid supports has the same events at every angle") {
  const Result along = run_frame(0.0, "exact");
  REQUIRE(along.report.outcome.kind == Outcome::Kind::done);
  // Its events are those of an integrator that knows nothing of series.
  const Result ida = run_frame(0.0, "ida");
  REQUIRE(along.events.size() > 50);
  REQUIRE(ida.events.size() == along.events.size());
  for (std::size_t i = 0; i < along.events.size(); ++i) {
    CAPTURE(i);
    CHECK(ida.events[i].contact == along.events[i].contact);
    CHECK(ida.events[i].to == along.events[i].to);
    CHECK(std::abs(ida.events[i].t - along.events[i].t) < 1e-8);
  }
  for (const double degrees : {7.0, 23.0, 30.0, 45.0, 51.0, 63.0, 90.0, 111.0, 135.0, 180.0 - 1e-9, 211.0}) {
    CAPTURE(degrees);
    const Result turned = run_frame(degrees, "exact");
    INFO(turned.report.outcome.reason);
    CHECK(turned.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(turned.events.size() == along.events.size());
    for (std::size_t i = 0; i < along.events.size(); ++i) {
      CHECK(turned.events[i].contact == along.events[i].contact);
      CHECK(turned.events[i].to == along.events[i].to);
      CHECK(std::abs(turned.events[i].t - along.events[i].t) < 1e-8);
    }
  }
}

TEST_CASE("two rigid contacts at rest with one regular solution go on") {
  // All degrees of freedom are held, so velocities are the rounding of an equilibrium.
  for (const char* t_end : {"1.5", "1.7", "2.0", "6.0"}) {
    CAPTURE(t_end);
    const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/regular-four-dof.toml",
                                   {{"run.engine", "exact"}, {"run.t_end", t_end}});
    const Result r = simulate(build_model(scene), scene.run);
    INFO(r.report.outcome.reason);
    CHECK(r.report.outcome.kind == Outcome::Kind::done);
    CHECK(r.report.audit.energy.value < 1e-9 * r.report.audit.energy_scale);
  }
}

TEST_CASE("a jump of the surface beside a tangential dashpot below the static limit is no slip") {
  // T jumps to ct * 0.1 = 3.3 < 4. Times of an independent integrator.
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_scene("jump-below-static-limit", engine);
    REQUIRE(r.report.outcome.kind == Outcome::Kind::done);
    std::vector<Event> changes;
    for (const Event& e : r.events)
      if (e.from != e.to) changes.push_back(e);
    REQUIRE(changes.size() == 3);
    const double times[] = {0.3010533778570808, 0.33666330347324047, 0.3977429028708775};
    const State states[] = {State::slip_minus, State::stick, State::slip_minus};
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(std::abs(changes[i].t - times[i]) < 1e-8);
      CHECK(changes[i].to == states[i]);
    }
    // The spring beside the dashpot is the contact's own: between f N / kt of slip and of sticking.
    CHECK(r.report.audit.energy.value < 1e-7 * r.report.audit.energy_scale);
    CHECK(r.report.audit.final.contact > 3.0 * 3.0 / (2.0 * 8000.0));
    CHECK(r.report.audit.final.contact < 4.0 * 4.0 / (2.0 * 8000.0));
  }
}

TEST_CASE("a contact with a tangential dashpot on a node without mass") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_scene("massless-node-dashpot", engine);
    INFO(r.report.outcome.reason);
    CHECK(r.report.outcome.kind == Outcome::Kind::done);
    CHECK(r.events.size() == 10);
    CHECK(r.report.audit.energy.value < 1e-6 * r.report.audit.energy_scale);
  }
}

TEST_CASE("a block turns where its load is just above friction") {
  // v' = -(2 + eps) until v = 0, then v' = -eps: what locating leaves of v is far more than eps undoes in the
  // resolution of the clock.
  for (const std::string& engine : locating_engines)
    for (const double eps : {1e-3, 1e-5, 1e-6, 1e-8, 1e-9})
      for (const double v0 : {2.0, 200.3})
        for (const double degrees : {0.0, 23.0}) {
          CAPTURE(engine);
          CAPTURE(eps);
          CAPTURE(v0);
          CAPTURE(degrees);
          const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
          const std::string text = fmt::format(
              "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
              "[run]\nt_end = 200.0\noutput_dt = 200.0\ninitial = {{ block = {{ vx = {}, vy = {} }} }}\n"
              "[nodes]\nblock = [0.0, 0.0]\n[[masses]]\nnode = \"block\"\nmass = 1.0\n"
              "[[contacts]]\nname = \"floor\"\nnode = \"block\"\nlaw = \"slider\"\ntangent = [{}, {}]\n"
              "normal_force = 1.0\nfriction = 1.0\n"
              "[[loads]]\nnode = \"block\"\ndirection = [{}, {}]\namplitude = {}\n",
              v0 * c, v0 * s, c, s, c, s, -(1.0 + eps));
          const Result r = run_text(text, engine, "1e-10", "0.1");
          INFO(r.report.outcome.reason);
          REQUIRE(r.report.outcome.kind == Outcome::Kind::done);
          CHECK(r.report.undecided == 0);
          REQUIRE(r.events.size() == 1);
          CHECK(r.events[0].from == State::slip_plus);
          CHECK(r.events[0].to == State::slip_minus);
          const double turns = v0 / (2.0 + eps);
          CHECK(r.events[0].t == doctest::Approx(turns).epsilon(1e-9));
          const Vector& v = r.rows.back().v;
          CHECK(v[0] * c + v[1] * s == doctest::Approx(-eps * (200.0 - turns)).epsilon(1e-5));
        }
}

TEST_CASE("ida goes on where a guard touches zero within a step") {
  // IDA halts at the root inside its step, and again at the step's end: that is no step of no length.
  const Scene scene =
      read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/touching-slip-rate.toml", {{"run.engine", "ida"}});
  const Result r = simulate(build_model(scene), scene.run);
  INFO(r.report.outcome.reason);
  CHECK(r.report.outcome.kind == Outcome::Kind::done);
  CHECK(r.report.outcome.t == doctest::Approx(0.5));
  // The touch itself is below the tolerance; c2 turns after it, as `exact` has it.
  CHECK(std::any_of(r.events.begin(), r.events.end(), [](const Event& e) {
    return e.to == State::slip_minus && std::abs(e.t - 0.0676005355236563) < 2e-6;
  }));
}

TEST_CASE("scales do not turn with the scene") {
  const auto scales = [](double degrees) {
    const Scene scene =
        parse_scene(turned_frame(degrees) + "[[loads]]\nnode = \"B\"\nmoment = 1.0e6\n", "frame.toml");
    return build_model(scene).scales;
  };
  const Scales along = scales(0.0);
  for (const double degrees : {17.0, 45.0, 133.0}) {
    CAPTURE(degrees);
    const Scales turned = scales(degrees);
    CHECK(turned.force == doctest::Approx(along.force).epsilon(1e-10));
    CHECK(turned.displacement == doctest::Approx(along.displacement).epsilon(1e-8));
    CHECK(turned.velocity == doctest::Approx(along.velocity).epsilon(1e-8));
  }
}

// Flights lower than the rounding of n . u, two metres along, ended a thousand times above capture_velocity.
TEST_CASE("a ball that slides while it bounces to rest has all its hits at every angle") {
  const auto ball = [](double degrees) {
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
        "gravity = [{:.17g}, {:.17g}]\n[run]\nt_end = 1.2\noutput_dt = 0.4\ninitial = {{ P = {{ ux = "
        "{:.17g}, "
        "uy = {:.17g}, vx = {:.17g}, vy = {:.17g} }} }}\n[nodes]\nP = [0.0, 0.0]\n[[masses]]\nnode = \"P\"\n"
        "mass = 1.0\n[[contacts]]\nname = \"F\"\nnode = \"P\"\nlaw = \"rigid\"\nnormal = [{:.17g}, {:.17g}]\n"
        "friction = 0.05\nrestitution = 0.5\ncapture_velocity = 1e-9\n",
        9.81 * s, -9.81 * c, -0.5 * s, 0.5 * c, 2.0 * c, 2.0 * s, -s, c);
  };
  const double v = std::sqrt(9.81);  // of the first hit; each takes half: 2^-32 of it is below 1e-9
  const double last = v / 9.81 * (1.0 + 2.0 * (1.0 - std::exp2(-31.0)));
  for (const double degrees : {0.0, 1e-7, 17.3, 45.0, 133.0})
    for (const std::string& engine : engines) {
      CAPTURE(degrees);
      CAPTURE(engine);
      const Result result = run_text(ball(degrees), engine);
      std::vector<Event> hits;
      for (const Event& event : result.events)
        if (event.type == EventType::impact) hits.push_back(event);
      REQUIRE(hits.size() == 32);
      CHECK(hits.back().t == doctest::Approx(last).epsilon(engine == "exact" ? 1e-12 : 1e-8));
      CHECK(hits.back().to != State::open);
      // What decided that: half of the last hit, over the slowest that flies.
      REQUIRE(hits.back().departure);
      CHECK(*hits.back().departure == doctest::Approx(v * std::exp2(-32.0) / 1e-9).epsilon(1e-4));
      REQUIRE(hits[30].departure);
      CHECK(*hits[30].departure > 1.0);
    }
}

TEST_CASE("a slider beside a landing lets go where no motion goes on with it held") {
  // By hand, all combinations of c1 and c2 from the forces just before: c1 sticks, c2 slips in the negative
  // direction, N = -26.95, T = -0.162; no other holds.
  const Result result = run_scene("slider-must-let-go", "exact");
  CAPTURE(result.report.outcome.reason);
  CHECK(result.report.outcome.t > 1.513);
  const auto stick = std::find_if(result.events.begin(), result.events.end(), [](const Event& event) {
    return event.t > 1.5123 && event.t < 1.5124 && event.contact == 1;
  });
  REQUIRE(stick != result.events.end());
  CHECK(stick->t == doctest::Approx(1.5123855970672047).epsilon(1e-9));
  CHECK(stick->to == State::stick);
  CHECK(stick->N_after == doctest::Approx(-26.95).epsilon(1e-3));
  CHECK(std::abs(stick->T_after) == doctest::Approx(0.162).epsilon(1e-2));
  const auto slip = std::find_if(result.events.begin(), result.events.end(), [&](const Event& event) {
    return event.t == stick->t && event.contact == 2;
  });
  REQUIRE(slip != result.events.end());
  CHECK(slip->to == State::slip_minus);
}

TEST_CASE("sliders that a hit has stopped are decided with it: forces that are not unique are refused") {
  for (const std::string& engine : engines)
    for (const char* capture : {"1e-4", "1e-7", "1e-12"}) {
      CAPTURE(engine);
      CAPTURE(capture);
      const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/stopped-by-a-hit.toml",
                                     {{"run.engine", engine}, {"contacts.c0.capture_velocity", capture}});
      const Result result = simulate(build_model(scene), scene.run);
      CHECK(result.report.outcome.kind == Outcome::Kind::stopped);
      CHECK(result.report.outcome.t == doctest::Approx(0.74863).epsilon(1e-4));
      CHECK(result.report.outcome.refusal.kind == Refusal::Kind::dependent);
    }
}

// At rest the floor and the guide share the weight of 10 N. N^2 + T^2 is least where the guide bears its limit, 0.6 N.
TEST_CASE("a ball that comes to rest beside a guide shares its weight at every angle, with every engine") {
  // It falls by 9.4 and rises against 10.6 m/s^2; each flight is as much shorter as its first speed.
  const double hit = std::sqrt(2.0 * 9.4 * 0.2), shrinks = 0.5 * std::sqrt(9.4 / 10.6);
  const double rest = hit / 9.4 + 0.5 * hit * (1.0 / 10.6 + 1.0 / std::sqrt(9.4 * 10.6)) / (1.0 - shrinks);
  for (const std::string& engine : locating_engines)
    for (const double degrees : {0.0, 1e-7, 17.3, 100.0, 179.999}) {
      const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
      CAPTURE(engine);
      CAPTURE(degrees);
      const Result result = run_text(
          fmt::format("schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
                      "gravity = [{:.17g}, {:.17g}]\n[run]\nt_end = 0.6\noutput_dt = 0.3\ndt = 1e-3\n"
                      "initial = {{ P = {{ ux = {:.17g}, uy = {:.17g} }} }}\n[nodes]\nP = [0.0, 0.0]\n"
                      "[[masses]]\nnode = \"P\"\nmass = 1.0\n[[contacts]]\nname = \"floor\"\nnode = \"P\"\n"
                      "law = \"rigid\"\nnormal = [{:.17g}, {:.17g}]\nfriction = 0.5\nrestitution = 0.5\n"
                      "[[contacts]]\nname = \"guide\"\nnode = \"P\"\nlaw = \"slider\"\n"
                      "tangent = [{:.17g}, {:.17g}]\nnormal_force = 2.0\nfriction = 0.3\n",
                      10.0 * s, -10.0 * c, -0.2 * s, 0.2 * c, -s, c, -s, c),
          engine);
      CAPTURE(result.report.outcome.reason);
      REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
      REQUIRE(!result.events.empty());
      CHECK(result.events.back().t == doctest::Approx(rest).epsilon(2e-5));
      const Result::Row& last = result.rows.back();
      CHECK(last.v.norm() <= 1e-12);
      CHECK(last.contacts[0].N == doctest::Approx(-9.4));
      CHECK(std::abs(last.contacts[1].T) == doctest::Approx(0.6));
    }
}

TEST_CASE("a belt that turns under a block which stands on a floor turns its friction, and nothing else") {
  // 10 N on the floor bear 5 N, the belt's 2 N 0.6 N: the block stands. The belt turns at (k pi - 0.5)/5.
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "gravity = [0.0, -10.0]\n[run]\nt_end = 3.0\noutput_dt = 0.5\n[nodes]\nP = [0.0, 0.0]\n[[masses]]\n"
      "node = \"P\"\nmass = 1.0\n[[contacts]]\nname = \"floor\"\nnode = \"P\"\nlaw = \"rigid\"\n"
      "normal = [0.0, 1.0]\nfriction = 0.5\n[[contacts]]\nname = \"belt\"\nnode = \"P\"\nlaw = \"slider\"\n"
      "tangent = [1.0, 0.0]\nnormal_force = 2.0\nfriction = 0.3\n"
      "surface_velocity = { type = \"harmonic\", amplitude = 0.1, omega = 5.0, phase = 0.5 }\n";
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result result = run_text(text, engine);
    CAPTURE(result.report.outcome.reason);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    std::vector<Event> turns;
    for (const Event& event : result.events)
      if (event.contact == 1) turns.push_back(event);
    REQUIRE(turns.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(turns[k].type == EventType::reversal);
      CHECK(turns[k].t == doctest::Approx((static_cast<double>(k + 1) * M_PI - 0.5) / 5.0).epsilon(1e-9));
      CHECK(std::abs(turns[k].T_after) == doctest::Approx(0.6));
      CHECK(turns[k].T_after == doctest::Approx(-turns[k].T));
    }
    for (const Result::Row& row : result.rows) CHECK(row.contacts[0].state == State::stick);
  }
}

// Its acceleration towards the beam was looked for with the beam's feet let go: both fall alike, and hits
// injected by the rounding of the gap what restitution took, for ever.
TEST_CASE("newmark: a ball comes to rest on what rests") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/ball-on-beam-turned.toml",
                                 {{"run.engine", "newmark"}});
  const Result result = simulate(build_model(scene), scene.run);
  CAPTURE(result.report.outcome.reason);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.events.size() < 400);
}

// Stiff modes force 16,500 steps within the last slip of `s1`. One tolerance for each made 7e-4 m/s, and its turn by 2e-4 m/s
// was taken for rounding: it went on sliding against its friction.
TEST_CASE("ida: a slip that stiff modes part into many steps ends where it ends") {
  const auto run = [](const char* engine, const char* rtol) {
    const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/many-steps.toml",
                                   {{"run.engine", engine}, {"run.rtol", rtol}});
    return simulate(build_model(scene), scene.run);
  };
  const Result exact = run("exact", "1e-8");
  REQUIRE(exact.events.size() == 206);
  CHECK(exact.events.back().t == doctest::Approx(0.07471149116).epsilon(1e-9));
  for (const char* rtol : {"1e-7", "1e-8"}) {
    CAPTURE(rtol);
    const Result ida = run("ida", rtol);
    CAPTURE(ida.report.outcome.reason);
    CHECK(ida.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(ida.events.size() == exact.events.size());
    for (std::size_t i = 0; i < ida.events.size(); ++i) {
      CHECK(ida.events[i].contact == exact.events[i].contact);
      CHECK(ida.events[i].type == exact.events[i].type);
      CHECK(std::abs(ida.events[i].t - exact.events[i].t) < 1e-6);
    }
  }
}

TEST_CASE("ida: slips slower than its tolerance are named with the key that finds them") {
  const std::string path = SIGNORINI_TEST_DATA "/scenes/decisions/slow-slips.toml";
  const auto run = [&](std::vector<Override> changes) {
    const Scene scene = read_scene(path, std::move(changes));
    return simulate(build_model(scene), scene.run);
  };
  const Result exact = run({{"run.engine", "exact"}});
  CHECK(exact.events.size() > 40);
  const Result coarse = run({{"run.engine", "ida"}, {"run.rtol", "1e-8"}});
  CHECK(coarse.events.size() < exact.events.size());
  const auto said = [](const std::string& warning) {
    return warning.find("slip rate touches zero") != std::string::npos &&
           warning.find("a smaller run.atol.velocity (") != std::string::npos;
  };
  CHECK(std::count_if(coarse.report.warnings.begin(), coarse.report.warnings.end(), said) == 1);
  const Result fine = run({{"run.engine", "ida"}, {"run.rtol", "1e-8"}, {"run.atol.velocity", "1e-14"}});
  REQUIRE(fine.events.size() == exact.events.size());
  for (std::size_t i = 0; i < fine.events.size(); ++i) {
    CHECK(fine.events[i].type == exact.events[i].type);
    CHECK(fine.events[i].t == doctest::Approx(exact.events[i].t).epsilon(1e-6));
  }
}

TEST_CASE("a slider that turns back does not make another slip that its new force would have held") {
  // A bar with consistent mass: m = 1 and 1/2 where the end a is held, k = 100. While b is tried as sticking a bears the load
  // of 3 alone, above its 2.7; in truth b slides on, and the mass between them takes 2 of it.
  const double speed = 0.5916;
  const double turns =
      std::atan2(speed / 10.0, 1.0 / 100.0) / 10.0;  // u'' = 1 - 100 u, u(0) = 0, u'(0) = -speed
  for (const double angle : {0.0, 0.7, 2.9})
    for (const bool other_order : {false, true})
      for (const char* engine : {"exact", "ida", "newmark"}) {
        CAPTURE(angle);
        CAPTURE(other_order);
        CAPTURE(engine);
        const double c = std::cos(angle), s = std::sin(angle);
        const std::string along = fmt::format("[{:.17g}, {:.17g}]", c, s),
                          across = fmt::format("[{:.17g}, {:.17g}]", -s, c);
        const auto slider = [&](const char* node, const char* friction) {
          return fmt::format(
              "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nlaw = \"slider\"\ntangent = {1}\n"
              "normal_force = 1.0\nfriction = {2}\n",
              node, along, friction);
        };
        const std::string held = slider("a", "{ static = 2.7, kinetic = 0.5 }"), turning = slider("b", "1.0");
        const std::string text =
            parts::head + parts::run_table(0.2, 0.1) +
            fmt::format("[run.initial]\nb = {{ vx = {:.17g}, vy = {:.17g} }}\n", -speed * c, -speed * s) +
            parts::section(1.0, 1.0, 3.0) + parts::nodes({{"a", 0.0, 0.0}, {"b", c, s}}) +
            parts::member("a, b", "type = \"bar\"\n") + parts::spring("a", across, 50.0) +
            parts::spring("b", across, 50.0) + parts::spring("b", along, 99.0) +
            fmt::format(
                "[[loads]]\nnode = \"a\"\ndirection = {}\namplitude = 3.0\nhistory = {{ type = "
                "\"constant\" }}\n",
                along) +
            (other_order ? turning + held : held + turning);
        const Scene scene = parse_scene(text, "bar.toml",
                                        {{"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.dt", "1e-4"}});
        const Result result = simulate(build_model(scene), scene.run);
        CHECK(result.report.outcome.kind == Outcome::Kind::done);
        CHECK(result.report.law_checks.violated == 0);
        REQUIRE(result.events.size() == 1);
        CHECK(result.events[0].contact == (other_order ? 0U : 1U));
        CHECK(result.events[0].type == EventType::reversal);
        const double error = std::abs(result.events[0].t - turns);
        CHECK(error < (engine == std::string("exact") ? 2.8e-15
                       : engine == std::string("ida") ? 1e-8
                                                      : 1e-6));
      }
}

TEST_SUITE_END();
