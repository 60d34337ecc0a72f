// Goes on from the last state of a run: displacements, velocities, shears of contacts.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  auto scene = signorini::read_scene("models/belt.toml", {{"run.t_end", "10"}, {"run.engine", "exact"}});
  const auto model = signorini::build_model(scene);
  const auto first = signorini::simulate(model, scene.run);
  scene.initial = {};
  scene.initial.saved = signorini::last_state(model, first);
  const auto second = signorini::simulate(signorini::build_model(scene), scene.run);

  const auto whole_scene =
      signorini::read_scene("models/belt.toml", {{"run.t_end", "20"}, {"run.engine", "exact"}});
  const auto whole = signorini::simulate(signorini::build_model(whole_scene), whole_scene.run);
  std::printf("%zu and %zu events, of %zu\n", first.events.size(), second.events.size(), whole.events.size());
  const double gone_on = 10.0 + second.events.back().t, at_once = whole.events.back().t;
  std::printf("the last one at %.12f, or %.12f\n", gone_on, at_once);
  return first.events.size() + second.events.size() == whole.events.size() &&
                 std::abs(gone_on - at_once) < 1e-9
             ? 0
             : 1;
}
