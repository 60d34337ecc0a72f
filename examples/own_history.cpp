// A load that no scene file can say: a sweep through frequencies that breaks off at t = 2.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>
#include <signorini/smooth.hpp>

int main() {
  using namespace signorini;
  Scene scene =
      read_scene("models/belt.toml", {{"run.t_end", "4"}, {"run.rtol", "1e-9"}, {"run.dt", "1e-4"}});
  const Piece sweep = Piece::of(smooth([](auto t) { return sin(3.0 * t * t); }));
  LoadSpec load{.direction = {.node = "block", .vector = {1.0, 0.0}}, .amplitude = 2.0};
  load.history.in_code = History({2.0}, {sweep, Piece{}});  // from 2 s on nothing
  scene.loads.push_back(load);
  const Result ida = simulate(scene);
  scene.run.engine = Engine::newmark;
  const Result newmark = simulate(scene);
  const double a = ida.rows.back().u[0], b = newmark.rows.back().u[0];
  std::printf("%zu events, %.7f m at the end; newmark: %.7f m\n", ida.events.size(), a, b);
  return std::abs(a - b) < 1e-6 ? 0 : 1;
}
