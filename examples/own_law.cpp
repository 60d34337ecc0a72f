// A law of one's own: a pad that is elastic up to its strength Y, is crushed there and keeps its dent p.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  using namespace signorini;
  using enum State;
  const double kn = 1e4, Y = 150.0;
  const UserLawForm none{{.N = 1.0}}, elastic{{.N = 1.0, .gap = -kn}, kn}, crushed{{.N = 1.0, .constant = Y}};
  const UserLawForm smooth{{.T = 1.0}};
  auto pad = std::make_shared<UserContactLaw>();
  pad->states = {
      {"off", open, none, smooth, {{{{.gap = 1.0}, -1.0}, 1}}},             // g - p falls: on
      {"on", closed, elastic, smooth, {{{{.N = -1.0}}, 0}, {crushed, 2}}},  // N = 0: off; N = -Y: crushed
      {"crushed",
       slip_minus,
       crushed,
       smooth,  // comes back: p = g + Y/kn, and on
       {{{{.vn = -1.0}}, 1, Form{.gap = 1.0, .constant = Y / kn}}}}};
  Scene scene = read_scene("examples/pad.toml");  // a ball falls on a pad
  scene.contacts[0].user_law = pad;
  const Result result = simulate(scene);
  for (const Event& e : result.events)
    std::printf("%.9f  %s -> %s\n", e.t, to_string(e.from), to_string(e.to));
  // m v^2 / 2 = Y^2 / 2 kn + Y |dent|; what the spring gives back is the speed of the rebound
  const double back = std::sqrt(Y * Y / kn / 2.0), v = result.rows.back().v[0];
  std::printf("rebound %.9f m/s, by hand %.9f\n", v, back);
  return result.events.size() == 4 && std::abs(v - back) < 1e-7 ? 0 : 1;
}
