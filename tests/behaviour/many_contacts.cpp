// A beam on many soft contacts: the series, which avoids work that an event does not touch, beside the flow in modes, which
// shares none of that.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// A beam of so many nodes, each on a contact, under pulses, all of it turned.
std::string beam(int nodes, double degrees) {
  const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
  std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
      "gravity = [{:.17g}, {:.17g}]\n[run]\nt_end = 0.05\noutput_dt = 0.05\ninitial = \"static\"\n[damping]\n"
      "ratios = [0.02, 0.02]\nfrequencies = [1.0, 30.0]\n[sections.s]\nEA = 2.1e9\nEI = 2.1e7\n"
      "mass_per_length = 100.0\n[nodes]\n",
      9.81 * s, -9.81 * c);
  std::string names, rest;
  for (int i = 0; i < nodes; ++i) {
    text += fmt::format("b{} = [{:.17g}, {:.17g}]\n", i, 2.0 * i * c, 2.0 * i * s);
    names += fmt::format("{}\"b{}\"", i > 0 ? ", " : "", i);
    rest += fmt::format(
        "[[contacts]]\nname = \"c{0}\"\nnode = \"b{0}\"\nlaw = \"compliant\"\nnormal = [{1:.17g}, {2:.17g}]\n"
        "normal_stiffness = 1e7\ntangential_stiffness = 1e7\nfriction = 0.3\n",
        i, -s, c);
    if (i % 6 != 2) continue;
    const double across = std::cos(1.7 * i), size = 1e4 * (1.2 + std::sin(2.3 * i));
    rest += fmt::format(
        "[[loads]]\nnode = \"b{}\"\ndirection = [{:.17g}, {:.17g}]\namplitude = {:.17g}\n"
        "history = {{ type = \"half_sine\", start = {:.17g}, duration = 0.03 }}\n",
        i, across * c - s, across * s + c, size, 0.001 * (i % 11));
  }
  return text + "[[members]]\nnodes = [" + names + "]\nsection = \"s\"\nelements = 1\n" + rest;
}

Result run_scene(const std::string& text, const char* flow) {
  const Scene scene =
      parse_scene(text, "beam.toml", {{"run.engine", "exact"}, {"run.flow", flow}, {"run.certify", "false"}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/many_contacts");

TEST_CASE("a beam on many contacts has the same events and peaks in both flows of exact") {
  const Result series = run_scene(beam(21, 17.0), "taylor"), modes = run_scene(beam(21, 17.0), "modal");
  CHECK(series.events.size() > 40);
  REQUIRE(series.events.size() == modes.events.size());
  for (std::size_t i = 0; i < series.events.size(); ++i) {
    const Event &a = series.events[i], &b = modes.events[i];
    CAPTURE(i);
    CHECK(a.contact == b.contact);
    CHECK(a.to == b.to);
    CHECK(std::abs(a.t - b.t) < 1e-11);
  }
  const std::vector<Peak>&p = series.report.peaks, &q = modes.report.peaks;
  REQUIRE(p.size() == q.size());
  for (std::size_t k = 0; k < p.size(); ++k) {
    CAPTURE(k);
    CHECK(p[k].N == doctest::Approx(q[k].N).epsilon(1e-9));
    CHECK(p[k].T == doctest::Approx(q[k].T).epsilon(1e-9));
    CHECK(p[k].normal == doctest::Approx(q[k].normal).epsilon(1e-9));
    CHECK(p[k].tangential == doctest::Approx(q[k].tangential).epsilon(1e-9));
  }
}

TEST_SUITE_END();
