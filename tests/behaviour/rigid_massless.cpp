// Rigid contacts where the structure has no mass: rows g = 0 and ut = const on displacements.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <tuple>

#include "behaviour/halves.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// Stiffness of a leg between (x, y) and (fx, fy), k along x and k_n along y, turned; rows of a matrix.
std::string leg_stiffness(double angle, double k, double k_n) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double xx = c * c * k + s * s * k_n, yy = s * s * k + c * c * k_n, xy = c * s * (k - k_n);
  const auto row = [](double a, double b) {
    return fmt::format("[{0:.17g}, {1:.17g}, {2:.17g}, {3:.17g}]", a, b, -a, -b);
  };
  return fmt::format("[{}, {}, {}, {}]", row(xx, xy), row(xy, yy), row(-xx, -xy), row(-xy, -yy));
}

/// A mass on a foot without mass, k along x and k_n along y between them; pressed by P, pulled by a ramp r t.
struct BlockOnFoot {
  double m = 2.0, k = 300.0, k_n = 900.0, P = 40.0, r = 3.0, fs = 0.5, fk = 0.5, t_end = 8.0;
  const char* engine = "exact";
  double angle = 0.0, unit = 1.0;  ///< the whole turned; lengths in units of 1/unit m

  [[nodiscard]] Scene scene() const {
    const double c = std::cos(angle), s = std::sin(angle);
    return parse_scene(fmt::format(
                           R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = {0}, engine = "{1}", rtol = 1e-10, output_dt = 0.25, initial = "static", certify = false }}
[matrices]
dofs = ["x", "y", "fx", "fy"]
mass = [[{2}, 0.0, 0.0, 0.0], [0.0, {2}, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]
stiffness = {3}
[[loads]]
direction = {{ x = {4:.17g}, y = {5:.17g} }}
amplitude = {6}
history = {{ type = "constant" }}
[[loads]]
direction = {{ x = {7:.17g}, y = {8:.17g} }}
amplitude = {9}
history = {{ type = "table", times = [0.0, 1.0e3], values = [0.0, 1.0e3] }}
[[contacts]]
name = "foot"
law = "rigid"
normal = {{ fx = {10:.17g}, fy = {11:.17g} }}
tangent = {{ fx = {7:.17g}, fy = {8:.17g} }}
friction = {{ static = {12}, kinetic = {13} }}
)",
                           t_end, engine, m, leg_stiffness(angle, k, k_n), s, -c, P, c, s, r, -s, c, fs, fk),
                       "foot.toml");
  }
  [[nodiscard]] double omega() const { return std::sqrt(k / m); }
  /// Stuck: x = (r/k)(t - sin(w t)/w); it slips once k x = f P.
  [[nodiscard]] double stuck(double t) const { return r / k * (t - std::sin(omega() * t) / omega()); }
  [[nodiscard]] double slips_at() const {
    double a = 0.0, b = t_end;
    while (b - a > 1e-15 * b) (k * stuck(0.5 * (a + b)) < fs * P ? a : b) = 0.5 * (a + b);
    return a;
  }
  /// Slides with T = fk P: x'' = (r t - fk P)/m.
  [[nodiscard]] double slides(double t) const {
    const double t1 = slips_at(), x1 = stuck(t1), v1 = r / k * (1.0 - std::cos(omega() * t1)), d = t - t1;
    return x1 + v1 * d + (r * t1 - fk * P) / m * d * d / 2.0 + r / m * d * d * d / 6.0;
  }
};

void check_closed_form(const BlockOnFoot& block, double digits) {
  const Result result = simulate(block.scene());
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violated == 0);
  REQUIRE(result.events.size() == 1);
  const double t1 = block.slips_at();
  CHECK(result.events[0].type == EventType::slip);
  CHECK(std::abs(result.events[0].t - t1) <= digits * t1);
  const double c = std::cos(block.angle), s = std::sin(block.angle);
  const double size = block.slides(block.t_end);
  for (const auto& row : result.rows) {
    CAPTURE(row.t);
    const bool after = row.t > t1;
    const double x = after ? block.slides(row.t) : block.stuck(row.t);
    const double T = after ? block.fk * block.P : block.k * x;
    const ContactSample& foot = row.contacts[0];
    CHECK(std::abs(c * row.u[0] + s * row.u[1] - x) <= digits * size);
    CHECK(std::abs(c * row.u[2] + s * row.u[3] - (x - T / block.k)) <= digits * size);
    CHECK(std::abs(-s * row.u[2] + c * row.u[3]) <= digits * size);
    CHECK(foot.gap == 0.0);
    CHECK(std::abs(foot.ut - (x - T / block.k)) <= digits * size);
    CHECK(std::abs(foot.slip - foot.ut) <= digits * size);
    CHECK(std::abs(foot.T - T) <= digits * block.P);
    CHECK(std::abs(foot.N + block.P) <= digits * block.P);
    // The springs of the structure hold all there is, and what static friction held beyond kinetic is lost at once.
    const double elastic = T * T / (2.0 * block.k) + block.P * block.P / (2.0 * block.k_n);
    CHECK(std::abs(row.energy.elastic - elastic) <= digits * elastic);
    CHECK(row.energy.contact == 0.0);
    const double before = block.fs * block.P, drop = before - block.fk * block.P;
    const double lost =
        !after ? 0.0
               : drop * (before + block.fk * block.P) / (2.0 * block.k) + T * (foot.slip - drop / block.k);
    CHECK(std::abs(row.energy.friction - lost) <= digits * block.P * size);
  }
}

constexpr double pulled_m = 2.0, pulled_k = 300.0, pulled_P = 40.0, pulled_r = 3.0, pulled_f = 0.5;

/// A mass behind a foot without mass, which is pressed by P and pulled by r t; lengths in units of 1/unit m.
std::string pulled_foot(const char* engine, double angle, double unit, double t_end) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto along = [](double x, double y) { return fmt::format("{{ fx = {:.17g}, fy = {:.17g} }}", x, y); };
  return fmt::format(R"(schema = 1
units = {{ {10} }}
run = {{ t_end = {0}, engine = "{1}", rtol = 1e-10, output_dt = 0.25, initial = "static", certify = false }}
[matrices]
dofs = ["x", "y", "fx", "fy"]
mass = [[{2}, 0.0, 0.0, 0.0], [0.0, {2}, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]
stiffness = {3}
[[loads]]
direction = {4}
amplitude = {5}
history = {{ type = "constant" }}
[[loads]]
direction = {6}
amplitude = {7}
history = {{ type = "table", times = [0.0, 1.0e3], values = [0.0, 1.0e3] }}
[[contacts]]
name = "foot"
law = "rigid"
normal = {8}
tangent = {6}
friction = {9}
[[output]]
name = "foot"
kind = "displacement"
direction = {6}
[[output]]
name = "speed"
kind = "velocity"
direction = {6}
)",
                     t_end, engine, pulled_m / unit, leg_stiffness(angle, pulled_k / unit, 900.0 / unit),
                     along(s, -c), pulled_P, along(c, s), pulled_r, along(-s, c), pulled_f,
                     unit == 1.0 ? "force = \"N\", mass = \"kg\", length = \"m\", time = \"s\""
                                 : "force = \"N\", mass = \"t\", length = \"mm\", time = \"s\"");
}

/// Two blocks that do not match on the ground, dragged to and fro at the top; law: of both seams, friction: of the upper.
std::string dragged_blocks(const char* engine, double degrees, const std::string& law,
                           const char* friction = "0.3") {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format(
      R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [{0:.17g}, {1:.17g}]
run = {{ t_end = 0.03, engine = "{2}", rtol = 1e-10, output_dt = 0.001, certify = false, initial = "static" }}
damping = {{ alpha = 60.0, beta = 0.0 }}
[[bodies]]
name = "low"
rectangle = {{ size = [0.4, 0.1], degrees = {3} }}
elements = [4, 2]
E = 2.0e7
nu = 0.3
density = 2000.0
thickness = 0.1
plane = "stress"
[[bodies]]
name = "high"
rectangle = {{ from = [{4:.17g}, {5:.17g}], size = [0.3, 0.2], degrees = {3} }}
elements = [3, 2]
E = 3.0e7
nu = 0.2
density = 2500.0
thickness = 0.1
plane = "stress"
[[seams]]
name = "foot"
slave = "low.bottom"
master = "ground"
friction = 0.5
contact_mass = "none"
{6}
[[seams]]
name = "joint"
slave = "high.bottom"
master = "low.top"
friction = {9}
contact_mass = "none"
{6}
[[loads]]
group = "high.top"
traction = 2500.0
direction = [{7:.17g}, {8:.17g}]
history = {{ type = "harmonic", omega = 300.0 }}
)",
      9.81 * s, -9.81 * c, engine, degrees, 0.05 * c - 0.1 * s, 0.05 * s + 0.1 * c, law, c, s, friction);
}

Scene dragged(const char* engine, double degrees, const std::string& law) {
  return parse_scene(dragged_blocks(engine, degrees, law), "blocks.toml");
}

const char* const rigid_law = "law = \"rigid\"";

std::string compliant_law(double stiffness) {
  return fmt::format("law = \"compliant\"\nnormal_stiffness = {0}\ntangential_stiffness = {0}", stiffness);
}

void check_alike_events(const Result& a, const Result& b, double within) {
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CAPTURE(i);
    CHECK(a.events[i].contact == b.events[i].contact);
    CHECK(a.events[i].to == b.events[i].to);
    CHECK(std::abs(a.events[i].t - b.events[i].t) <= within);
  }
}

/// Greatest difference of displacements over all rows.
double farthest(const Result& a, const Result& b) {
  REQUIRE(a.rows.size() == b.rows.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    most = std::max(most, (a.rows[i].u - b.rows[i].u).cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rigid_massless");

TEST_CASE("a block on a foot without mass: slip begins where T reaches f N, the foot follows; closed forms") {
  for (const double angle : {0.0, 0.7, -2.1}) {
    CAPTURE(angle);
    check_closed_form({.angle = angle}, 1e-10);
    check_closed_form({.fs = 0.5, .fk = 0.3, .angle = angle}, 1e-10);
  }
  check_closed_form({.engine = "ida", .angle = 0.7}, 1e-7);
}

TEST_CASE("loads on the foot itself: displacements, rates, energy and work are those of the foot") {
  // The foot is pressed and pulled, the mass follows: stuck x = 0; sliding T = f P, m x'' = r t - f P = k (foot - x).
  const double t1 = pulled_f * pulled_P / pulled_r, t_end = 8.0;
  const auto check = [&](const char* engine, double angle, double unit, double digits) {
    CAPTURE(engine);
    CAPTURE(angle);
    CAPTURE(unit);
    const Result result = simulate(parse_scene(pulled_foot(engine, angle, unit, t_end), "foot.toml"));
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.law_checks.violated == 0);
    REQUIRE(result.events.size() == 1);
    CHECK(std::abs(result.events[0].t - t1) <= digits * t1);
    const auto x_at = [&](double d) { return pulled_r * d * d * d / (6.0 * pulled_m); };
    const double c = std::cos(angle), s = std::sin(angle), P = pulled_P, r = pulled_r, k = pulled_k;
    const double size = x_at(t_end - t1) + r * (t_end - t1) / k, top = pulled_f * P * size;
    for (const auto& row : result.rows) {
      CAPTURE(row.t);
      const double d = std::max(0.0, row.t - t1), x = x_at(d), v = r * d * d / (2.0 * pulled_m);
      const double foot = x + r * d / k, lost = pulled_f * P * foot;
      const auto along = [&](const Vector& q, Eigen::Index at) { return (c * q[at] + s * q[at + 1]) / unit; };
      const auto across = [&](const Vector& q, Eigen::Index at) {
        return (-s * q[at] + c * q[at + 1]) / unit;
      };
      CHECK(std::abs(along(row.u, 0) - x) <= digits * size);
      CHECK(std::abs(along(row.u, 2) - foot) <= digits * size);
      CHECK(std::abs(across(row.u, 2)) <= digits * size);
      CHECK(std::abs(across(row.u, 0)) <= digits * size);
      CHECK(std::abs(along(row.v, 2) - (d > 0.0 ? v + r / k : 0.0)) <= digits * (v + r / k));
      CHECK(std::abs(row.contacts[0].ut / unit - foot) <= digits * size);
      CHECK(std::abs(row.contacts[0].N + P) <= digits * P);
      CHECK(std::abs(row.contacts[0].T - std::min(r * row.t, pulled_f * P)) <= digits * P);
      const double elastic = r * d * r * d / (2.0 * k), kinetic = 0.5 * pulled_m * v * v;
      CHECK(std::abs(row.energy.elastic / unit - elastic) <= digits * top);
      CHECK(std::abs(row.energy.kinetic / unit - kinetic) <= digits * top);
      CHECK(std::abs(row.energy.friction / unit - lost) <= digits * top);
      CHECK(std::abs(row.energy.loads / unit - (lost + elastic + kinetic)) <= digits * top);
      CHECK(row.energy.contact == 0.0);
    }
    const Vector &u = result.rows.back().u, &v = result.rows.back().v;
    const auto& last = result.responses.back().values;  // the foot and its rate, by outputs
    CHECK(std::abs(last[0] - (c * u[2] + s * u[3])) <= 1e-12 * unit * size);
    CHECK(std::abs(last[1] - (c * v[2] + s * v[3])) <= 1e-12 * unit * size);
  };
  for (const double angle : {0.0, 0.7}) check("exact", angle, 1.0, 1e-10);
  check("exact", -2.1, 1000.0, 1e-10);
  check("ida", 0.7, 1.0, 1e-7);
}

TEST_CASE(
    "heat, tractions and pressures on nodes of a rigid seam without mass: the limit of compliant ones") {
  const auto loaded = [](const char* engine, double degrees, const std::string& law) {
    std::string text = dragged_blocks(engine, degrees, law);
    text.insert(text.find("[[bodies]]\nname = \"high\""),
                "thermal_expansion = 1e-5\ntemperature = { type = \"table\", times = [0.0, 0.06], values = "
                "[0.0, 4.0] }\n");
    text +=
        "[[loads]]\ngroup = \"low.bottom\"\ntraction = 300.0\ndirection = [" +
        fmt::format("{:.17g}, {:.17g}", std::cos(degrees * std::numbers::pi / 180.0),
                    std::sin(degrees * std::numbers::pi / 180.0)) +
        "]\nhistory = { type = \"harmonic\", omega = 200.0 }\n[[loads]]\ngroup = \"low.left\"\npressure = "
        "500.0\nhistory = { type = \"harmonic\", omega = 250.0 }\n";
    return text;
  };
  const auto run = [&](const char* engine, double degrees, const std::string& law) {
    return simulate(parse_scene(loaded(engine, degrees, law), "loaded.toml"));
  };
  const Result limit = run("exact", 0.0, rigid_law);
  REQUIRE(limit.report.outcome.kind == Outcome::Kind::done);
  CHECK(limit.report.law_checks.violated == 0);
  CHECK(limit.events.size() > 10);
  const double off = farthest(limit, run("exact", 0.0, compliant_law(1e11)));
  const double closer = farthest(limit, run("exact", 0.0, compliant_law(1e12)));
  CHECK(off / closer == doctest::Approx(10.0).epsilon(0.1));
  double most = 0.0;
  for (const auto& row : limit.rows) most = std::max(most, row.energy.kinetic + row.energy.elastic);
  for (const auto& row : limit.rows)
    CHECK(std::abs(row.energy.balance() - limit.rows.front().energy.balance()) <= 1e-9 * most);
  check_alike_events(limit, run("exact", 33.7, rigid_law), 1e-10);
  check_alike_events(limit, run("ida", 0.0, rigid_law), 1e-6);
  const auto halves = tests::halves::split_text(loaded("exact", 0.0, rigid_law), {}, 0.47);
  CHECK(halves.events_agree);
  CHECK(halves.state <= 1e-8);
}

TEST_CASE("rigid seams without mass: exact, ida and turned alike; laws, energy, halves") {
  const Result exact = simulate(dragged("exact", 0.0, rigid_law));
  REQUIRE(exact.report.outcome.kind == Outcome::Kind::done);
  CHECK(exact.events.size() > 10);
  CHECK(exact.report.law_checks.violated == 0);
  double most = 0.0;
  for (const auto& row : exact.rows) most = std::max(most, row.energy.kinetic + row.energy.elastic);
  for (const auto& row : exact.rows) {
    CHECK(std::abs(row.energy.balance() - exact.rows.front().energy.balance()) <= 1e-9 * most);
    for (const ContactSample& c : row.contacts) {
      CHECK(c.gap >= 0.0);
      if (!is_open(c.state)) CHECK(c.gap == 0.0);
      if (kind_of(c.state) == State::stick) CHECK(c.vt == 0.0);
    }
  }
  const Result turned = simulate(dragged("exact", 33.7, rigid_law));
  check_alike_events(exact, turned, 1e-10);
  check_alike_events(exact, simulate(dragged("ida", 0.0, rigid_law)), 1e-6);
  const auto halves = tests::halves::split_text(dragged_blocks("exact", 0.0, rigid_law), {}, 0.47);
  CHECK(halves.events_agree);
  CHECK(halves.events > 3);
  CHECK(halves.time <= 1e-9);
  CHECK(halves.state <= 1e-8);
}

TEST_CASE("rigid seams without mass are the limit of compliant ones: differences fall like 1/k") {
  const Result limit = simulate(dragged("exact", 0.0, rigid_law));
  double before = 0.0;
  for (const double k : {1e10, 1e11, 1e12}) {
    CAPTURE(k);
    const double now = farthest(limit, simulate(dragged("exact", 0.0, compliant_law(k))));
    if (before > 0.0) CHECK(before / now == doctest::Approx(10.0).epsilon(0.1));
    before = now;
  }
}

TEST_CASE("what slides at once keeps sliding where another seam closes on the way; witness and laws") {
  // joint.2 lets go at its static limit 0.35 N and drops to 0.3 N; the parts without mass that follow close joint.1, which
  // has just opened. How fast joint.2 slides is told where they arrive: it was stuck halfway, at 0.306 N.
  for (const auto& [engine, degrees, law] : {std::tuple{"exact", 0.0, std::string(rigid_law)},
                                             {"exact", 33.7, std::string(rigid_law)},
                                             {"ida", 0.0, std::string(rigid_law)},
                                             {"exact", 0.0, compliant_law(1e13)}}) {
    CAPTURE(engine);
    CAPTURE(degrees);
    CAPTURE(law);
    const std::string text = dragged_blocks(engine, degrees, law, "{ static = 0.35, kinetic = 0.3 }");
    const Scene scene = parse_scene(text, "blocks.toml", {{"run.t_end", "0.0065"}});
    const Model model = build_model(scene);
    const Result result = simulate(scene);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.law_checks.violated == 0);
    long seen = 0;
    for (std::size_t i = 0; i + 1 < result.events.size(); ++i) {
      const Event &closing = result.events[i], &slip = result.events[i + 1];
      if (closing.type != EventType::contact || slip.t != closing.t) continue;
      ++seen;
      CHECK(model.contacts[static_cast<std::size_t>(closing.contact)].name == "joint.1");
      CHECK(model.contacts[static_cast<std::size_t>(slip.contact)].name == "joint.2");
      CHECK(!closing.t_uncertainty);  // its own guard gives no time
      CHECK(slip.to == State::slip_plus);
      CHECK(slip.T == doctest::Approx(-0.35 * slip.N).epsilon(1e-6));
      CHECK(slip.T_after == doctest::Approx(-0.3 * slip.N_after).epsilon(1e-9));
    }
    CHECK(seen == 1);
  }
}

TEST_CASE(
    "friction that makes forces without mass not unique is refused, as are dampers and rebounds there") {
  const auto refused = [](const std::string& text, const std::string& message) {
    CAPTURE(message);
    try {
      static_cast<void>(build_model(parse_scene(text, "refused.toml")));
      FAIL("accepted");
    } catch (const SceneError& e) {
      CHECK_MESSAGE(std::string(e.what()).find(message) != std::string::npos, std::string(e.what()));
    }
  };
  // A foot on a leg that leans: [k_xx k_xy; k_xy k_yy] = [2 1; 1 2] k, F_nn = F_tt, F_nt = -F_nn/2; unique below f = 2.
  const auto leaning = [](const char* f, const char* more) {
    return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0 }}
[matrices]
dofs = ["x", "y", "fx", "fy"]
mass = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]
stiffness = [[2.0, 1.0, -2.0, -1.0], [1.0, 2.0, -1.0, -2.0], [-2.0, -1.0, 2.0, 1.0], [-1.0, -2.0, 1.0, 2.0]]
[[contacts]]
name = "foot"
law = "rigid"
normal = {{ fy = 1.0 }}
tangent = {{ fx = 1.0 }}
friction = {}
{})",
                       f, more);
  };
  CHECK_NOTHROW(static_cast<void>(build_model(parse_scene(leaning("1.99", ""), "leaning.toml"))));
  refused(leaning("2.01", ""),
          "contacts.foot.friction: the forces of this contact are not unique while it slides");
  refused(leaning("0.5", "restitution = 0.5\n"),
          "contacts.foot.restitution: fy.u has no mass, so nothing rebounds");
  std::string damped = dragged_blocks("exact", 0.0, rigid_law);
  damped.replace(damped.find("beta = 0.0"), 10, "beta = 1e-5");
  refused(damped, "damping.beta damps its motion");
}

TEST_CASE(
    "feet that couple: friction above (1 - c)/d is warned of, since their forces may not be unique "
    "together") {
  // Compliance of two feet: F_nn = [1 c; c 1], F_nt = [0 d; d 0], F_tt = 2. F_nn - s f F_nt is positive definite while
  // |c - s f d| < 1: f < (1 - c)/d = 1.25 for s = -1.
  const double c = 0.5, d = 0.4;
  Eigen::Matrix4d F;
  F << 1.0, 0.0, c, d, 0.0, 2.0, d, 0.0, c, d, 1.0, 0.0, d, 0.0, 0.0, 2.0;  // n1, t1, n2, t2
  const Eigen::Matrix4d K = F.inverse();
  const auto feet = [&](double f) {
    std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 1.0 }
[matrices]
dofs = ["n1", "t1", "n2", "t2", "x"]
mass = [[0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 1.0]]
stiffness = [)";
    for (int i = 0; i < 4; ++i)
      text += fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}, 0.0],", K(i, 0), K(i, 1), K(i, 2), K(i, 3));
    text += "[0.0, 0.0, 0.0, 0.0, 1.0]]\n";
    for (int k = 1; k <= 2; ++k)
      text += fmt::format(
          "[[contacts]]\nname = \"foot{0}\"\nlaw = \"rigid\"\nnormal = {{ n{0} = 1.0 }}\ntangent = {{ t{0} = "
          "1.0 "
          "}}\nfriction = {1}\n",
          k, f);
    std::string all;
    for (const std::string& warning : build_model(parse_scene(text, "feet.toml")).warnings)
      all += warning + "\n";
    return all.find("may not be unique while all of them slide in the same direction") != std::string::npos
               ? all
               : std::string();
  };
  CHECK(feet(1.249).empty());
  CHECK(feet(1.251).find("the forces of the 2 rigid contacts") != std::string::npos);
  CHECK(feet(2.5).find("unique with 0.5 times this friction") != std::string::npos);
}

TEST_SUITE_END();
