// Two blocks of 2000 unknowns with a seam of 50 nodes whose meshes do not match: engines, and the scene seen otherwise.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <map>
#include <numbers>

#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace signorini::tests::large_seams {
namespace {

constexpr int seam_nodes = 50;

/// How the scene is written down, and computed.
struct Look {
  const char* engine = "exact";
  double degrees = 0.0;
  bool mirrored = false, millimetres = false;
  double cutoff = 20000.0;  ///< 0: the whole model
  double dt = 1e-6, t_end = 0.004;
  bool certify = false;
};

/// A block of 64 x 8 Q4 that is held, and one of 49 x 9 on it, which is pushed to and fro along its top and struck aside.
std::string dragged_block(const Look& look) {
  const double a = look.degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  const double side = look.mirrored ? -1.0 : 1.0, m = look.millimetres ? 1000.0 : 1.0,
               kg = look.millimetres ? 1e-3 : 1.0;
  const auto vector = [&](double x, double y, double length) {
    x *= side;
    return fmt::format("[{:.17g}, {:.17g}]", (c * x - s * y) * length, (s * x + c * y) * length);
  };
  const auto block = [&](const char* name, double x, double y, double width, double height,
                         const char* elements, double E, double nu, double density) {
    return fmt::format(
        R"([[bodies]]
name = "{}"
rectangle = {{ from = {}, size = [{:.17g}, {:.17g}], degrees = {} }}
elements = {}
E = {:.17g}
nu = {}
density = {:.17g}
thickness = {:.17g}
plane = "stress"
)",
        name, vector(look.mirrored ? x + width : x, y, m), width * m, height * m, look.degrees, elements,
        E / (m * m), nu, density * kg / (m * m * m), 0.5 * m);
  };
  return fmt::format(
             R"(schema = 1
units = {{ force = "N", mass = "{}", length = "{}", time = "s" }}
gravity = {}
run = {{ t_end = {}, engine = "{}", rtol = 1e-10, dt = {}, output_dt = 1e-3, initial = "static", certify = {} }}
damping = {{ alpha = 100.0, beta = 0.0 }}
{}
)",
             look.millimetres ? "t" : "kg", look.millimetres ? "mm" : "m", vector(0.0, -9.81, m), look.t_end,
             look.engine, look.dt, look.certify,
             look.cutoff > 0.0 ? fmt::format("reduction = {{ cutoff_omega = {} }}", look.cutoff) : "") +
         block("low", -1.0, 0.0, 2.0, 0.4, "[64, 8]", 2e9, 0.3, 2000.0) +
         block("high", -0.9, 0.4, 1.7, 0.5, "[49, 9]", 3e9, 0.2, 2500.0) +
         fmt::format(R"([[supports]]
nodes = ["low.bottom"]
fix = ["ux", "uy"]
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
law = "compliant"
layer = {{ E = {:.17g}, G = {:.17g}, thickness = {:.17g} }}
friction = 0.3
contact_mass = "none"
[[loads]]
group = "high.top"
traction = {:.17g}
direction = {}
history = {{ type = "harmonic", omega = 3000.0 }}
[[loads]]
group = "high.{}"
traction = {:.17g}
direction = {}
history = {{ type = "half_sine", start = 0.0, duration = 0.003 }}
)",
                     1e9 / (m * m), 4e8 / (m * m), 0.005 * m, 6e4 / (m * m), vector(1.0, 0.0, 1.0),
                     look.mirrored ? "left" : "right", 1.2e5 / (m * m), vector(0.8, -0.6, 1.0));
}

/// Changes of state, contact by contact; of a mirrored scene as the other has them.
using Sequences = std::map<int, std::vector<std::pair<State, double>>>;

Sequences sequences(const std::vector<Event>& events, bool mirrored = false) {
  Sequences all;
  for (const Event& e : events) {
    const State to = !mirrored                   ? e.to
                     : e.to == State::slip_plus  ? State::slip_minus
                     : e.to == State::slip_minus ? State::slip_plus
                                                 : e.to;
    all[mirrored ? seam_nodes - 1 - e.contact : e.contact].emplace_back(to, e.t);
  }
  return all;
}

/// Greatest difference of times; infinite where a contact has other states.
double farthest_event(const Sequences& a, const Sequences& b) {
  double most = a.size() == b.size() ? 0.0 : HUGE_VAL;
  for (const auto& [contact, events] : a) {
    const auto other = b.find(contact);
    if (other == b.end() || other->second.size() != events.size()) return HUGE_VAL;
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (events[i].first != other->second[i].first) return HUGE_VAL;
      most = std::max(most, std::abs(events[i].second - other->second[i].second));
    }
  }
  return most;
}

Result run_of(const Look& look) {
  const Scene scene = parse_scene(dragged_block(look), "blocks.toml");
  Result result = simulate(scene);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violated == 0);
  return result;
}

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/large_seams");

TEST_CASE(
    "2000 unknowns, 50 seam nodes, reduced: exact certified to the end, ida alike, turned and mirrored in "
    "mm") {
  const Scene scene = parse_scene(dragged_block({.certify = true}), "blocks.toml");
  const Model model = build_model(scene);
  REQUIRE(model.contacts.size() == seam_nodes);
  REQUIRE(model.reduction);
  CHECK(model.reduction->dofs.size() > 1900);
  Result rows;
  const CertifiedReport run = simulate_certified(model, scene.run, rows);
  REQUIRE(run.certificate);
  CHECK(run.certificate->complete);
  const Sequences exact = sequences(rows.events);
  CHECK(rows.events.size() > 150);
  CHECK(farthest_event(exact, sequences(run_of({.engine = "ida"}).events)) <= 1e-9);
  const Look look{.degrees = -101.3, .mirrored = true, .millimetres = true};
  CHECK(farthest_event(exact, sequences(run_of(look).events, true)) <= 1e-11);
}

TEST_CASE("2000 unknowns, 50 seam nodes, the whole model: exact and ida alike, turned") {
  const double t_end = 0.0015;
  const Result whole = run_of({.cutoff = 0.0, .t_end = t_end});
  const Sequences exact = sequences(whole.events);
  CHECK(whole.events.size() > 20);
  CHECK(farthest_event(exact, sequences(run_of({.degrees = 33.7, .cutoff = 0.0, .t_end = t_end}).events)) <=
        1e-11);
  CHECK(farthest_event(exact, sequences(run_of({.engine = "ida", .cutoff = 0.0, .t_end = t_end}).events)) <=
        1e-9);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/behaviour/large_seams");

TEST_CASE(
    "2000 unknowns, 50 seam nodes, reduced: turned, mirrored, in mm, one by one; newmark with the square of "
    "dt") {
  const Sequences exact = sequences(run_of({}).events);
  CHECK(farthest_event(exact, sequences(run_of({.degrees = 33.7}).events)) <= 1e-11);
  CHECK(farthest_event(exact, sequences(run_of({.degrees = -101.3, .mirrored = true}).events, true)) <=
        1e-11);
  CHECK(farthest_event(exact, sequences(run_of({.degrees = 12.0, .millimetres = true}).events)) <= 1e-11);
  double before = 0.0;
  for (const double dt : {2e-6, 1e-6}) {
    CAPTURE(dt);
    const double off = farthest_event(exact, sequences(run_of({.engine = "newmark", .dt = dt}).events));
    CHECK(off <= 2e-7);
    if (before > 0.0) CHECK(before / off == doctest::Approx(4.0).epsilon(0.05));
    before = off;
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::large_seams
