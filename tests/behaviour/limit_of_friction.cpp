// Blocks whose loads are exactly at the limit of friction, or off it by some roundings, at every angle: rest
// goes on as rest, decided once, and what is clearly above the limit slips.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

struct Axes {
  double nx, ny, tx, ty;
  explicit Axes(double degrees)
      : nx(-std::sin(degrees * M_PI / 180.0)), ny(std::cos(degrees * M_PI / 180.0)), tx(ny), ty(-nx) {}
};

std::string vector(double x, double y) { return fmt::format("[{:.17g}, {:.17g}]", x, y); }

std::string block_on_floor(const std::string& node, double mass, double friction, const Axes& a) {
  return fmt::format(
      "[[masses]]\nnode = \"{0}\"\nmass = {1:.17g}\n[[contacts]]\nname = \"{0}\"\nnode = \"{0}\"\n"
      "law = \"rigid\"\nnormal = {2}\nfriction = {3:.17g}\n",
      node, mass, vector(a.nx, a.ny), friction);
}

std::string push(const std::string& node, double force, const Axes& a, const char* history = "") {
  return fmt::format("[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = {:.17g}\n{}", node,
                     vector(a.tx, a.ty), force, history);
}

std::string header(double gx, double gy) {
  return fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\ngravity = {}\n"
      "[run]\nt_end = 1.0\noutput_dt = 0.5\n",
      vector(gx, gy));
}

std::string spring(const Axes& a) {
  return fmt::format("[[springs]]\nnode = \"b\"\nagainst = \"d\"\ndirection = {}\nstiffness = 100.0\n",
                     vector(a.tx, a.ty));
}

/// Two blocks on an incline of the angle atan f, tied by a spring, the whole turned.
std::string on_incline(double friction, double degrees) {
  const Axes a(degrees), g(degrees - std::atan(friction) * 180.0 / M_PI);
  return header(-9.81 * g.nx, -9.81 * g.ny) + "[nodes]\nb = [0.0, 0.0]\nd = " + vector(a.tx, a.ty) + "\n" +
         spring(a) + block_on_floor("b", 1.0, friction, a) + block_on_floor("d", 2.0, friction, a);
}

/// Two blocks on level ground, turned, pushed by their limits times 1 + excess.
std::string pushed(double mass, double friction, double excess, double degrees, const char* history = "") {
  const Axes a(degrees);
  return header(-a.nx, -a.ny) + "[nodes]\nb = [0.0, 0.0]\nd = " + vector(a.tx, a.ty) + "\n" + spring(a) +
         block_on_floor("b", mass, friction, a) + block_on_floor("d", 2.0 * mass, friction, a) +
         push("b", mass * friction * (1.0 + excess), a, history) +
         push("d", 2.0 * mass * friction * (1.0 + excess), a, history);
}

/// most: changes of state at the utmost. What slips by some roundings of its load has not moved.
void check_rest(const Result& r, std::ptrdiff_t most = 0) {
  INFO(r.report.outcome.reason);
  CHECK(r.report.outcome.kind == Outcome::Kind::done);
  const auto changes =
      std::count_if(r.events.begin(), r.events.end(), [](const Event& e) { return e.from != e.to; });
  CHECK(changes <= most);
  REQUIRE(!r.rows.empty());
  CHECK(r.rows.back().u.norm() < 1e-12);  // half of the limit would move it by a tenth
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/limit_of_friction");

TEST_CASE("two blocks on an incline of the angle of friction stay, decided once, at every angle") {
  for (const std::string& engine : locating_engines)
    for (int degrees = 0; degrees < 360; degrees += 10) {
      CAPTURE(engine);
      CAPTURE(degrees);
      const Result r = run_text(on_incline(0.3, degrees), engine, "1e-10", "7e-3");
      check_rest(r);
      CHECK(r.report.undecided == 1);
    }
}

TEST_CASE("blocks pushed by some roundings more or less than their limits are decided") {
  int n = 0;
  for (const double excess :
       {0.0, 1e-15, -1e-15, 5e-15, 1e-14, 2e-14, 2.3e-14, 2.6e-14, -2.6e-14, 3e-14, 5e-14, 1e-13, 1e-12})
    for (const double friction : {0.30000000000000004, 0.32695526231248917, 0.7451316570407011}) {
      const double degrees = 37.3 * ++n, mass = 1.0 + 0.7310257 * n;
      CAPTURE(excess);
      CAPTURE(friction);
      for (const std::string& engine : locating_engines) {
        CAPTURE(engine);
        check_rest(run_text(pushed(mass, friction, excess, degrees), engine, "1e-10", "7e-3"));
        check_rest(
            run_text(pushed(mass, friction, excess, degrees, "history = { type = \"step\", start = 0.3 }\n"),
                     engine, "1e-10", "7e-3"),
            std::abs(excess) > 2e-14 ? 2 : 0);  // each block slips once
      }
    }
}

TEST_CASE("a block on an incline within some roundings of its angle of friction is decided") {
  const std::string text =
      header(0.9480588536897652, 0.31809497000180387) + "[nodes]\nb = [-0.759, 0.062]\n" +
      "[[masses]]\nnode = \"b\"\nmass = 6804.730435915759\n[[contacts]]\nname = \"c\"\nnode = \"b\"\n"
      "law = \"rigid\"\nnormal = [-0.8404852642843658, -0.5418344032274436]\n"
      "friction = 0.25416917060754973\n";
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    check_rest(run_text(text, engine, "1e-8", "7e-3"));
  }
}

TEST_CASE("rest at the limit ends where the load turns round, however flat it begins") {
  // No derivative up to the fourth says that f N (1 - 64 t^5) falls: it reaches the other limit at 0.5.
  const Axes a(30.0);
  const std::string text = header(-a.nx, -a.ny) + "[nodes]\nb = [0.0, 0.0]\n" +
                           block_on_floor("b", 1.7, 0.3, a) +
                           push("b", 1.7 * 0.3, a,
                                "history = { type = \"polynomial\", coefficients = [1.0, 0.0, 0.0, 0.0, 0.0, "
                                "-64.0] }\n");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    INFO(r.report.outcome.reason);
    CHECK(r.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(r.events.size() == 1);
    CHECK(r.events[0].to == State::slip_minus);
    CHECK(r.events[0].t == doctest::Approx(0.5).epsilon(1e-9));
  }
}

TEST_CASE("blocks pushed clearly beyond their limits slip as one") {
  // a = f (gravity 1) times the excess, along the tangent
  for (const double excess : {1e-10, 1e-6})
    for (const double degrees : {0.0, 30.0, 161.0}) {
      CAPTURE(excess);
      CAPTURE(degrees);
      const Result r = run_text(pushed(1.3, 0.3, excess, degrees), "exact");
      REQUIRE(r.report.outcome.kind == Outcome::Kind::done);
      const Axes a(degrees);
      const double expected = 0.5 * 0.3 * excess;
      for (const int node : {0, 1}) {
        const double moved = a.tx * r.rows.back().u[2 * node] + a.ty * r.rows.back().u[2 * node + 1];
        CHECK(moved == doctest::Approx(expected).epsilon(1e-4));  // of 1 + excess, 1e-10 keeps six digits
      }
    }
}

TEST_SUITE_END();
