// Orbits against closed forms and independent computations.
#include "signorini/orbit.hpp"

#include <doctest/doctest.h>

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "behaviour/orbit_runs.hpp"
#include "behaviour/orbit_scenes.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbits");

TEST_CASE("a chain before a one-sided spring: NLvib's third example, and Liouville's determinant") {
  OrbitOptions options;
  options.transient = 0;
  const Orbit orbit = orbit_of(chain("0.62"), options);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  CHECK(orbit.residual <= 1e-13);
  CHECK(orbit.period == doctest::Approx(2.0 * pi / 0.62).epsilon(1e-15));
  CHECK(std::abs(saved_value(orbit, "d0.u") - 0.9719291853302878) <= 1e-11);
  CHECK(std::abs(saved_value(orbit, "d1.u") - 0.6459326749109593) <= 1e-11);
  CHECK(std::abs(saved_value(orbit, "d0.v") - 0.25416996239535306) <= 1e-11);
  CHECK(std::abs(saved_value(orbit, "d1.v") - 0.0715593505999609) <= 1e-11);
  const double det = std::exp(-0.09 * orbit.period);
  CHECK(std::abs(product_of_multipliers(orbit) - det) <= 1e-11 * det);
  CHECK(orbit.steps.size() <= 7);
}

TEST_CASE("a Jenkins element that slips loses 4 f N (A - f N/kt) a cycle") {
  const Orbit orbit = orbit_of(jenkins());
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  CHECK(orbit.residual <= 1e-12);
  const Result run = run_on(jenkins(), orbit);
  const OutputExtremes x = run.report.response.front();
  const double A = 0.5 * (x.maximum - x.minimum), loss = 4.0 * (A - 1.0 / 20.0);
  CHECK(std::abs(orbit.cycle.friction - loss) <= 1e-11 * loss);
  CHECK(std::abs(orbit.cycle.loads - orbit.cycle.friction - orbit.cycle.damping) <= 1e-11 * loss);
  CHECK(orbit.stable.value_or(false));
  CHECK(orbit.families.empty());
  CHECK(orbit.sequence.size() == 4);
}

TEST_CASE("a Jenkins element that never slips has a multiplier of one: a family") {
  const Orbit orbit = orbit_of(jenkins("0.3"));
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  REQUIRE(orbit.families.size() == 1);
  CHECK(orbit.families.front() == "contact 'c' never slips");
  REQUIRE(orbit.multipliers.size() == 3);
  CHECK(std::abs(orbit.multipliers[0] - 1.0) <= 1e-12);
  // The others are those of m = 1, c = 0.02, k = 21 over T.
  const double decay = std::exp(-0.01 * orbit.period);
  CHECK(std::abs(std::abs(orbit.multipliers[1]) - decay) <= 1e-12);
  CHECK(orbit.stable.value_or(false));
  CHECK(orbit.sequence.empty());
}

TEST_CASE(
    "an event at the orbit's time 0, beside it to both sides or at the period's end, is in the sequence "
    "once") {
  const auto text = [](double phase) {
    std::string scene = jenkins();
    return scene.replace(scene.find("1.5707963267948966"), 18, fmt::format("{:.17g}", phase));
  };
  const Orbit plain = orbit_of(text(0.3));
  REQUIRE(plain.found);
  REQUIRE(plain.sequence.size() == 4);
  for (const Event& event : plain.sequence)
    for (const double off : {-1e-5, -1e-7, -1e-13, 0.0, 1e-13, 1e-7, 1e-5}) {
      CAPTURE(event.t);
      CAPTURE(off);
      const Orbit orbit = orbit_of(text(0.3 + 1.5 * (event.t + off)));
      CAPTURE(orbit.reason);
      REQUIRE(orbit.found);
      REQUIRE(orbit.sequence.size() == 4);
      std::vector<double> expected;
      for (const Event& other : plain.sequence) {
        const double t = std::remainder(other.t - event.t - off, plain.period);
        expected.push_back(t < -1e-8 ? t + plain.period : t);
      }
      std::sort(expected.begin(), expected.end());
      for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(orbit.sequence[k].t - expected[k]) <= 2e-8);
      CHECK(std::abs(orbit.cycle.friction - plain.cycle.friction) <= 1e-9 * plain.cycle.friction);
    }
}

TEST_CASE(
    "Den Hartog's oscillator has his amplitude without stops, and rests where the closed form does with "
    "two") {
  const auto text = [](const char* friction, const char* omega) {
    return matrix_scene(
        "t_end = 100.0", "mass = [[1.0]]\nstiffness = [[1.0]]",
        std::string("law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = ") + friction,
        std::string("[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = \"harmonic\", "
                    "omega = ") +
            omega + " }\n[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
  };
  // X = sqrt(V^2 - F^2 U^2) with V = 1/(1 - b^2), U = sin(pi/b)/(b (1 + cos(pi/b)));  two stops: a root of the slide
  for (const auto& [scene, amplitude, events] :
       {std::tuple{text("0.5", "0.8"), 2.33223498754136, 2}, {text("0.8", "0.5"), 1.02078517361116, 4}}) {
    const Orbit orbit = orbit_of(scene);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    const OutputExtremes x = run_on(scene, orbit).report.response.front();
    CHECK(std::abs(x.maximum - amplitude) <= 1e-10);
    CHECK(std::abs(x.minimum + amplitude) <= 1e-10);
    CHECK(orbit.sequence.size() == static_cast<std::size_t>(events));
    CHECK(orbit.residual <= 1e-12);
  }
}

TEST_CASE("an impact oscillator with one hit a cycle: det Phi = e^2 exp(-c T/m)") {
  const std::string text =
      matrix_scene("t_end = 100.0", "mass = [[2.0]]\nstiffness = [[2.0]]\ndamping = [[0.2]]",
                   "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 0.1\nrestitution = 0.8",
                   "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 2.0\nhistory = { type = \"harmonic\", "
                   "omega = 2.3 }\n");
  const Orbit orbit = orbit_of(text);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  const auto hits = static_cast<double>(orbit.sequence.size());
  const double det = std::pow(0.8, 2.0 * hits) * std::exp(-0.1 * orbit.period);
  CHECK(std::abs(product_of_multipliers(orbit) - det) <= 1e-11 * det);
}

TEST_CASE("a block on a belt sticks and slips with the period pi + 2 atan 0.4 + 5") {
  const std::string text = matrix_scene("t_end = 60.0", "mass = [[1.0]]\nstiffness = [[1.0]]",
                                        "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = "
                                        "1.0\nfriction = { static = 1.0, kinetic = 0.5 }\n"
                                        "surface_velocity = 0.2");
  const Orbit orbit = orbit_of(text);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  CHECK(orbit.autonomous);
  CHECK(std::abs(orbit.period - (pi + 2.0 * std::atan(0.4) + 5.0)) <= 1e-12);
  CHECK(orbit.sequence.size() == 2);
  CHECK(orbit.stable.value_or(false));
  CHECK(orbit.max_multiplier <= 1e-10);  // what sticks has forgotten how it came
}

TEST_CASE("turned and mirrored, in other units, from a shifted load: the same orbit") {
  const auto frame = [](double turn, double mirror, double length, double time, double start) {
    const double c = std::cos(turn), s = std::sin(turn);
    const auto vector = [&](double x, double y) {
      y *= mirror;
      return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
    };
    const double force = length / (time * time);  // of a kilogram
    const double k = 1.0 / (time * time);
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end "
        "= {:.17g}\n"
        "[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n"
        "[[springs]]\nnode = \"A\"\ndirection = {}\nstiffness = {:.17g}\ndamping = {:.17g}\n"
        "[[springs]]\nnode = \"A\"\ndirection = {}\nstiffness = {:.17g}\ndamping = {:.17g}\n"
        "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = {}\ngap = "
        "{:.17g}\n"
        "normal_stiffness = {:.17g}\ntangential_stiffness = {:.17g}\nfriction = 0.4\n"
        "[[loads]]\nnode = \"A\"\ndirection = {}\namplitude = {:.17g}\nhistory = {{ type = \"harmonic\", "
        "omega = {:.17g}, "
        "start = {:.17g} }}\n",
        40.0 * time, vector(0.96, 0.28), 1.0 * k, 0.1 / time, vector(-0.28, 0.96), 2.0 * k, 0.1 / time,
        vector(0.0, 1.0), 0.02 * length, 30.0 * k, 20.0 * k, vector(0.6, 0.8), 1.0 * force, 1.1 / time,
        start * time);
  };
  const Orbit plain = orbit_of(frame(0.0, 1.0, 1.0, 1.0, 0.0));
  CAPTURE(plain.reason);
  REQUIRE(plain.found);
  REQUIRE(plain.sequence.size() >= 2);
  for (const auto& [turn, mirror, length, time, start] : {std::tuple{0.7, 1.0, 1.0, 1.0, 0.0},
                                                          {2.3, -1.0, 1.0, 1.0, 0.0},
                                                          {0.0, 1.0, 1000.0, 1.0, 0.0},
                                                          {-1.1, -1.0, 0.01, 60.0, 0.0},
                                                          {0.0, 1.0, 1.0, 1.0, 3.7}}) {
    CAPTURE(turn);
    CAPTURE(length);
    CAPTURE(start);
    const Orbit other = orbit_of(frame(turn, mirror, length, time, start));
    CAPTURE(other.reason);
    REQUIRE(other.found);
    if (turn == 0.0 && start == 0.0)  // amplitudes are read along x and y
      CHECK(std::abs(other.amplitude / length - plain.amplitude) <= 1e-10 * plain.amplitude);
    CHECK(std::abs(other.max_multiplier - plain.max_multiplier) <= 1e-10);
    REQUIRE(other.sequence.size() == plain.sequence.size());
    const double force = length / (time * time);
    CHECK(std::abs(other.cycle.friction / (force * length) - plain.cycle.friction) <=
          1e-11 * plain.cycle.loads);
    CHECK(std::abs(other.cycle.loads / (force * length) - plain.cycle.loads) <= 1e-11 * plain.cycle.loads);
  }
}

TEST_CASE("a disturbed run leaves or returns by its multipliers") {
  // The state a period later, of runs that begin 1e-6 to both sides of the orbit, along each degree of freedom.
  const std::string text = chain("0.62");
  OrbitOptions options;
  options.transient = 0;
  const Orbit orbit = orbit_of(text, options);
  REQUIRE(orbit.found);
  const std::vector<std::string> names{"d0.u", "d1.u", "d0.v", "d1.v"};
  const double h = 1e-6;
  Eigen::Matrix4d phi;
  for (int j = 0; j < 4; ++j) {
    Eigen::Vector4d ends[2];
    for (int side = 0; side < 2; ++side) {
      Scene scene = orbit_scene(reader_of_text(text), orbit);
      for (auto& [name, value] : scene.initial.saved->motions)
        if (name == names[static_cast<std::size_t>(j)]) value += side == 0 ? -h : h;
      const Result run = simulate(scene);
      ends[side] << run.rows.back().u, run.rows.back().v;
    }
    phi.col(j) = (ends[1] - ends[0]) / (2.0 * h);
  }
  CHECK(std::abs(phi.trace() - [&] {
          std::complex<double> sum = 0.0;
          for (const auto& mu : orbit.multipliers) sum += mu;
          return sum.real();
        }()) <= 1e-7);
  CHECK(std::abs(phi.determinant() - product_of_multipliers(orbit)) <= 1e-7);
}

TEST_CASE("eight masses between a stop and a Jenkins element: Phi in modes against differences of runs") {
  // Damping alpha M, alpha 0.1; so many unknowns that stretches are crossed in closed form.
  const auto text = [](const char* amplitude) {
    std::string mass, stiffness, damping;
    for (int i = 0; i < 8; ++i) {
      std::string m, k, c;
      for (int j = 0; j < 8; ++j) {
        m += fmt::format("{}{}", j > 0 ? ", " : "", i == j ? 1.0 + 0.1 * i : 0.0);
        c += fmt::format("{}{:.17g}", j > 0 ? ", " : "", i == j ? 0.1 * (1.0 + 0.1 * i) : 0.0);
        k += fmt::format("{}{}", j > 0 ? ", " : "",
                         i == j                 ? (i == 7 ? 15.5 : 17.0 + 2.0 * i)
                         : std::abs(i - j) == 1 ? -(8.0 + 0.5 * (i + j))
                                                : 0.0);
      }
      mass += (i > 0 ? ", [" : "[") + m + "]";
      stiffness += (i > 0 ? ", [" : "[") + k + "]";
      damping += (i > 0 ? ", [" : "[") + c + "]";
    }
    return matrix_scene(
        "t_end = 40.0", "mass = [" + mass + "]\nstiffness = [" + stiffness + "]\ndamping = [" + damping + "]",
        "law = \"compliant\"\nnormal = { d7 = -1.0 }\ntangent = { d6 = 1.0 }\ngap = 0.05\n"
        "normal_stiffness = 40.0\ntangential_stiffness = 30.0\nfriction = 0.3\n"
        "[[contacts]]\nname = \"j\"\nlaw = \"slider\"\ntangent = { d2 = 0.8, d3 = 0.6 }\nnormal_force = 1.0\n"
        "friction = 0.4\ntangential_stiffness = 20.0",
        std::string("[[loads]]\ndirection = { d7 = 1.0, d1 = 0.5 }\namplitude = ") + amplitude +
            "\nhistory = { type = \"harmonic\", omega = 0.9 }\n");
  };
  {  // nothing slips or closes: multipliers are exp of what the linear chain with the element's spring has
    const Orbit still = orbit_of(text("0.02"));
    CAPTURE(still.reason);
    REQUIRE(still.found);
    REQUIRE(still.families.size() == 1);
    CHECK(std::abs(product_of_multipliers(still) - std::exp(-0.8 * still.period)) <=
          1e-11 * std::exp(-0.8 * still.period));
  }
  const std::string scene = text("2.5");
  const Orbit orbit = orbit_of(scene);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  REQUIRE(orbit.sequence.size() >= 4);
  const Eigen::MatrixXd phi = monodromy_by_runs(scene, orbit, 8, 1e-6);
  REQUIRE(orbit.multipliers.size() == static_cast<std::size_t>(phi.rows()));
  std::complex<double> sum = 0.0, squares = 0.0;
  for (const auto& mu : orbit.multipliers) {
    sum += mu;
    squares += mu * mu;
  }
  CHECK(std::abs(phi.trace() - sum.real()) <= 1e-7);
  CHECK(std::abs((phi * phi).trace() - squares.real()) <= 1e-7);
}

TEST_CASE(
    "a conservative motion at a given energy: one mass between two elastic stops, Code_Aster's SDND122") {
  // Stops kc at +-y0. A quarter of a period: from 0 to y0 with w0^2 = k/m, then about yc = kc y0/(k + kc) with
  // w1^2 = (k + kc)/m:  A = sqrt(2 E/k),  t1 = asin(y0/A)/w0,  v1 = w0 sqrt(A^2 - y0^2),  t2 = atan2(v1/w1, y0 - yc)/w1
  const double y0 = 0.5, kc = 20.0, m = 2.0, k = 3.0, E = 3.0;
  const std::string text =
      matrix_scene("t_end = 30.0\nengine = \"exact\"\ninitial = { u = [0.2], v = [1.0] }",
                   "mass = [[2.0]]\nstiffness = [[3.0]]",
                   "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 0.5\nnormal_stiffness = 20.0",
                   "[[contacts]]\nname = \"d\"\nlaw = \"compliant\"\nnormal = { d0 = 1.0 }\ngap = "
                   "0.5\nnormal_stiffness = 20.0\n"
                   "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
  OrbitOptions options;
  options.energy = E;
  const Orbit orbit = orbit_of(text, options);
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  const double w0 = std::sqrt(k / m), w1 = std::sqrt((k + kc) / m), A = std::sqrt(2.0 * E / k);
  const double yc = kc * y0 / (k + kc), v1 = w0 * std::sqrt(A * A - y0 * y0);
  const double T = 4.0 * (std::asin(y0 / A) / w0 + std::atan2(v1 / w1, y0 - yc) / w1);
  CHECK(std::abs(orbit.period - T) <= 1e-10 * T);
  // The ratio y0/B of SDND122 with kc/k kept: B = yc + amplitude of contact, from 1/2 k B^2 + 1/2 kc (B - y0)^2 = E.
  const double B = yc + std::sqrt(v1 * v1 / (w1 * w1) + (y0 - yc) * (y0 - yc));
  const OutputExtremes x = run_on(text, orbit).report.response.front();
  CHECK(std::abs(x.maximum - B) <= 1e-10);
  CHECK(std::abs(0.5 * k * B * B + 0.5 * kc * (B - y0) * (B - y0) - E) <= 1e-12);
  CHECK(orbit.multipliers.size() == 2);
  CHECK_THROWS_AS(orbit_of(jenkins(), options), UsageError);
}

TEST_CASE(
    "the error of multipliers contains the tolerance of ida; auto takes exact for an impact oscillator") {
  const auto text = [](const std::string& engine) {
    return matrix_scene(
        "t_end = 100.0\nengine = \"" + engine + "\"\nrtol = 1e-7",
        "mass = [[2.0]]\nstiffness = [[2.0]]\ndamping = [[1.2]]",
        "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 0.1\nrestitution = 0.8",
        "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 2.0\nhistory = { type = \"harmonic\", "
        "omega = 2.3 }\n");
  };
  const Orbit exact = orbit_of(text("exact")), ida = orbit_of(text("ida")), chosen = orbit_of(text("auto"));
  REQUIRE((exact.found && ida.found && chosen.found));
  REQUIRE(ida.multipliers.size() == exact.multipliers.size());
  CHECK(ida.multiplier_error < 1e-3);
  for (std::size_t i = 0; i < exact.multipliers.size(); ++i)
    CHECK(std::abs(ida.multipliers[i] - exact.multipliers[i]) <= ida.multiplier_error);
  CHECK(chosen.residual == exact.residual);
  CHECK(chosen.multipliers == exact.multipliers);
}

TEST_CASE("a search that is interrupted at any time ends without an orbit") {
  struct Stopper final : Recorder {
    long left;
    explicit Stopper(long calls) : left(calls) {}
    void event(const Event& /*event*/) override {}
    void sample(const Sample& /*sample*/) override {}
    bool progress(double /*t*/) override { return left-- > 0; }
  };
  OrbitOptions options;
  options.transient = 1;
  constexpr long many = 1000000;
  Stopper never(many);
  REQUIRE(find_orbit(reader_of_text(chain("0.62")), options, &never).found);
  const long calls = many - never.left;
  REQUIRE(calls > 20);
  for (long k = 0; k < calls; k += std::max(1L, calls / 200)) {
    CAPTURE(k);
    Stopper stopper(k);
    static_cast<void>(find_orbit(reader_of_text(chain("0.62")), options, &stopper));
    CHECK(stopper.left < 0);
  }
}

TEST_CASE("scenes without an orbit say why") {
  const auto text = [](const std::string& loads, const std::string& run = "") {
    return matrix_scene("t_end = 9.0\n" + run, "mass = [[1.0]]\nstiffness = [[1.0]]",
                        "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.5",
                        loads);
  };
  const auto load = [](const std::string& history) {
    return "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = " + history + " }\n";
  };
  const auto refused = [&](const std::string& scene, const std::string& words,
                           const OrbitOptions& options = {}) {
    CAPTURE(words);
    try {
      static_cast<void>(orbit_of(scene, options));
      FAIL_CHECK("not refused");
    } catch (const Error& error) {
      CAPTURE(error.what());
      CHECK(std::string(error.what()).find(words) != std::string::npos);
    }
  };
  refused(text(""), "found no periodic load");
  refused(text(load("\"harmonic\", omega = 1.0") + load("\"harmonic\", omega = 1.4142135623730951")),
          "loads.2.history");
  refused(text(load("\"polynomial\", coefficients = [0.0, 1.0]") + load("\"harmonic\", omega = 1.0")),
          "loads.1.history");
  refused(text(load("\"harmonic\", omega = 1.0")), "loads.1.history", {.period = 3.0});
  refused(text(load("\"harmonic\", omega = 1.0"), "engine = \"newmark\"\ndt = 0.01"), "run.engine");
  refused(text(load("\"harmonic\", omega = 1.0")), "--times", {.times = 0});
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/orbits");

TEST_CASE(
    "a support that its acceleration carries away has no orbit; without drift the orbit closes in closed "
    "form") {
  // From rest at zero, a sin(w t + phase) leaves the mean velocity a cos(phase)/w: 2 pi a cos(phase)/w^2 a period.
  const double m = 1.3, k = 3.0, c = 0.3, w = 3.0;
  const auto text = [&](double a, double phase, const char* length) {
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"{}\", time = \"s\" }}\n[run]\nt_end "
        "= 60.0\n"
        "[nodes]\nA = [0.0, 0.0]\nB = [1.0, 0.0]\n[sections.s]\nEA = 3.0\nEI = 1.0\nmass_per_length = 0.0\n"
        "[[masses]]\nnode = \"A\"\nmass = {}\n[[springs]]\nnode = \"A\"\ndirection = [1.0, 0.0]\nstiffness = "
        "0.0\n"
        "damping = {}\n[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"s\"\ntype = "
        "\"bar\"\n[[supports]]\nnode = "
        "\"A\"\nfix = [\"uy\"]\n[[supports]]\nnode = \"B\"\nfix = [\"uy\"]\n[[supports]]\nnode = \"B\"\nfix "
        "= "
        "[\"ux\"]\nacceleration = {{ type = \"harmonic\", omega = {}, amplitude = {:.17g}, phase = {:.17g} "
        "}}\n",
        length, m, c, w, a, phase);
  };
  for (const double phase : {0.0, 0.7, 2.9}) {
    CAPTURE(phase);
    std::string message;
    try {
      (void)orbit_of(text(1.0, phase, "m"));
    } catch (const SceneError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find("supports.3.acceleration") != std::string::npos);
    CHECK(message.find(fmt::format("displaces the support by {:.6g} in each",
                                   2.0 * pi * std::cos(phase) / (w * w))) != std::string::npos);
  }
  const Orbit orbit = orbit_of(text(1.0, 0.5 * pi, "m"));
  CAPTURE(orbit.reason);
  REQUIRE(orbit.found);
  // u_B = (1 - cos w t)/w^2: the mass swings about 1/w^2 with the amplitude of its transfer function.
  const double swing = k / (w * w) / std::abs(std::complex<double>(k - m * w * w, c * w));
  const std::complex<double> z = -k / (w * w) / std::complex<double>(k - m * w * w, c * w);
  CHECK(std::abs(saved_value(orbit, "A.ux") - (1.0 / (w * w) + z.real())) <= 1e-12);
  CHECK(std::abs(orbit.amplitude - swing) <=
        1e-4 * swing);  // supports are given, and no displacements of the state
}

TEST_SUITE_END();
