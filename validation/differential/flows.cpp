#include "differential/flows.hpp"

#include <algorithm>
#include <cmath>

#include "run/choose_engine.hpp"
#include "signorini/error.hpp"

namespace signorini::differential {
namespace {

/// A jump of the same size, at the same time.
void make_still(HistorySpec& history) {
  if (history.type == HistoryType::constant || history.type == HistoryType::step ||
      history.type == HistoryType::rectangle)
    return;
  HistorySpec still;
  still.type = std::isfinite(history.end) ? HistoryType::rectangle : HistoryType::step;
  still.offset = history.offset;
  still.amplitude = history.amplitude;
  still.start = history.start;
  still.end = history.end;
  still.place = history.place;
  history = still;
}

void make_linear(ContactSpec& contact, double stiffness) {
  if (contact.capabilities().takes_impulses) {
    contact.law = Law::compliant;
    contact.normal_stiffness = stiffness;
    contact.restitution = 0.0;
    contact.capture_velocity.reset();
  }
  if (contact.friction.any() && !contact.tangential_stiffness) contact.tangential_stiffness = 0.5 * stiffness;
  contact.normal_damping = contact.tangential_damping = 0.0;
  contact.friction.stribeck_velocity.reset();
  make_still(contact.normal_force);
  contact.surface_velocity = HistorySpec{};
  contact.surface_velocity.amplitude = 0.0;
}

bool modes_take(const Scene& scene) {
  try {
    RunSpec modal = scene.run;
    modal.flow = Flow::modal;
    (void)run::choose_flow(build_model(scene), modal);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace

std::optional<Scene> for_both_flows(Scene scene) {
  scene.run.engine = Engine::exact;
  scene.run.flow = Flow::taylor;
  scene.reduction.reset();
  for (ContactSpec& contact : scene.contacts) {
    contact.tangential_damping = 0.0;
    contact.friction.stribeck_velocity.reset();
  }
  if (modes_take(scene)) return scene;
  scene.damping.beta = 0.0;
  if (!(scene.damping.alpha > 0.0)) scene.damping.alpha = 1.0 / scene.run.t_end;
  if (scene.matrices) {
    scene.matrices->damping.entries.clear();
    for (const MatrixSpec::Entry& entry : scene.matrices->mass.entries)
      scene.matrices->damping.entries.push_back({entry.row, entry.column, scene.damping.alpha * entry.value});
    scene.matrices->damping.size = scene.matrices->mass.size;
    scene.damping = {};
  }
  for (Spring& spring : scene.springs) spring.damping = 0.0;
  for (LoadSpec& load : scene.loads) make_still(load.history);
  for (BaseMotionSpec& motion : scene.base_motion) make_still(motion.acceleration);
  double stiffness = 1.0;
  for (const Spring& spring : scene.springs) stiffness = std::max(stiffness, spring.stiffness);
  for (ContactSpec& contact : scene.contacts) stiffness = std::max(stiffness, contact.normal_stiffness);
  for (ContactSpec& contact : scene.contacts) make_linear(contact, stiffness);
  if (!modes_take(scene)) return std::nullopt;
  return scene;
}

Transformed in_modes(const Scene& scene) {
  Transformed other{"in modes", scene, {}, false};
  other.scene.run.flow = Flow::modal;
  return other;
}

}  // namespace signorini::differential
