// Branches of orbits over a key, against closed forms and orbits that are found in another way.
#include <doctest/doctest.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "behaviour/orbit_scenes.hpp"

using namespace signorini;
using namespace signorini::tests;

TEST_SUITE_BEGIN("behaviour/orbit branches");

TEST_CASE("a branch over the frequency passes both folds of a one-sided spring's resonance") {
  // A linear branch first: below the gap the amplitude is that of the linear chain at every point.
  const SceneReader linear = reader_of_text(chain("0.62") +
                                            "[[output]]\nname = \"x\"\nkind = \"displacement\"\n"
                                            "direction = { d0 = 1.0 }\n");
  BranchOptions options;
  options.orbit.transient = 60;
  options.path = "loads.1.history.omega";
  options.from = 0.3;
  options.to = 0.4;
  const Branch branch = continue_branch(linear, options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(branch.points.size() >= 5);
  for (const BranchPoint& p : branch.points) {
    const double w = p.parameter;
    using C = std::complex<double>;
    const C a(1.0 - w * w, 0.03 * w), b(-1.0, -0.03 * w), d(2.0 - w * w, 0.06 * w);
    const double u0 = std::abs(-b * 0.1 / (a * d - b * b)), u1 = std::abs(a * 0.1 / (a * d - b * b));
    CHECK(std::abs(p.maxima.front() - u0) <= 1e-11);
    CHECK(std::abs(p.amplitude - std::max(u0, u1)) <= 1e-11);
    CHECK(p.stable.value_or(false));
    CHECK(std::abs(p.period - 2.0 * std::numbers::pi / w) <= 1e-14 * p.period);
  }
  CHECK(branch.points.back().parameter == 0.4);
}

TEST_CASE("a branch locates the flip of an impact oscillator where the closed form has it") {
  // m = k = 1 at a wall where the spring is slack, one hit a cycle of cos(w t): Phi from hit to hit has
  //   det = e^2,   tr = -2 e C + (1 + e)^2 (1 + C) (1 - w^2)/2,   C = cos(2 pi/w);   flip: 1 + tr + det = 0
  const double e = 0.8;
  const auto flips = [&](double w) {
    const double C = std::cos(2.0 * std::numbers::pi / w);
    return 1.0 + e * e - 2.0 * e * C + 0.5 * (1.0 + e) * (1.0 + e) * (1.0 + C) * (1.0 - w * w);
  };
  double below = 2.6, above = 2.7;
  REQUIRE(flips(below) * flips(above) < 0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    ((flips(middle) < 0.0) == (flips(below) < 0.0) ? below : above) = middle;
  }
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 2.6;
  options.to = 2.7;
  options.step = 0.1;
  const Branch branch = continue_branch(
      reader_of_text(matrix_scene("t_end = 100.0\nengine = \"exact\"",
                                  "mass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[0.0]]",
                                  "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 0.0\nrestitution = 0.8",
                                  "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = "
                                  "\"harmonic\", omega = 2.6, phase = 1.5707963267948966 }\n")),
      options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  long found = 0;
  for (const BranchPoint& p : branch.points) {
    if (p.special == "flip") {
      ++found;
      CHECK(std::abs(p.parameter - below) <= 1e-10);
      CHECK(std::abs(p.max_multiplier - 1.0) <= 1e-9);
    } else if (std::abs(p.parameter - below) > 1e-6) {
      CHECK(p.stable == (p.parameter < below));
    }
  }
  CHECK(found == 1);
}

TEST_CASE("a branch over friction locates Den Hartog's boundary of motions without stops") {
  // b = w (m = k = P = 1): no stops as long as the force at a reversal exceeds friction, b^2 X >= F, X = sqrt(V^2 - F^2 U^2):
  //   F = b^2 V/sqrt(1 + b^4 U^2),   V = 1/(1 - b^2),   U = sin(pi/b)/(b (1 + cos(pi/b)))
  const double b = 0.8, V = 1.0 / (1.0 - b * b),
               U = std::sin(std::numbers::pi / b) / (b * (1.0 + std::cos(std::numbers::pi / b)));
  const double boundary = b * b * V / std::sqrt(1.0 + b * b * b * b * U * U);
  BranchOptions options;
  options.path = "contacts.1.friction";
  options.from = 0.7;
  options.to = 0.9;
  options.step = 0.2;
  const Branch branch =
      continue_branch(reader_of_text(matrix_scene(
                          "t_end = 100.0", "mass = [[1.0]]\nstiffness = [[1.0]]",
                          "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.7",
                          "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = "
                          "\"harmonic\", omega = 0.8 }\n")),
                      options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  long found = 0;
  for (const BranchPoint& p : branch.points) {
    if (p.special == "sequence") {
      ++found;
      CAPTURE(p.parameter);
      CHECK(std::abs(p.parameter - boundary) <= 1e-10);
    }
    if (std::abs(p.parameter - boundary) > 1e-6) CHECK(p.events == (p.parameter < boundary ? 2 : 4));
  }
  CHECK(found == 1);
}

TEST_CASE("the branch of twice the period leaves at the flip of an impact oscillator") {
  // As above; beyond the flip the stable orbit closes after two periods: a run on it repeats itself after 2 T, not after T.
  const std::string text = matrix_scene(
      "t_end = 100.0\nengine = \"exact\"", "mass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[0.0]]",
      "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 0.0\nrestitution = 0.8",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.0\nhistory = { type = "
      "\"harmonic\", omega = 2.6, phase = 1.5707963267948966 }\n"
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 2.6;
  options.to = 2.68;
  options.step = 0.1;
  options.switches = 1;
  const Branch branch = continue_branch(reader_of_text(text), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(branch.sides.size() == 1);
  CAPTURE(branch.sides.front().end);
  CHECK(branch.sides.front().kind == "flip");
  long points = 0;
  const BranchPoint* last = nullptr;
  for (const BranchPoint& p : branch.points) {
    if (p.branch != 2) continue;
    ++points;
    last = &p;
    CHECK(std::abs(p.period - 4.0 * std::numbers::pi / p.parameter) <= 1e-12);
    CHECK(p.residual <= 1e-9);
  }
  REQUIRE(points > 2);
  CHECK(last->parameter > branch.sides.front().parameter);
  // Independent: a transient to the orbit of twice the period, with its own Newton's method.
  const SceneReader there = [&](const std::vector<Override>& changes) {
    std::vector<Override> all{{"loads.1.history.omega", fmt::format("{}", last->parameter)}};
    all.insert(all.end(), changes.begin(), changes.end());
    return reader_of_text(text)(all);
  };
  OrbitOptions twice;
  twice.times = 2;
  twice.transient = 200;
  const Orbit orbit = find_orbit(there, twice);
  REQUIRE(orbit.found);
  CHECK(orbit.stable == last->stable);
  CHECK(std::abs(orbit.max_multiplier - last->max_multiplier) <= 1e-6);
  const OutputExtremes x = simulate(orbit_scene(there, orbit)).report.response.front();
  CHECK(std::abs(x.minimum - last->minima.front()) <= 1e-8);
}

TEST_CASE(
    "a branch of stick-slip orbits over the belt's speed v: period pi + 2 atan 2 v + 1/v at each point") {
  BranchOptions options;
  options.path = "contacts.1.surface_velocity";
  options.from = 0.2;
  options.to = 0.5;
  options.step = 0.2;
  const Branch branch = continue_branch(
      reader_of_text(matrix_scene("t_end = 60.0\nengine = \"exact\"", "mass = [[1.0]]\nstiffness = [[1.0]]",
                                  "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\n"
                                  "friction = { static = 1.0, kinetic = 0.5 }\nsurface_velocity = 0.2")),
      options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(branch.points.size() >= 4);
  for (const BranchPoint& p : branch.points) {
    const double v = p.parameter;
    CHECK(std::abs(p.period - (std::numbers::pi + 2.0 * std::atan(2.0 * v) + 1.0 / v)) <= 1e-9);
    CHECK(p.stable.value_or(false));
  }
}

TEST_CASE("a branch of the pipeline over the frequency: fast mode shapes do not shorten its steps") {
  // The highest mode shapes turn by hundreds of radians where the period changes by a step.
  const SceneReader read = reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml",
                                     {{"run.engine", "exact"},
                                      {"loads.1.amplitude", "20.0"},
                                      {"loads.1.history", "{ type = \"harmonic\", omega = 100.0 }"}});
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 100.0;
  options.to = 106.0;
  options.step = 0.4;
  options.most_points = 12;
  const Branch branch = continue_branch(read, options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  for (const BranchPoint& p : branch.points) CHECK(p.residual <= 1e-9);
  // Another way to the last point: a transient.
  const Orbit last = find_orbit([&](const std::vector<Override>& changes) {
    std::vector<Override> all{{"loads.1.history.omega", "106.0"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return read(all);
  });
  REQUIRE(last.found);
  // Half the greatest range of a displacement: rotations, which have another unit, are none.
  const Scene scene = orbit_scene(
      [&](const std::vector<Override>& changes) {
        std::vector<Override> all{{"loads.1.history.omega", "106.0"}};
        all.insert(all.end(), changes.begin(), changes.end());
        return read(all);
      },
      last);
  const Model model = build_model(scene);
  const Result run = simulate(model, scene.run);
  double range = 0.0;
  for (std::size_t i = 0; i < model.physical_dofs().size(); ++i) {
    if (model.physical_dofs()[i].rotation) continue;
    double low = run.rows.front().u[static_cast<Eigen::Index>(i)], high = low;
    for (const auto& row : run.rows) {
      low = std::min(low, row.u[static_cast<Eigen::Index>(i)]);
      high = std::max(high, row.u[static_cast<Eigen::Index>(i)]);
    }
    range = std::max(range, high - low);
  }
  CHECK(std::abs(last.amplitude - 0.5 * range) <= 1e-3 * range);  // the rows are 1/200 of the period apart
  // Both start from another place of the orbit, so that fast modes that ride on the motion are seen at other places: with 96
  // places in the period they made a difference of 6e-5 of the range.
  CHECK(std::abs(branch.points.back().amplitude - last.amplitude) <= 3e-5 * range);
  CHECK(branch.points.back().events == static_cast<long>(last.sequence.size()));
  CHECK(std::abs(branch.points.back().max_multiplier - last.max_multiplier) <= 1e-6);
}

TEST_CASE("a branch in two parts, the second from the mark of the first, ends where one of one part does") {
  BranchOptions options;
  options.path = "loads.1.amplitude";
  options.from = 3.0;
  options.to = 3.5;
  options.step = 0.1;
  const SceneReader read = reader_of_text(jenkins());
  const Branch whole = continue_branch(read, options);
  REQUIRE(whole.complete);
  options.most_points = 4;
  const Branch first = continue_branch(read, options);
  CHECK(!first.complete);
  REQUIRE(first.last);
  CHECK(first.last->parameter == first.points.back().parameter);
  options.most_points = 1000;
  options.resume_from = first.last;
  const Branch second = continue_branch(read, options);
  CAPTURE(second.end);
  REQUIRE(second.complete);
  CHECK(second.points.front().parameter > first.points.back().parameter);
  CHECK(second.points.back().parameter == 3.5);
  CHECK(std::abs(second.points.back().maxima.front() - whole.points.back().maxima.front()) <= 1e-9);
  CHECK(std::abs(second.points.back().max_multiplier - whole.points.back().max_multiplier) <= 1e-8);
  CHECK(second.points.back().sequence == whole.points.back().sequence);
}

TEST_CASE("branches end with a reason: a key that only shifts the motion, a value that the scene refuses") {
  BranchOptions options;
  options.path = "loads.1.history.phase";
  options.from = 0.5;
  options.to = 1.0;
  const Branch shifted = continue_branch(reader_of_text(jenkins()), options);
  CHECK(!shifted.complete);
  CHECK(shifted.points.size() == 1);
  CHECK(shifted.end.find("only shifts the motion in time") != std::string::npos);
  options.path = "contacts.1.friction";
  options.from = 0.9;
  options.to = -0.1;
  options.step = 0.1;
  const Branch refused = continue_branch(reader_of_text(jenkins()), options);
  CAPTURE(refused.end);
  CHECK(!refused.complete);
  CHECK(refused.points.size() > 3);
  CHECK(refused.end.find("the scene is refused") != std::string::npos);
  CHECK(refused.points.back().parameter < 0.3);
}

TEST_CASE(
    "a branch over the load goes through to the load zero, where the motion is rest, and begins there") {
  // Linear below the gap, or stuck: the amplitude is proportional to the load all the way.
  const std::string gapped =
      matrix_scene("t_end = 60.0", "mass = [[1.3]]\nstiffness = [[2.1]]\ndamping = [[0.17]]",
                   "law = \"rigid\"\nnormal = { d0 = -1.0 }\ngap = 0.3\nrestitution = 0.6",
                   "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.15\nhistory = { type = \"harmonic\", "
                   "omega = 1.7 }\n"
                   "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
  const double stiffness = std::abs(std::complex<double>(2.1 - 1.3 * 1.7 * 1.7, 0.17 * 1.7));
  const double anchored = std::abs(std::complex<double>(21.0 - 1.5 * 1.5, 0.02 * 1.5));
  for (const auto& [text, least, from, to] : {std::tuple{gapped, stiffness, 0.15, 0.0},
                                              {gapped, stiffness, 0.0, 0.15},
                                              {gapped, stiffness, 0.15, -0.15},
                                              {jenkins(), anchored, 3.0, 0.0},
                                              {jenkins(), anchored, 0.0, 3.0}}) {
    CAPTURE(text);
    CAPTURE(from);
    CAPTURE(to);
    BranchOptions options;
    options.path = "loads.1.amplitude";
    options.from = from;
    options.to = to;
    const Branch branch = continue_branch(reader_of_text(text), options);
    CAPTURE(branch.end);
    CHECK(branch.complete);
    REQUIRE(!branch.points.empty());
    CHECK(branch.points.back().parameter == to);
    CHECK(branch.points.size() < 200);
    for (const BranchPoint& p : branch.points) {
      if (p.events > 0) continue;
      CAPTURE(p.parameter);
      const double middle = 0.5 * (p.maxima.front() + p.minima.front());
      CHECK(std::abs(p.maxima.front() - middle - std::abs(p.parameter) / least) <= 1e-9);
      CHECK(p.stable.value_or(false));
    }
  }
}

TEST_CASE(
    "a branch of a linear oscillator with hardly any damping has one orbit at each value, and no fold") {
  // |x| = F/|k - m w^2 + i c w|, multipliers of magnitude exp(-c T/(2 m)); over 4e4 widths of the resonance
  const double m = 1.7, c = 3e-4, F = 23.0, w = 13.0;
  BranchOptions options;
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "[run]\nt_end = 3.0\nengine = \"exact\"\n[nodes]\na = [0.0, 0.0]\n"
      "[[masses]]\nnode = \"a\"\nmass = 1.7\n[[supports]]\nnode = \"a\"\nfix = [\"uy\"]\n"
      "[[springs]]\nnode = \"a\"\ndirection = [1.0, 0.0]\nstiffness = 291.3\ndamping = 3e-4\n"
      "[[loads]]\nnode = \"a\"\ndirection = [1.0, 0.0]\namplitude = 23.0\n"
      "history = { type = \"harmonic\", omega = 13.0, phase = 0.6 }\n"
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\nat = \"a\"\ndirection = [1.0, 0.0]\n";
  options.path = "springs.1.stiffness";
  for (const auto& [from, to] : {std::pair(100.0, 900.0), {900.0, 100.0}}) {
    options.from = from;
    options.to = to;
    const Branch branch = continue_branch(reader_of_text(text), options);
    CAPTURE(branch.end);
    REQUIRE(branch.complete);
    CHECK(branch.points.back().parameter == to);
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const BranchPoint& p = branch.points[i];
      const double k = p.parameter, x = F / std::abs(std::complex<double>(k - m * w * w, c * w));
      CAPTURE(k);
      CHECK(p.special.empty());
      CHECK(p.stable.value_or(false));
      CHECK(std::abs(p.maxima.front() - x) <= 1e-6 * x);
      CHECK(std::abs(p.max_multiplier - std::exp(-c * std::numbers::pi / (m * w))) <= 1e-9);
      if (i == 0) continue;
      const double way = (k - branch.points[i - 1].parameter) / (to - from);
      CHECK(way > 0.0);
      CHECK(way <= options.step * (1.0 + 1e-9));
    }
  }
}

namespace {

/// A ball that a table throws up once a period: hits at phases where sin = g T (1 - e)/(2 (1 + e) w V) ..., two orbits above
///   B0 = w V,   V = g T/2 (1 - e)/(1 + e)      B: amplitude of the acceleration
std::string ball() {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = "
         "[0.0, -9.81]\n"
         "[run]\nt_end = 3.0\nengine = \"exact\"\n"
         "initial = { a = { uy = 0.028860859291964823, vy = 0.7180120150509977 } }\n[nodes]\na = [0.0, 0.0]\n"
         "[[masses]]\nnode = \"a\"\nmass = 1.7\n[[supports]]\nnode = \"a\"\nfix = [\"ux\"]\n"
         "[[contacts]]\nname = \"c\"\nnode = \"a\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\nrestitution = "
         "0.63\n"
         "[[base_motion]]\ndirection = [0.0, 1.0]\nacceleration = { type = \"harmonic\", amplitude = "
         "9.729822543571219, omega = 31.7, phase = -1.1165197534631535 }\n";
}

}  // namespace

TEST_CASE(
    "a ball on a vibrating table: one fold, at any step, and multipliers of the closed form on both parts") {
  // mu^2 - (1 + e^2 + (1 + e)^2 a/g) mu + e^2 = 0,   a = -+ sqrt(B^2 - B0^2)
  const double e = 0.63, g = 9.81, w = 31.7, V = g * std::numbers::pi / w * (1.0 - e) / (1.0 + e), B0 = w * V;
  BranchOptions options;
  options.path = "base_motion.1.acceleration.amplitude";
  options.from = 9.729822543571219;
  options.to = 0.9 * B0;
  for (const double step : {0.01, 0.02, 0.03, 0.05}) {
    CAPTURE(step);
    options.step = step;
    const Branch branch = continue_branch(reader_of_text(ball()), options);
    CAPTURE(branch.end);
    REQUIRE(branch.complete);
    CHECK(branch.end.find("has no orbit") != std::string::npos);
    double sign = -1.0;
    long folds = 0;
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const BranchPoint& p = branch.points[i];
      CAPTURE(p.parameter);
      if (i > 0) CHECK(sign * (p.parameter - branch.points[i - 1].parameter) > 0.0);
      if (p.special == "fold") {
        ++folds;
        sign = 1.0;
        CHECK(std::abs(p.parameter - B0) <= 1e-8);
        continue;
      }
      CHECK(p.special.empty());
      const double a = sign * std::sqrt(std::max(0.0, p.parameter * p.parameter - B0 * B0));
      const double half = 0.5 * (1.0 + e * e + (1.0 + e) * (1.0 + e) * a / g);
      const std::complex<double> root = std::sqrt(std::complex<double>(half * half - e * e));
      const double greatest = std::max(std::abs(half + root), std::abs(half - root));
      CHECK(std::abs(p.max_multiplier - greatest) <= 1e-5 * greatest);
    }
    CHECK(folds == 1);
  }
}

TEST_CASE(
    "each switch at a flip of the bouncing ball leads to an orbit that repeats after twice the time only") {
  // Distances of flips shrink towards Feigenbaum's ratio 4.669; an orbit counted twice would have other ones.
  BranchOptions options;
  options.path = "base_motion.1.acceleration.amplitude";
  options.from = 12.0;
  options.to = 14.2;
  options.step = 0.1;
  options.switches = 3;
  std::string text = ball();
  const std::string at = "9.729822543571219";
  text.replace(text.find(at), at.size(), "12.0");
  const Branch branch = continue_branch(reader_of_text(text), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(branch.sides.size() == 3);
  std::vector<double> flips(5, 0.0);
  for (const BranchPoint& p : branch.points) {
    if (p.special == "flip" && flips.at(static_cast<std::size_t>(p.branch)) == 0.0)
      flips[static_cast<std::size_t>(p.branch)] = p.parameter;
    // Just beside the flip it is stable, and its greatest multiplier near 1.
    if (p.special != "switched") continue;
    const double leaves = branch.sides.at(static_cast<std::size_t>(p.branch) - 2).parameter;
    CHECK(std::abs(p.parameter - leaves) <= 0.01);
    CHECK(p.max_multiplier > 0.9);
    CHECK(p.stable.value_or(false));
  }
  REQUIRE(flips[4] > 0.0);
  const double first = (flips[2] - flips[1]) / (flips[3] - flips[2]),
               second = (flips[3] - flips[2]) / (flips[4] - flips[3]);
  CHECK(std::abs(second - 4.669) < std::abs(first - 4.669));
  CHECK(std::abs(second - 4.669) < 0.3);
}

namespace {

/// Two masses in a row, the second one before a stop, or between two.
std::string row_of_two(const std::string& stops, const std::string& omega) {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
         "3.0\n"
         "engine = \"exact\"\nrtol = 1e-11\n[nodes]\na = [0.0, 0.0]\nb = [1.0, 0.0]\n"
         "[[masses]]\nnode = \"a\"\nmass = 1.7\n[[masses]]\nnode = \"b\"\nmass = 0.9\n"
         "[[supports]]\nnodes = [\"a\", \"b\"]\nfix = [\"uy\"]\n"
         "[[springs]]\nnode = \"a\"\ndirection = [1.0, 0.0]\nstiffness = 291.3\ndamping = 0.3\n"
         "[[springs]]\nnode = \"b\"\nagainst = \"a\"\ndirection = [1.0, 0.0]\nstiffness = 117.7\ndamping = "
         "0.2\n" +
         stops +
         "gap = 0.05\nnormal_stiffness = 1711.0\n"
         "[[loads]]\nnode = \"a\"\ndirection = [1.0, 0.0]\namplitude = 23.0\n"
         "history = { type = \"harmonic\", omega = " +
         omega +
         ", phase = 0.6 }\n"
         "[[output]]\nname = \"u\"\nkind = \"displacement\"\nat = \"b\"\ndirection = [1.0, 0.0]\n";
}

}  // namespace

TEST_CASE("a symmetric branch between two stops is followed through a branch point as a symmetric one") {
  const std::string stops =
      "[[stops]]\nname = \"s\"\nnode = \"b\"\nlaw = \"compliant\"\ndirection = [1.0, 0.0]\n";
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 6.0;
  options.to = 5.0;
  for (const double step : {0.15}) {
    CAPTURE(step);
    options.step = step;
    const Branch branch = continue_branch(reader_of_text(row_of_two(stops, "6.0")), options);
    CAPTURE(branch.end);
    REQUIRE(branch.complete);
    CHECK(branch.points.back().parameter == 5.0);
    std::vector<double> branching, tori;
    for (const BranchPoint& p : branch.points) {
      CAPTURE(p.parameter);
      // At the branch point itself nothing holds the asymmetric part.
      if (p.special != "branch point")
        CHECK(std::abs(p.maxima.front() + p.minima.front()) <= 1e-5 * p.maxima.front());
      if (p.special == "branch point") branching.push_back(p.parameter);
      if (p.special == "neimark-sacker") tori.push_back(p.parameter);
    }
    REQUIRE(branching.size() == 2);
    CHECK(std::abs(branching[0] - 5.790946) <= 1e-5);
    CHECK(std::abs(branching[1] - 5.337308) <= 1e-5);
    REQUIRE(tori.size() == 1);
    CHECK(std::abs(tori[0] - 5.304025) <= 1e-5);
  }
}

TEST_CASE("what branches off between two stops is a pair that mirrors each other, at any step") {
  // Downwards in frequency the symmetric orbit loses its stability to the pair.
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "3.0\n"
      "engine = \"exact\"\n[nodes]\na = [0.0, 0.0]\n[[masses]]\nnode = \"a\"\nmass = 0.687\n"
      "[[supports]]\nnode = \"a\"\nfix = [\"uy\"]\n"
      "[[springs]]\nnode = \"a\"\ndirection = [1.0, 0.0]\nstiffness = 72.67\ndamping = 0.919\n"
      "[[stops]]\nname = \"s\"\nnode = \"a\"\nlaw = \"compliant\"\ndirection = [1.0, 0.0]\ngap = 0.0626\n"
      "normal_stiffness = 4136.0\n"
      "[[loads]]\nnode = \"a\"\ndirection = [1.0, 0.0]\namplitude = 21.5\n"
      "history = { type = \"harmonic\", omega = 10.5, phase = 0.288 }\n"
      "[[output]]\nname = \"u\"\nkind = \"displacement\"\nat = \"a\"\ndirection = [1.0, 0.0]\n";
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 10.5;
  options.to = 9.3;
  options.switches = 1;
  std::vector<double> where;
  for (const double step : {0.05, 0.02, 0.009}) {
    CAPTURE(step);
    options.step = step;
    const Branch branch = continue_branch(reader_of_text(text), options);
    CAPTURE(branch.end);
    double branching = 0.0;
    std::vector<double> least[2], greatest[2];
    for (const BranchPoint& p : branch.points) {
      CAPTURE(p.branch);
      CAPTURE(p.parameter);
      if (p.special == "branch point" && p.branch == 1) branching = p.parameter;
      if (p.branch < 2) continue;
      REQUIRE(p.branch <= 3);
      CHECK(p.parameter < branching);
      if (p.special == "switched") CHECK(p.stable);
      const auto which = static_cast<std::size_t>(p.branch - 2);
      least[which].push_back(p.minima.front());
      greatest[which].push_back(p.maxima.front());
    }
    where.push_back(branching);
    REQUIRE(least[0].size() > 2);
    REQUIRE(least[1].size() > 2);
    // They part, and to both sides.
    const double first = greatest[0].back() + least[0].back(), second = greatest[1].back() + least[1].back();
    CHECK(std::abs(first) > 0.01 * greatest[0].back());
    CHECK(std::abs(second) > 0.01 * greatest[1].back());
    CHECK((first < 0.0) != (second < 0.0));
  }
  for (const double omega : where) CHECK(std::abs(omega - where[0]) <= 1e-6);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/orbit branches");

TEST_CASE(
    "the pipeline's response on soft pads bends and folds twice: between the folds it has three orbits") {
  BranchOptions options;
  options.path = "loads.1.history.omega";
  options.from = 49.2;
  options.to = 45.5;
  options.step = 0.04;
  const Branch branch = continue_branch(
      reader_of(std::string(SIGNORINI_MODELS) + "/../validation/orbits/pipeline-pads.toml"), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  CHECK(branch.points.back().parameter == 45.5);
  std::vector<double> folds;
  for (const BranchPoint& p : branch.points) {
    // Ten times the noise of the map, to which fast mode shapes without damping bring some 1e-9 of the amplitude.
    CHECK(p.residual <= 5e-8);
    if (p.special != "fold") continue;
    folds.push_back(p.parameter);
    CHECK(std::abs(p.max_multiplier - 1.0) <= 1e-6);
  }
  REQUIRE(folds.size() == 2);
  // The key turns there, and nowhere else.
  const auto beyond = [&](std::size_t first, std::size_t last, double sign) {
    for (std::size_t i = first + 1; i <= last; ++i)
      CHECK(sign * (branch.points[i].parameter - branch.points[i - 1].parameter) > -1e-9);
  };
  std::vector<std::size_t> turns{0};
  for (std::size_t i = 0; i < branch.points.size(); ++i)
    if (branch.points[i].special == "fold") turns.push_back(i);
  turns.push_back(branch.points.size() - 1);
  for (std::size_t k = 0; k < 3; ++k) beyond(turns[k], turns[k + 1], k == 1 ? 1.0 : -1.0);
  CHECK(folds[0] < 47.0);
  CHECK(folds[1] > 47.0);
  // From the first point to the first fold stable, to the second one unstable, stable again.
  std::size_t part = 0;
  long undecided = 0;              // a multiplier is as near to 1 as its error
  std::vector<double> at(3, 0.0);  // span of the third of the way between the folds
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const BranchPoint& p = branch.points[i];
    CAPTURE(p.parameter);
    if (p.special == "fold") ++part;
    const bool beside = std::abs(p.max_multiplier - 1.0) <= 1e-6;
    if (!beside && p.stable) CHECK(*p.stable == (part != 1));
    undecided += p.stable ? 0 : 1;
    if (std::abs(p.parameter - 47.0) < 0.2) at[part] = p.maxima.front() - p.minima.front();
  }
  CHECK(undecided <= 6);
  CHECK(at[0] > 1.02 * at[1]);
  CHECK(at[1] > 2.0 * at[2]);
}

TEST_CASE("the resonance of a one-sided spring bends over, its middle part is unstable") {
  BranchOptions options;
  options.orbit.transient = 60;
  options.path = "loads.1.history.omega";
  options.from = 0.5;
  options.to = 1.0;
  const Branch branch = continue_branch(reader_of_text(chain("0.62")), options);
  CAPTURE(branch.end);
  CHECK(branch.complete);
  long folds = 0, flips = 0, unstable = 0;
  for (const BranchPoint& p : branch.points) {
    flips += p.special == "flip" ? 1 : 0;
    if (p.special == "fold" || p.special == "flip" || p.special == "neimark-sacker")
      CHECK(std::abs(p.max_multiplier - 1.0) <= 1e-5);  // that of time and those of families aside
    folds += p.special == "fold" ? 1 : 0;
    unstable += p.stable.value_or(true) ? 0 : 1;
    CHECK(p.residual <= 1e-9);
  }
  CHECK(folds == 2);
  CHECK(flips == 2);
  CHECK(unstable > 0);
}

TEST_SUITE_END();
