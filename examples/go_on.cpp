// Goes on from the last state of a run: displacements, velocities, shears of contacts.
#include <cmath>
#include <cstdio>
#include <signorini/simulate.hpp>

int main() {
  auto scene = signorini::read_scene("models/belt.toml", {{"run.t_end", "10"}, {"run.engine", "exact"}});
  const auto model = signorini::build_model(scene);
  const auto first = signorini::simulate(model, scene.run);
  const auto& last = first.rows.back();

  signorini::SavedState state;
  for (int i = 0; i < model.size(); ++i) {
    const auto& dof = model.dofs[static_cast<std::size_t>(i)];
    state.motions.emplace_back(dof.displacement, last.u[i]);
    state.motions.emplace_back(dof.velocity, last.v[i]);
  }
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    state.shears.emplace_back(model.contacts[k].name, last.contacts[k].T);
  scene.initial = {};
  scene.initial.saved = state;
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
