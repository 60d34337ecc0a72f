// Keys that are found again from what a run with other values gave.
#include "signorini/fit.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "behaviour/one_mass.hpp"
#include "own_folder.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// A block on a spring that a slider rubs.
SceneReader rubbed() {
  const std::string text =
      matrix_scene("t_end = 9.0\noutput_dt = 1.0\ninitial = { u = [1.03], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[4.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.3");
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

std::filesystem::path written(const std::string& name, const std::string& text) {
  static const OwnFolder folder;
  const std::filesystem::path path = folder.path() / name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/fit");

TEST_CASE("friction and first displacement from rows of a run without noise") {
  const std::vector<std::string> paths{"contacts.c.friction", "run.initial.u.1"};
  const Sensitivities truth = sensitivities(
      [](const std::vector<Override>& changes) {
        std::vector<Override> all{{"contacts.c.friction", "0.33"}, {"run.initial.u.1", "1.01"}};
        all.insert(all.end(), changes.begin(), changes.end());
        return rubbed()(all);
      },
      {});
  Measurements data;
  for (std::size_t i = 1; i < truth.times.size(); ++i)
    data.rows.push_back({0, "", truth.columns[0], truth.times[i], truth.values[i][0], 1.0});
  const Fit found = fit(rubbed(), paths, data);
  CHECK(found.converged);
  CHECK(std::abs(found.keys[0].value - 0.33) < 1e-9);
  CHECK(std::abs(found.keys[1].value - 1.01) < 1e-9);
  CHECK(found.keys[0].start == 0.3);
  CHECK(found.chi_squared < 1e-16);
  for (const double residual : found.residuals) CHECK(std::abs(residual) < 1e-9);
}

TEST_CASE("friction and stiffness of the pipeline from its first thirty events, with noise of 1e-5 s") {
  const std::string models = SIGNORINI_MODELS;
  const Measurements data = read_measurements(models + "/pipeline-measured.csv");
  REQUIRE(data.rows.size() == 30);
  CHECK(data.has_sigma);
  const Fit found =
      fit(reader_of(models + "/pipeline.toml",
                    {{"run.engine", "exact"}, {"run.t_end", "0.187"}, {"run.output_dt", "0.1"}}),
          {"contacts.*.friction", "contacts.*.normal_stiffness"}, data);
  CHECK(found.converged);
  const std::vector<double> truth{0.302, 1.01e6};
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(found.keys[i].path);
    CHECK(found.keys[i].sigma > 0.0);
    CHECK(std::abs(found.keys[i].value - truth[i]) < 3.0 * found.keys[i].sigma);
    // and closer than it was
    CHECK(std::abs(found.keys[i].value - truth[i]) < 0.2 * std::abs(found.keys[i].start - truth[i]));
  }
  CHECK(found.chi_squared > 10.0);  // 28 +- 7.5
  CHECK(found.chi_squared < 55.0);
  CHECK(found.covariance[0][1] == doctest::Approx(found.covariance[1][0]));
}

TEST_CASE("without sigmas the scatter of the data is that of the keys") {
  // x = f exactly: one number that is measured five times
  Measurements data;
  const double values[] = {0.9, 1.1, 1.0, 0.95, 1.05};
  for (const double value : values) data.rows.push_back({0, "", "d0.u", 0.0, value, 1.0});
  const Fit found = fit(rubbed(), {"run.initial.u.1"}, data);
  CHECK(found.keys[0].value == doctest::Approx(1.0));
  CHECK(found.keys[0].sigma == doctest::Approx(std::sqrt(0.025 / 4.0 / 5.0)));
  data.has_sigma = true;
  for (Measurement& m : data.rows) m.sigma = 0.2;
  CHECK(fit(rubbed(), {"run.initial.u.1"}, data).keys[0].sigma == doctest::Approx(0.2 / std::sqrt(5.0)));
}

namespace {

/// Two blocks on plates, each pushed by 9 N sin(pi t): each slips where that is 10 N times its friction.
SceneReader two_blocks(double friction_a, double friction_b) {
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "run = { t_end = 0.5, output_dt = 0.1 }\nnodes = { a = [0.0, 0.0], b = [1.0, 0.0] }\n";
  for (const auto& [node, name, friction] :
       {std::tuple("a", "A", friction_a), std::tuple("b", "B", friction_b)})
    text += fmt::format(
        "[[masses]]\nnode = \"{0}\"\nmass = 1.0\n[[supports]]\nnode = \"{0}\"\nfix = [\"uy\"]\n"
        "[[contacts]]\nname = \"{1}\"\nnode = \"{0}\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\n"
        "normal_force = 10.0\nfriction = {2}\n[[loads]]\nnode = \"{0}\"\ndirection = [1.0, 0.0]\n"
        "amplitude = 9.0\nhistory = {{ type = \"half_sine\", start = 0.0, end = 1.0 }}\n",
        node, name, friction);
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}
double slips_at(double friction) { return std::asin(friction * 10.0 / 9.0) / std::acos(-1.0); }

/// A block of 1 kg on a spring of 100 N/m that a plate rubs: it turns at multiples of pi/10 s.
SceneReader oscillator(const std::string& mass = "1.0") {
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
      "run = { t_end = 3.0, output_dt = 0.1, initial = { block = { ux = 1.0 } } }\n"
      "nodes = { block = [0.0, 0.0] }\nmasses = [{ node = \"block\", mass = " +
      mass +
      " }]\n[[supports]]\nnode = \"block\"\nfix = [\"uy\"]\n[[springs]]\nnode = \"block\"\ndirection = [1.0, "
      "0.0]\nstiffness = 100.0\n[[contacts]]\nname = \"plate\"\nnode = \"block\"\nlaw = \"slider\"\ntangent "
      "= "
      "[1.0, 0.0]\nnormal_force = 10.0\nfriction = 0.4\n";
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}
/// Its turns, over a factor of the natural frequency.
Measurements turns_of(double faster, double sigma) {
  Measurements data;
  data.has_sigma = true;
  for (std::size_t i = 1; i <= 9; ++i)
    data.rows.push_back(
        {i, "plate", "", 0.0, 0.1 * std::acos(-1.0) * static_cast<double>(i) / faster, sigma, "reversal"});
  return data;
}
bool doubted(const Fit& fit, const std::string& what) {
  for (const std::string& doubt : fit.issues)
    if (doubt.find(what) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("fit: from one order of two events to the other, across the kink where they meet") {
  // By numbers alone: the earlier slip was B's, the later A's; the scene begins with A earlier.
  Measurements data;
  data.rows.push_back({1, "", "", 0.0, slips_at(0.32), 1.0});
  data.rows.push_back({2, "", "", 0.0, slips_at(0.35), 1.0});
  const Fit found = fit(two_blocks(0.3, 0.32), {"contacts.A.friction"}, data);
  CHECK(found.converged);
  CHECK(std::abs(found.keys[0].value - 0.35) < 1e-9);
  // Started where they meet.
  const Fit meeting = fit(two_blocks(0.32, 0.32), {"contacts.A.friction"}, data);
  CHECK(meeting.converged);
  CHECK(std::abs(meeting.keys[0].value - 0.35) < 1e-9);
  // With the contacts' names the first run has the wrong order, and says so.
  data.rows[0].contact = "B";
  CHECK_THROWS_WITH_AS(static_cast<void>(fit(two_blocks(0.3, 0.32), {"contacts.A.friction"}, data)),
                       doctest::Contains("event 1 of the run is slip of contact \"A\""), UsageError);
}

TEST_CASE("fit: started at the minimum it stays there") {
  const Fit events = fit(oscillator(), {"springs.1.stiffness"}, turns_of(1.0, 1e-4));
  CHECK(events.converged);
  CHECK(std::abs(events.keys[0].value - 100.0) < 1e-7);
  // times of turns are i pi sqrt(m/k), dt/dk = -t/(2 k): sigma = 1e-4 / sqrt(sum (t/(2 k))^2)
  double sum = 0.0;
  for (int i = 1; i <= 9; ++i) sum += std::pow(0.1 * std::acos(-1.0) * i / 200.0, 2);
  CHECK(events.keys[0].sigma == doctest::Approx(1e-4 / std::sqrt(sum)));
  CHECK(events.freedom == 8);
  CHECK(events.probability > 0.999);
  const Sensitivities own = sensitivities(oscillator(), {});
  Measurements columns;
  for (std::size_t i = 1; i < own.times.size(); ++i)
    columns.rows.push_back({0, "", own.columns[0], own.times[i], own.values[i][0], 1.0});
  const Fit exact = fit(oscillator(), {"springs.1.stiffness"}, columns);
  CHECK(exact.converged);
  CHECK(std::abs(exact.keys[0].value - 100.0) < 1e-7);
}

TEST_CASE("fit: keys that measurements do not determine are named and have no value") {
  // The times depend on k/m alone.
  const Fit both = fit(oscillator(), {"springs.1.stiffness", "masses.1.mass", "run.initial.block.ux"},
                       turns_of(1.01, 1e-4));
  CHECK_FALSE(both.converged);
  CHECK(std::isnan(both.keys[0].value));
  CHECK(std::isnan(both.keys[1].value));
  CHECK(doubted(both, "do not determine springs.1.stiffness, masses.1.mass and run.initial.block.ux"));
  const Fit one = fit(oscillator(), {"springs.1.stiffness", "run.initial.block.ux"}, turns_of(1.01, 1e-4));
  CHECK_FALSE(one.converged);
  CHECK(std::abs(one.keys[0].value - 102.01) < 1e-5);
  CHECK(std::isnan(one.keys[1].value));
  CHECK(doubted(one, "do not determine run.initial.block.ux"));
}

TEST_CASE("fit: what the run does not explain is no result") {
  Measurements data = turns_of(1.0, 1e-4);
  for (std::size_t i = 0; i < data.rows.size(); ++i) data.rows[i].value += (i % 2 == 0 ? 0.01 : -0.01);
  const Fit far = fit(oscillator(), {"springs.1.stiffness"}, data);
  CHECK_FALSE(far.converged);
  CHECK(doubted(far, "chi squared is "));
  CHECK(far.probability < 1e-6);
  data.has_sigma = false;  // then the scatter is what it is
  for (Measurement& m : data.rows) m.sigma = 1.0;
  CHECK(fit(oscillator(), {"springs.1.stiffness"}, data).converged);
  Measurements millimetres;
  const Sensitivities own = sensitivities(oscillator(), {});
  for (std::size_t i = 1; i < own.times.size(); ++i)
    millimetres.rows.push_back({0, "", own.columns[0], own.times[i], 1e3 * own.values[i][0], 1.0});
  const Fit unit = fit(oscillator(), {"springs.1.stiffness"}, millimetres);
  CHECK_FALSE(unit.converged);
  CHECK(doubted(unit, "of the measured numbers"));
}

TEST_CASE("fit: events are those that were measured, and other columns of their rows count") {
  Measurements data = turns_of(1.0, 1e-4);
  data.rows[1].type = "separation";
  CHECK_THROWS_WITH_AS(
      static_cast<void>(fit(oscillator(), {"springs.1.stiffness"}, data)),
      doctest::Contains("event 2 of the run is reversal of contact \"plate\" at t = 0.628318531, "
                        "but the measurements give separation"),
      UsageError);
  Measurements late = turns_of(1.0, 1e-4);
  late.rows[8].value *= 1000.0;
  CHECK_THROWS_WITH_AS(static_cast<void>(fit(oscillator(), {"springs.1.stiffness"}, late)),
                       doctest::Contains("expected a time of the run, which ends at run.t_end = 3 s"),
                       UsageError);
  // At t = 0.2 s the block is at 0.04 + 0.96 cos(2), as no friction of a plate makes the period another one.
  const auto path =
      written("both.csv",
              fmt::format("event_index,t,block.ux,contact,event\n1,{:.17g},,plate,reversal\n"
                          ",0.2,{:.17g},,\n2,{:.17g},{:.17g},plate,reversal\n",
                          0.1 * std::acos(-1.0), 0.04 + 0.96 * std::cos(2.0), 0.2 * std::acos(-1.0), 0.84));
  const Measurements both = read_measurements(path.string());
  std::filesystem::remove(path);
  REQUIRE(both.rows.size() == 4);
  CHECK(both.rows[1].column == "block.ux");
  CHECK(both.rows[3].column == "block.ux");
  const Fit found = fit(oscillator("1.02"), {"masses.1.mass"}, both);
  CHECK(found.converged);
  CHECK(std::abs(found.keys[0].value - 1.0) < 1e-7);
}

TEST_CASE("a key at its bound is named, and has no sigma") {
  // Swings that are greater than those without any friction.
  Measurements data;
  for (int i = 1; i < 9; ++i) data.rows.push_back({0, "", "d0.u", 1.0 * i, 1.06 * std::cos(2.0 * i), 1.0});
  const Fit found = fit(rubbed(), {"contacts.c.friction"}, data);
  CHECK_FALSE(found.converged);
  CHECK(found.reason.find("contacts.c.friction is at its bound: ") == 0);
  CHECK(found.keys[0].value < 1e-5);
  CHECK(std::isnan(found.keys[0].sigma));
}

TEST_CASE("measurements: a last line without its line break counts, a byte order mark does not") {
  const auto path = written("unended.csv",
                            "\xEF\xBB\xBF"
                            "t,d0.u\r\n1,0.5\r\n2,0.75");
  const Measurements data = read_measurements(path.string());
  std::filesystem::remove(path);
  REQUIRE(data.rows.size() == 2);
  CHECK(data.rows[1].t == 2.0);
  CHECK(data.rows[1].value == 0.75);
  CHECK(data.rows[1].line == 3);
}

TEST_CASE("tables that are no measurements, and measurements that the run has not") {
  const auto refused = [](const std::string& text, const std::string& said) {
    const auto path = written("bad.csv", text);
    std::string message;
    try {
      static_cast<void>(read_measurements(path.string()));
    } catch (const Error& error) {
      message = error.what();
      CHECK(error.code() == ExitCode::scene);
    }
    std::filesystem::remove(path);
    CAPTURE(message);
    CHECK(message.find(said) != std::string::npos);
  };
  refused("event_index,contact\n1,c\n", ":1: found the columns \"event_index,contact\", expected a column t");
  refused("event_index,t\n1,0.5\n0,0.6\n",
          ":3:1: event_index: found 0, expected the number of a row of events.csv (1, 2, ...)");
  refused("event_index,t\n1,soon\n", ":2:2: t: found \"soon\", expected a finite number");
  refused("t,d0.u,sigma\n1,0.5,-1\n", ":2:3: sigma: found -1, expected a number > 0");
  refused("t,d0.u\n", ":2: found no measurement, expected at least one row");
  refused("t,d0.u\n1,0.5\n2\n", ":3: found 1 cell, expected 2 cells, as many as in the header");
  refused("t,d0.u\n1,0.5,3\n", ":2: found 3 cells, expected 2 cells, as many as in the header");
  refused("t,d0.u\n1,0.5\n\n2,0.6\n", ":3: found a blank line, expected 2 cells, as many as in the header");
  refused("t,d0.u\n-0.1,0.5\n", ":2:1: t: found -0.1, expected a time >= 0; the run starts at t = 0");
  refused("event_index,t\n1,-0.1\n", ":2:2: t: found -0.1, expected a time >= 0; the run starts at t = 0");
  refused("event_index,t\n1,0.5\n2,0.6\n1,0.5\n",
          ":4: event_index: found 1 again, expected each event once; line 2 has the same event");
  refused("t,d0.u\n1,0.5\n1,0.6\n",
          ":3: d0.u: found t = 1 again, expected each time once; line 2 has the same time");
  refused(std::string("\x01\xFF\x13", 3), ":1: found the columns ");
  Measurements data;
  data.rows.push_back({0, "", "d9.u", 1.0, 0.0, 1.0});
  CHECK_THROWS_WITH_AS(fit(rubbed(), {"contacts.c.friction"}, data), "the run has no column \"d9.u\"",
                       UsageError);
  data.rows[0] = {99, "c", "", 0.0, 1.0, 1.0};
  CHECK_THROWS_AS(fit(rubbed(), {"contacts.c.friction"}, data), UsageError);
  CHECK_THROWS_AS(fit(rubbed(), {"contacts.c.friction", "run.initial.u.1"}, data), UsageError);
}
