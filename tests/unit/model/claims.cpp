// What the headers of models/*.toml claim, cheaply: each is read, built and run as far as its claims reach.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

constexpr double pi = 3.14159265358979323846;

struct Computed {
  Scene scene;
  Model model;
  Result result;

  Computed(const std::string& name, const std::vector<Override>& changes)
      : scene(read_scene(SIGNORINI_MODELS "/" + name + ".toml", changes)),
        model(build_model(scene)),
        result(simulate(model, scene.run)) {
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
  }
  [[nodiscard]] std::vector<Event> events(const std::string& contact) const {
    std::vector<Event> found;
    for (const Event& e : result.events)
      if (e.contact >= 0 && model.contacts[static_cast<std::size_t>(e.contact)].name == contact)
        found.push_back(e);
    return found;
  }
  [[nodiscard]] double first_slip(const std::string& contact) const {
    for (const Event& e : events(contact))
      if (e.type == EventType::slip) return e.t;
    return -1.0;
  }
};

}  // namespace

TEST_SUITE("unit/model/claims") {
  TEST_CASE("every model has its claims below") {
    const std::set<std::string> known = {
        "belt",     "chain",      "coulomb-pad", "cracked-block", "den-hartog", "dry-joint",   "lift-off",
        "matrices", "oscillator", "pipe-shoe",   "pipeline",      "piping",     "rigid-frame", "rocking"};
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(SIGNORINI_MODELS))
      if (entry.path().extension() == ".toml") found.insert(entry.path().stem().string());
    CHECK(found == known);
  }

  TEST_CASE("coulomb-pad turns at -0.65, 0.45, -0.25 and stays at 0.05 mm") {
    std::vector<double> times;
    for (int k = 1; k <= 4; ++k) times.push_back(k * pi / 100.0);
    Scene scene = read_scene(SIGNORINI_MODELS "/coulomb-pad.toml");
    scene.run.output_times = times;
    const Model model = build_model(scene);
    const Result result = simulate(model, scene.run);
    REQUIRE(result.events.size() == 4);
    REQUIRE(result.rows.size() >= 4);
    const double turns[] = {-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3};
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(result.events[k].t == doctest::Approx(times[k]).epsilon(1e-7));
      CHECK(result.events[k].type == (k < 3 ? EventType::reversal : EventType::stick));
      CHECK(result.rows[k].u[0] == doctest::Approx(turns[k]).epsilon(1e-4));
    }
    CHECK(result.rows.back().u[0] == doctest::Approx(0.05e-3).epsilon(1e-4));
    CHECK(std::abs(result.events[3].T_after) == doctest::Approx(0.5).epsilon(1e-4));
  }

  TEST_CASE("den-hartog stops twice a cycle, to opposite sides") {
    const Computed run("den-hartog", {});
    const auto& events = run.result.events;
    REQUIRE(events.size() > 16);
    const double period = 4.0 * pi;
    for (std::size_t k = 12; k + 2 < events.size(); ++k) {
      const bool slips = events[k].type == EventType::slip;
      CHECK(events[k + 1].type == (slips ? EventType::stick : EventType::slip));
      CHECK(events[k + 2].t - events[k].t == doctest::Approx(period / 2.0).epsilon(2e-3));
      if (slips) CHECK(slip_sign(events[k].to) == -slip_sign(events[k + 2].to));
    }
  }

  TEST_CASE("lift-off lifts off, lands, hops once and settles") {
    const Computed run("lift-off", {});
    std::vector<double> opens, lands;
    for (const Event& e : run.events("left")) {
      if (e.type == EventType::separation) opens.push_back(e.t);
      if (e.type == EventType::contact) lands.push_back(e.t);
    }
    REQUIRE(opens.size() == 2);
    REQUIRE(lands.size() == 2);
    CHECK(opens[0] == doctest::Approx(0.032).epsilon(0.02));
    CHECK(lands[0] == doctest::Approx(0.161).epsilon(0.01));
    double gap = 0.0, blow = 0.0, pull = 0.0;
    for (const auto& row : run.result.rows) {
      gap = std::max(gap, row.contacts[0].gap);
      if (row.t > 0.1) blow = std::max(blow, -row.contacts[0].N);
      for (const auto& c : row.contacts) pull = std::max(pull, c.N);
    }
    CHECK(gap == doctest::Approx(4e-3).epsilon(0.03));
    CHECK(blow == doctest::Approx(2.0 * 12.75).epsilon(0.1));
    CHECK(pull <= 1e-9);
    CHECK(run.model.statics.reactions[0] == doctest::Approx(12.75).epsilon(1e-3));
    CHECK(run.result.rows.back().contacts[0].N == doctest::Approx(-12.75).epsilon(0.03));
    const double pressed_in = run.events("left")[1].gap.value();
    CHECK(pressed_in < 0.0);
  }

  TEST_CASE("piping: heat slides the pipe out from its anchor, friction holds 12 mm of it back") {
    const Model model = build_model(read_scene(SIGNORINI_MODELS "/piping.toml"));
    double ends = 0.0;
    for (std::size_t i = 0; i < model.dofs.size(); ++i)
      if (model.dofs[i].displacement == "P100.ux") ends = model.u0[static_cast<Eigen::Index>(i)];
    const double weight = 0.22 * 9.81, out = 1.2e-5 * 60.0 * 300.0;
    CHECK(ends == doctest::Approx(out - 0.3 * weight * 300.0 * 300.0 / (2.0 * 2.35e6)).epsilon(5e-4));
    CHECK(model.statics.reactions[10] == doctest::Approx(12.0 * weight).epsilon(1e-3));
    double friction = 0.0;
    for (std::size_t k = 0; k < 25; ++k) friction -= model.contacts[k].initial_shear;
    CHECK(friction == doctest::Approx(0.3 * weight * 300.0).epsilon(0.03));
  }

  TEST_CASE("chain: the front of slip creeps back") {
    const Computed run("chain", {{"run.t_end", "20"}, {"run.frames", "[]"}});
    CHECK(run.first_slip("c10") == doctest::Approx(2.04).epsilon(0.01));
    CHECK(run.first_slip("c9") == doctest::Approx(5.5).epsilon(0.02));
    CHECK(run.first_slip("c8") == doctest::Approx(9.9).epsilon(0.02));
    CHECK(run.first_slip("c7") == doctest::Approx(17.0).epsilon(0.03));
    CHECK(run.first_slip("c6") < 0.0);
  }

  TEST_CASE("rocking: the first impacts 0.20205 s and 0.17607 s apart, rest on both feet after 1.608 s") {
    const Computed run("rocking", {});
    const auto left = run.events("foot-L"), right = run.events("foot-R");
    const auto first = [](const std::vector<Event>& events) {
      return std::find_if(events.begin(), events.end(),
                          [](const Event& e) { return e.type == EventType::impact; });
    };
    REQUIRE((first(left) != left.end() && first(right) != right.end()));
    CHECK(first(right)->t == doctest::Approx(0.20205).epsilon(1e-4));
    CHECK(first(left)->t - first(right)->t == doctest::Approx(0.17607).epsilon(1e-4));
    CHECK(run.result.events.back().t == doctest::Approx(1.6085).epsilon(1e-3));
    for (const ContactSample& contact : run.result.rows.back().contacts) CHECK(contact.state == State::stick);
  }

  TEST_CASE("belt: static friction gives way at 7.6 s, then a limit cycle") {
    const Computed run("belt", {{"run.t_end", "45"}});
    const auto events = run.events("belt");
    REQUIRE(events.size() > 8);
    CHECK(run.first_slip("belt") == doctest::Approx(7.6).epsilon(1e-3));
    for (const Event& e : events)
      if (e.type == EventType::slip) {
        CHECK(std::abs(e.T) == doctest::Approx(1.5));
        CHECK(std::abs(e.T_after) == doctest::Approx(1.0));
      }
    const std::size_t n = events.size();
    CHECK(events[n - 1].t - events[n - 3].t ==
          doctest::Approx(events[n - 3].t - events[n - 5].t).epsilon(1e-6));
  }

  TEST_CASE("oscillator: the envelope falls by 0.2 m a half swing and ends at -0.03 m") {
    const Computed run("oscillator", {});
    double least = 0.0;
    for (const auto& row : run.result.rows) least = std::min(least, row.u[0]);
    CHECK(least == doctest::Approx(-0.83).epsilon(1e-3));
    CHECK(run.result.rows.back().u[0] == doctest::Approx(-0.03).epsilon(0.01));
    CHECK(run.result.events.back().type == EventType::stick);
  }

  TEST_CASE("matrices: the floor sticks and slips, the stop opens and closes") {
    const Computed run("matrices", {{"run.t_end", "3"}});
    std::set<EventType> floor, stop;
    for (const Event& e : run.events("floor")) floor.insert(e.type);
    for (const Event& e : run.events("stop")) stop.insert(e.type);
    CHECK(floor.contains(EventType::stick));
    CHECK(floor.contains(EventType::slip));
    CHECK(stop == std::set<EventType>{EventType::contact, EventType::separation});
  }

  TEST_CASE("dry-joint: the upper block stays behind as Newmark's block; the joint stays pressed") {
    const Computed run("dry-joint", {});
    CHECK(std::abs(run.result.responses.back().values[0] / -0.0213 - 1.0) <= 0.02);
    for (const Event& e : run.result.events) CHECK(e.type != EventType::separation);
  }

  TEST_CASE(
      "pipe-shoe: slides by the heat less what friction takes; a sixth of the sole and more lifts off") {
    const Computed run("pipe-shoe", {});
    CHECK(std::abs(run.result.responses.back().values[0] / 0.01199 - 1.0) <= 2e-3);
    const SeamSpec& sole = run.scene.seams.front();
    bool found = false;
    for (const auto& row : run.result.rows) {
      if (std::abs(row.t - 0.6) > 1e-9) continue;
      found = true;
      double open = 0.0, most = 0.0;
      for (std::size_t k = 0; k < sole.nodes.size(); ++k) {
        if (is_open(row.contacts[k].state)) open += sole.nodes[k].length;
        most = std::max(most, -row.contacts[k].N / (0.2 * sole.nodes[k].length));
      }
      CHECK(std::abs(open - 0.07) <= 0.025);  // an element
      CHECK(most == doctest::Approx(121e3).epsilon(0.1));
    }
    CHECK(found);
  }

  TEST_CASE("cracked-block: half a period closed, half a period open") {
    const Computed run("cracked-block", {});
    // Upward zeros after the push.
    std::vector<double> zeros;
    for (std::size_t i = 1; i < run.result.responses.size(); ++i) {
      const auto &a = run.result.responses[i - 1], &b = run.result.responses[i];
      if (a.t > 0.06 && a.values[0] < 0.0 && b.values[0] >= 0.0) zeros.push_back(b.t);
    }
    REQUIRE(zeros.size() >= 4);
    const double f = static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
    CHECK(f < 57.1);
    CHECK(f > 0.8 * 57.1);
  }

  TEST_CASE("pipeline: the first support slips, lifts off and lands sliding") {
    const Computed run("pipeline", {{"run.t_end", "0.155"}});
    const auto events = run.events("first");
    REQUIRE(events.size() >= 3);
    CHECK(events[0].type == EventType::slip);
    CHECK(events[0].t == doctest::Approx(1.939e-3).epsilon(1e-3));
    CHECK(events[1].type == EventType::separation);
    CHECK(events[1].t == doctest::Approx(2.631e-3).epsilon(1e-3));
    CHECK(events.back().type == EventType::contact);
    CHECK(events.back().t == doctest::Approx(0.15487).epsilon(1e-4));
    CHECK(events.back().to == State::slip_plus);
  }
}
