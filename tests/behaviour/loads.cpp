// Loads, strains, hinges and supports that move, against own finite elements and matrix exponentials.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "behaviour/driven.hpp"
#include "behaviour/engines.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::loads {
namespace {

using namespace driven;
using namespace parts;

Result compute(const std::string& text, const std::string& engine, const std::vector<Override>& more = {}) {
  std::vector<Override> changes{
      {"run.engine", engine}, {"run.rtol", "1e-12"}, {"run.dt", "1e-3"}, {"run.certify", "false"}};
  changes.insert(changes.end(), more.begin(), more.end());
  const Scene scene = parse_scene(text, "test.toml", changes);
  return simulate(build_model(scene), scene.run);
}

void check_rows(const Result& result, const std::vector<int>& dofs, const Driven& driven, double tolerance) {
  REQUIRE(result.rows.size() > 5);
  double most = 0.0, off = 0.0;
  for (const Result::Row& row : result.rows) {
    const Eigen::VectorXd expected = driven.at(row.t);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const double u = row.u[dofs[i]], e = expected[static_cast<Eigen::Index>(i)];
      most = std::max(most, std::abs(e));
      off = std::max(off, std::abs(u - e));
    }
  }
  CHECK(off < tolerance * most);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
}

double tolerance_of(const std::string& engine) {
  return engine == "newmark" ? 2e-4 : 1e-10;  // ida: at rtol 1e-12, 1e-13 where it rings
}

int dof(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.physical_dofs().size(); ++i)
    if (model.physical_dofs()[i].displacement == name) return static_cast<int>(i);
  FAIL("no degree of freedom " << name);
  return -1;
}

// A beam over two spans, hinged at B in the second, its supports shaken each in its own way, loaded along the
// second span and by a moment.
const std::string spans =
    head + run_table(0.6, 0.05) + "[damping]\nalpha = 0.4\nbeta = 1e-4\n" + section(1e5, 3e3, 0.3) +
    nodes({{"A", 0, 0}, {"B", 3, 0}, {"C", 7, 0}}) + member("A, B") + member("B, C", "release = [\"B\"]\n") +
    fixed("A", "ux, rz") +
    fixed("A", "uy", "motion = { type = \"polynomial\", coefficients = [0.0, 0.0, 0.05], start = 0.0 }\n") +
    fixed("C", "uy", "motion = { type = \"harmonic\", omega = 9.0, amplitude = 0.02 }\n") + R"(
[[loads]]
name = "snow"
nodes = ["C", "B"]
direction = [0.0, -1.0]
distributed = 4.0
history = { type = "step" }
[[loads]]
node = "B"
moment = 5.0
history = { type = "step" }
)";

/// Unknowns: B.uy, B.rz, the rotation of the hinged end, C.rz.
Driven two_spans() {
  // All: A.uy A.rz B.uy B.rz hinge C.uy C.rz
  Matrix K = Matrix::Zero(7, 7), M = K;
  const std::array<std::array<int, 4>, 2> where{{{0, 1, 2, 3}, {2, 4, 5, 6}}};
  const std::array<double, 2> lengths{3.0, 4.0};
  for (std::size_t e = 0; e < 2; ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        K(where[e][static_cast<std::size_t>(i)], where[e][static_cast<std::size_t>(j)]) +=
            bending(3e3, lengths[e])(i, j);
        M(where[e][static_cast<std::size_t>(i)], where[e][static_cast<std::size_t>(j)]) +=
            inertia(0.3, lengths[e])(i, j);
      }
  const Matrix C = 0.4 * M + 1e-4 * K;
  const std::vector<int> free{2, 3, 4, 6};
  Driven d{M(free, free), C(free, free), K(free, free), Matrix::Zero(4, 5), 9.0};
  const auto column = [&](const Matrix& a, int support) { return Eigen::VectorXd(a(free, support)); };
  // A: s = 0.05 t^2
  d.F.col(square) -= 0.05 * column(K, 0);
  d.F.col(linear) -= 0.10 * column(C, 0);
  d.F.col(one) -= 0.10 * column(M, 0);
  // C: s = 0.02 sin 9 t
  d.F.col(sine) -= 0.02 * column(K, 5) - 0.02 * 81.0 * column(M, 5);
  d.F.col(cosine) -= 0.02 * 9.0 * column(C, 5);
  // q L / 2, q L^2 / 12
  d.F(0, one) -= 4.0 * 4.0 / 2.0;
  d.F(2, one) -= 4.0 * 16.0 / 12.0;
  d.F(3, one) += 4.0 * 16.0 / 12.0;
  d.F(1, one) += 5.0;
  return d;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/loads");

TEST_CASE("a hinge, a distributed load, a moment and two supports shaken apart") {
  const Driven expected = two_spans();
  const Model model = build_model(parse_scene(spans, "test.toml"));
  const std::vector<int> dofs{dof(model, "B.uy"), dof(model, "B.rz"), dof(model, "B-C.B.rz"),
                              dof(model, "C.rz")};
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    check_rows(compute(spans, engine, {{"run.dt", "1e-4"}}), dofs, expected, tolerance_of(engine));
  }
  // All modes kept: the reduced model is the model.
  check_rows(compute(spans + "[reduction]\ncutoff_omega = 1e6\n", "exact"), dofs, expected, 1e-10);
}

TEST_CASE("what supports do closes the balance of energy") {
  for (const std::string& engine : engines) {
    const Result result = compute(spans, engine);
    CHECK(result.report.audit.energy.value < 1e-8 * result.report.audit.energy_scale);
    CHECK(result.report.audit.work_of_loads > 0.01);
  }
}

TEST_CASE("heat: a clamped beam at any angle pushes its end out, and rings when it comes suddenly") {
  for (const double angle : {0.0, 0.7, 2.5}) {
    const std::string structure = section(2e5, 2e3, 0.0) +
                                  nodes({{"A", 0, 0}, {"B", 5.0 * std::cos(angle), 5.0 * std::sin(angle)}}) +
                                  point_mass("B", 0.8, 0.1) + fixed("A", "ux, uy, rz") +
                                  member("A, B", "elements = 3\nthermal_expansion = 1.2e-5\n");
    const double out = 1.2e-5 * 40.0 * 5.0, omega = std::sqrt(2e5 / 5.0 / 0.8);
    const auto along = [&](const Model& model, const Vector& u) {
      return u[dof(model, "B.ux")] * std::cos(angle) + u[dof(model, "B.uy")] * std::sin(angle);
    };
    const std::string rest =
        head + run_table(0.2, 0.01, "static") + structure + "temperature = 30.0\ninitial_strain = 1.2e-4\n";
    const Model at_rest = build_model(parse_scene(rest, "test.toml"));
    CHECK(along(at_rest, at_rest.u0) == doctest::Approx(out).epsilon(1e-11));
    const std::string sudden =
        head + run_table(0.2, 0.01) + structure + "temperature = { type = \"step\", amplitude = 40.0 }\n";
    const Model model = build_model(parse_scene(sudden, "test.toml"));
    for (const std::string& engine : locating_engines) {
      CAPTURE(engine);
      const Result result = compute(sudden, engine, {{"run.dt", "2e-4"}, {"run.rtol", "5e-14"}});
      for (const Result::Row& row : result.rows)
        CHECK(std::abs(along(model, row.u) - out * (1.0 - std::cos(omega * row.t))) <
              (engine == "newmark" ? 2e-2 : tolerance_of(engine)) * out);
    }
  }
}

TEST_CASE("a bar takes heat and distributed loads, along and across") {
  const std::string text =
      head + run_table(1.0, 0.1, "static") + "[sections.s]\nEA = 1e4\nmass_per_length = 0.0\n" +
      nodes({{"A", 0, 0}, {"B", 3, 4}}) + point_mass("B", 1.0) + spring("B", "[1.0, 0.0]", 700.0) +
      fixed("A", "ux, uy") + fixed("B", "uy") +
      member("A, B", "type = \"bar\"\nthermal_expansion = 1e-5\ntemperature = 50.0\n") + R"([[loads]]
nodes = ["A", "B"]
axes = "member"
direction = [0.6, 0.8]
distributed = 2.0
)";
  const Model model = build_model(parse_scene(text, "test.toml"));
  // along (0.6, 0.8), to the left (-0.8, 0.6): q = 2 (0.6 e + 0.8 n)
  const double qx = 2.0 * (0.6 * 0.6 - 0.8 * 0.8), k = 1e4 / 5.0 * 0.36 + 700.0;
  const double expected = (0.5 * 5.0 * qx + 0.6 * 1e4 * 5e-4) / k;
  CHECK(model.u0[dof(model, "B.ux")] == doctest::Approx(expected).epsilon(1e-12));
}

TEST_CASE("springs of rotations, dampers on a support that moves") {
  const std::string text =
      head + run_table(2.0, 0.1) + nodes({{"A", 0, 0}, {"B", 1, 0}}) + point_mass("B", 0.5, 0.2) +
      "[[springs]]\nnode = \"B\"\nagainst = \"A\"\nrotation_stiffness = 7.0\nrotation_damping = 0.3\n" +
      spring("B", "[1.0, 0.0]", 40.0) + "against = \"A\"\ndamping = 0.6\n" + fixed("B", "uy") +
      fixed("A", "rz", "motion = { type = \"harmonic\", omega = 3.0, amplitude = 0.1 }\n") +
      fixed("A", "ux", "acceleration = { type = \"polynomial\", coefficients = [0.4], start = 0.0 }\n") +
      "[[loads]]\nnode = \"B\"\nmoment = 0.25\nhistory = { type = \"step\" }\n";
  Driven turning{Matrix::Constant(1, 1, 0.2), Matrix::Constant(1, 1, 0.3), Matrix::Constant(1, 1, 7.0),
                 Matrix::Zero(1, 5), 3.0};
  turning.F(0, sine) = 7.0 * 0.1;
  turning.F(0, cosine) = 0.3 * 0.1 * 3.0;
  turning.F(0, one) = 0.25;
  Driven moving{Matrix::Constant(1, 1, 0.5), Matrix::Constant(1, 1, 0.6), Matrix::Constant(1, 1, 40.0),
                Matrix::Zero(1, 5), 3.0};
  moving.F(0, square) = 40.0 * 0.2;
  moving.F(0, linear) = 0.6 * 0.4;
  const Model model = build_model(parse_scene(text, "test.toml"));
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result result = compute(text, engine);
    check_rows(result, {dof(model, "B.rz")}, turning, tolerance_of(engine));
    check_rows(result, {dof(model, "B.ux")}, moving, tolerance_of(engine));
  }
}

TEST_CASE("the base moves along both directions at once, one of them in g") {
  const std::string text = head + run_table(1.0, 0.1) + nodes({{"A", 0, 0}}) + point_mass("A", 2.0) +
                           spring("A", "[1.0, 0.0]", 50.0) + spring("A", "[0.0, 1.0]", 90.0) + R"(
[[base_motion]]
direction = [1.0, 0.0]
acceleration = { type = "step", amplitude = 0.2, unit = "g" }
[[base_motion]]
direction = [0.0, 1.0]
acceleration = { type = "step", amplitude = 0.7 }
)";
  for (const std::string& engine : engines) {
    const Result result = compute(text, engine);
    for (const Result::Row& row : result.rows) {
      CHECK(row.u[0] == doctest::Approx(-0.2 * 9.80665 / 25.0 * (1.0 - std::cos(5.0 * row.t))).epsilon(1e-9));
      CHECK(row.u[1] ==
            doctest::Approx(-0.7 / 45.0 * (1.0 - std::cos(std::sqrt(45.0) * row.t))).epsilon(1e-9));
    }
  }
}

TEST_CASE("base motion is the motion of all supports, seen from them") {
  // The same frame, its two feet moved by s(t), against -M r s'' relative to them.
  const std::string frame = head + run_table(0.5, 0.05) + section(1e5, 3e3, 0.3) +
                            nodes({{"A", 0, 0}, {"B", 0, 3}, {"C", 4, 3}, {"D", 4, 0}}) +
                            member("A, B, C, D", "elements = 2\n") + fixed("A, D", "uy, rz");
  const std::string course = "{ type = \"polynomial\", coefficients = [0.5, 2.0], start = 0.0 }\n";
  const std::string moved = frame + fixed("A, D", "ux", "acceleration = " + course);
  const std::string shaken =
      frame + fixed("A, D", "ux") + "[base_motion]\ndirection = [1.0, 0.0]\nacceleration = " + course;
  const Result a = compute(moved, "exact"), b = compute(shaken, "exact");
  const Model model = build_model(parse_scene(moved, "test.toml"));
  REQUIRE(a.rows.size() == b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    const double t = a.rows[i].t, s = 0.25 * t * t + t * t * t / 3.0;
    for (Eigen::Index j = 0; j < a.rows[i].u.size(); ++j) {
      const std::string& name = model.dofs[static_cast<std::size_t>(j)].displacement;
      const double ground = name.ends_with(".ux") ? s : 0.0;
      CHECK(std::abs(a.rows[i].u[j] - ground - b.rows[i].u[j]) < 1e-11);
    }
  }
}

TEST_CASE(
    "a support that jumps or has a kink is refused where mass or dampers would answer with an impulse") {
  const auto with = [&](const std::string& motion) {
    std::string text = spans;
    const std::string old = "{ type = \"harmonic\", omega = 9.0, amplitude = 0.02 }";
    text.replace(text.find(old), old.size(), motion);
    return text;
  };
  const auto message = [](const std::string& text) -> std::string {
    try {
      (void)build_model(parse_scene(text, "test.toml"));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK(message(with("{ type = \"step\", start = 0.1 }")).find("jumps at t = 0.1") != std::string::npos);
  CHECK(message(with("{ type = \"table\", times = [0.0, 0.1, 0.2], values = [0.0, 1.0, 1.0], hold = true }"))
            .find("velocity jumps at t = 0.1") != std::string::npos);
  CHECK(message(with("{ type = \"table\", times = [0.0, 0.1, 0.2], values = [0.0, 1.0, 1.0], hold = true, "
                     "interpolation = \"steffen\" }")) == "no error");
}

TEST_CASE("a static start takes supports where they are") {
  std::string text = spans;
  const std::string old = "{ type = \"harmonic\", omega = 9.0, amplitude = 0.02 }";
  text.replace(text.find(old), old.size(), "-0.03");
  text.replace(text.find("t_end"), 5, "initial = \"static\"\nt_end");
  const Model model = build_model(parse_scene(text, "test.toml"));
  // a cantilever with a hinged beam behind it: only the beam follows, as a straight line
  CHECK(model.u0[dof(model, "B.uy")] == doctest::Approx(0.0).epsilon(1e-12));
  CHECK(model.u0[dof(model, "C.rz")] == doctest::Approx(-0.03 / 4.0).epsilon(1e-10));
  CHECK(model.u0[dof(model, "B-C.B.rz")] == doctest::Approx(-0.03 / 4.0).epsilon(1e-10));
}

TEST_SUITE_END();

}  // namespace signorini::tests::loads
