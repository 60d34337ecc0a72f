#include "model/frictional_start.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/suggest.hpp"
#include "contact/friction.hpp"
#include "model/geometric_start.hpp"
#include "model/statics/frictional.hpp"

namespace signorini {
namespace {

/// Name in stages for all loads of a kind.
std::string word_of(LoadKind kind) {
  switch (kind) {
    case LoadKind::temperature:
      return "temperature";
    case LoadKind::initial_strain:
      return "initial strain";
    case LoadKind::preload:
      return "preload";
    case LoadKind::support:
      return "supports";
    case LoadKind::base:
      return "base motion";
    case LoadKind::force:
    case LoadKind::moment:
    case LoadKind::distributed:
    case LoadKind::weight:
    case LoadKind::support_rate:
      break;
  }
  return "";
}

[[noreturn]] void refuse_name(const StageSpec& spec, std::size_t index, const std::string& key,
                              const Model& model) {
  const std::string& name = spec.loads[index];
  std::vector<std::string> names;
  for (const Load& load : model.loads)
    for (const std::string& known : {word_of(load.kind), load.name})
      if (!known.empty() && std::find(names.begin(), names.end(), known) == names.end())
        names.push_back(known);
  throw SceneError(spec.load_places[index], key,
                   fmt::format("no load is called \"{}\"{}", name, suggestion(name, names)));
}

/// True for a kind of load whose values are all zero, as an override may set them: the stage then changes nothing.
bool is_zero_kind(const Scene& scene, const std::string& name) {
  const auto expands = [](const auto& part) { return part.thermal_expansion != 0.0; };
  if (name == word_of(LoadKind::temperature))
    return std::any_of(scene.members.begin(), scene.members.end(), expands) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(), expands);
  if (name == word_of(LoadKind::preload)) return !scene.springs.empty();
  return name == word_of(LoadKind::base) && !scene.base_motion.empty();
}

/// True if the stage's name refers to the load, by its own name or by its kind.
bool is_called(const Load& load, const std::string& name) {
  return name == load.name || name == word_of(load.kind);
}

/// Adds up the loads of one stage, and counts how often each load was taken.
Stage made(const Scene& scene, std::size_t number, const Model& model, std::vector<int>& taken) {
  const StageSpec& spec = scene.initial.stages[number - 1];
  const std::string key = fmt::format("run.stages.{}.loads", number);
  Stage stage{spec.name, Vector::Zero(model.size()), spec.steps};
  for (std::size_t j = 0; j < spec.loads.size(); ++j) {
    bool any = false;
    for (std::size_t i = 0; i < model.loads.size(); ++i) {
      const Load& load = model.loads[i];
      if (!is_called(load, spec.loads[j])) continue;
      any = true;
      if (++taken[i] > 1)
        throw SceneError(
            spec.load_places[j], key,
            fmt::format("\"{}\" is already in an earlier stage; list each load in one stage only",
                        load.name));
      load.direction.add_to(stage.load, load.history.value(0.0));
    }
    if (!any && !is_zero_kind(scene, spec.loads[j])) refuse_name(spec, j, key, model);
  }
  return stage;
}

/// acts: loads that act in some stage.
std::vector<Stage> stages_of(const Scene& scene, const Model& model, std::vector<bool>& acts) {
  std::vector<Stage> stages;
  if (scene.initial.stages.empty()) {
    Stage all{"loads", Vector::Zero(model.size()), 1};
    for (const Load& load : model.loads) {
      acts.push_back(load.is_static);
      if (load.is_static) load.direction.add_to(all.load, load.history.value(0.0));
    }
    return {all};
  }
  std::vector<int> taken(model.loads.size(), 0);
  for (std::size_t i = 0; i < scene.initial.stages.size(); ++i)
    stages.push_back(made(scene, i + 1, model, taken));
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (load.is_static && taken[i] == 0 && load.history.value(0.0) != 0.0)
      throw SceneError(
          scene.initial.stages.front().place, "run.stages",
          fmt::format("\"{}\" acts from the beginning but is in no stage; add it to the loads of a stage",
                      load.name));
    acts.push_back(taken[i] > 0);
  }
  return stages;
}

/// True if a load of the stage is not zero; even on fixed degrees of freedom it then compresses members and bodies.
bool presses(const StageSpec& spec, const Model& model) {
  return std::any_of(model.loads.begin(), model.loads.end(), [&](const Load& load) {
    return load.history.value(0.0) != 0.0 &&
           std::any_of(spec.loads.begin(), spec.loads.end(),
                       [&](const std::string& name) { return is_called(load, name); });
  });
}

}  // namespace

void start_with_friction(const Scene& scene, DofMap& map, Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].friction.by_force())
      throw SceneError(scene.contacts[k].place, scene.contacts[k].key("friction"),
                       "initial = \"frictional\" does not know friction that depends on the normal force; "
                       "use one coefficient, "
                       "or initial = \"static\"");
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].initial_shear != 0.0)
      throw SceneError(scene.contacts[k].place, scene.contacts[k].key("initial_shear"),
                       "has no meaning beside initial = \"frictional\", which finds it");
  std::vector<bool> acts;
  const std::vector<Stage> stages = stages_of(scene, model, acts);
  FrictionalEquilibrium found =
      frictional_equilibrium(model.stiffness, model.contacts, stages, map, scene.initial.place);
  if (scene.run.geometric) found = stiffened_end(scene, acts, std::move(found), map, model);
  for (std::size_t i = 0; i < scene.initial.stages.size(); ++i)
    if (stages[i].load.isZero(0.0) && !(scene.run.geometric && presses(scene.initial.stages[i], model)))
      found.start.doubts.push_back(
          fmt::format("stage '{}' loads nothing: what it names is zero at t = 0", stages[i].name));
  model.u0 = std::move(found.u);
  model.v0 = Vector::Zero(model.size());
  model.static_start = true;
  model.statics = std::move(found.start);
  model.warnings.insert(model.warnings.end(), model.statics.doubts.begin(), model.statics.doubts.end());
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& c = model.contacts[k];
    if (!c.tangential_stiffness || !c.has_friction()) continue;
    // The run computes N anew: the shear stays within its limit to the last digit.
    const double N = c.resting_force(model.u0).value_or(-model.statics.reactions[k]);
    const double limit = sticking_limit(c, N);
    c.initial_shear = std::clamp(found.shears[k], -limit, limit);
  }
}

}  // namespace signorini
