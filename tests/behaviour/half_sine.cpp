// A rigid block on two rigid feet, shaken by a half sine: sliding and linear rocking, beside an event follower of its own.
//
//   m x'' = -m a(t) + H,  m y'' = -m g + L + R,  J w' = h H + b (R - L)        feet: ux = x + h w, uy = y -+ b w
//
// In every state accelerations are A + B a(t), so that velocities and displacements are closed forms; events are roots
// of these by bisection, and states are looked for among all of them.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "base/eigen_dense.hpp"
#include "behaviour/one_mass.hpp"

namespace signorini::tests::half_sine {
namespace {

using Vector3 = Eigen::Vector3d;
constexpr double after = 1e-7;  // s: where states are told apart

struct Block {
  double m = 2.0, b = 0.3, h = 0.8, J = 0.5, f = 0.42, g = 9.81, size = 6.0, duration = 0.45;

  [[nodiscard]] double pulse(double t) const {
    return t < duration ? size * std::sin(std::numbers::pi / duration * t) : 0.0;
  }
  [[nodiscard]] std::string scene(double t_end) const {
    return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n" +
           fmt::format(
               "gravity = [0.0, {:.17g}]\n[run]\nt_end = {:.17g}\noutput_dt = {:.17g}\ncertify = "
               "false\n[nodes]\nL "
               "= [{:.17g}, 0.0]\nR = [{:.17g}, 0.0]\n",
               -g, t_end, t_end / 7.0, -b, b) +
           fmt::format(
               "[[rigid]]\nname = \"block\"\ncentre = [0.0, {:.17g}]\nnodes = [\"L\", \"R\"]\nmass = "
               "{:.17g}\ninertia = {:.17g}\n",
               h, m, J) +
           fmt::format(
               "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, "
               "1.0]\nfriction = {:.17g}\n",
               f) +
           fmt::format(
               "[base_motion]\ndirection = [1.0, 0.0]\nacceleration = {{ type = \"half_sine\", start = 0.0, "
               "duration = {:.17g}, amplitude = {:.17g} }}\n",
               duration, size);
  }
};

/// Which feet bear, and which way those slide.
struct Mode {
  bool left = true, right = true;
  int slip = 0;
};

class Follower {
 public:
  explicit Follower(const Block& block) : s_(block) { decide(); }

  /// Times of all events up to t_end.
  const std::vector<double>& follow(double t_end) {
    while (t_ < t_end && times_.size() < 40) step(t_end);
    return times_;
  }
  [[nodiscard]] const Vector3& place() const { return q_; }
  [[nodiscard]] bool rests() const { return mode_.left && mode_.right && mode_.slip == 0; }
  int impacts = 0, slips = 0;

 private:
  [[nodiscard]] Vector3 up(bool right) const { return {0.0, 1.0, right ? s_.b : -s_.b}; }
  [[nodiscard]] Vector3 aside() const { return {1.0, 0.0, s_.h}; }

  /// (accelerations or jumps, L, R, H) by (constant, ground) or of velocities: columns of the right side.
  [[nodiscard]] Eigen::MatrixXd solved(const Mode& mode, const Eigen::MatrixXd& dynamics,
                                       const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6), r = Eigen::MatrixXd::Zero(6, dynamics.cols());
    A.diagonal().head(3) = Vector3(s_.m, s_.m, s_.J);
    A.block(0, 3, 3, 1) = -up(false);
    A.block(0, 4, 3, 1) = -up(true);
    A.block(0, 5, 3, 1) = -aside();
    r.topRows(3) = dynamics;
    for (const bool right : {false, true}) {
      const int i = right ? 4 : 3;
      if (right ? mode.right : mode.left) {
        A.block(i, 0, 1, 3) = up(right).transpose();
        r.row(i) = rows.row(right ? 1 : 0);
      } else {
        A(i, i) = 1.0;
      }
    }
    if ((mode.left || mode.right) && mode.slip == 0) {
      A.block(5, 0, 1, 3) = aside().transpose();
      r.row(5) = rows.row(2);
    } else {
      A(5, 5) = 1.0;
      A(5, 3) = A(5, 4) = mode.slip * s_.f;
    }
    return base::solve_dense(A, r);
  }
  [[nodiscard]] Eigen::MatrixXd accelerations(const Mode& mode) const {
    Eigen::MatrixXd dynamics = Eigen::MatrixXd::Zero(3, 2);
    dynamics(1, 0) = -s_.m * s_.g;
    dynamics(0, 1) = -s_.m;
    return solved(mode, dynamics, Eigen::MatrixXd::Zero(3, 2));
  }
  /// With forces: x(0..2) accelerations, 3, 4, 5: L, R, H.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::MatrixXd& law, double t) const {
    return law.col(0) + law.col(1) * s_.pulse(t);
  }
  void move(double t, Vector3& q, Vector3& v) const {
    const double w = std::numbers::pi / s_.duration, d = t - t_, size = t_ < s_.duration ? s_.size : 0.0;
    const Vector3 A = law_.col(0).head(3), B = law_.col(1).head(3) * size;
    q = q_ + v_ * d + 0.5 * d * d * A +
        B * ((std::sin(w * t_) - std::sin(w * t)) / (w * w) + std::cos(w * t_) * d / w);
    v = v_ + d * A + B * (std::cos(w * t_) - std::cos(w * t)) / w;
  }
  /// All positive while the mode holds.
  [[nodiscard]] std::array<double, 4> guards(double t) const {
    Vector3 q, v;
    move(t, q, v);
    const Eigen::VectorXd x = at(law_, t);
    std::array<double, 4> g{mode_.left ? x[3] : up(false).dot(q), mode_.right ? x[4] : up(true).dot(q), 1.0,
                            1.0};
    const double limit = s_.f * (x[3] + x[4]);
    if (mode_.left || mode_.right) {
      g[2] = mode_.slip == 0 ? limit - x[5] : mode_.slip * (aside().dot(v));
      if (mode_.slip == 0) g[3] = limit + x[5];
    }
    return g;
  }
  void step(double t_end) {
    const double end = t_ < s_.duration ? std::min(s_.duration, t_end) : t_end, h = 1e-4;
    for (double a = t_; a < end; a += h) {
      const double b = std::min(a + h, end);
      std::optional<double> first;
      const std::array<double, 4> from = guards(a + (a == t_ ? after : 0.0)), to = guards(b);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!(from[i] > 0.0 && to[i] <= 0.0)) continue;
        double lo = a, hi = b;
        for (int k = 0; k < 70; ++k) (guards(0.5 * (lo + hi))[i] > 0.0 ? lo : hi) = 0.5 * (lo + hi);
        if (!first || hi < *first) first = hi;
      }
      if (!first) continue;
      times_.push_back(*first);
      arrive(*first);
      return;
    }
    arrive(end);
  }
  void arrive(double t) {
    Vector3 q, v;
    move(t, q, v);
    q_ = q;
    v_ = v;
    t_ = t;
    hit();
    decide();
  }
  [[nodiscard]] bool touches(bool right) const { return std::abs(up(right).dot(q_)) < 1e-11; }
  /// e = 0: of those that touch, which take an impulse, and whether they slide on.
  void hit() {
    const bool left = touches(false), right = touches(true);
    if (!((left && up(false).dot(v_) < -1e-9) || (right && up(true).dot(v_) < -1e-9))) return;
    ++impacts;
    for (const bool by_left : {true, false})
      for (const bool by_right : {true, false})
        for (const int slip : {0, 1, -1}) {
          if ((by_left && !left) || (by_right && !right) || !(by_left || by_right)) continue;
          Eigen::MatrixXd rows(3, 1);
          rows << -up(false).dot(v_), -up(true).dot(v_), -aside().dot(v_);
          const Eigen::VectorXd x = solved({by_left, by_right, slip}, Eigen::MatrixXd::Zero(3, 1), rows);
          const Vector3 v = v_ + x.head(3);
          const bool bears = x[3] >= -1e-12 && x[4] >= -1e-12,
                     flies = (!left || up(false).dot(v) > -1e-9) && (!right || up(true).dot(v) > -1e-9);
          const bool rubs =
              slip == 0 ? std::abs(x[5]) <= s_.f * (x[3] + x[4]) : slip * (aside().dot(v)) > 1e-12;
          if (!bears || !flies || !rubs) continue;
          v_ = v;
          return;
        }
    FAIL("no impact");
  }
  /// The one whose guards hold a little later.
  void decide() {
    for (const bool left : {true, false})
      for (const bool right : {true, false})
        for (const int slip : {0, 1, -1}) {
          const auto may = [&](bool bears, bool of_right) {
            return !bears || (touches(of_right) && std::abs(up(of_right).dot(v_)) < 1e-9);
          };
          if (!may(left, false) || !may(right, true) || (!(left || right) && slip != 0)) continue;
          if ((left || right) && slip == 0 && std::abs(aside().dot(v_)) > 1e-9) continue;
          const Mode last = mode_;
          mode_ = {left, right, slip};
          law_ = accelerations(mode_);
          const auto g = guards(t_ + after);
          if (std::all_of(g.begin(), g.end(), [](double x) { return x > 0.0; })) {
            if (slip != 0 && last.slip != slip) ++slips;
            return;
          }
          mode_ = last;
        }
    FAIL("no state");
  }

  Block s_;
  double t_ = 0.0;
  Vector3 q_ = Vector3::Zero(), v_ = Vector3::Zero();
  Mode mode_;
  Eigen::MatrixXd law_;
  std::vector<double> times_;
};

void check_case(const Block& block, double t_end, int impacts, int slips) {
  Follower follower(block);
  const std::vector<double> times = follower.follow(t_end);
  CHECK(follower.impacts >= impacts);
  CHECK(follower.slips >= slips);
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Result result = run_text(block.scene(t_end), engine, "1e-11");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    const double limit = engine[0] == 'e' ? 1e-10 : 1e-7;
    for (const double t : times) {
      CAPTURE(t);
      double nearest = 1.0;
      for (const Event& e : result.events) nearest = std::min(nearest, std::abs(e.t - t));
      CHECK(nearest < limit);
    }
    const Vector& u = result.rows.back().u;  // L.ux, ...: by the names of the columns
    const Model model = build_model(parse_scene(block.scene(t_end), "test.toml"));
    for (const Column& column : model.columns) {
      if (column.velocity) continue;
      const std::string& name = column.name;
      const Vector3& q = follower.place();
      if (name == "block.ux") CHECK(std::abs(u[column.dof] - q[0]) < limit);
      if (name == "block.uy") CHECK(std::abs(u[column.dof] - q[1]) < limit);
      if (name == "block.rz") CHECK(std::abs(u[column.dof] - q[2]) < limit);
    }
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/half_sine");

TEST_CASE("a block that only slides") {
  Block block;
  block.f = 0.3;  // below b/h
  check_case(block, 1.2, 0, 1);
}

TEST_CASE("a block that rocks, with hits of its feet") {
  Block block;
  block.f = 3.0;
  check_case(block, 1.2, 2, 0);
}

TEST_CASE("a block that rocks and slides") {
  Block block;
  block.f = 0.42;
  block.size = 9.0;
  check_case(block, 1.2, 1, 1);
}

TEST_SUITE_END();

}  // namespace signorini::tests::half_sine
