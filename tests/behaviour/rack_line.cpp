// A pipe line of 60 m on a rack: loop, guide, hangers, a rigid link, heat of 180 K, P-delta, shaken along two directions.
//
// The scene is tests/scenes/starts/reduced_rack.toml, whole and reduced; what is asked is that it is one and the same line,
// however it is computed.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "behaviour/halves.hpp"
#include "behaviour/rates.hpp"
#include "behaviour/seen_otherwise.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"
#include "study/verify/verify.hpp"

namespace signorini::tests {
namespace {

std::string line_text(double cutoff, double t_end) {
  std::ifstream file(SIGNORINI_TEST_DATA "/scenes/starts/reduced_rack.toml");
  REQUIRE(file);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto cut = text.find("[reduction]");
  REQUIRE(cut != std::string::npos);
  text.erase(cut);
  const auto end = text.find("t_end = 0.02");
  REQUIRE(end != std::string::npos);
  text.replace(end, 12, fmt::format("t_end = {}", t_end));
  text +=
      "[[output]]\nname = \"worst\"\nkind = \"envelope\"\nnodes = [\"P4\", \"P5\", \"a\", \"b\"]\nquantity = "
      "\"stress\"\n"
      "[[output]]\nname = \"anchor\"\nkind = \"reaction\"\nat = \"P0\"\ndirection = [1.0, 0.0]\n";
  return cutoff > 0.0 ? text + fmt::format("[reduction]\ncutoff_frequency = {}\n", cutoff) : text;
}

Result line_run(const std::string& text, const char* engine) {
  const Scene scene = parse_scene(text, "line.toml", {{"run.engine", engine}, {"run.rtol", "1e-9"}});
  Result result = simulate(scene);
  INFO(result.report.outcome.reason);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violations.empty());
  return result;
}

/// Contact by contact the same events, times within what both runs state for their uncertainty and `time`: all shoes start
/// at their limits, so that the first slips are known to 1e-4 s only; motion of the nodes within `motion` of its greatest.
void check_alike(const Result& one, const Result& other, double time, double motion) {
  halves::Difference d;
  halves::compare_events(one.events, other.events, 0.0, one.rows.back().t, d);
  CAPTURE(d.first);
  CHECK(d.events_agree);
  CHECK(d.events > 20);
  for (int k = 0; k < 8; ++k) {
    std::vector<const Event*> mine, others;
    for (const Event& e : one.events)
      if (e.contact == k) mine.push_back(&e);
    for (const Event& e : other.events)
      if (e.contact == k) others.push_back(&e);
    REQUIRE(mine.size() == others.size());
    for (std::size_t i = 0; i < mine.size(); ++i)
      CHECK(std::abs(mine[i]->t - others[i]->t) <
            time + 2.0 * (mine[i]->t_uncertainty.value_or(0.0) + others[i]->t_uncertainty.value_or(0.0)));
  }
  double off = 0.0, size = 0.0;
  REQUIRE(one.rows.size() == other.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    off = std::max(off, (one.rows[i].u - other.rows[i].u).cwiseAbs().maxCoeff());
    size = std::max(size, one.rows[i].u.cwiseAbs().maxCoeff());
  }
  CHECK(off < motion * size);
}

/// Rates of times of events by a key of the scene, beside differences of fourth order.
void check_rates(const char* path) {
  const auto read = reader_of_text(line_text(0.0, 0.1));
  CAPTURE(path);
  const Sensitivities s = sensitivities(read, {path});
  CHECK(s.parameters[0].reason == "");
  const double p = s.parameters[0].value, h = 1e-4 * p;
  std::vector<Result> runs;
  for (const int k : {-2, -1, 1, 2})
    runs.push_back(run_exact(read, {path, fmt::format("{:.17g}", p + k * h)}));
  REQUIRE(s.events.size() > 5);
  double greatest = 0.0;
  for (const auto& row : s.event_rates) greatest = std::max(greatest, std::abs(row[0].t));
  CHECK(greatest > 0.0);
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    CAPTURE(i);
    for (const Result& run : runs) REQUIRE(run.events.size() == s.events.size());
    const auto t = [&](std::size_t run) { return runs[run].events[i].t; };
    const double expected = (8.0 * (t(2) - t(1)) - (t(3) - t(0))) / (12.0 * h);
    // Differences know a time no better than its run does: the first, from the limit on, to 1e-8 s, others to 1e-11 s.
    const double known = runs[0].events[i].t_uncertainty.value_or(0.0) + 1e-11;
    CHECK(std::abs(s.event_rates[i][0].t - expected) < 1e-5 * greatest + 1.5 * known / h);
  }
}

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/rack_line");

TEST_CASE("rack line: exact and ida, and reduced with all its modes") {
  const Result whole = line_run(line_text(0.0, 0.3), "exact");
  CHECK(whole.report.audit.energy.value < 1e-9 * whole.report.audit.energy_scale);
  check_alike(whole, line_run(line_text(0.0, 0.3), "ida"), 1e-6, 1e-6);
  check_alike(whole, line_run(line_text(1e5, 0.3), "exact"), 1e-8, 1e-8);
}

TEST_CASE("rack line: in two halves, whole and reduced") {
  for (const double cutoff : {0.0, 300.0}) {
    CAPTURE(cutoff);
    const halves::Difference d = halves::split_text(line_text(cutoff, 0.3), {{"run.engine", "exact"}}, 0.37);
    CAPTURE(d.first);
    CHECK(d.events > 10);
    CHECK(d.events_agree);
    CHECK(d.state < 1e-8);
  }
}

TEST_CASE("rack line: turned by odd angles, permuted, in other units") {
  check_seen_otherwise(parse_scene(line_text(0.0, 0.03), "line.toml"), 6, 3);
}

TEST_CASE("rack line: verify finds that ida and newmark agree") {
  const Scene scene = parse_scene(line_text(0.0, 0.1), "line.toml", {{"run.engine", "ida"}});
  verify::VerifyRequest request;
  request.run = scene.run;
  request.max_seconds = 8.0;
  const Model model = build_model(scene);
  const verify::Verification v = verify::verify(model, model, request);
  INFO(v.sentence);
  CHECK(v.verdict == verify::Agreement::agree);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/behaviour/rack_line");

TEST_CASE("rack line: turned by odd angles, mirrored, permuted, in other units, in all ways") {
  check_seen_otherwise(parse_scene(line_text(0.0, 0.03), "line.toml"), 17);  // eleven runs of 10 s a second
}

TEST_CASE("rack line: derivatives by a hanger's cold load, a wall and shaking are those of differences") {
  check_rates("springs.1.hanger.cold");
  check_rates("sections.pipe.pipe.wall");
  check_rates("base_motion.1.acceleration.amplitude");
}

TEST_SUITE_END();

}  // namespace signorini::tests
