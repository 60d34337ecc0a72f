// Keys that are found again from what a run with other values gave.
#include "signorini/fit.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "behaviour/one_mass.hpp"

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
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("signorini-fit-" + name);
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
  refused("event_index,contact\n1,c\n", ":1: expected a column t");
  refused("event_index,t\n1,0.5\n0,0.6\n", ":3: event_index: found 0, expected a row of events.csv, from 1");
  refused("event_index,t\n1,soon\n", ":2: t: found \"soon\", expected a finite number");
  refused("t,d0.u,sigma\n1,0.5,-1\n", ":2: sigma: found -1, expected more than zero");
  refused("t,d0.u\n", ":2: expected at least one row");
  Measurements data;
  data.rows.push_back({0, "", "d9.u", 1.0, 0.0, 1.0});
  CHECK_THROWS_WITH_AS(fit(rubbed(), {"contacts.c.friction"}, data), "the run has no column \"d9.u\"",
                       UsageError);
  data.rows[0] = {99, "c", "", 0.0, 1.0, 1.0};
  CHECK_THROWS_AS(fit(rubbed(), {"contacts.c.friction"}, data), UsageError);
  CHECK_THROWS_AS(fit(rubbed(), {"contacts.c.friction", "run.initial.u.1"}, data), UsageError);
}
