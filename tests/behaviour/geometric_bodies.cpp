// run.geometric: rigid bodies under static forces, k = sum F . r, and blocks that rock by it.
//
//   (I_C + m r^2) rz'' = -(k_spring + sum F . r) rz
//   on a foot: th'' = p^2 (th - b/h),  p^2 = m g h/I_O,   quarter period acosh(1/(1 - th0 h/b))/p
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <fstream>

#include "behaviour/engines.hpp"
#include "behaviour/halves.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/scene_parts.hpp"
#include "behaviour/seen_otherwise.hpp"
#include "own_folder.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::geometric_bodies {
namespace {

using namespace parts;

Model built(const std::string& text, const std::vector<Override>& changes = {}) {
  return build_model(parse_scene(text, "test.toml", changes));
}

std::string body(const std::string& name, const std::string& centre, const std::string& nodes, double mass,
                 double inertia) {
  return fmt::format("[[rigid]]\nname = \"{}\"\ncentre = {}\nnodes = {}\nmass = {:.17g}\ninertia = {:.17g}\n",
                     name, centre, quoted(nodes), mass, inertia);
}

/// Under gravity along (gx, gy).
std::string heavy(double gx, double gy, const std::string& run) {
  return head +
         fmt::format(
             "gravity = [{:.17g}, {:.17g}]\n[run]\nt_end = 1.0\nengine = \"exact\"\ncertify = "
             "false\ngeometric = true\n",
             gx, gy) +
         run;
}

constexpr const char* from_static = "initial = \"static\"\n";

/// b / h: half width and half height, feet below the centre.
struct Block {
  double m = 2.3, b = 0.31, h = 1.17, g = 9.81, tilt = 0.11;
  [[nodiscard]] double inertia() const { return m * (4.0 * b * b + 4.0 * h * h) / 12.0; }
  [[nodiscard]] double about_foot() const { return inertia() + m * (b * b + h * h); }
  [[nodiscard]] double p() const { return std::sqrt(m * g * h / about_foot()); }
  /// Tilted about its left foot, at rest.
  [[nodiscard]] std::string scene(double t_end, bool geometric = true) const {
    return head + fmt::format("gravity = [0.0, {:.17g}]\n", -g) +
           fmt::format("[run]\nt_end = {}\nengine = \"exact\"\ncertify = false\ngeometric = {}\n", t_end,
                       geometric) +
           fmt::format("initial = {{ block = {{ ux = {:.17g}, uy = {:.17g}, rz = {:.17g} }} }}\n", -tilt * h,
                       tilt * b, tilt) +
           fmt::format("[nodes]\nL = [{:.17g}, 0.0]\nR = [{:.17g}, 0.0]\n", -b, b) +
           body("block", fmt::format("[0.0, {:.17g}]", h), "L, R", m, inertia()) +
           "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, "
           "1.0]\nfriction = 2.0\n";
  }
};

double stiffness_of_turn(const Model& model) {
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].rotation) return model.stiffness.coeff(i, i);
  FAIL("nothing turns");
  return 0.0;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/geometric_bodies");

TEST_CASE("a pendulum that hangs: m g h, wherever its centre and its weights are, at every angle") {
  const double m = 1.7, inertia = 0.23, g = 9.81, arm = 0.8;
  for (const double angle : {0.0, 0.9, 4.0}) {
    const double dx = std::sin(angle), dy = -std::cos(angle);  // the way down
    const std::string down = fmt::format("[{:.17g}, {:.17g}]", arm * dx + 0.3, arm * dy - 0.2);
    const std::string hung = "[nodes]\nA = [0.3, -0.2]\nB = " + down + "\n" + fixed("A", "ux, uy");
    const std::string beside = fmt::format("[{:.17g}, {:.17g}]", 5.0, 7.0);
    for (const std::string& rest :
         {hung + body("b", "\"B\"", "A", m, inertia),
          hung + body("b", "\"A\"", "B", 0.0, 0.0) + point_mass("B", m, inertia),
          hung + body("b", beside, "A, B", 0.0, 0.0) + point_mass("B", m, inertia)}) {
      const Model model = built(heavy(g * dx, g * dy, from_static) + rest);
      REQUIRE(model.size() == 1);
      CHECK(model.stiffness.coeff(0, 0) == doctest::Approx(m * g * arm).epsilon(1e-13));
      CHECK(model.omega1 ==
            doctest::Approx(std::sqrt(m * g * arm / (inertia + m * arm * arm))).epsilon(1e-13));
      CHECK(model.geometric->load_factors.empty());
    }
  }
}

TEST_CASE("an inverted pendulum on a spring: factor k/(m g h) and frequency; without, it falls") {
  const double m = 1.7, inertia = 0.23, g = 9.81, arm = 0.8, k = 21.0;
  const std::string up = "[nodes]\nA = [0.0, 0.0]\nB = [0.0, 0.8]\n" + fixed("A", "ux, uy") +
                         body("b", "\"B\"", "A", m, inertia);
  const std::string held = fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n", k);
  const Model model = built(heavy(0.0, -g, from_static) + up + held);
  REQUIRE(model.geometric->load_factors.size() == 1);
  CHECK(model.geometric->load_factors[0] == doctest::Approx(k / (m * g * arm)).epsilon(1e-12));
  CHECK(model.omega1 ==
        doctest::Approx(std::sqrt((k - m * g * arm) / (inertia + m * arm * arm))).epsilon(1e-12));
  CHECK_THROWS_WITH_AS(static_cast<void>(built(heavy(0.0, -g, from_static) + up)),
                       doctest::Contains("load factor 0"), SceneError);
  const std::string weak =
      fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {:.17g}\n", 0.75 * m * g * arm);
  CHECK_THROWS_WITH_AS(static_cast<void>(built(heavy(0.0, -g, from_static) + up + weak)),
                       doctest::Contains("load factor is 0.75"), SceneError);
}

TEST_CASE(
    "a spring within a body turns with it: its preload changes nothing, at any angle and in either "
    "direction") {
  const double m = 2.0, inertia = 0.3, g = 9.81, k = 60.0;
  for (const double angle : {0.0, 0.7, 3.9}) {
    const double x = std::sin(angle), y = std::cos(angle);  // the way up
    const std::string up =
        fmt::format("[nodes]\nA = [0.0, 0.0]\nT = [{:.17g}, {:.17g}]\nS = [0.4, -0.3]\n", 2.0 * x, 2.0 * y) +
        fixed("A", "ux, uy") + body("b", fmt::format("[{:.17g}, {:.17g}]", x, y), "A, T, S", m, inertia) +
        fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n", k);
    for (const double preload : {0.0, 10.0, 25.0, -10.0})
      for (const char* other : {"T", "S"}) {
        CAPTURE(angle);
        CAPTURE(preload);
        const Model model =
            built(heavy(-g * x, -g * y, from_static) + up +
                  fmt::format("[[springs]]\nnode = \"{}\"\nagainst = \"A\"\ndirection = [{:.17g}, "
                              "{:.17g}]\npreload = {}\n",
                              other, x, y, preload));
        REQUIRE(model.geometric->load_factors.size() == 1);
        CHECK(model.geometric->load_factors[0] == doctest::Approx(k / (m * g)).epsilon(1e-12));
        CHECK(model.omega1 == doctest::Approx(std::sqrt((k - m * g) / (inertia + m))).epsilon(1e-12));
      }
  }
}

TEST_CASE("a base that accelerates from a stage on is weight the other way, at every angle") {
  const double m = 1.7, inertia = 0.23, g = 9.81, arm = 0.8, k = 21.0;
  const std::string stages =
      "initial = \"frictional\"\n[[run.stages]]\nname = \"weight\"\nloads = [\"gravity\"]\n[[run.stages]]\n"
      "name = \"lift\"\nloads = [\"base motion\"]\n";
  for (const double angle : {0.0, 0.9, 4.0}) {
    const double x = std::sin(angle), y = std::cos(angle);  // the way up
    const auto lifted = [&](double a) {
      return fmt::format("[[base_motion]]\ndirection = [{:.17g}, {:.17g}]\nacceleration = {:.17g}\n", x, y,
                         a);
    };
    const Model model = built(
        heavy(-0.6 * g * x, -0.6 * g * y, stages) +
        fmt::format("[nodes]\nA = [0.1, 0.2]\nB = [{:.17g}, {:.17g}]\n", 0.1 + arm * x, 0.2 + arm * y) +
        fixed("A", "ux, uy") + body("b", "\"B\"", "A", 0.7 * m, inertia) + point_mass("B", 0.3 * m, 0.0) +
        fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n", k) + lifted(0.25 * g) +
        lifted(0.15 * g));
    REQUIRE(model.size() == 1);
    CHECK(model.stiffness.coeff(0, 0) == doctest::Approx(k - m * g * arm).epsilon(1e-13));
  }
}

TEST_CASE("a stage's loads that supports hold wholly are known, and press what stands on them") {
  const double m = 1.7, g = 9.81, arm = 0.8, k = 21.0, P = 5.5;
  const std::string stages =
      "initial = \"frictional\"\n[[run.stages]]\nname = \"a\"\nloads = [\"gravity\"]\n[[run.stages]]\nname = "
      "\"b\"\nloads = [\"load 1\"]\n";
  const Model model = built(
      heavy(0.0, -g, stages) + "[nodes]\nA = [0.0, 0.0]\nB = [0.0, 0.8]\n" + fixed("A", "ux, uy") +
      body("b", "\"B\"", "A", m, 0.23) +
      fmt::format("[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n[[loads]]\nnode = \"B\"\ndirection = "
                  "[0.0, -1.0]\namplitude = {}\n",
                  k, P));
  CHECK(model.stiffness.coeff(0, 0) == doctest::Approx(k - (m * g + P) * arm).epsilon(1e-13));
  CHECK(model.warnings.empty());
}

TEST_CASE("the reaction of a pendulum that leans: what pushes it, whatever its weight does") {
  const double m = 1.7, g = 9.81, arm = 0.8, k = 21.0, H = 0.3;
  const std::string text =
      heavy(0.0, -g, from_static) + "[nodes]\nA = [0.0, 0.0]\nB = [0.0, 0.8]\n" + fixed("A", "ux, uy") +
      body("b", "\"B\"", "A", m, 0.23) +
      fmt::format(
          "[[springs]]\nnode = \"A\"\nrotation_stiffness = {}\n[[loads]]\nnode = \"B\"\ndirection = "
          "[1.0, 0.0]\namplitude = {}\n",
          k, H) +
      "[[output]]\nname = \"R\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [1.0, 0.0]\n";
  const Scene scene = parse_scene(text, "test.toml");
  const Model model = build_model(scene);
  CHECK(model.u0[0] == doctest::Approx(-H * arm / (k - m * g * arm)).epsilon(1e-12));
  CHECK(simulate(model, scene.run).responses.back().values[0] == doctest::Approx(-H).epsilon(1e-10));
}

TEST_CASE("forces of springs, members, heat and contacts on a body: sum F . r by hand") {
  // A body pressed by a spring that a support strains, by a hot bar, by loads and through a stop.
  const std::string points =
      "[nodes]\nl = [-1.0, 0.4]\nr = [1.2, -0.3]\nt = [0.2, 0.9]\nf = [-1.0, 3.4]\nw = [4.2, -0.3]\n";
  const std::string rest =
      body("b", "[0.1, 0.2]", "l, r, t", 0.5, 0.4) + fixed("f, w", "ux, uy") +
      "[sections.s]\nEA = 1000.0\nmass_per_length = 0.2\n" +
      member("r, w", "type = \"bar\"\nthermal_expansion = 1e-5\ntemperature = 40.0\n") +
      member("l, f", "type = \"bar\"\n") + spring("b", "[1.0, 0.0]", 60.0) + spring("l", "[0.0, 1.0]", 45.0) +
      "preload = 2.5\n" +
      "[[springs]]\nnode = \"b\"\nrotation_stiffness = 500.0\n"
      "[[contacts]]\nname = \"stop\"\nnode = \"t\"\nlaw = \"compliant\"\nnormal = [0.0, "
      "-1.0]\nnormal_stiffness = 80.0\ngap = -0.01\n" +
      "[[loads]]\nnode = \"t\"\ndirection = [0.6, 0.8]\namplitude = 1.3\n[[loads]]\nnode = \"b\"\nmoment = "
      "0.7\n";
  const std::string text = heavy(0.3, -9.81, from_static) + points + rest;
  // The forces follow from where it stands without their stiffness.
  const Model plain = built(text, {{"run.geometric", "false"}});
  double x = 0.0, y = 0.0, turn = 0.0;
  for (int i = 0; i < plain.size(); ++i) {
    const std::string& name = plain.dofs[static_cast<std::size_t>(i)].displacement;
    (name == "b.ux" ? x : name == "b.uy" ? y : turn) = plain.u0[i];
  }
  const auto ux = [&](double py) { return x - turn * (py - 0.2); };
  const auto uy = [&](double px) { return y + turn * (px - 0.1); };
  const double bar = 1000.0 * (-ux(-0.3) / 3.0 - 4e-4);  // r to w, tension
  const double rope = 1000.0 * (-uy(-1.0) / 3.0);        // l to f
  double k = 0.0;
  const auto add = [&](double px, double py, double fx, double fy) {
    k += fx * (px - 0.1) + fy * (py - 0.2);
  };
  add(1.2, -0.3, bar + 0.3 * 0.3, -9.81 * 0.3);  // half of the bar's weight, 0.6 t
  add(-1.0, 0.4, 0.3 * 0.3, rope - 9.81 * 0.3 - 45.0 * uy(-1.0) - 2.5);
  add(0.2, 0.9, 1.3 * 0.6, 1.3 * 0.8 + 80.0 * std::min(0.0, -0.01 - uy(0.2)));
  const Model model = built(text);
  REQUIRE(model.geometric->forces.bodies.size() == 1);
  CHECK(model.geometric->forces.bodies[0].stiffness == doctest::Approx(k).epsilon(1e-10));
  CHECK(model.geometric->forces.elements[0].at_from == doctest::Approx(bar + 0.3 * 0.3).epsilon(1e-10));
  CHECK(model.geometric->forces.elements[0].at_to == doctest::Approx(bar - 0.3 * 0.3).epsilon(1e-10));
}

TEST_CASE("a body at the end of a bend that is more flexible than its section: W at the arm of the end") {
  const std::string text = heavy(0.0, -9.81, from_static) + "[nodes]\nA = [0.0, 0.0]\nB = [2.0, 2.0]\n" +
                           section(4e4, 500.0, 0.0) +
                           member("A, B", "elements = 6\nbend = { radius = 2.0, flexibility = 3.7 }\n") +
                           fixed("A", "ux, uy, rz") + body("b", "[2.3, 1.6]", "B", 0.5, 0.4);
  const Model model = built(text);
  CHECK(model.geometric->forces.bodies[0].stiffness == doctest::Approx(9.81 * 0.5 * 0.4).epsilon(1e-9));
}

TEST_CASE("a rigid bar between two members is a stiff one: the same stiffness by other means") {
  // A stack of a column, a rigid piece and a column, against one whose middle is a beam of 10^5 times its stiffness.
  const std::string points = "[nodes]\nA = [0.0, 0.0]\nB = [0.0, 1.0]\nC = [0.0, 1.6]\nD = [0.0, 2.4]\n";
  const auto stack = [&](bool rigid) {
    std::string text = heavy(0.0, 0.0, from_static) + points + section(4e4, 5.0, 0.1) +
                       "[sections.stiff]\nEA = 4e9\nEI = 5e6\nmass_per_length = 0.0\n" +
                       member("A, B", "elements = 4\n") + member("C, D", "elements = 4\n") +
                       fixed("A", "ux, uy, rz") + fixed("D", "ux") +
                       "[[loads]]\nnode = \"D\"\ndirection = [0.0, -1.0]\namplitude = 5.0\n";
    text += rigid ? body("piece", "[0.7, 1.1]", "B, C", 0.0, 0.0)
                  : "[[members]]\nnodes = [\"B\", \"C\"]\nsection = \"stiff\"\n";
    return built(text);
  };
  const std::vector<double> a = stack(true).geometric->load_factors, b = stack(false).geometric->load_factors;
  REQUIRE(a.size() == 5);
  for (std::size_t i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-5));
}

TEST_CASE("a block rocks: quarter period, ten impacts and their rates in closed form") {
  const Block block;
  const double p = block.p(), share = block.b / block.h;
  const double ratio = 1.0 - 2.0 * block.m * block.b * block.b / block.about_foot();
  const Model model = built(block.scene(10.0));
  CHECK(stiffness_of_turn(model) == doctest::Approx(-block.m * block.g * block.h).epsilon(1e-14));
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Scene scene =
        parse_scene(block.scene(10.0), "test.toml", {{"run.engine", engine}, {"run.rtol", "1e-10"}});
    const Result result = simulate(build_model(scene), scene.run);
    CHECK(result.report.outcome.reason == "");
    CHECK(result.report.law_checks.violations.empty());
    double t = std::acosh(1.0 / (1.0 - block.tilt / share)) / p;
    double rate = p * std::sqrt(share * share - (share - block.tilt) * (share - block.tilt));
    int impacts = 0;
    const double bound = engine == "exact" ? 1e-10 : 1e-6;
    for (const Event& event : result.events) {
      if (event.type != EventType::impact || !(event.vn < 0.0) || impacts == 10) continue;
      CHECK(event.t == doctest::Approx(t).epsilon(bound));
      CHECK(event.contact == (impacts % 2 == 0 ? 1 : 0));
      CHECK(event.vn == doctest::Approx(-2.0 * block.b * rate).epsilon(bound));
      rate *= ratio;
      t += 2.0 / p * std::atanh(rate / (p * share));
      ++impacts;
    }
    CHECK(impacts == 10);
  }
}

TEST_CASE("a block on rigid feet starts with friction under inclined gravity: its feet bear by statics") {
  for (const double lean : {0.0, 0.13, -0.2}) {
    const Block block;
    const double gx = block.g * std::sin(lean), gy = -block.g * std::cos(lean);
    std::string text = block.scene(0.1);
    text = heavy(gx, gy, "initial = \"frictional\"\n") + text.substr(text.find("[nodes]"));
    const Model model = built(text);
    const double share = 0.5 * block.m * gx * block.h / block.b;  // from the left foot to the right one
    REQUIRE(model.statics.stages.size() >= 1);
    const StageEnd& end = model.statics.stages.back();
    CHECK(-end.N[0] == doctest::Approx(-0.5 * block.m * gy - share).epsilon(1e-10));
    CHECK(-end.N[1] == doctest::Approx(-0.5 * block.m * gy + share).epsilon(1e-10));
    CHECK(std::abs(std::abs(end.T[0] + end.T[1]) - std::abs(block.m * gx)) < 1e-9);
    CHECK(model.u0.cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("what contacts hold wholly has no scale of its own, and ida follows the block as exact does") {
  for (const double size : {6.0, 6.06, 6.1}) {
    std::string text = Block{.m = 2880.0, .b = 0.3, .h = 1.0}.scene(6.0);
    text.replace(text.find("initial"), text.find('\n', text.find("initial")) - text.find("initial"),
                 "initial = \"static\"");
    text += fmt::format(
        "[base_motion]\ndirection = [1.0, 0.0]\nacceleration = {{ type = \"half_sine\", amplitude = {}, "
        "start = "
        "0.0, duration = 0.3 }}\n",
        size);
    const Model model = built(text);
    CHECK(model.scales.displacement > 1e-3);
    const Result exact = run_text(text, "exact"), ida = run_text(text, "ida");
    REQUIRE(exact.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(ida.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(exact.events.size() > 10);
    for (std::size_t i = 0; i < 10; ++i) {
      CHECK(ida.events[i].contact == exact.events[i].contact);
      CHECK(std::abs(ida.events[i].t - exact.events[i].t) < 1e-6);
    }
  }
}

TEST_CASE(
    "how far the linear block parts from Housner's: the tables of docs/decisions and validation/published") {
  // I_O th'' = -m g R sin(alpha - th) from rest at th0, by th = th0 (1 - s^2) and the midpoint rule; an impact leaves a part r
  // of th'^2 = 2 m g R (cos(alpha - th0) - cos alpha) / I_O, which tilts it again.
  const auto quarter = [](double alpha, double tilt) {
    constexpr int n = 4000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n, th = tilt * (1.0 - s * s);
      sum += 2.0 * tilt * s / n /
             std::sqrt(4.0 * std::sin(alpha - 0.5 * (th + tilt)) * std::sin(0.5 * (tilt - th)));
    }
    return sum;
  };
  struct Entry {
    double slender, part, first, fifth;  // %
  };
  for (const Entry& e : {Entry{2.0, 0.5, -1.48, -0.07}, Entry{3.0, 0.99, -26.26, -10.38},
                         Entry{5.0, 0.9, -2.80, -0.31}, Entry{20.0, 0.99, -1.43, -0.25}}) {
    Block block;
    block.b = 0.2;
    block.h = e.slender * block.b;
    const double alpha = std::atan(1.0 / e.slender), radius = std::hypot(block.b, block.h);
    block.tilt = e.part * alpha;
    const Scene scene = parse_scene(block.scene(50.0), "test.toml");
    const Result result = simulate(build_model(scene), scene.run);
    const double rate = std::sqrt(block.m * block.g * radius / block.about_foot());
    const double ratio = 1.0 - 2.0 * block.m * block.b * block.b / block.about_foot();
    double tilt = block.tilt, t = quarter(alpha, tilt) / rate;
    int impacts = 0;
    for (const Event& event : result.events) {
      if (event.type != EventType::impact || !(event.vn < 0.0)) continue;
      if (++impacts == 1) CHECK(std::abs(100.0 * (event.t / t - 1.0) - e.first) < 0.006);
      if (impacts == 5) CHECK(std::abs(100.0 * (event.t / t - 1.0) - e.fifth) < 0.006);
      const double left = ratio * ratio * (std::cos(alpha - tilt) - std::cos(alpha));
      tilt = alpha - std::acos(std::cos(alpha) + left);
      t += 2.0 * quarter(alpha, tilt) / rate;
    }
    CHECK(impacts >= 5);
  }
}

TEST_CASE("a block that rocks in two halves: the forces of the first are those of the second") {
  const halves::Difference d =
      halves::split_text(Block().scene(4.0), {{"run.engine", "exact"}, {"run.flow", "taylor"}}, 0.37);
  INFO(d.first);
  CHECK(d.events_agree);
  CHECK(d.events > 5);
  CHECK(d.time < 1e-11);
  // From another static state the run would freeze others: its file tells, and the bits are those.
  const OwnFolder own;
  const auto folder = own.path() / "first";
  const Scene scene = parse_scene(Block().scene(0.3), "test.toml");
  const Model model = build_model(scene);
  result::RunDirectory directory(folder, scene, model, {true, {"test"}});
  static_cast<void>(directory.finish(simulate(model, scene.run, directory)));
  std::string later = Block().scene(1.0);
  const std::size_t at = later.find("initial = "), end = later.find('\n', at);
  later.replace(at, end - at, fmt::format("initial = {{ run = \"{}\" }}", folder.string()));
  const Model same = built(later);
  CHECK(same.geometric->forces.bodies[0].stiffness == model.geometric->forces.bodies[0].stiffness);
  CHECK(same.warnings == model.warnings);
  const Model heavier = built(later, {{"gravity", "[0.0, -5.0]"}});
  CHECK(heavier.geometric->forces.bodies[0].stiffness == model.geometric->forces.bodies[0].stiffness);
  CHECK(stiffness_of_turn(heavier) == stiffness_of_turn(model));
  const Model without = built(later, {{"run.geometric", "false"}});
  CHECK(!without.geometric);
  bool said = false;
  for (const std::string& warning : without.warnings)
    said = said || warning.find("run.geometric") != std::string::npos;
  CHECK(said);
  // Rows of other members or bodies, or not all of them, are no forces of this structure. (With the manifest they are refused as altered.)
  REQUIRE(std::filesystem::remove(folder / "manifest.json"));
  const auto with_rows = [&](const std::string& rows) {
    std::ofstream(folder / "geometric.csv") << "what,from,to,N_from,N_to,stiffness\n" << rows;
    CAPTURE(rows);
    CHECK_THROWS_WITH_AS(static_cast<void>(built(later)),
                         doctest::Contains("belongs to other members or rigid bodies"), SceneError);
  };
  with_rows("");
  with_rows("rigid,another,,,,-98.1\n");
  with_rows("rigid,block,,,,-98.1\nrigid,another,,,,-98.1\n");
  with_rows("member,A,B,-1.0,-1.0,\nrigid,block,,,,-98.1\n");
  // Without the file others would be frozen, and nobody would know.
  REQUIRE(std::filesystem::remove(folder / "geometric.csv"));
  CHECK_THROWS_WITH_AS(static_cast<void>(built(later)),
                       doctest::Contains(("found no " + (folder / "geometric.csv").string()).c_str()),
                       SceneError);
  CHECK_NOTHROW(static_cast<void>(built(later, {{"run.geometric", "false"}})));
}

TEST_CASE("a block at rest on its feet stands, and rocks on springs as its stiffness says") {
  const Block block;
  const Model rigid = built(block.scene(1.0), {{"run.initial", "static"}});
  REQUIRE(rigid.statics.reactions.size() == 2);
  for (const double reaction : rigid.statics.reactions)
    CHECK(reaction == doctest::Approx(0.5 * block.m * block.g).epsilon(1e-12));
  CHECK(rigid.u0.cwiseAbs().maxCoeff() < 1e-14);
  const double kn = 300.0;
  const std::string text = [&] {
    std::string t = block.scene(1.0);
    const std::string from = "law = \"rigid\"";
    t.replace(t.find(from), from.size(),
              fmt::format("law = \"compliant\"\nnormal_stiffness = {}\ntangential_stiffness = 1e9", kn));
    return t;
  }();
  const Model model = built(text, {{"run.initial", "static"}});
  CHECK(model.geometric->load_factors.front() ==
        doctest::Approx(2.0 * kn * block.b * block.b / (block.m * block.g * block.h)).epsilon(1e-6));
  const double square = (2.0 * kn * block.b * block.b - block.m * block.g * block.h) /
                        (block.inertia() + block.m * block.h * block.h);
  CHECK(model.omega1 == doctest::Approx(std::sqrt(square)).epsilon(1e-6));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/behaviour/geometric_bodies");

TEST_CASE("a portal with a rigid girder that leans on a stop: turned, mirrored, permuted, in other units") {
  const std::string text =
      heavy(0.0, -9.81, from_static) +
      "[nodes]\nA = [0.0, 0.0]\nB = [0.3, 3.2]\nC = [4.1, 3.3]\nD = [4.3, 0.1]\n" + section(5e4, 6.4, 0.01) +
      member("A, B", "elements = 3\n") + member("D, C", "elements = 3\n") + fixed("A, D", "ux, uy, rz") +
      body("girder", "[2.0, 3.6]", "B, C", 0.5, 0.6) +
      "[[springs]]\nnode = \"girder\"\ndirection = [0.2, 1.0]\nstiffness = 3.0\npreload = 0.7\n"
      "[[contacts]]\nname = \"stop\"\nnode = \"C\"\nlaw = \"compliant\"\nnormal = [-1.0, 0.1]\ngap = "
      "0.01\nnormal_stiffness = 800.0\ntangential_stiffness = 500.0\nfriction = 0.3\n"
      "[[loads]]\nnode = \"girder\"\ndirection = [1.0, 0.0]\namplitude = 0.4\nhistory = { type = "
      "\"harmonic\", "
      "omega = 5.0 }\n";
  const Scene scene = parse_scene(text, "test.toml", {{"run.t_end", "6.0"}});
  const Model model = build_model(scene), plain = built(text, {{"run.geometric", "false"}});
  CHECK(model.geometric->load_factors.front() < 5.0);
  CHECK(model.omega1 < 0.95 * plain.omega1);
  check_seen_otherwise(scene, 11);
}

TEST_SUITE_END();

}  // namespace signorini::tests::geometric_bodies
