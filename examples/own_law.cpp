// A law of one's own: a pad that is elastic up to its strength Y, is crushed there and keeps its dent p.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  auto scene = signorini::parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 0.25, engine = "ida", rtol = 1e-10, initial = { ball = { vy = -3.0 } } }
nodes = { ball = [0.0, 0.0] }
masses = [{ node = "ball", mass = 2.0 }]
supports = [{ node = "ball", fix = ["ux"] }]
contacts = [{ name = "pad", node = "ball", law = "compliant", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4 }]
)",
                                      "in code");
  using enum signorini::State;
  const double kn = 1e4, Y = 150.0;
  auto pad = std::make_shared<signorini::OwnLaw>();
  const signorini::OwnForm elastic{{.N = 1.0, .gap = -kn}, kn}, free{{.N = 1.0}}, smooth{{.T = 1.0}};
  pad->states = {
      {"off", open, free, smooth, {{{{.gap = 1.0}, -1.0}, 1}}},  // g - p falls: on
      {"on",
       closed,
       elastic,
       smooth,
       {{{{.N = -1.0}}, 0},                  // -N falls: off
        {{{.N = 1.0, .constant = Y}}, 2}}},  // N + Y falls: crushed
      {"crushed",
       slip_minus,
       {{.N = 1.0, .constant = Y}},
       smooth,
       {{{{.vn = -1.0}}, 1, signorini::Form{.gap = 1.0, .constant = Y / kn}}}},  // comes back: p = g + Y/kn
  };
  scene.contacts[0].own = pad;
  const auto result = signorini::simulate(signorini::build_model(scene), scene.run);
  for (const auto& e : result.events)
    std::printf("%.9f  %s -> %s\n", e.t, signorini::to_string(e.from), signorini::to_string(e.to));
  // m v^2 / 2 = Y^2 / 2 kn + Y |dent|; what the spring gives back is the speed of the rebound
  const double back = std::sqrt(Y * Y / kn / 2.0), v = result.rows.back().v[0];
  std::printf("rebound %.9f m/s, by hand %.9f\n", v, back);
  return result.events.size() == 4 && std::abs(v - back) < 1e-7 ? 0 : 1;
}
