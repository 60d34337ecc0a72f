// What rounding hides is within the error of an event, or not certain.
//
//   a chain of six masses, the last one on a stop: g ~ -(t - 0.1)^12, zero to its rounding long after 0.1 s
//   a contact that chatters beside a slider: its last flights are as low as the rounding of the places of its nodes
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "signorini/certify.hpp"

namespace signorini::tests::below_rounding {
namespace {

struct Run {
  Result rows;
  Certificate certificate;
};

Run run_scene(const std::string& name, const std::vector<Override>& more) {
  std::vector<Override> overrides = more;
  overrides.push_back({"run.certify", "true"});
  const Scene scene =
      read_scene(std::string(SIGNORINI_TEST_DATA) + "/scenes/certified/" + name + ".toml", overrides);
  Run result;
  CertifiedReport report = simulate_certified(build_model(scene), scene.run, result.rows);
  REQUIRE(report.certificate);
  result.certificate = std::move(*report.certificate);
  return result;
}

bool same(const Event& a, const Event& b) {
  return a.contact == b.contact && a.type == b.type && a.from == b.from && a.to == b.to;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/below_rounding");

TEST_CASE("a contact that closes with the twelfth power of time: its error covers the time below rounding") {
  for (const char* engine : {"exact", "ida"})
    for (const char* flow : {"taylor", "modal"}) {
      if (engine == std::string("ida") && flow == std::string("modal")) continue;
      CAPTURE(std::string(engine));
      CAPTURE(std::string(flow));
      std::vector<Override> how{{"run.engine", engine}};
      if (engine == std::string("exact")) how.push_back({"run.flow", flow});
      const Run result = run_scene("chain6", how);
      REQUIRE(result.rows.events.size() > 1);
      const Event& closes = result.rows.events[1];
      REQUIRE(closes.type == EventType::contact);
      REQUIRE(result.certificate.certain(1));
      CHECK(closes.t - result.certificate.t_errors[1] <= 0.1);
      // Later ones do not suffer: what it has missed was below rounding.
      if (engine == std::string("exact")) CHECK(result.certificate.t_errors[2] < 1e-3);
    }
}

TEST_CASE("chatter beside a slider is the same turned, and in modes as far as it is certain") {
  const Run along = run_scene("chatter", {{"run.engine", "exact"}, {"run.flow", "taylor"}});
  for (const char* flow : {"taylor", "modal"})
    for (const char* name : {"chatter", "chatter-turned"}) {
      CAPTURE(std::string(flow));
      CAPTURE(std::string(name));
      const Run other = run_scene(name, {{"run.engine", "exact"}, {"run.flow", flow}});
      std::size_t certain = 0;
      for (std::size_t i = 0; i < other.rows.events.size() && other.certificate.certain(i); ++i, ++certain) {
        if (!along.certificate.certain(i)) break;
        CAPTURE(i);
        REQUIRE(i < along.rows.events.size());
        const Event &a = along.rows.events[i], &b = other.rows.events[i];
        REQUIRE(same(a, b));
        const double apart = std::abs(a.t - b.t);
        const double bounds = along.certificate.t_errors[i] + other.certificate.t_errors[i];
        CHECK(apart <= bounds);
      }
      CHECK(certain >= 60);
      if (other.rows.events.size() != along.rows.events.size()) CHECK(certain < other.rows.events.size());
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests::below_rounding
