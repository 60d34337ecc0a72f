// A motion that begins a thousand seconds later is the same motion, but its clock is coarser: chatter has its last hits
// where a rebound that the clock does not resolve rests. What is certain of the later one is what the earlier one did.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>

#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::late_chatter {
namespace {

/// A mass on springs that a pulse throws against a stop, turned by atan2(0.5646, 0.8253).
std::string text(double begin) {
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = {0:.17g}
engine = "ida"
certify = true
[nodes]
a = [0.0, 0.0]
[[masses]]
node = "a"
mass = 0.7015463661686019
[[springs]]
node = "a"
direction = [0.8253356149096783, 0.5646424733950354]
stiffness = 177.11506054058492
damping = 0.4055098475906457
[[springs]]
node = "a"
direction = [-0.5646424733950354, 0.8253356149096783]
stiffness = 177.11506054058492
damping = 0.4055098475906457
[[contacts]]
name = "f"
node = "a"
law = "rigid"
normal = [-0.8253356149096783, -0.5646424733950354]
gap = 0.02
restitution = 0.6
friction = 0.2
[[loads]]
node = "a"
direction = [0.6967067093471654, 0.7173560908995228]
amplitude = 9.0
history = {{ type = "half_sine", start = {1:.17g}, duration = 0.73, period = 1.1 }}
)",
                     begin + 6.0, begin + 0.1);
}

struct Run {
  Result result;
  Certificate certificate;
  bool open = false;  // a capture was faster than capture_velocity
};

Run run_scene(double begin) {
  const Scene scene = parse_scene(text(begin), "late.toml");
  Run found;
  CertifiedReport report = simulate_certified(build_model(scene), scene.run, found.result);
  REQUIRE(report.certificate);
  found.certificate = std::move(*report.certificate);
  found.open = report.report.first_undecided.has_value();
  return found;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/late_chatter");

TEST_CASE("what ida certifies of a late chatter is what happened early") {
  const Run early = run_scene(0.0), late = run_scene(1000.0);
  std::size_t certain = 0;
  for (std::size_t i = 0; i < late.result.events.size() && late.certificate.certain(i); ++i, ++certain) {
    CAPTURE(i);
    REQUIRE(i < early.result.events.size());
    CHECK(late.result.events[i].type == early.result.events[i].type);
    CHECK(std::abs(late.result.events[i].t - 1000.0 - early.result.events[i].t) < 1e-7);
  }
  CHECK(certain > 10);
  CHECK(late.result.events.size() < early.result.events.size());  // hits are missing
  CHECK_FALSE(late.certificate.complete);
  CHECK(late.open);
}

TEST_SUITE_END();

}  // namespace signorini::tests::late_chatter
