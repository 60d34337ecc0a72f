// Looks at the motion at every step, and lets go of a load as soon as the block has moved by 5 mm.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

struct Hand : signorini::Result {
  double released = 0.0;
  bool steers() const override { return true; }
  bool steer(const signorini::Sample& now, signorini::Steering& run) override {
    if (released == 0.0 && (*now.u)[0] > 5e-3) {
      run.set_load("push", signorini::History::constant(0.0));
      released = now.t;
    }
    return true;  // false would end the run
  }
};

int main() {
  const auto scene = signorini::parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 3.0, engine = "ida", rtol = 1e-10 }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 1.0 }]
supports = [{ node = "block", fix = ["uy"] }]
contacts = [{ node = "block", law = "slider", tangent = [1.0, 0.0], normal_force = 10.0, friction = 0.3 }]
loads = [{ name = "push", node = "block", direction = [1.0, 0.0], amplitude = 6.0 }]
)",
                                            "in code");
  Hand hand;
  static_cast<void>(signorini::simulate(signorini::build_model(scene), scene.run, hand));
  const double v = 3.0 * hand.released, by_hand = 0.5 * v * hand.released + v * v / 6.0;
  std::printf("released at %.6f s, at rest at %.9f m, by hand %.9f m\n", hand.released, hand.rows.back().u[0],
              by_hand);
  return hand.released > 0.0 && std::abs(hand.rows.back().u[0] - by_hand) < 1e-9 ? 0 : 1;
}
