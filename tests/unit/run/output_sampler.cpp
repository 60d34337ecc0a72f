#include "run/output_sampler.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Times : Recorder {
  void event(const Event&) override {}
  void sample(const Sample& s) override { rows.push_back(s.t); }
  void frame(const Sample& s) override { frames.push_back(s.t); }
  std::vector<double> rows, frames;
};

Scene falling_mass() {
  return parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
output_dt = 0.25
frames = [0.3, 0.5]
[nodes]
m = [0.0, 0.0]
[[masses]]
node = "m"
mass = 1.0
)",
                     "test.toml");
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/output_sampler");

TEST_CASE("samples: rows and frames come in the order of time, both at once where they coincide") {
  const Scene scene = falling_mass();
  const Model model = build_model(scene);
  const linear::SystemMatrices structure(model);
  run::Auditor auditor(model, structure);
  Times times;
  run::OutputSampler samples(model, scene.run, auditor, times);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  const motion::Point point{model.u0, model.v0, Vector(), Vector::Zero(model.size())};
  std::vector<double> asked;
  while (samples.next() < std::numeric_limits<double>::infinity()) {
    asked.push_back(samples.next());
    samples.emit(asked.back(), motion::WorkIntegrals(), forcing, {}, point);
  }
  CHECK(asked == std::vector<double>{0.0, 0.25, 0.3, 0.5, 0.75, 1.0});
  CHECK(times.rows == std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0});
  CHECK(times.frames == std::vector<double>{0.3, 0.5});
}

TEST_SUITE_END();
