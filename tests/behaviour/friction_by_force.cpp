// Friction whose coefficient depends on the normal force, beside an integrator of Runge and Kutta that knows the law alone;
// the same scene seen otherwise, and what is refused.
//
//   |T| <= F,  F = |N| ( heavy + (light - heavy) exp(-|N| / force) )
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <functional>

#include "behaviour/halves.hpp"
#include "behaviour/one_mass.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::by_force {
namespace {

constexpr double light = 0.6, heavy = 0.15, force = 20.0;

double limit(double N) {
  const double x = -N, share = std::exp(-x / force);
  return x * (light * share + heavy * (1.0 - share));
}

/// A mass on a tangential spring, over a compliant contact or under a given compression.
struct Body {
  double m = 3.0, k = 60.0, kn = 3000.0, kt = 2000.0, weight = 30.0, pull = 14.0, omega = 9.0;
  std::function<double(double)> compression = {};  // of a slider
};

enum class Phase { open, stick, plus, minus };

struct Change {
  double t;
  Phase to;
};

/// Steps of h; a step in which a guard falls is shortened until the guard is zero.
class Reference {
 public:
  using State = std::array<double, 4>;  // x, x', y, y'

  Reference(const Body& body, const State& start) : body_(body), y_(start) {
    if (N(0.0, y_) < 0.0) phase_ = Phase::stick;
  }

  std::vector<Change> run(double t_end, double h) {
    std::vector<Change> changes;
    double t = 0.0;
    while (t < t_end - 1e-14) {
      const double step = std::min(h, t_end - t);
      const State next = moved(t, y_, step);
      if (least_guard(t + step, next) >= 0.0) {
        y_ = next;
        t += step;
        continue;
      }
      double low = 0.0, high = step;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (least_guard(t + middle, moved(t, y_, middle)) >= 0.0 ? low : high) = middle;
      }
      y_ = moved(t, y_, high);
      t += high;
      phase_ = after(t);
      changes.push_back({t, phase_});
    }
    return changes;
  }
  [[nodiscard]] const State& state() const { return y_; }

 private:
  [[nodiscard]] double N(double t, const State& y) const {
    return body_.compression ? -body_.compression(t) : body_.kn * y[2];
  }
  [[nodiscard]] double T(double t, const State& y) const {
    switch (phase_) {
      case Phase::open:
        return 0.0;
      case Phase::stick:
        return body_.kt * (y[0] - anchor_);
      case Phase::plus:
        return limit(N(t, y));
      case Phase::minus:
        return -limit(N(t, y));
    }
    return 0.0;
  }
  /// p' of what slips, by a difference: it need not be smooth, only right.
  [[nodiscard]] double slip_rate(double t, const State& y) const {
    const double h = 1e-6, s = phase_ == Phase::plus ? 1.0 : -1.0;
    const State a = shifted(y, rate(t, y), -h), b = shifted(y, rate(t, y), h);
    return s * y[1] - (limit(N(t + h, b)) - limit(N(t - h, a))) / (2.0 * h * body_.kt);
  }
  [[nodiscard]] double least_guard(double t, const State& y) const {
    const double closed = -N(t, y);
    switch (phase_) {
      case Phase::open:
        return y[2];
      case Phase::stick:
        return std::min(closed, limit(N(t, y)) - std::abs(T(t, y)));
      case Phase::plus:
      case Phase::minus:
        return std::min(closed, slip_rate(t, y));
    }
    return 0.0;
  }
  Phase after(double t) {
    if (phase_ == Phase::open) {  // both forces grow from zero: the cone's apex
      anchor_ = y_[0];
      if (body_.kt * std::abs(y_[1]) <= light * body_.kn * std::abs(y_[3])) return Phase::stick;
      return y_[1] > 0.0 ? Phase::plus : Phase::minus;
    }
    const double force_now = T(t, y_);
    if (std::abs(N(t, y_)) < 1e-9) return Phase::open;
    if (phase_ == Phase::stick) return force_now > 0.0 ? Phase::plus : Phase::minus;
    anchor_ = y_[0] - force_now / body_.kt;
    return Phase::stick;
  }
  [[nodiscard]] State rate(double t, const State& y) const {
    const double push = body_.pull * std::sin(body_.omega * t);
    const double lift = body_.compression ? 0.0 : -body_.weight - (phase_ == Phase::open ? 0.0 : N(t, y));
    return {y[1], (push - body_.k * y[0] - T(t, y)) / body_.m, y[3], lift / body_.m};
  }
  static State shifted(const State& y, const State& by, double h) {
    State result = y;
    for (std::size_t i = 0; i < y.size(); ++i) result[i] += h * by[i];
    return result;
  }
  [[nodiscard]] State moved(double t, const State& y, double h) const {
    const State a = rate(t, y), b = rate(t + 0.5 * h, shifted(y, a, 0.5 * h)),
                c = rate(t + 0.5 * h, shifted(y, b, 0.5 * h)), d = rate(t + h, shifted(y, c, h));
    State result = y;
    for (std::size_t i = 0; i < y.size(); ++i) result[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return result;
  }

  Body body_;
  State y_;
  Phase phase_ = Phase::open;
  double anchor_ = 0.0;
};

constexpr const char* law = "friction = { light = 0.6, heavy = 0.15, force = 20.0 }\n";
constexpr std::array start = {0.0, 0.5, 0.01, -0.3};

/// The compliant body, turned by an angle, with lengths and forces in other units.
std::string turned(const Body& b, double angle, double t_end, double length = 1.0, double of_force = 1.0,
                   const std::string& friction = law) {
  const double c = std::cos(angle), s = std::sin(angle), stiffness = of_force / length;
  const auto at = [&](double along, double across) {
    return fmt::format("[{:.17g}, {:.17g}]", c * along - s * across, s * along + c * across);
  };
  return matrix_scene(
      fmt::format("t_end = {}\noutput_dt = {}\ninitial = {{ u = {}, v = {} }}", t_end, t_end / 20.0,
                  at(start[0], start[2] * length), at(start[1] * length, start[3] * length)),
      fmt::format("mass = [[{0:.17g}, 0.0], [0.0, {0:.17g}]]\nstiffness = [[{1:.17g}, {2:.17g}], [{2:.17g}, "
                  "{3:.17g}]]",
                  b.m * stiffness, b.k * stiffness * c * c, b.k * stiffness * c * s, b.k * stiffness * s * s),
      fmt::format(
          "law = \"compliant\"\nnormal = {{ d0 = {:.17g}, d1 = {:.17g} }}\ntangent = {{ d0 = {:.17g}, d1 = "
          "{:.17g} }}\nnormal_stiffness = {:.17g}\ntangential_stiffness = {:.17g}\n",
          -s, c, c, s, b.kn * stiffness, b.kt * stiffness) +
          friction,
      fmt::format("[[loads]]\ndirection = {{ d0 = {:.17g}, d1 = {:.17g} }}\namplitude = "
                  "{:.17g}\n[[loads]]\ndirection = "
                  "{{ d0 = {:.17g}, d1 = {:.17g} }}\namplitude = {:.17g}\nhistory = {{ type = \"harmonic\", "
                  "omega = {} }}\n",
                  s, -c, b.weight * of_force, c, s, b.pull * of_force, b.omega));
}

State state_of(Phase phase) {
  return phase == Phase::open    ? State::open
         : phase == Phase::stick ? State::stick
         : phase == Phase::plus  ? State::slip_plus
                                 : State::slip_minus;
}

void check_against(const Result& result, const std::vector<Change>& expected, double within) {
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(result.events.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(result.events[i].to == state_of(expected[i].to));
    CHECK(std::abs(result.events[i].t - expected[i].t) < within);
  }
  CHECK(result.report.law_checks.violations.empty());
  CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  CHECK(result.report.audit.friction.value < 1e-7 * result.report.audit.force_scale);
}

std::string bearing(const std::string& friction, const std::string& more = "", const std::string& run = "") {
  return matrix_scene(
      run + "t_end = 2.0\noutput_dt = 0.1\ninitial = { u = [0.0], v = [0.0] }",
      "mass = [[3.0]]\nstiffness = [[60.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = { type = \"table\", times = [0.0, 2.0], "
      "values "
      "= [10.0, 60.0] }\ntangential_stiffness = 2000.0\n" +
          friction + more,
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 14.0\nhistory = { type = \"harmonic\", omega = 9.0 "
      "}\n");
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/friction_by_force");

TEST_CASE("a body that bounces and slides has the events of a small step; turned, and in other units, too") {
  const Body body;
  const double t_end = 1.7;
  Reference reference(body, start);
  const std::vector<Change> expected = reference.run(t_end, 2e-5);
  REQUIRE(expected.size() > 12);
  for (const double angle : {0.0, 0.83, -2.1}) {
    CAPTURE(angle);
    const Result result = run_text(turned(body, angle, t_end), "ida", "1e-11");
    check_against(result, expected, 2e-9);
    const auto& u = result.rows.back().u;
    CHECK(std::abs(std::cos(angle) * u[0] + std::sin(angle) * u[1] - reference.state()[0]) < 1e-9);
    CHECK(std::abs(-std::sin(angle) * u[0] + std::cos(angle) * u[1] - reference.state()[2]) < 1e-9);
  }
  check_against(run_text(turned(body, 0.83, t_end, 1000.0, 1e-3,
                                "friction = { light = 0.6, heavy = 0.15, force = 0.02 }\n"),
                         "ida", "1e-11"),
                expected, 2e-9);
}

TEST_CASE("a bearing under a compression that grows has the events of a small step") {
  Body body;
  body.compression = [](double t) { return 10.0 + 25.0 * t; };
  Reference reference(body, {0.0, 0.0, 0.0, 0.0});
  const std::vector<Change> expected = reference.run(2.0, 2e-5);
  REQUIRE(expected.size() > 8);
  const Result result = run_text(bearing(law), "ida", "1e-11");
  check_against(result, expected, 1e-8);
  CHECK(std::abs(result.rows.back().u[0] - reference.state()[0]) < 1e-9);
}

TEST_CASE(
    "under a force that is far greater, or far smaller, the coefficient is one number; so it is where the "
    "two are alike") {
  const Body body;
  const auto end_of = [&](const std::string& friction) {
    return run_text(turned(body, 0.4, 0.5, 1.0, 1.0, friction), "ida", "1e-10").rows.back().u[0];
  };
  CHECK(std::abs(end_of("friction = { light = 0.6, heavy = 0.15, force = 1e9 }\n") -
                 end_of("friction = 0.6\n")) < 1e-7);
  CHECK(std::abs(end_of("friction = { light = 0.6, heavy = 0.15, force = 1e-6 }\n") -
                 end_of("friction = 0.15\n")) < 1e-6);
  CHECK(end_of("friction = { light = 0.3, heavy = 0.3, force = 20.0 }\n") == end_of("friction = 0.3\n"));
}

TEST_CASE("a run in two halves is the run, and a certified run is certain to its end") {
  const Body body;
  const std::string text = turned(body, 0.83, 1.7);
  const halves::Difference d = halves::split_text(text, {{"run.engine", "ida"}, {"run.rtol", "1e-10"}}, 0.41);
  CAPTURE(d.first);
  CHECK(d.events_agree);
  CHECK(d.events > 8);
  CHECK(d.state < 1e-7);
  const Scene scene =
      parse_scene(text, "test.toml", {{"run.engine", "ida"}, {"run.rtol", "1e-9"}, {"run.certify", "true"}});
  Result result;
  const CertifiedReport report = simulate_certified(build_model(scene), scene.run, result);
  REQUIRE(report.certificate);
  CHECK(report.certificate->complete);
  const std::vector<Change> expected = Reference(body, start).run(1.7, 2e-5);
  REQUIRE(result.events.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(std::abs(result.events[i].t - expected[i].t) < report.certificate->t_errors[i] + 1e-11);
}

TEST_CASE("what does not know friction that depends on N says so") {
  const auto message = [](const std::string& text, const std::vector<Override>& changes) -> std::string {
    try {
      const Scene scene = parse_scene(text, "test.toml", changes);
      static_cast<void>(simulate(build_model(scene), scene.run));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&](const std::string& text, const char* words,
                        const std::vector<Override>& changes = {}) {
    CAPTURE(words);
    const std::string found = message(text, changes);
    CAPTURE(found);
    CHECK(found.find(words) != std::string::npos);
  };
  for (const char* engine : {"exact", "newmark", "friction-iteration"})
    says(bearing(law), "the friction of contact 'c' depends on its normal force",
         {{"run.engine", engine}, {"run.dt", "1e-3"}});
  says(bearing(law, "tangential_damping = 3.0\n"), "cannot be combined with tangential_damping");
  says(bearing(law, "", "engine = \"ida\"\n"), "frictional", {{"run.initial", "frictional"}});
  says(bearing("friction = { light = 0.2, heavy = 0.1 }\n"),
       "required for friction that depends on the normal force");
  says(bearing("friction = { light = 0.2, heavy = 0.1, force = 3.0, slow = 0.1 }\n"),
       "cannot be combined with light");
  says(bearing("friction = { light = 0.2, heavy = 0.0, force = 3.0 }\n"), "heavy");
  Body body;
  std::string text = turned(body, 0.0, 0.1);
  text.replace(text.find("tangential_stiffness"), 0, "normal_damping = 2.0\n");
  says(text, "cannot be combined with normal_damping");
  says(matrix_scene("t_end = 1.0", "mass = [[1.0]]\nstiffness = [[0.0]]",
                    std::string("law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 3.0\n") + law),
       "needs a tangential_stiffness");
  says(matrix_scene("t_end = 1.0", "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
                    std::string("law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n") + law),
       "is not available for rigid contacts");
  says(matrix_scene(
           "t_end = 1.0\nengine = \"ida\"",
           "mass = [[1.0, 0.0], [0.0, 0.0]]\nstiffness = [[1.0, 0.0], [0.0, 1.0]]",
           std::string(
               "law = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 3.0\ntangential_stiffness = 4.0\n") +
               law),
       "needs mass where it acts");
}

TEST_SUITE_END();

}  // namespace signorini::tests::by_force
