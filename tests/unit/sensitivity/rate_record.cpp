// Which figures of a contact have derivatives: closed forms of a free oscillator and a pressed slider.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"

namespace signorini::tests::rate_records {
namespace {

const Response* find(const Sensitivities& s, const std::string& name, int contact) {
  const auto found = std::find_if(s.responses.begin(), s.responses.end(),
                                  [&](const Response& r) { return r.name == name && r.contact == contact; });
  return found == s.responses.end() ? nullptr : &*found;
}

/// How often it was told of what.
struct Counted : Recorder {
  bool steering = false;
  int events = 0, samples = 0, responses = 0, instants = 0;
  void event(const Event& /*event*/) override { ++events; }
  void sample(const Sample& /*sample*/) override { ++samples; }
  void response(double /*t*/, const std::vector<double>& /*values*/) override { ++responses; }
  [[nodiscard]] bool wants_instants() const override { return true; }
  void instant(const InstantRow& /*instant*/) override { ++instants; }
  [[nodiscard]] bool steers() const override { return steering; }
};

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/rate_record");

TEST_CASE("peaks of a contact with a gap and of a slider without one: values, times and derivatives") {
  // d0 presses on an element, u = x cos w t in the state closed; d1 hangs on a slider that sticks.
  const std::string text =
      matrix_scene("t_end = 0.9\noutput_dt = 0.9\ninitial = { u = [-0.2, 0.0], v = [-0.6, 0.3] }",
                   "mass = [[2.0, 0.0], [0.0, 0.5]]\nstiffness = [[0.0, 0.0], [0.0, 8.0]]",
                   "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 18.0",
                   "[[contacts]]\nname = \"s\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = "
                   "40.0\nfriction = 0.5\n"
                   "tangential_stiffness = 10.0\n");
  const Sensitivities s =
      rates_of(text, {"contacts.c.normal_stiffness", "run.initial.v.2", "contacts.s.normal_force"});
  // c: w = 3, u = -A cos(w t - phi), A = sqrt(0.2^2 + 0.2^2) and phi = pi/4
  const double w = 3.0, A = 0.2 * std::sqrt(2.0), turn = M_PI / 4.0 / w;
  const Response* N = find(s, "peak N", 0);
  REQUIRE(N);
  CHECK(N->value == doctest::Approx(-18.0 * A).epsilon(1e-13));
  CHECK(N->t == doctest::Approx(turn).epsilon(1e-9));
  // A^2 = u^2 + v^2 m / k: dA/dk = -v^2 m / (2 A k^2); tan phi = v / (w u): dt = d(phi / w)
  const double dA = -0.36 * 2.0 / (2.0 * A * 18.0 * 18.0), dw = w / 36.0, dphi = -0.5 * dw / w;
  CHECK(N->rates[0] == doctest::Approx(-(A + 18.0 * dA)).epsilon(1e-11));
  CHECK(N->t_rates[0] == doctest::Approx(dphi / w - M_PI / 4.0 * dw / (w * w)).epsilon(1e-10));
  CHECK(std::abs(N->rates[1]) < 1e-13);
  const Response* normal = find(s, "peak normal", 0);
  REQUIRE(normal);
  // It lets go at w t = phi + pi/2 with A w, and has gone farthest at the end.
  const double open = 0.75 * M_PI / w, open_rate = dphi / w - 0.75 * M_PI * dw / (w * w);
  CHECK(normal->value == doctest::Approx(0.2 + A * w * (0.9 - open)).epsilon(1e-12));
  CHECK(normal->rates[0] ==
        doctest::Approx((dA * w + A * dw) * (0.9 - open) - A * w * open_rate).epsilon(1e-10));
  CHECK(find(s, "peak T", 0) == nullptr);
  // s: w = 6, u = v / w sin w t
  const Response *T = find(s, "peak T", 1), *tangential = find(s, "peak tangential", 1);
  REQUIRE(T);
  REQUIRE(tangential);
  CHECK(T->value == doctest::Approx(10.0 * 0.3 / 6.0).epsilon(1e-12));
  CHECK(T->rates[1] == doctest::Approx(10.0 / 6.0).epsilon(1e-11));
  CHECK(std::abs(tangential->value) == doctest::Approx(0.3 / 6.0).epsilon(1e-12));
  CHECK(std::abs(tangential->rates[1]) == doctest::Approx(1.0 / 6.0).epsilon(1e-11));
  CHECK(std::abs(tangential->t - std::round(6.0 * tangential->t / M_PI - 0.5) * M_PI / 6.0 - M_PI / 12.0) <
        1e-8);
  const Response* pressed = find(s, "peak N", 1);
  REQUIRE(pressed);
  CHECK(pressed->value == -40.0);
  CHECK(pressed->rates[2] == doctest::Approx(-1.0).epsilon(1e-14));
  CHECK(find(s, "peak normal", 1) == nullptr);
  const Response* rest = find(s, "rest tangential", 1);
  REQUIRE(rest);
  CHECK(rest->value == doctest::Approx(0.05 * std::sin(5.4)).epsilon(1e-11));
  CHECK(rest->rates[1] == doctest::Approx(std::sin(5.4) / 6.0).epsilon(1e-11));
}

TEST_CASE("a recorder is told of all that a run without derivatives tells; one that steers is refused") {
  const std::string text =
      matrix_scene("t_end = 2.0\noutput_dt = 0.25\ninitial = { u = [0.3], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[9.0]]",
                   "law = \"compliant\"\nnormal = { d0 = 1.0 }\nnormal_stiffness = 18.0",
                   "[[output]]\nname = \"u\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
  const SceneReader read = reader_of_text(text);
  Counted alone, beside;
  const Scene scene = read({});
  (void)simulate(build_model(scene), scene.run, alone);
  (void)sensitivities(read, {"contacts.c.normal_stiffness"}, &beside);
  CHECK(alone.events > 1);
  CHECK(alone.instants > 1);
  CHECK(alone.responses > 4);
  CHECK(beside.events == alone.events);
  CHECK(beside.samples == alone.samples);
  CHECK(beside.responses == alone.responses);
  CHECK(beside.instants == alone.instants);
  beside.steering = true;
  CHECK_THROWS_WITH_AS(sensitivities(read, {"contacts.c.normal_stiffness"}, &beside),
                       doctest::Contains("does not steer"), UsageError);
}

TEST_SUITE_END();

}  // namespace signorini::tests::rate_records
