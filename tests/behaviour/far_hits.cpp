// What a hit at one end of a long beam does at the other: in a consistent mass matrix each node takes some 0.28 of what its
// neighbour takes, so that 24 nodes away a hit of 0.05 m/s moves a foot by 1e-15 m/s. Where that is rounding no contact may
// be decided by it, whichever way the beam lies; where it is not, what the decision makes of it is no break of a law.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "signorini/scene.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::far_hits {
namespace {

/// A beam of n nodes, 2 m apart, above the ground at an angle; moving along it at 0.5 m/s where it slides. a_metre: 1, or
/// 1000 in mm and t.
class Beam {
 public:
  Beam(int nodes, double angle, double a_metre = 1.0)
      : nodes_(nodes), c_(std::cos(angle)), s_(std::sin(angle)), m_(a_metre) {}

  [[nodiscard]] std::string at(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", c_ * x - s_ * y, s_ * x + c_ * y);
  }
  [[nodiscard]] std::string last() const { return fmt::format("b{}", nodes_ - 1); }
  [[nodiscard]] std::string scene(double t_end, double speed) const {
    std::string text = fmt::format(
        "schema = 1\nunits = {{ force = \"N\", {}, time = \"s\" }}\ngravity = {}\n[run]\nt_end = {}\n"
        "output_dt = 0.01\ncertify = false\n[run.initial]\n",
        m_ > 1.0 ? "mass = \"t\", length = \"mm\"" : "mass = \"kg\", length = \"m\"", at(0.0, -10.0 * m_),
        t_end);
    for (int i = 0; i < nodes_; ++i)
      text += fmt::format("b{} = {{ vx = {:.17g}, vy = {:.17g} }}\n", i, speed * m_ * c_, speed * m_ * s_);
    text += fmt::format("[sections.s]\nEA = 2.1e7\nEI = {}\nmass_per_length = {}\n[nodes]\n", 2.1e6 * m_ * m_,
                        100.0 / (m_ * m_));
    for (int i = 0; i < nodes_; ++i) text += fmt::format("b{} = {}\n", i, at(2.0 * m_ * i, 0.0));
    text += fmt::format("[[members]]\nnodes = [\"b0..{}\"]\nsection = \"s\"\n", last());
    return text + fmt::format(
                      "[[contacts]]\nname = \"stop\"\nnode = \"{}\"\nlaw = \"rigid\"\nnormal = {}\ngap = "
                      "{}\nrestitution = 0.3\n",
                      last(), at(0.0, 1.0), 1e-4 * m_);
  }
  /// With a dashpot, at the other end.
  [[nodiscard]] std::string foot(const char* friction) const {
    return fmt::format(
        "[[contacts]]\nname = \"foot\"\nnode = \"b0\"\nlaw = \"compliant\"\nnormal = {}\nnormal_stiffness = "
        "{}\n"
        "tangential_stiffness = {}\nnormal_damping = {}\nfriction = {}\n",
        at(0.0, 1.0), 1e7 / m_, 5e6 / m_, 2e4 / m_, friction);
  }

 private:
  int nodes_;
  double c_, s_, m_;
};

Result run_scene(const std::string& text, const char* engine) {
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.dt", "1e-5"}});
  Result result = simulate(build_model(scene), scene.run);
  INFO(result.report.outcome.reason);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violated == 0);
  return result;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/far_hits");

TEST_CASE("a foot with a dashpot slides through hits that only rounding brings, and breaks no law") {
  for (const int nodes : {6, 10, 14, 18, 22, 26, 34})
    for (const char* friction : {"0.3", "{ static = 0.35, kinetic = 0.3 }"}) {
      CAPTURE(nodes);
      CAPTURE(friction);
      for (const double angle : {0.0, 0.4, 1.9}) {
        CAPTURE(angle);
        const Beam beam(nodes, angle);
        const std::string text = beam.scene(0.03, 0.5) + beam.foot(friction);
        for (const char* engine : {"exact", "ida", "newmark"}) {
          CAPTURE(engine);
          const Result result = run_scene(text, engine);
          if (nodes >= 26)  // 0.28^25: less than 1e-13 of the hit
            for (const Event& e : result.events) CHECK(e.contact == 0);
        }
      }
    }
}

TEST_CASE("which hits are felt far away does not depend on the unit of length") {
  // Rates of rotation have another unit: beside velocities in m/s they are as great, beside those in mm/s a thousandth.
  for (const int nodes : {10, 13, 14, 15, 16, 17}) {
    CAPTURE(nodes);
    const auto events = [&](double a_metre) {
      const Beam beam(nodes, 0.7, a_metre);
      return run_scene(beam.scene(0.03, 0.5) + beam.foot("0.3"), "exact").events;
    };
    const std::vector<Event> metres = events(1.0), millimetres = events(1e3);
    REQUIRE(metres.size() == millimetres.size());
    for (std::size_t i = 0; i < metres.size(); ++i) {
      CHECK(metres[i].contact == millimetres[i].contact);
      CHECK(metres[i].to == millimetres[i].to);
      CHECK(std::abs(metres[i].t - millimetres[i].t) < 1e-10);
    }
  }
}

TEST_CASE("a slider that sticks rigidly is not let go by the rounding of a hit") {
  for (const int nodes : {26, 34}) {
    CAPTURE(nodes);
    for (const double angle : {0.0, 0.3, 1.1, 2.7}) {
      CAPTURE(angle);
      const Beam beam(nodes, angle);
      const Result result = run_scene(
          beam.scene(0.02, 0.0) +
              fmt::format(
                  "[[contacts]]\nname = \"slider\"\nnode = \"b0\"\nlaw = \"slider\"\ntangent = "
                  "{}\nnormal_force "
                  "= 1000.0\nfriction = 0.3\n[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = 100.0\n",
                  beam.at(1.0, 0.0), beam.last(), beam.at(1.0, 0.0)),
          "exact");
      CHECK(result.events.size() > 2);
      for (const Event& e : result.events) CHECK(e.contact == 0);
    }
  }
}

TEST_CASE("a rigid slider that moves for less than the clock resolves has no row of it, and breaks no law") {
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/slider-beside-chatter.toml",
                                   {{"run.engine", engine}});
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.law_checks.violated == 0);
    CHECK(result.events.size() > 600);
    State last = State::stick;  // of s2
    for (const Event& e : result.events) {
      if (e.contact != 2) continue;
      CAPTURE(e.t);
      CHECK(e.from == last);
      CHECK(e.to != e.from);
      last = e.to;
    }
  }
}

TEST_CASE(
    "a contact that comes to its own limit slips, though another that slips with it would have relieved it") {
  // Static friction is above the kinetic one: c15 lets go at its static limit, c16 follows by the drop.
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/decisions/drops-beside-each-other.toml",
                                 {{"run.certify", "false"}});
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violated == 0);
  CHECK(result.events.size() > 50);
}

TEST_SUITE_END();

}  // namespace signorini::tests::far_hits
