// Lemke's method against its own conditions and against enumeration, on thousands of random problems.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/lcp.hpp"
#include "decide/coulomb_problem.hpp"

using namespace signorini;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Kind = decide::CoulombItem::Kind;

MatrixXd random_matrix(std::mt19937_64& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

bool solves(const MatrixXd& M, const VectorXd& q, const VectorXd& z) {
  const VectorXd w = q + M * z;
  const double zero = 1e-10 * (1.0 + z.cwiseAbs().maxCoeff());
  return w.minCoeff() >= -zero && z.minCoeff() >= 0.0 && w.cwiseProduct(z).cwiseAbs().maxCoeff() <= zero;
}

/// Number of solutions with different z, by all choices of active sets.
int count_solutions(const MatrixXd& M, const VectorXd& q) {
  const Eigen::Index n = q.size();
  std::vector<VectorXd> found;
  for (int code = 0; code < (1 << n); ++code) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < n; ++i)
      if (code >> i & 1) active.push_back(i);
    VectorXd z = VectorXd::Zero(n);
    if (!active.empty()) {
      const MatrixXd block = M(active, active);
      const VectorXd x = base::solve_dense(block, VectorXd(-q(active)));
      z(active) = x;
    }
    if (z.minCoeff() < -1e-12 || !solves(M, q, z.cwiseMax(0.0))) continue;
    bool known = false;
    for (const VectorXd& other : found) known = known || (other - z).norm() < 1e-7 * (1.0 + z.norm());
    if (!known) found.push_back(z);
  }
  return static_cast<int>(found.size());
}

/// m contacts on a body whose inverse mass in their coordinates is random, positive definite.
decide::CoulombProblem random_problem(std::mt19937_64& random, std::size_t m, double friction,
                                      bool only_frictional) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto size = static_cast<Eigen::Index>(2 * m);
  const MatrixXd a = random_matrix(random, size, size + 2);
  decide::CoulombProblem p{a * a.transpose(), random_matrix(random, size, 1), {}, ForceLayout(m)};
  for (std::size_t i = 0; i < m; ++i) {
    decide::CoulombItem item;
    const double choice = uniform(random);
    item.kind = only_frictional || choice < 0.5 ? Kind::frictional
                : choice < 0.7                  ? Kind::normal
                : choice < 0.9                  ? Kind::sliding
                                                : Kind::pressed;
    item.static_friction = friction * uniform(random);
    item.kinetic_friction = item.static_friction;
    item.sign = uniform(random) < 0.5 ? 1 : -1;
    item.applied_normal_force = uniform(random);
    p.items.push_back(item);
  }
  return p;
}

/// Signorini's and Coulomb's conditions.
void check_conditions(const decide::CoulombProblem& p, const decide::CoulombSolution& s) {
  const double zero = 1e-9 * (1.0 + s.force.cwiseAbs().maxCoeff() + p.b.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const decide::CoulombItem& item = p.items[i];
    const auto n = static_cast<Eigen::Index>(2 * i), t = n + 1;
    const double l = item.kind == Kind::pressed ? item.applied_normal_force : s.force[n];
    const double k = s.force[t], rn = s.response[n], rt = s.response[t];
    if (item.kind == Kind::limit) {
      CHECK(item.sign * k >= -zero);
      CHECK(item.sign * rt >= -zero);
      CHECK(std::abs(k * rt) <= zero * (1.0 + std::abs(k) + std::abs(rt)));
      CHECK(s.force[n] == 0.0);
      continue;
    }
    if (item.kind != Kind::pressed) {
      CHECK(l >= -zero);
      CHECK(rn >= -zero);
      CHECK(std::abs(l * rn) <= zero * (1.0 + std::abs(l) + std::abs(rn)));
    }
    if (item.kind == Kind::normal) continue;
    const double f = s.kinetic[i] ? item.kinetic_friction : item.static_friction;
    if (item.kind == Kind::sliding) {
      CHECK(std::abs(k + item.sign * item.kinetic_friction * l) <= zero);
      continue;
    }
    CHECK(std::abs(k) <= f * l + zero);
    if (std::abs(rt) > 1e3 * zero) CHECK(std::abs(k + (rt > 0.0 ? 1 : -1) * f * l) <= 1e3 * zero);
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/base/lcp");

TEST_CASE("Lemke solves thousands of problems with P-matrices, each with exactly one solution") {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Index n = 1 + trial % 7;
    const MatrixXd a = random_matrix(random, n, n), skew = random_matrix(random, n, n);
    const MatrixXd M = a * a.transpose() + 0.1 * MatrixXd::Identity(n, n) + (skew - skew.transpose());
    const VectorXd q = random_matrix(random, n, 1);
    const auto z = base::solve_lcp(M, q);
    REQUIRE(z.has_value());
    CHECK(solves(M, q, *z));
    CHECK(count_solutions(M, q) == 1);
  }
}

TEST_CASE("a ray is reported, and only where enumeration finds nothing either, for copositive matrices") {
  std::mt19937_64 random(2);
  int none = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Index n = 1 + trial % 5;
    const MatrixXd a = random_matrix(random, n, std::max<Eigen::Index>(1, n / 2));
    const MatrixXd M = a * a.transpose();  // singular for n > 1
    const VectorXd q = random_matrix(random, n, 1);
    const auto z = base::solve_lcp(M, q);
    if (z) {
      CHECK(solves(M, q, *z));
    } else {
      ++none;
      CHECK(count_solutions(M, q) == 0);
    }
  }
  CHECK(none > 100);
}

TEST_CASE("degenerate right sides: zeros and ties do not cycle") {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> small(-1, 1);
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Index n = 2 + trial % 6;
    const MatrixXd a = MatrixXd::NullaryExpr(n, n, [&] { return static_cast<double>(small(random)); });
    const MatrixXd M = a * a.transpose() + MatrixXd::Identity(n, n);
    const VectorXd q = VectorXd::NullaryExpr(n, [&] { return static_cast<double>(small(random)); });
    const auto z = base::solve_lcp(M, q);
    REQUIRE(z.has_value());
    CHECK(solves(M, q, *z));
  }
}

TEST_CASE("contacts that couple: Lemke's solution fulfils all conditions and is among the enumerated ones") {
  std::mt19937_64 random(4);
  int unique = 0, none = 0, several = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto m = static_cast<std::size_t>(1 + trial % 3);
    const decide::CoulombProblem p = random_problem(random, m, 2.0, false);
    const std::vector<decide::CoulombSolution> all = decide::all_solutions(p).solutions;
    const auto one = decide::solve(p);
    CHECK(one.has_value() == !all.empty());
    (all.empty() ? none : all.size() == 1 ? unique : several) += 1;
    if (!decide::may_be_nonunique(p)) CHECK(all.size() == 1);
    if (!one) continue;
    check_conditions(p, *one);
    bool among = false;
    for (const decide::CoulombSolution& s : all)
      among = among || (s.response - one->response).norm() <= 1e-7 * (1.0 + one->response.norm());
    CHECK(among);
  }
  CHECK(unique > 2000);
  CHECK(none > 10);  // Painleve: these matrices couple strongly
  CHECK(several > 10);
}

TEST_CASE(
    "contacts at their limit stick or slip along their sign, beside others, more than are enumerated, too") {
  std::mt19937_64 random(11);
  int sticks = 0, slips = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const auto m = static_cast<std::size_t>(1 + trial % 9);
    decide::CoulombProblem p = random_problem(random, m, 0.02, false);
    for (std::size_t i = 0; i < m; i += 2) {
      p.items[i].kind = Kind::limit;
      const auto n = static_cast<Eigen::Index>(2 * i);  // its normal is a row in force already
      p.W.row(n).setZero();
      p.W.col(n).setZero();
      p.b[n] = 0.0;
    }
    const auto one = decide::solve(p);
    REQUIRE(one.has_value());
    check_conditions(p, *one);
    for (std::size_t i = 0; i < m; i += 2) {
      const auto t = static_cast<Eigen::Index>(2 * i + 1);
      (p.items[i].sign * one->force[t] > 0.0 ? sticks : slips) += 1;
    }
    if (m > decide::max_enumerated) continue;
    const std::vector<decide::CoulombSolution> all = decide::all_solutions(p).solutions;
    REQUIRE(all.size() == 1);
    CHECK((all[0].response - one->response).norm() <= 1e-7 * (1.0 + one->response.norm()));
  }
  CHECK(sticks > 300);
  CHECK(slips > 300);
}

TEST_CASE("up to six contacts all states are tried, and no more") {
  for (const std::size_t count : {decide::max_enumerated, decide::max_enumerated + 1}) {
    const auto n = static_cast<Eigen::Index>(2 * count);
    decide::CoulombProblem p{MatrixXd::Identity(n, n), VectorXd::Zero(n), {}, ForceLayout(count)};
    for (std::size_t i = 0; i < count; ++i) {
      p.items.push_back({Kind::frictional, 0.5, 0.5, 0.0, 0});
      p.b[static_cast<Eigen::Index>(2 * i)] = -1.0;
    }
    const decide::EnumerationResult all = decide::all_solutions(p);
    CHECK(all.solutions.size() == (count == decide::max_enumerated ? 1 : 0));
    CHECK(std::isnan(all.min_violation) == (count > decide::max_enumerated));
  }
}

TEST_CASE("a seam of contacts that share few smooth motions: a hit has a solution, and it is found") {
  // W is semidefinite, its condition is beyond 1e10; all normals but one rest, to rounding. Stewart and Trinkle: a solution exists.
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int round = 0; round < 150; ++round) {
    CAPTURE(round);
    constexpr Eigen::Index m = 11, modes = 19;
    MatrixXd rows(2 * m, modes);
    for (Eigen::Index j = 0; j < modes; ++j) {
      const double n = uniform(random), t = uniform(random), shift = uniform(random);
      for (Eigen::Index i = 0; i < m; ++i) {
        const double place = static_cast<double>(i) / (m - 1), size = std::pow(1.6, -static_cast<double>(j));
        rows(2 * i, j) = n * size * std::cos(3.0 * static_cast<double>(j) * place + shift);
        rows(2 * i + 1, j) = t * size * std::sin(3.0 * static_cast<double>(j) * place - shift);
      }
    }
    const auto hit = static_cast<Eigen::Index>(round % m);
    MatrixXd resting(m - 1, modes);
    for (Eigen::Index i = 0, at = 0; i < m; ++i)
      if (i != hit) resting.row(at++) = rows.row(2 * i);
    VectorXd v = random_matrix(random, modes, 1);
    for (int twice = 0; twice < 2; ++twice) {
      const VectorXd off = resting * v;
      v -= base::least_squares(resting, off);
    }
    if (rows.row(2 * hit).dot(v) > 0.0) v = -v;
    decide::CoulombProblem p{rows * rows.transpose(), rows * v, {}, ForceLayout(m)};
    for (Eigen::Index i = 0; i < m; ++i) {
      decide::CoulombItem item;
      item.kind = Kind::frictional;
      item.static_friction = item.kinetic_friction = 0.4;
      p.items.push_back(item);
    }
    const auto solution = decide::solve(p);
    CHECK(solution);
    if (solution) check_conditions(p, *solution);
  }
}

TEST_CASE("an impact without restitution has a solution whatever the friction, and never gains energy") {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto m = static_cast<std::size_t>(1 + trial % 4);
    const decide::CoulombProblem p = random_problem(random, m, 3.0, true);
    const auto s = decide::solve(p);
    REQUIRE(s.has_value());
    check_conditions(p, *s);
    const double loss = -0.5 * s->force.dot(p.b + s->response);
    CHECK(loss >= -1e-9 * (1.0 + s->force.squaredNorm()));
  }
}

TEST_CASE(
    "static above kinetic friction: what sticks has the static coefficient, what slips the kinetic one") {
  decide::CoulombProblem p{
      MatrixXd::Identity(2, 2), VectorXd(2), {{Kind::frictional, 0.5, 0.3, 0.0, 0}}, ForceLayout(1)};
  p.b << -1.0, 0.4;
  auto s = decide::solve(p);
  REQUIRE(s.has_value());
  CHECK(s->response[1] == doctest::Approx(0.0));
  CHECK(s->force[1] == doctest::Approx(-0.4));
  p.b << -1.0, 0.6;
  s = decide::solve(p);
  REQUIRE(s.has_value());
  CHECK(s->force[1] == doctest::Approx(-0.3));
  CHECK(s->response[1] == doctest::Approx(0.3));
}

TEST_CASE("Painleve's rod: no state where the sliding contact digs in, two where it may also let go") {
  // g'' = b_n + (W_nn - s f W_nt) l with a negative factor
  decide::CoulombProblem p{MatrixXd(2, 2), VectorXd(2), {{Kind::sliding, 1.5, 1.5, 0.0, 1}}, ForceLayout(1)};
  p.W << 1.0, 0.9, 0.9, 1.2;
  p.b << -1.0, 0.0;
  CHECK(!decide::solve(p).has_value());
  CHECK(decide::all_solutions(p).solutions.empty());
  p.b << 1.0, 0.0;
  CHECK(decide::all_solutions(p).solutions.size() == 2);
  CHECK(decide::may_be_nonunique(p));
}

TEST_CASE("just below Painleve's limit, and at that of friction: sticking and slipping are one motion") {
  // Slipping, g'' = b_n + (1 - 0.9 f) l with a factor of 1e-6 to 1e-10; l = 1 and T = -f hold either way.
  for (const double below : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    const double f = (1.0 - below) / 0.9;
    decide::CoulombProblem p{MatrixXd(2, 2), VectorXd(2), {{Kind::frictional, f, f, 0.0, 1}}, ForceLayout(1)};
    p.W << 1.0, 0.9, 0.9, 1.2;
    for (const double off : {-2e-14, 0.0, 2e-14}) {
      CAPTURE(below);
      CAPTURE(off);
      p.b = -p.W * Eigen::Vector2d(1.0, -f * (1.0 + off));
      const decide::EnumerationResult all = decide::all_solutions(p);
      REQUIRE(all.solutions.size() == 1);
      CHECK(all.solutions[0].force[0] == doctest::Approx(1.0).epsilon(3e-14 / below + 1e-6));
    }
  }
}

TEST_SUITE_END();
