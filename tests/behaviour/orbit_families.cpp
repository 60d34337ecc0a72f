// Branches through families of orbits: contacts that never slip hold any mean force.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// A slider of limit 1 beside a spring, driven at 1.5; in the beginning it holds `shear`.
std::string held_slider(double shear) {
  return matrix_scene(
      "t_end = 9.0\ninitial = { u = [0.0] }", "mass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[0.3]]",
      fmt::format("law = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = 1.0\nfriction = 1.0\n"
                  "tangential_stiffness = 20.0\ninitial_shear = {}",
                  shear),
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.3\nhistory = { type = \"harmonic\", omega = 1.5 }\n"
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
}

/// Twelve masses in a chain, each on a slider of its own limit; the first is driven.
std::string slider_chain() {
  const int n = 12;
  const auto row = [](const std::vector<double>& x) { return fmt::format("[{}]", fmt::join(x, ", ")); };
  std::vector<std::string> mass, stiffness, damping;
  std::string contacts;
  for (int i = 0; i < n; ++i) {
    std::vector<double> m(n), k(n), c(n);
    const auto at = static_cast<std::size_t>(i);
    m[at] = 1.0;
    k[at] = 2.5;
    c[at] = 0.1;
    if (i > 0) k[at - 1] = -1.0;
    if (i + 1 < n) k[at + 1] = -1.0;
    mass.push_back(row(m));
    stiffness.push_back(row(k));
    damping.push_back(row(c));
    contacts += fmt::format(
        "[[contacts]]\nname = \"c{}\"\nlaw = \"slider\"\ntangent = {{ d{} = 1.0 }}\nnormal_force = {}\n"
        "friction = 0.3\ntangential_stiffness = {}\n",
        i, i, 0.3 + 0.01 * ((35 * i) % 84), 3.0 + 0.3 * i);
  }
  return fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\n"
      "t_end = 50.0\nengine = \"exact\"\ncertify = false\n[matrices]\nmass = [{}]\nstiffness = [{}]\n"
      "damping = [{}]\n{}[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = 0.3\n"
      "history = {{ type = \"harmonic\", omega = 0.8 }}\n"
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = {{ d0 = 1.0 }}\n",
      fmt::join(mass, ", "), fmt::join(stiffness, ", "), fmt::join(damping, ", "), contacts);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit families");

TEST_CASE("the branch of a slider that holds a mean force begins to slip where one without does") {
  // The slider's spring alone would carry |T| = kt P/|k + kt - m w^2 + i c w|; it slips where this is its limit, 1.
  const double w = 1.5, slips = std::abs(std::complex<double>(21.0 - w * w, 0.3 * w)) / 20.0;
  for (const double shear : {0.0, 0.6, -0.69}) {
    CAPTURE(shear);
    BranchOptions options;
    options.path = "loads.1.amplitude";
    options.from = 0.3;
    options.to = 1.5;
    options.step = 0.1;
    const Branch branch = continue_branch(reader_of_text(held_slider(shear)), options);
    CAPTURE(branch.end);
    REQUIRE(branch.complete);
    long changes = 0;
    for (const BranchPoint& p : branch.points) {
      CAPTURE(p.parameter);
      // In the middle of the family the motion is symmetric: the mean of T = -k x is zero within 1e-5 of its amplitude.
      CHECK(std::abs(p.maxima.front() + p.minima.front()) <= 2e-5);
      if (p.special == "sequence") {
        ++changes;
        CHECK(std::abs(p.parameter - slips) <= 1e-8);
      } else {
        CHECK(p.events == (p.parameter < slips ? 0 : 4));
      }
    }
    CHECK(changes == 1);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/orbit families");

TEST_CASE("a chain of twelve sliders is followed through twenty changes of sequence") {
  const SceneReader read = reader_of_text(slider_chain());
  BranchOptions options;
  options.path = "loads.1.amplitude";
  options.from = 0.3;
  options.to = 3.0;
  const Branch branch = continue_branch(read, options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  int changes = 0;
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    changes += branch.points[i].sequence != branch.points[i - 1].sequence ? 1 : 0;
  CHECK(changes >= 20);
  // Another way to some of the points: a transient at that load alone.
  for (std::size_t i = 0; i < branch.points.size(); i += 10) {
    const BranchPoint& p = branch.points[i];
    if (!p.special.empty()) continue;
    const SceneReader there = [&](const std::vector<Override>& more) {
      std::vector<Override> all{{"loads.1.amplitude", fmt::format("{}", p.parameter)}};
      all.insert(all.end(), more.begin(), more.end());
      return read(all);
    };
    const Orbit orbit = find_orbit(there);
    CAPTURE(p.parameter);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    const OutputExtremes x = simulate(orbit_scene(there, orbit)).report.response.front();
    const double range = p.maxima.front() - p.minima.front();  // the mean differs from member to member
    CHECK(std::abs(x.maximum - x.minimum - range) <= 1e-9 * range);
    // Beside a change of the sequence one member has a slip that another one has not.
    if (static_cast<long>(orbit.sequence.size()) == p.events)
      CHECK(std::abs(orbit.max_multiplier - p.max_multiplier) <= 1e-6);
  }
}

TEST_SUITE_END();
