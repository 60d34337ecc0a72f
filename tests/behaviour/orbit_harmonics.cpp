// Orbits of NLvib's examples against harmonic balance: the difference falls with the harmonics.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>

#include "behaviour/harmonic_balance.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

using BalanceKind = HarmonicBalance::Element::Kind;

std::string matrix_text(const Eigen::MatrixXd& a) {
  std::vector<std::string> rows;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    std::vector<std::string> row;
    for (Eigen::Index j = 0; j < a.cols(); ++j) row.push_back(fmt::format("{:.17g}", a(i, j)));
    rows.push_back(fmt::format("[{}]", fmt::join(row, ", ")));
  }
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

std::string form_text(const Eigen::VectorXd& direction, double factor = 1.0) {
  std::vector<std::string> terms;
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    if (direction[i] != 0.0) terms.push_back(fmt::format("d{} = {}", i, factor * direction[i]));
  return fmt::format("{{ {} }}", fmt::join(terms, ", "));
}

/// The same system as a scene. A regularised slider becomes one that sticks.
std::string balance_scene(const HarmonicBalance& system, const std::string& run) {
  std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nengine = "
      "\"exact\"\n{}\n[matrices]\nmass = {}\nstiffness = {}\ndamping = {}\n",
      run, matrix_text(system.M), matrix_text(system.K), matrix_text(system.C));
  int number = 0;
  for (const HarmonicBalance::Element& e : system.elements) {
    text += fmt::format("[[contacts]]\nname = \"c{}\"\n", number++);
    if (e.kind == BalanceKind::one_sided)
      text += fmt::format("law = \"compliant\"\nnormal = {}\ngap = {}\nnormal_stiffness = {}\n",
                          form_text(e.direction, -1.0), e.limit, e.stiffness);
    else
      text += fmt::format(
          "law = \"slider\"\ntangent = {}\nnormal_force = {}\nfriction = 1.0\n{}", form_text(e.direction),
          e.limit,
          e.kind == BalanceKind::jenkins ? fmt::format("tangential_stiffness = {}\n", e.stiffness) : "");
  }
  return text + fmt::format(
                    "[[loads]]\ndirection = {}\namplitude = 1.0\nhistory = {{ type = \"harmonic\", "
                    "omega = {:.17g}, phase = 1.5707963267948966 }}\n",
                    form_text(system.load), system.w);
}

/// A period of the orbit at 200 equal distances, one column each.
Eigen::MatrixXd orbit_motion(const std::string& text, int transient) {
  OrbitOptions options;
  options.transient = transient;
  const Orbit orbit = find_orbit(reader_of_text(text), options);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  REQUIRE(orbit.families.empty());
  Scene scene = orbit_scene(reader_of_text(text), orbit);
  const int count = 200;
  scene.run.output_dt.reset();
  scene.run.output_times.emplace();
  for (int j = 0; j < count; ++j) scene.run.output_times->push_back(orbit.period * j / count);
  const Result run = simulate(scene);
  Eigen::MatrixXd x(run.rows.front().u.size(), count);
  for (int j = 0; j < count; ++j) {
    const double t = orbit.period * j / count;
    const auto row = std::find_if(run.rows.begin(), run.rows.end(),
                                  [&](const auto& r) { return std::abs(r.t - t) <= 1e-9 * orbit.period; });
    REQUIRE(row != run.rows.end());
    x.col(j) = row->u;
  }
  return x;
}

/// Greatest difference over the period, over the greatest displacement.
double difference_over_period(const HarmonicBalance& system, const Eigen::MatrixXd& q,
                              const Eigen::MatrixXd& x) {
  double worst = 0.0;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    worst = std::max(worst, (system.at(q, static_cast<double>(j) / static_cast<double>(x.cols())) - x.col(j))
                                .cwiseAbs()
                                .maxCoeff());
  return worst / x.cwiseAbs().maxCoeff();
}

void falls_with_harmonics(HarmonicBalance system, const Eigen::MatrixXd& x, std::vector<int> harmonics,
                          double factor, double last) {
  double before = 1.0;
  for (const int H : harmonics) {
    CAPTURE(H);
    system.harmonics = H;
    const Eigen::MatrixXd q = system.solve(x);
    CHECK(system.left(q) <= 1e-10 * (1.0 + system.load.norm()));
    const double now = difference_over_period(system, q, x);
    CHECK(now <= factor * before);
    before = now;
  }
  CHECK(before <= last);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit harmonics");

TEST_CASE("NLvib's third example: harmonic balance approaches the orbit before a one-sided spring") {
  HarmonicBalance system;
  system.M = Eigen::Matrix2d::Identity();
  system.K = Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 2.0}};
  system.C = 0.03 * system.K;
  system.load = Eigen::Vector2d(0.0, 0.1);
  system.elements = {{BalanceKind::one_sided, Eigen::Vector2d(1.0, 0.0), 100.0, 1.0}};
  system.w = 0.62;
  const Eigen::MatrixXd x =
      orbit_motion(balance_scene(system,
                                 "t_end = 9.0\ninitial = { u = [0.9471418552234623, 0.6753036568662564], "
                                 "v = [0.37884121883540234, 0.10774812890179698] }"),
                   0);
  falls_with_harmonics(system, x, {10, 20, 40}, 0.5, 1e-3);
}

TEST_CASE("NLvib's seventh example without its cubic springs: two Jenkins elements and a one-sided spring") {
  HarmonicBalance system;
  system.M = Eigen::Matrix3d::Identity();
  system.K = Eigen::Matrix3d{{2.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 2.0}};
  system.C = 0.02 * system.K;
  system.load = Eigen::Vector3d(0.0, 4.0, 0.0);  // both slip
  system.elements = {{BalanceKind::jenkins, Eigen::Vector3d(1.0, 0.0, 0.0), 20.0, 1.0},
                     {BalanceKind::jenkins, Eigen::Vector3d(-1.0, 1.0, 0.0), 20.0, 1.0},
                     {BalanceKind::one_sided, Eigen::Vector3d(0.0, 0.0, 1.0), 1.0, 0.25}};
  for (const double w : {0.7, 1.3}) {
    CAPTURE(w);
    system.w = w;
    const Eigen::MatrixXd x = orbit_motion(balance_scene(system, "t_end = 100.0"), 60);
    falls_with_harmonics(system, x, {3, 7, 14}, 0.5, 1e-3);
  }
}

TEST_CASE(
    "a slider that NLvib regularises, as in its eighth example: the difference falls with the "
    "regularisation") {
  HarmonicBalance system;
  system.M = Eigen::Matrix2d::Identity();
  system.K = Eigen::Matrix2d{{2.0, -1.0}, {-1.0, 2.0}};
  system.C = 0.05 * system.K;
  system.load = Eigen::Vector2d(0.0, 2.0);
  system.elements = {{BalanceKind::regularised, Eigen::Vector2d(1.0, 0.0), 0.1, 0.3}};
  system.w = 1.1;
  system.harmonics = 30;
  const Eigen::MatrixXd x = orbit_motion(balance_scene(system, "t_end = 100.0"), 60);
  double before = 1.0;
  for (const double eps : {1.0, 0.3, 0.1}) {
    CAPTURE(eps);
    system.elements.front().stiffness = eps;
    const Eigen::MatrixXd q = system.solve(x);
    CHECK(system.left(q) <= 1e-10 * (1.0 + system.load.norm()));
    const double now = difference_over_period(system, q, x);
    CHECK(now <= 0.5 * before);
    before = now;
  }
  CHECK(before <= 1e-3);
}

TEST_SUITE_END();
