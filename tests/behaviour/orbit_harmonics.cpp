// Orbits of NLvib's examples against harmonic balance: the difference falls with the harmonics.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>

#include "base/eigen_dense.hpp"
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

/// NLvib's eighth example: a cantilever of 2 m, 8 elements of Euler and Bernoulli, a slider at its fourth node, a force at the
/// tip; damping beta K of 1 % in the first mode shape of the beam that sticks. Here from the elements' textbook matrices.
struct FrictionBeam {
  static constexpr double EI = 185e9 * 2.5e-5, mass = 7830.0 * 0.03, span = 0.25, limit = 1.5, load = 0.2;
  static constexpr Eigen::Index n = 16, slider = 4, tip = 14;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + 2, n + 2), K = M;
  double beta, stuck;  // stuck: first frequency of the beam that sticks

  FrictionBeam() {
    const double l = span, l2 = l * l;
    const Eigen::Matrix4d k{{12.0, 6.0 * l, -12.0, 6.0 * l},
                            {6.0 * l, 4.0 * l2, -6.0 * l, 2.0 * l2},
                            {-12.0, -6.0 * l, 12.0, -6.0 * l},
                            {6.0 * l, 2.0 * l2, -6.0 * l, 4.0 * l2}};
    const Eigen::Matrix4d m{{156.0, 22.0 * l, 54.0, -13.0 * l},
                            {22.0 * l, 4.0 * l2, 13.0 * l, -3.0 * l2},
                            {54.0, 13.0 * l, 156.0, -22.0 * l},
                            {-13.0 * l, -3.0 * l2, -22.0 * l, 4.0 * l2}};
    for (Eigen::Index e = 0; e < 8; ++e) {
      K.block(2 * e, 2 * e, 4, 4) += EI / (l * l2) * k;
      M.block(2 * e, 2 * e, 4, 4) += mass * l / 420.0 * m;
    }
    K = K.bottomRightCorner(n, n).eval();
    M = M.bottomRightCorner(n, n).eval();
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < n; ++i)
      if (i != slider) free.push_back(i);
    const Eigen::MatrixXd held = K(free, free), masses = M(free, free);
    stuck = std::sqrt(base::generalized_eigenvalues(held, masses)[0]);
    beta = 2.0 * 0.01 / stuck;
  }

  /// Columns: deflection of the slider's node at `samples` equal distances of a period, with f = limit tanh(v/eps), in
  /// harmonics up to H: q_h = [Z_h^-1 p]_c - [Z_h^-1]_cc f_h, Z_h = K (1 + i h w beta) - h^2 w^2 M. From a motion of it.
  [[nodiscard]] Eigen::VectorXd balance(double w, double eps, const Eigen::VectorXd& motion) const {
    using std::complex;
    const int H = 41;
    const Eigen::Index N = motion.size(), size = 2 * H;
    Eigen::MatrixXd cosines(N, H), sines(N, H);
    Eigen::VectorXcd compliance(H);
    complex<double> driven;
    for (int k = 0; k < H; ++k) {
      const int h = 2 * k + 1;
      for (Eigen::Index j = 0; j < N; ++j) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(h * j) / static_cast<double>(N);
        cosines(j, k) = std::cos(angle);
        sines(j, k) = std::sin(angle);
      }
      Eigen::MatrixXd Z(2 * n, 2 * n);  // of real and imaginary parts
      Z << K - h * h * w * w * M, -h * w * beta * K, h * w * beta * K, K - h * h * w * w * M;
      const Eigen::VectorXd x = base::solve_dense(Z, Eigen::VectorXd::Unit(2 * n, slider));
      compliance[k] = {x[slider], x[n + slider]};
      if (h == 1) driven = load * complex<double>(x[tip], x[n + tip]);
    }
    // q = Re sum (a - i b) e^(i h w t), velocities likewise
    const auto residual = [&](const Eigen::VectorXd& y) {
      const Eigen::VectorXd a = y.head(H), b = y.tail(H);
      const Eigen::VectorXd order = Eigen::VectorXd::LinSpaced(H, 1.0, 2 * H - 1) * w;
      const Eigen::VectorXd v = cosines * order.cwiseProduct(b) - sines * order.cwiseProduct(a);
      const Eigen::VectorXd f = limit * (v.array() / eps).tanh().matrix();
      const Eigen::VectorXd fc = cosines.transpose() * f * (2.0 / static_cast<double>(N)),
                            fs = sines.transpose() * f * (2.0 / static_cast<double>(N));
      Eigen::VectorXd r(size);
      for (int h = 0; h < H; ++h) {
        const complex<double> q = complex<double>(a[h], -b[h]) +
                                  compliance[h] * complex<double>(fc[h], -fs[h]) - (h == 0 ? driven : 0.0);
        r[h] = q.real();
        r[H + h] = q.imag();
      }
      return r;
    };
    Eigen::VectorXd y(size);
    y << cosines.transpose() * motion, sines.transpose() * motion;
    y *= 2.0 / static_cast<double>(N);
    const double amplitude = motion.cwiseAbs().maxCoeff();
    for (int i = 0; i < 60; ++i) {
      const Eigen::VectorXd r = residual(y);
      if (r.norm() <= 1e-11 * amplitude) break;
      Eigen::MatrixXd J(size, size);
      const double step = 1e-7 * amplitude;
      for (Eigen::Index k = 0; k < size; ++k)
        J.col(k) = (residual(y + step * Eigen::VectorXd::Unit(size, k)) - r) / step;
      const Eigen::VectorXd dy = base::solve_dense(J, r);
      double part = 1.0;
      while (part > 1e-3 && residual(y - part * dy).norm() >= r.norm()) part *= 0.5;
      y -= part * dy;
    }
    CHECK(residual(y).norm() <= 1e-9 * amplitude);
    return cosines * y.head(H) + sines * y.tail(H);
  }

  [[nodiscard]] std::string scene(double w) const {
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\n"
        "t_end = 1.0\nengine = \"exact\"\n[damping]\nbeta = {:.17g}\n"
        "[sections.beam]\nEA = 5.55e9\nEI = {:.17g}\nmass_per_length = {:.17g}\n"
        "[nodes]\nA = [0.0, 0.0]\nP = [0.75, 0.0]\nB = [2.0, 0.0]\n"
        "[[members]]\nnodes = [\"A\", \"P\", \"B\"]\nsection = \"beam\"\nelements = [3, 5]\n"
        "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\", \"rz\"]\n"
        "[[contacts]]\nname = \"slider\"\nnode = \"P\"\nlaw = \"slider\"\ntangent = [0.0, 1.0]\n"
        "normal_force = {}\nfriction = 1.0\n"
        "[[loads]]\nnode = \"B\"\ndirection = [0.0, 1.0]\namplitude = {}\nhistory = {{ type = \"harmonic\", "
        "omega = {:.17g}, phase = 1.5707963267948966 }}\n",
        beta, EI, mass, limit, load, w);
  }
};

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

TEST_SUITE_BEGIN("slow/orbit harmonics");

TEST_CASE(
    "NLvib's eighth example, a beam on a slider: the difference to its regularised friction falls with the "
    "regularisation") {
  const FrictionBeam beam;
  for (const double w : {beam.stuck, 0.97 * beam.stuck}) {
    CAPTURE(w);
    const SceneReader read = reader_of_text(beam.scene(w));
    OrbitOptions options;
    options.transient = 60;
    const Orbit orbit = find_orbit(read, options);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    REQUIRE(!orbit.sequence.empty());
    Scene scene = orbit_scene(read, orbit);
    const int count = 1024;
    scene.run.output_dt.reset();
    scene.run.output_times.emplace();
    for (int j = 0; j < count; ++j) scene.run.output_times->push_back(orbit.period * j / count);
    const Result run = simulate(scene);
    Eigen::VectorXd x(count);
    for (int j = 0; j < count; ++j) {
      const double t = (*scene.run.output_times)[static_cast<std::size_t>(j)];
      const auto row = std::find_if(run.rows.rbegin(), run.rows.rend(),
                                    [&](const auto& r) { return r.t <= t * (1.0 + 1e-12); });
      x[j] = row->contacts.front().ut;
    }
    double before = 1.0;
    for (const double eps : {1e-7, 3e-8, 1e-8, 3e-9}) {
      CAPTURE(eps);
      const double now = (beam.balance(w, eps, x) - x).cwiseAbs().maxCoeff() / x.cwiseAbs().maxCoeff();
      CHECK(now <= 0.6 * before);
      before = now;
    }
    CHECK(before <= 2e-3);
  }
}

TEST_SUITE_END();
