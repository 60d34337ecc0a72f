// Contacts against a node whose support moves. If all supports move together this is [base_motion], with displacements
// relative to the ground:
//
//   u = w + s(t),     base_motion: w, acceleration s''
//
// A contact that never opens is a spring between the two nodes.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "signorini/error.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::moving_obstacle {
namespace {

constexpr double A = 0.02, omega = 30.0;
const std::string head =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";

/// Angles with the axes: the table moves along (0.6, 0.8), its normal is (-sin, cos) of 0.3 rad.
const double cn = std::cos(0.3), sn = std::sin(0.3);
constexpr double dx = 0.6, dy = 0.8;

std::string run_table(double t_end) {
  return fmt::format("[run]\nt_end = {}\noutput_dt = {}\nrtol = 1e-10\ndt = 2e-5\n", t_end, t_end / 40.0);
}

/// The table moves, in both components, or the ground accelerates as it does.
std::string moves(bool by_support) {
  if (!by_support)
    return fmt::format(
        "[[supports]]\nnode = \"table\"\nfix = [\"ux\", \"uy\"]\n[base_motion]\ndirection = [{}, {}]\n"
        "acceleration = {{ type = \"harmonic\", omega = {}, amplitude = {:.17g} }}\n",
        dx, dy, omega, -A * omega * omega);
  std::string text;
  for (const auto& [name, part] : {std::pair("ux", dx), {"uy", dy}})
    text += fmt::format(
        "[[supports]]\nnode = \"table\"\nfix = [\"{}\"]\nmotion = {{ type = \"harmonic\", omega = {}, "
        "amplitude = {:.17g} }}\n",
        name, omega, A * part);
  return text;
}

double s(double t) { return A * std::sin(omega * t); }

std::string outputs(const char* node) {
  return fmt::format(
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\nat = \"{0}\"\ndirection = [1.0, 0.0]\n"
      "[[output]]\nname = \"y\"\nkind = \"displacement\"\nat = \"{0}\"\ndirection = [0.0, 1.0]\n",
      node);
}

Result run(const std::string& text, const std::string& engine) {
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}});
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  return result;
}

/// The values of the outputs at the times of the rows, after the events there.
std::vector<Result::Response> on_grid(const Result& result) {
  std::vector<Result::Response> rows;
  for (const Result::Row& row : result.rows)
    for (const Result::Response& response : result.responses)
      if (response.t == row.t) {
        if (!rows.empty() && rows.back().t == row.t) rows.pop_back();
        rows.push_back(response);
      }
  return rows;
}

/// Same events and forces; displacements differ by the motion of the ground.
void compare(const std::string& moving, const std::string& based, const std::string& engine) {
  CAPTURE(engine);
  const Result a = run(moving, engine), b = run(based, engine);
  const double close = engine == "exact" ? 1e-10 : 1e-6;
  REQUIRE(!b.events.empty());
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CHECK(a.events[i].t == doctest::Approx(b.events[i].t).epsilon(close));
    CHECK(a.events[i].contact == b.events[i].contact);
    CHECK(a.events[i].to == b.events[i].to);
  }
  const auto rows_a = on_grid(a), rows_b = on_grid(b);
  REQUIRE(rows_a.size() == rows_b.size());
  REQUIRE(rows_a.size() > 30);
  double force = 0.0;
  for (const Result::Row& row : b.rows)
    for (const ContactSample& c : row.contacts) force = std::max({force, std::abs(c.N), std::abs(c.T)});
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (std::size_t k = 0; k < a.rows[i].contacts.size(); ++k) {
      CAPTURE(a.rows[i].t);
      CHECK(std::abs(a.rows[i].contacts[k].N - b.rows[i].contacts[k].N) <= 1e2 * close * force);
      CHECK(std::abs(a.rows[i].contacts[k].T - b.rows[i].contacts[k].T) <= 1e2 * close * force);
    }
  for (std::size_t i = 0; i < rows_a.size(); ++i) {
    const double t = rows_a[i].t;
    CHECK(t == rows_b[i].t);
    CHECK(std::abs(rows_a[i].values[0] - rows_b[i].values[0] - dx * s(t)) <= 10.0 * close * A);
    CHECK(std::abs(rows_a[i].values[1] - rows_b[i].values[1] - dy * s(t)) <= 10.0 * close * A);
  }
}

std::string ball(bool by_support, const std::string& law) {
  // The ball has the velocity of the table at the start, (dx, dy) A omega, which is no velocity relative to the ground.
  const double v = by_support ? A * omega : 0.0;
  return head + fmt::format("gravity = [{:.17g}, {:.17g}]\n", 9.81 * sn, -9.81 * cn) + run_table(0.6) +
         fmt::format("initial = {{ ball = {{ vx = {:.17g}, vy = {:.17g} }} }}\n", v * dx, v * dy) +
         "[nodes]\ntable = [0.0, 0.0]\nball = [0.0, 0.0]\n[[masses]]\nnode = \"ball\"\nmass = 2.0\n" +
         fmt::format(
             "[[contacts]]\nname = \"hit\"\nnode = \"ball\"\nagainst = \"table\"\nnormal = [{:.17g}, "
             "{:.17g}]\n",
             -sn, cn) +
         law + moves(by_support) + outputs("ball");
}

std::string refusal(const std::string& text) {
  try {
    (void)build_model(parse_scene(text, "test.toml"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE_BEGIN("behaviour/moving_obstacle");

TEST_CASE("a ball on a table that a support moves does what it does on ground that shakes") {
  for (const char* engine : {"exact", "ida", "newmark"}) {
    const std::string
        rigid = "law = \"rigid\"\nrestitution = 0.4\ncapture_velocity = 1e-3\nfriction = 0.3\n",
        compliant =
            "law = \"compliant\"\nnormal_stiffness = 2e4\ntangential_stiffness = 1e4\nfriction = 0.3\n";
    compare(ball(true, compliant), ball(false, compliant), engine);
    if (std::string(engine) != "newmark") compare(ball(true, rigid), ball(false, rigid), engine);
  }
}

TEST_CASE("a rigid block with two feet on such a table, and a ball on top of the block") {
  const auto scene = [](bool by_support) {
    const double v = by_support ? A * omega : 0.0;
    std::string text =
        head + "gravity = [0.0, -9.81]\n" + run_table(0.5) +
        fmt::format(
            "[run.initial]\nblock = {{ vx = {0:.17g}, vy = {1:.17g} }}\nball = {{ vx = {0:.17g}, vy = "
            "{1:.17g} }}\n",
            v * dx, v * dy) +
        "[nodes]\ntable = [0.0, 0.0]\nL = [-0.5, 0.0]\nR = [0.4, 0.0]\ntop = [0.1, 1.0]\nball = [0.1, 1.0]\n"
        "[[masses]]\nnode = \"ball\"\nmass = 0.3\n"
        "[[rigid]]\nname = \"block\"\ncentre = [0.0, 0.5]\nnodes = [\"L\", \"R\", \"top\"]\nmass = 3.0\n"
        "inertia = 0.4\n";
    for (const char* foot : {"L", "R"})
      text += fmt::format(
          "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nagainst = \"table\"\nlaw = \"compliant\"\nnormal = "
          "[0.0, 1.0]\n"
          "normal_stiffness = 4e4\ntangential_stiffness = 2e4\nfriction = 0.4\n",
          foot);
    return text +
           "[[contacts]]\nname = \"on top\"\nnode = \"ball\"\nagainst = \"top\"\nlaw = \"compliant\"\nnormal "
           "= [0.0, 1.0]\n"
           "normal_stiffness = 1e4\ntangential_stiffness = 1e4\nfriction = 0.2\n" +
           moves(by_support) + outputs("top");
  };
  for (const char* engine : {"exact", "ida"}) compare(scene(true), scene(false), engine);
}

TEST_CASE("a contact that stays closed is a spring to the moving node, also beside springs to the ground") {
  const auto scene = [](bool contact) {
    const std::string between = contact ? "[[contacts]]\nname = \"c\"\nnode = \"ball\"\nagainst = "
                                          "\"table\"\nlaw = \"compliant\"\nnormal = [-0.28, 0.96]\n"
                                          "normal_stiffness = 5e3\n"
                                        : "[[springs]]\nnode = \"ball\"\nagainst = \"table\"\ndirection = "
                                          "[-0.28, 0.96]\nstiffness = 5e3\n";
    return head + "gravity = [0.0, -9.81]\n" + run_table(0.5) + "initial = { ball = { uy = -0.03 } }\n" +
           "[nodes]\ntable = [0.0, 0.0]\nball = [0.0, 0.0]\n[[masses]]\nnode = \"ball\"\nmass = 20.0\n" +
           between +
           "[[springs]]\nnode = \"ball\"\ndirection = [1.0, 0.0]\nstiffness = 3e3\ndamping = 12.0\n"
           "[[supports]]\nnode = \"table\"\nfix = [\"ux\"]\n[[supports]]\nnode = \"table\"\nfix = [\"uy\"]\n"
           "motion = { type = \"harmonic\", omega = 9.0, amplitude = 0.004, offset = 0.002 }\n" +
           outputs("ball") +
           (contact ? "[[output]]\nname = \"f\"\nkind = \"contact\"\nat = \"c\"\nquantity = \"N\"\n"
                    : "[[output]]\nname = \"f\"\nkind = \"spring\"\nspring = 1\n") +
           "[[output]]\nname = \"r\"\nkind = \"reaction\"\nat = \"table\"\ndirection = [0.0, 1.0]\n";
  };
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Result a = run(scene(true), engine), b = run(scene(false), engine);
    CHECK(a.events.empty());
    REQUIRE(a.responses.size() == b.responses.size());
    const double close = engine[0] == 'e' ? 1e-10 : 1e-6;
    for (std::size_t i = 0; i < a.responses.size(); ++i) {
      CAPTURE(a.responses[i].t);
      for (const std::size_t k : {0, 1})
        CHECK(std::abs(a.responses[i].values[k] - b.responses[i].values[k]) <= close * 0.04);
      CHECK(a.responses[i].values[2] < 0.0);
      for (const std::size_t k : {2, 3})
        CHECK(std::abs(a.responses[i].values[k] - b.responses[i].values[k]) <= close * 200.0);
    }
  }
}

TEST_CASE("a ball that falls onto a table that rises at constant velocity: the closed form of its rebounds") {
  // g0 = h - (V t + g t^2 / 2); a rebound leaves with e times the relative velocity c = sqrt(V^2 + 2 g h); flights 2 e^n c / g.
  constexpr double V = 0.7, h = 0.3, g = 9.81, e = 0.6;
  const std::string text =
      head + "gravity = [0.0, -9.81]\n" + run_table(1.2) +
      "[nodes]\ntable = [0.0, 0.0]\nball = [0.0, 0.3]\n" +
      "[[masses]]\nnode = \"ball\"\nmass = 2.0\n[[supports]]\nnodes = [\"table\", \"ball\"]\nfix = [\"ux\"]\n"
      "[[supports]]\nnode = \"table\"\nfix = [\"uy\"]\nmotion = { type = \"polynomial\", coefficients = "
      "[0.0, 0.7] }\n"
      "[[contacts]]\nname = \"hit\"\nnode = \"ball\"\nagainst = \"table\"\nlaw = \"rigid\"\nnormal = [0.0, "
      "1.0]\n"
      "gap = 0.3\nrestitution = 0.6\n";
  const double c = std::sqrt(V * V + 2.0 * g * h);
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Result result = run(text, engine);
    std::vector<double> hits;
    for (const Event& event : result.events)
      if (event.type == EventType::impact) hits.push_back(event.t);
    REQUIRE(hits.size() >= 4);
    double t = (c - V) / g, leaves = e * c;
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(hits[i] == doctest::Approx(t).epsilon(1e-9));
      t += 2.0 * leaves / g;
      leaves *= e;
    }
  }
}

TEST_CASE("what cannot be relative to one obstacle is refused, and base_motion is named") {
  const std::string scene =
      head + run_table(0.1) +
      "[nodes]\ntable = [0.0, 0.0]\nball = [0.0, 0.0]\nwall = [0.0, 1.0]\n[[masses]]\nnode = \"ball\"\n"
      "mass = 1.0\n[[supports]]\nnode = \"wall\"\nfix = [\"ux\", \"uy\"]\n[[supports]]\nnode = "
      "\"table\"\nfix = [\"ux\"]\n"
      "[[supports]]\nnode = \"table\"\nfix = [\"uy\"]\nmotion = { type = \"harmonic\", omega = 9.0 }\n";
  const auto contact = [](const char* name, const char* node, const char* against) {
    return fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\n{}law = \"compliant\"\nnormal = [0.0, "
        "1.0]\nnormal_stiffness = "
        "1e3\n",
        name, node, *against ? fmt::format("against = \"{}\"\n", against) : std::string());
  };
  const std::string up = contact("a", "ball", "table");
  REQUIRE(refusal(scene + up) == "none");
  REQUIRE(refusal(scene + contact("a", "table", "ball")) == "none");
  for (const std::string& more : {up + contact("b", "ball", ""), up + contact("b", "ball", "wall"),
                                  contact("a", "table", "wall"), contact("a", "table", "")}) {
    const std::string message = refusal(scene + more);
    CAPTURE(message);
    CHECK(has(message, "a support moves node 'table' in y"));
    CHECK(has(message, "give [base_motion] instead"));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::moving_obstacle
