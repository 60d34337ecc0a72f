// Static friction above kinetic on feet or sliders that hold one motion together: it begins when all of them are at their
// static limits, and only then does friction drop.
//
//   a block on two feet, pushed by F = A t at its centre:   N_0 = a_0 - c t,   N_1 = a_1 + c t,   c = A h / (b_0 + b_1)
//   it breaks away when       A t = fs_0 N_0 + fs_1 N_1     (each foot alone is at its limit earlier, at rest)
//   and slides by             m v' = A t - fk m g           with one kinetic coefficient fk
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/rates.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/certify.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::held_friction {
namespace {

constexpr double m = 2.0, g = 9.81, A = 12.0, h = 0.3, b0 = 0.5, b1 = 0.4;
constexpr const char* engines[] = {"exact", "ida", "newmark"};

struct Block {
  double turn = 0.0;
  double static_0 = 0.5, static_1 = 0.5, kinetic = 0.3;
  std::string history = "{ type = \"polynomial\", coefficients = [0.0, 1.0] }";
  double t_end = 1.2;

  [[nodiscard]] double breaks_away() const {
    const double a0 = m * g * b1 / (b0 + b1), a1 = m * g * b0 / (b0 + b1), c = A * h / (b0 + b1);
    return (static_0 * a0 + static_1 * a1) / (A + c * (static_0 - static_1));
  }
  [[nodiscard]] std::string vector(double x, double y) const {
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                       std::sin(turn) * x + std::cos(turn) * y);
  }
  [[nodiscard]] std::string scene() const {
    std::string text = parts::head + "gravity = " + vector(0.0, -g) +
                       fmt::format("\n[run]\nt_end = {}\noutput_dt = 0.05\ninitial = \"static\"\n", t_end) +
                       "[nodes]\nL = " + vector(-b0, 0.0) + "\nR = " + vector(b1, 0.0) +
                       "\n[[rigid]]\nname = \"block\"\ncentre = " + vector(0.0, h) +
                       fmt::format("\nnodes = [\"L\", \"R\"]\nmass = {}\ninertia = 0.2\n", m);
    for (const bool right : {false, true})
      text += fmt::format(
          "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nlaw = \"rigid\"\nnormal = {1}\n"
          "friction = {{ static = {2:.17g}, kinetic = {3:.17g} }}\n",
          right ? "R" : "L", vector(0.0, 1.0), right ? static_1 : static_0, kinetic);
    return text + "[[loads]]\nnode = \"block\"\ndirection = " + vector(1.0, 0.0) +
           fmt::format("\namplitude = {}\nhistory = {}\n", A, history);
  }
  [[nodiscard]] double along(const Result::Row& row) const {
    return std::cos(turn) * row.u[0] + std::sin(turn) * row.u[1];
  }
};

Result run_scene(const std::string& text, const std::string& engine) {
  const Scene scene = parse_scene(
      text, "test.toml",
      {{"run.engine", engine}, {"run.certify", "false"}, {"run.rtol", "1e-10"}, {"run.dt", "1e-3"}});
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  CHECK(result.report.audit.friction.value <= 1e-9 * result.report.audit.force_scale);
  return result;
}

/// When the last contact that holds lets go, after `from`.
double last_slip(const Result& result, double from = 0.0) {
  double t = -1.0;
  for (const Event& event : result.events)
    if (event.type == EventType::slip && event.t > from) t = event.t;
  return t;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/held_friction");

TEST_CASE("a block on two feet is at rest up to the sum of their static limits") {
  for (const char* engine : engines)
    for (const double turn : {0.0, 0.3, -2.1})
      for (const bool alike : {true, false}) {
        CAPTURE(engine);
        CAPTURE(turn);
        CAPTURE(alike);
        Block block{.turn = turn};
        if (!alike) {
          block.static_0 = 0.62;
          block.static_1 = 0.37;
        }
        const Result result = run_scene(block.scene(), engine);
        const double t = block.breaks_away();
        CHECK(last_slip(result) == doctest::Approx(t).epsilon(1e-9));
        const double after = block.t_end - t, friction = block.kinetic * m * g;
        const double slid = (A * (std::pow(block.t_end, 3) - std::pow(t, 3)) / 6.0 - A * t * t * after / 2.0 -
                             friction * after * after / 2.0) /
                            m;
        CHECK(block.along(result.rows.back()) == doctest::Approx(slid).epsilon(1e-5));
        for (const Result::Row& row : result.rows) {
          const ContactSample &L = row.contacts[0], &R = row.contacts[1];
          const double T = L.T + R.T;
          if (row.t < t) {
            CHECK(std::abs(block.along(row)) < 1e-10);
            CHECK(T == doctest::Approx(A * row.t).epsilon(1e-9));
          } else {
            CHECK(T == doctest::Approx(friction).epsilon(1e-9));
          }
        }
      }
}

TEST_CASE("pushed to below its limit and pulled back, it breaks away at the same limit on the other side") {
  for (const char* engine : engines)
    for (const double turn : {0.0, 0.7}) {
      CAPTURE(engine);
      CAPTURE(turn);
      const Block block{
          .turn = turn,
          .history = "{ type = \"table\", times = [0.0, 1.0, 3.0, 4.0], values = [0.0, 0.75, -1.2, -1.2] }",
          .t_end = 3.5};
      const double away = 1.0 + 2.0 * (0.75 + 0.5 * m * g / A) / 1.95;
      const Result result = run_scene(block.scene(), engine);
      CHECK(last_slip(result) == doctest::Approx(away).epsilon(1e-9));
      for (const Result::Row& row : result.rows) CHECK((row.t > away || std::abs(block.along(row)) < 1e-10));
    }
}

TEST_CASE("sliders of one mass: it moves when the last of them is at its static limit") {
  constexpr double N[] = {10.0, 5.0, 8.0}, fs[] = {0.5, 0.5, 0.9}, fk[] = {0.3, 0.4, 0.2};
  std::string text = parts::head +
                     "[run]\nt_end = 2.0\noutput_dt = 0.1\ninitial = { u = [0.0], v = [0.0] }\n"
                     "[matrices]\nmass = [[1.3]]\nstiffness = [[0.0]]\n"
                     "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 14.0\n"
                     "history = { type = \"polynomial\", coefficients = [0.0, 1.0] }\n";
  double holds = 0.0, rubs = 0.0;
  for (int i = 0; i < 3; ++i) {
    text += fmt::format(
        "[[contacts]]\nname = \"c{}\"\nlaw = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = {}\n"
        "friction = {{ static = {}, kinetic = {} }}\n",
        i, N[i], fs[i], fk[i]);
    holds += fs[i] * N[i];
    rubs += fk[i] * N[i];
  }
  const double t = holds / 14.0, after = 2.0 - t;
  for (const char* engine : engines) {
    CAPTURE(engine);
    const Result result = run_scene(text, engine);
    CHECK(last_slip(result) == doctest::Approx(t).epsilon(1e-9));
    const double slid =
        (14.0 * (8.0 - t * t * t) / 6.0 - 7.0 * t * t * after - rubs * after * after / 2.0) / 1.3;
    CHECK(result.rows.back().u[0] == doctest::Approx(slid).epsilon(1e-5));
    // The limit of a slider that is reached first stands still while the others take more.
    for (const Result::Row& row : result.rows)
      if (row.t > 2.0 * fs[1] * N[1] / 14.0 * 1.5 && row.t < t)
        CHECK(row.contacts[1].T == doctest::Approx(fs[1] * N[1]).epsilon(1e-9));
  }
}

TEST_CASE("a run that goes on while one foot bears its static limit is the run") {
  const Block block;
  for (const char* engine : engines) {
    CAPTURE(engine);
    const std::vector<Override> settings{
        {"run.engine", engine}, {"run.certify", "false"}, {"run.rtol", "1e-10"}, {"run.dt", "1e-3"}};
    const double split = 0.65;  // L is at its limit from 0.545 on
    const Scene whole = parse_scene(block.scene(), "test.toml", settings);
    Scene first = whole, second = whole;
    first.run.t_end = split;
    second.run.t_end = block.t_end - split;
    second.loads[0].history.shift = -split;
    const Model model = build_model(first);
    second.initial = {};
    second.initial.saved = last_state(model, simulate(model, first.run));
    const Result later = simulate(build_model(second), second.run);
    CHECK(later.report.outcome.reason == "");
    CHECK(later.report.law_checks.violations.empty());
    CHECK(last_slip(later) == doctest::Approx(block.breaks_away() - split).epsilon(1e-9));
  }
}

TEST_CASE(
    "a mass on a block on two feet slides by its own law, whatever the order of contacts and the angle") {
  // The block stays: 0.5 * 5 g bears what comes. The mass breaks away at 0.4 * 2 g and slides with 0.2 * 2 g.
  const double away = 0.4 * 2.0 * g / 20.0, after = 1.0 - away;
  const double slid = (10.0 * (1.0 / 3.0 - std::pow(away, 3) / 3.0 - away * away * after) -
                       0.2 * 2.0 * g * after * after / 2.0) /
                      2.0;
  for (const double turn : {0.0, 0.31})
    for (const std::string order : {"lrb", "lbr", "rbl", "blr", "brl"})
      for (const char* engine : {"exact", "ida"}) {
        CAPTURE(turn);
        CAPTURE(order);
        CAPTURE(engine);
        const Block axes{.turn = turn};
        std::string text = parts::head + "gravity = " + axes.vector(0.0, -g) +
                           "\n[run]\nt_end = 1.0\noutput_dt = 0.05\n" +
                           "[nodes]\nl = " + axes.vector(-0.5, 0.0) + "\nr = " + axes.vector(0.5, 0.0) +
                           "\ntop = " + axes.vector(0.0, 0.1) + "\nb = " + axes.vector(0.0, 0.1) +
                           "\n[[rigid]]\nname = \"A\"\ncentre = " + axes.vector(0.0, 0.05) +
                           "\nnodes = [\"l\", \"r\", \"top\"]\nmass = 3.0\ninertia = 0.3\n[[masses]]\nnode = "
                           "\"b\"\nmass = 2.0\n";
        for (const char which : order)
          text +=
              fmt::format("[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nlaw = \"rigid\"\nnormal = {1}\n{2}",
                          which, axes.vector(0.0, 1.0),
                          which == 'b' ? "against = \"top\"\nfriction = { static = 0.4, kinetic = 0.2 }\n"
                                       : "friction = 0.5\n");
        text += "[[loads]]\nnode = \"b\"\ndirection = " + axes.vector(1.0, 0.0) +
                "\namplitude = 20.0\nhistory = { type = \"polynomial\", coefficients = [0.0, 1.0] }\n";
        const Result result = run_scene(text, engine);
        CHECK(last_slip(result) == doctest::Approx(away).epsilon(1e-8));
        const auto b = order.find('b');
        CHECK(result.rows.back().contacts[b].ut == doctest::Approx(slid).epsilon(1e-6));
      }
}

TEST_CASE("a box that stands against a wall is pulled away from it without an event at the wall") {
  for (const double turn : {0.0, 0.297})
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(turn);
      CAPTURE(engine);
      const Block axes{.turn = turn};
      std::string text = parts::head + "gravity = " + axes.vector(0.0, -g) +
                         "\n[run]\nt_end = 1.0\noutput_dt = 0.1\n" +
                         "[nodes]\nl = " + axes.vector(-0.3, 0.0) + "\nr = " + axes.vector(0.3, 0.0) +
                         "\nw = " + axes.vector(0.3, 0.1) +
                         "\n[[rigid]]\nname = \"box\"\ncentre = " + axes.vector(0.0, 0.1) +
                         "\nnodes = [\"l\", \"r\", \"w\"]\nmass = 2.0\ninertia = 0.067\n";
      for (const char which : {'l', 'r', 'w'})
        text += fmt::format(
            "[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\nlaw = \"rigid\"\nnormal = {1}\nfriction = {2}\n",
            which, which == 'w' ? axes.vector(-1.0, 0.0) : axes.vector(0.0, 1.0), which == 'w' ? 0.0 : 0.5);
      text +=
          "[[loads]]\nnode = \"box\"\ndirection = " + axes.vector(-1.0, 0.0) +
          fmt::format("\namplitude = {}\nhistory = {{ type = \"polynomial\", coefficients = [0.0, 1.0] }}\n",
                      m * g);
      const Result result = run_scene(text, engine);
      CHECK(last_slip(result) == doctest::Approx(0.5).epsilon(1e-8));
      CHECK(result.events.size() == 2);  // the foot that bears less, then the other one
    }
}

TEST_CASE("slow loads that only shares of friction would bear are refused, not guessed") {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      (void)build_model(parse_scene(text, "test.toml"));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::string shares = "does not share friction between contacts";
  // Limits 5 and 2: both are within them up to 4.
  const auto two_sliders = [](double force, double kinetic) {
    return parts::head +
           "[run]\nt_end = 1.0\ninitial = \"frictional\"\n[matrices]\nmass = [[1.3]]\nstiffness = "
           "[[100.0]]\n" +
           fmt::format("[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = {}\n", force) +
           fmt::format(
               "[[contacts]]\nname = \"a\"\nlaw = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = 10.0\n"
               "friction = {{ static = 0.5, kinetic = {} }}\n",
               kinetic) +
           "[[contacts]]\nname = \"b\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = "
           "10.0\nfriction = 0.2\n";
  };
  for (const double kinetic : {0.5, 0.3}) {
    const Model rests = build_model(parse_scene(two_sliders(3.9, kinetic), "test.toml"));
    CHECK(std::abs(rests.u0[0]) < 1e-14);
    CHECK(refusal(two_sliders(6.0, kinetic))
              .find("contact 'b' reaches its friction limit while other contacts restrain") !=
          std::string::npos);
    CHECK(refusal(two_sliders(10.0, kinetic)).find(shares) != std::string::npos);
  }
  // A block that is pushed slowly, whatever the angle.
  for (const double turn : {0.0, 0.4}) {
    Block block{.turn = turn, .history = "{ type = \"constant\" }"};
    std::string text = block.scene();
    text.replace(text.find("\"static\""), 8, "\"frictional\"");
    const auto pushed = [&](double force) {
      std::string with = text;
      return with.replace(with.find("amplitude = 12"), 14, fmt::format("amplitude = {}", force));
    };
    CHECK(refusal(pushed(4.0)).empty());
    CHECK_FALSE(refusal(pushed(9.0)).empty());
    const std::string stages =
        "[[run.stages]]\nname = \"w\"\nloads = [\"gravity\"]\n[[run.stages]]\nname = \"p\"\nloads = [\"load "
        "1\"]\n";
    CHECK(refusal(pushed(5.4) + stages).empty());
    CHECK(refusal(pushed(9.0) + stages).find(shares) != std::string::npos);
  }
}

TEST_CASE("certified, and its time by the coefficients of both feet") {
  Block block;
  block.static_0 = 0.55;
  const Scene scene =
      parse_scene(block.scene(), "test.toml", {{"run.engine", "exact"}, {"run.certify", "true"}});
  Result rows;
  const CertifiedReport certified = simulate_certified(build_model(scene), scene.run, rows);
  REQUIRE(certified.certificate);
  CHECK(certified.certificate->complete);

  const auto by = rates_of(block.scene(), {"contacts.L.friction.static", "contacts.R.friction.static"});
  REQUIRE(by.events.size() >= 2);
  const double e = 1e-6;
  for (const bool right : {false, true}) {
    Block more = block, less = block;
    (right ? more.static_1 : more.static_0) += e;
    (right ? less.static_1 : less.static_0) -= e;
    const double rate = (more.breaks_away() - less.breaks_away()) / (2.0 * e);
    CHECK(by.event_rates.back()[right ? 1 : 0].t == doctest::Approx(rate).epsilon(1e-8));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::held_friction
