// A load that no scene file can say: a sweep through frequencies that breaks off at t = 2.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>
#include <signorini/smooth.hpp>

int main() {
  auto scene = signorini::read_scene("models/belt.toml", {{"run.t_end", "4"}, {"run.rtol", "1e-9"}});
  signorini::LoadSpec load;
  load.direction = {"block", {1.0, 0.0}, {}, {}};
  load.amplitude = 2.0;
  load.history.in_code = signorini::History(
      {2.0}, {signorini::Piece::of(signorini::smooth([](auto t) { return sin(3.0 * t * t); })), {}});
  scene.loads.push_back(load);
  double last[2];
  for (const auto engine : {signorini::Engine::ida, signorini::Engine::newmark}) {
    scene.run.engine = engine;
    scene.run.dt = 1e-4;
    const auto result = signorini::simulate(signorini::build_model(scene), scene.run);
    last[engine == signorini::Engine::newmark] = result.rows.back().u[0];
    std::printf("%s: %zu events, %.7f at the end\n",
                scene.run.engine == signorini::Engine::ida ? "ida" : "newmark", result.events.size(),
                result.rows.back().u[0]);
  }
  return std::abs(last[0] - last[1]) < 1e-6 ? 0 : 1;
}
