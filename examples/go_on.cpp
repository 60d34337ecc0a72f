// Goes on from the last state of a run: displacements, velocities, shears and memories of contacts.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  auto scene = signorini::read_scene("models/belt.toml", {{"run.t_end", "10"}, {"run.engine", "exact"}});
  const auto model = build_model(scene);
  const auto first = simulate(model, scene.run);
  scene.initial = {.saved = last_state(model, first)};
  const auto second = simulate(scene);

  const auto whole =
      simulate(signorini::read_scene("models/belt.toml", {{"run.t_end", "20"}, {"run.engine", "exact"}}));
  const double gone_on = 10.0 + second.events.back().t, at_once = whole.events.back().t;
  std::printf("the last event at %.12f s, or in one run %.12f s\n", gone_on, at_once);
  const bool same = first.events.size() + second.events.size() == whole.events.size();
  return same && std::abs(gone_on - at_once) < 1e-9 ? 0 : 1;
}
