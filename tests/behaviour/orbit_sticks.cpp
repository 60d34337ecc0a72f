// Orbits of two masses, one of which rubs and stops (Pascal, Nonlinear Dynamics 77, 2014), against the motion in closed form.
#include <doctest/doctest.h>

#include <fmt/core.h>

#include <Eigen/LU>  // inverses of small matrices
#include <algorithm>
#include <numbers>

#include "base/eigen_dense.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// K x + x'' = (p cos(w t + phase) - s F) (1, 0): two undamped masses of 1 while the first one slips.
struct TwoMasses {
  Eigen::Matrix2d K;
  double w, p, F;

  struct State {
    Eigen::Vector2d x, v;
  };
  [[nodiscard]] State slipping(const State& from, double phase, double s, double t) const {
    const base::EigenPairs modes = base::symmetric_eigen(K);
    const Eigen::Vector2d answer =
        (K - w * w * Eigen::Matrix2d::Identity()).inverse() * Eigen::Vector2d(p, 0.0);
    const Eigen::Vector2d rest = K.inverse() * Eigen::Vector2d(-s * F, 0.0);
    const Eigen::Vector2d x0 = modes.vectors.transpose() * (from.x - std::cos(phase) * answer - rest);
    const Eigen::Vector2d v0 = modes.vectors.transpose() * (from.v + w * std::sin(phase) * answer);
    Eigen::Vector2d q, r;
    for (int k = 0; k < 2; ++k) {
      const double o = std::sqrt(modes.values[k]);
      q[k] = x0[k] * std::cos(o * t) + v0[k] / o * std::sin(o * t);
      r[k] = -x0[k] * o * std::sin(o * t) + v0[k] * std::cos(o * t);
    }
    return {modes.vectors * q + std::cos(w * t + phase) * answer + rest,
            modes.vectors * r - w * std::sin(w * t + phase) * answer};
  }
  /// The second mass alone, the first one stands at from.x.
  [[nodiscard]] State sticking(const State& from, double t) const {
    const double o = std::sqrt(K(1, 1)), rest = -K(1, 0) * from.x[0] / K(1, 1), x0 = from.x[1] - rest;
    State to = from;
    to.x[1] = rest + x0 * std::cos(o * t) + from.v[1] / o * std::sin(o * t);
    to.v[1] = -x0 * o * std::sin(o * t) + from.v[1] * std::cos(o * t);
    return to;
  }
};

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit sticks");

TEST_CASE("two masses, one of which stops twice a period: an orbit of slips and sticks in closed form") {
  for (const double w : {0.4, 0.65}) {
    CAPTURE(w);
    const TwoMasses masses{Eigen::Matrix2d{{2.0, -1.0}, {-1.0, 2.0}}, w, 1.0, 0.5};
    const std::string text = matrix_scene(
        "t_end = 100.0\nengine = \"exact\"",
        "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[2.0, -1.0], [-1.0, 2.0]]",
        "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.5",
        fmt::format(
            "[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = 1.0\nhistory = {{ type = \"harmonic\", "
            "omega = {:.17g}, phase = 1.5707963267948966 }}\n",
            w));
    OrbitOptions options;
    options.transient = 200;
    const Orbit orbit = find_orbit(reader_of_text(text), options);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    CHECK(orbit.residual <= 1e-12);
    REQUIRE(orbit.sequence.size() == 4);
    // Begins with a slip.
    std::size_t first = orbit.sequence.front().type == EventType::slip ? 0 : 1;
    const Event &slip = orbit.sequence[first], &stick = orbit.sequence[first + 1];
    REQUIRE((slip.type == EventType::slip && stick.type == EventType::stick));
    Scene scene = orbit_scene(reader_of_text(text), orbit);
    scene.run.output_dt.reset();
    scene.run.output_times = std::vector<double>{slip.t};
    const Result run = simulate(scene);
    const auto row = std::find_if(run.rows.begin(), run.rows.end(),
                                  [&](const auto& r) { return std::abs(r.t - slip.t) <= 1e-9; });
    REQUIRE(row != run.rows.end());
    const TwoMasses::State begin{row->u, row->v};
    const double phase = w * (slip.t + orbit.phase), s = slip.to == State::slip_plus ? 1.0 : -1.0;
    // Friction is at its limit there; the slip ends at the mirror image of where it began; half a period later the stick does.
    CHECK(std::abs(std::cos(phase) - masses.K.row(0) * begin.x - s * 0.5) <= 1e-10);
    const TwoMasses::State stopped = masses.slipping(begin, phase, s, stick.t - slip.t);
    CHECK(std::abs(stopped.v[0]) <= 1e-10);
    CHECK(std::abs(stopped.x[0] + begin.x[0]) <= 1e-10);
    const TwoMasses::State half = masses.sticking(stopped, 0.5 * orbit.period - (stick.t - slip.t));
    CHECK((half.x + begin.x).norm() <= 1e-10);
    CHECK(std::abs(half.v[1] + begin.v[1]) <= 1e-10);
  }
}

TEST_SUITE_END();
