// A scene made in code, and results without files.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>
#include <string>

int main() {
  for (const double push : {4.0, 6.0, 8.0}) {
    const auto scene = signorini::parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 3.0, engine = "exact" }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 1.0 }]
supports = [{ node = "block", fix = ["uy"] }]
contacts = [{ node = "block", law = "slider", tangent = [1.0, 0.0], normal_force = 10.0, friction = 0.3 }]
loads = [{ node = "block", direction = [1.0, 0.0], amplitude = )" +
                                                  std::to_string(push) +
                                                  R"(, history = { type = "rectangle", end = 0.5 } }])",
                                              "in code");
    const auto result = signorini::simulate(signorini::build_model(scene), scene.run);
    const double a = push - 3.0, v = 0.5 * a, by_hand = 0.25 * v + v * v / 6.0;
    std::printf("%g N: %.9f m, by hand %.9f m\n", push, result.rows.back().u[0], by_hand);
    if (std::abs(result.rows.back().u[0] - by_hand) > 1e-12) return 1;
  }
  return 0;
}
