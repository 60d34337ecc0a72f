// Looks at the motion at every step, and lets go of a load as soon as the block has moved by 5 mm.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

struct Hand : signorini::Result {
  double released = 0.0;
  bool steers() const override { return true; }
  bool steer(const signorini::Sample& now, signorini::Steering& run) override {
    if (released > 0.0 || (*now.u)[0] < 5e-3) return true;  // false would end the run
    run.set_load("push", signorini::History::constant(0.0));
    released = now.t;
    return true;
  }
};

int main() {
  Hand hand;
  simulate(signorini::read_scene("examples/push.toml"), hand);
  // 6 N against 3 N of friction on 1 kg, then friction alone
  const double v = 3.0 * hand.released, by_hand = 0.5 * v * hand.released + v * v / 6.0;
  const double rests = hand.rows.back().u[0];
  std::printf("released at %.6f s, at rest at %.9f m, by hand %.9f m\n", hand.released, rests, by_hand);
  return hand.released > 0.0 && std::abs(rests - by_hand) < 1e-9 ? 0 : 1;
}
