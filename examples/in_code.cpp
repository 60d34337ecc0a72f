// A scene made in code, and results without files: a block on a plate, pushed for half a second.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  using namespace signorini;
  Scene scene;
  scene.units = {"N", "kg", "m", "s"};
  scene.run = {.t_end = 3.0, .engine = Engine::exact};
  scene.nodes = {{.name = "block"}};
  scene.masses = {{.node = "block", .mass = 1.0}};
  scene.supports = {{.node = "block", .uy = true}};
  const Direction along{.node = "block", .vector = {1.0, 0.0}};
  scene.contacts = {{.name = "plate", .law = Law::slider, .tangent = along, .friction = {0.3, 0.3}}};
  scene.contacts[0].normal_force.amplitude = 10.0;
  scene.loads = {{.direction = along, .history = {.type = HistoryType::rectangle, .end = 0.5}}};
  for (const double push : {4.0, 6.0, 8.0}) {
    scene.loads[0].amplitude = push;
    const double way = simulate(scene).rows.back().u[0];
    const double a = push - 3.0, v = 0.5 * a, by_hand = 0.25 * v + v * v / 6.0;
    std::printf("%g N: %.9f m, by hand %.9f m\n", push, way, by_hand);
    if (std::abs(way - by_hand) > 1e-12) return 1;
  }
}
