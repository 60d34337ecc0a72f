#include "model/initial_state.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "contact/curved_surface.hpp"
#include "contact/friction.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/moving_obstacles.hpp"
#include "model/assembly/springs.hpp"
#include "model/p_delta.hpp"
#include "model/statics/frictional.hpp"
#include "scene/components.hpp"
#include "scene/saved_state.hpp"
#include "signorini/error.hpp"

namespace signorini::model {
namespace {

Vector given_vector(const std::vector<double>& values, int n, const InitialSpec& spec, const char* key) {
  if (values.empty()) return Vector::Zero(n);
  if (static_cast<int>(values.size()) != n)
    throw SceneError(spec.place, key,
                     fmt::format("found {}, expected {}, one for each degree of freedom",
                                 base::count_text(values.size(), "number"), n));
  return Eigen::Map<const Vector>(values.data(), n);
}

[[noreturn]] void refuse_saved(const InitialSpec& spec, const std::string& why) {
  throw SceneError(spec.place, "run.initial.run", why + ": expected a run of the same structure");
}

/// Errors: SceneError if the saved run and the scene do not have the same contacts with friction.
void check_saved_contacts(const Scene& scene) {
  std::unordered_set<std::string> contacts, saved;
  for (const auto& [name, T] : scene.initial.saved->shears) saved.insert(name);
  for (const ContactSpec& contact : scene.contacts) {
    contacts.insert(contact.name);
    if (contact.friction.any() && !saved.contains(contact.name))
      refuse_saved(scene.initial, fmt::format("the saved state has no shear of contact '{}'", contact.name));
    if (contact.friction.any() && contact.tangential_damping > 0.0 &&
        !scene::saved_motion(*scene.initial.saved, contact.name + ".slip"))
      refuse_saved(scene.initial, fmt::format("the saved state has no {}.slip, which a contact with "
                                              "tangential_damping needs",
                                              contact.name));
  }
  for (const auto& [name, T] : scene.initial.saved->shears)
    if (!contacts.contains(name))
      refuse_saved(scene.initial,
                   fmt::format("the saved state has contact '{}', but the scene does not", name));
  for (const SavedState::UserLawMemory& own : scene.initial.saved->user_law_states) {
    const auto same = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                                   [&](const ContactSpec& contact) { return contact.name == own.contact; });
    if (same == scene.contacts.end() || own.state >= same->contact_law()->user_law_states().size())
      refuse_saved(scene.initial, fmt::format("the saved state has contact '{}' in state {} of a "
                                              "user-defined law, but the scene has no such contact or state",
                                              own.contact, own.state));
  }
}

std::string key_of(const InitialSpec::Component& c) {
  return fmt::format("run.initial.{}.{}", c.node, c.component);
}

/// Final state of the previous run: values of the degrees of freedom with the same names.
InitialState saved_state(const Scene& scene, const assembly::DofMap& map) {
  const InitialSpec& spec = scene.initial;
  InitialState state{Vector::Zero(map.size()), Vector::Zero(map.size())};
  std::unordered_map<std::string, double> values;
  for (const auto& [name, value] : spec.saved->motions) values.emplace(name, value);
  const auto value_of = [&](const std::string& name) {
    const auto found = values.find(name);
    if (found == values.end()) refuse_saved(spec, fmt::format("the saved state has no {}", name));
    const double value = found->second;
    values.erase(found);
    return value;
  };
  check_saved_contacts(scene);
  values.erase(scene::saved_alpha);
  for (int i = 0; i < map.size(); ++i) {
    state.u[i] = value_of(map.dofs[static_cast<std::size_t>(i)].displacement);
    state.v[i] = value_of(map.dofs[static_cast<std::size_t>(i)].velocity);
  }
  for (const assembly::TiedDof& tied : map.tied) {  // tied motions follow from degrees of freedom
    values.erase(tied.dof.displacement);
    values.erase(tied.dof.velocity);
  }
  // Saved values of sliding points and surfaces are used by contacts, not by degrees of freedom.
  for (const ContactSpec& contact : scene.contacts)
    for (const char* of : {".slip", ".slip_rate", ".surface"}) values.erase(contact.name + of);
  for (const auto& [name, value] : spec.saved->motions)
    if (values.contains(name) && !name.starts_with("support "))
      refuse_saved(spec, fmt::format("the saved state has {}, but the scene does not", name));
  return state;
}

/// Place of a given initial value in u or v.
struct GivenPlace {
  bool velocity = false;
  int dof = 0;
};
/// Names, for messages, of the displacements or rates that determine the tied motion `tied`; empty if only supports do.
std::string determining_dofs(const assembly::DofMap& map, int tied, bool rates) {
  std::vector<std::string> names;
  for (const assembly::TiedTerm& term : map.terms(tied))
    if (term.number >= 0) {
      const Dof& dof = map.dofs[static_cast<std::size_t>(term.number)];
      names.push_back(rates ? dof.velocity : dof.displacement);
    }
  return base::join_quoted(names, 3);
}

/// Place in u or v of a given component; nullopt if it is fixed, or tied at a seam, so that the given value has no effect.
std::optional<GivenPlace> place_of(const InitialSpec::Component& c, const assembly::DofMap& map) {
  const std::string key = key_of(c);
  const auto named = scene::component_named(c.component);
  if (!named || named->name() != c.component)
    throw SceneError(c.place, key, fmt::format("found '{}', expected ux, uy, rz, vx, vy or wz", c.component));
  const int node = element::find_node(map.mesh, c.node, c.place, key);
  const int number = map.number[static_cast<std::size_t>(node)][named->index];
  if (const int own = map.own_number(node, named->index); own >= 0) return GivenPlace{named->rate, own};
  if (number == assembly::DofMap::absent)
    throw SceneError(
        c.place, key,
        fmt::format("node '{}' has no degree of freedom for {}; remove this value", c.node, c.component));
  if (number == assembly::DofMap::fixed && c.value != 0.0)
    throw SceneError(c.place, key,
                     fmt::format("found {}, expected 0: a support fixes this component", c.value));
  if (map.is_tied(number) && map.body[static_cast<std::size_t>(node)] < 0)
    return std::nullopt;  // a node of a seam: other nodes determine its motion
  if (map.is_tied(number)) {
    const std::string names = determining_dofs(map, number, named->rate);
    throw SceneError(
        c.place, key,
        fmt::format("node '{}' is part of a rigid body, so its motion follows from {}; {}", c.node,
                    names.empty() ? "the supports of this body" : "the motion of this body",
                    names.empty() ? "remove this value" : "give " + names + " instead"));
  }
  if (number < 0) return std::nullopt;
  return GivenPlace{named->rate, number};
}

/// True for each degree of freedom whose initial displacement affects the motion, by a damper, or by the
/// dashpot or friction of a contact.
std::vector<bool> initial_displacement_matters(const Model& model) {
  std::vector<bool> result(static_cast<std::size_t>(model.size()), false);
  for (int k = 0; k < model.damping.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(model.damping, k); it; ++it)
      if (it.value() != 0.0) result[static_cast<std::size_t>(it.row())] = true;
  for (const Contact& contact : model.contacts) {
    if (contact.normal_damping != 0.0 || !contact.obeys_coulomb())
      for (const auto& term : contact.normal.terms) result[static_cast<std::size_t>(term.first)] = true;
    if (contact.has_friction() || !contact.obeys_coulomb())
      for (const auto& term : contact.tangent.terms) result[static_cast<std::size_t>(term.first)] = true;
  }
  return result;
}

/// Warning about an initial value of a degree of freedom without mass.
std::string unused(const Model& model, const GivenPlace& at, double value, const SourcePlace& place,
                   const std::string& key) {
  const Dof& dof = model.dofs[static_cast<std::size_t>(at.dof)];
  const double unit = (dof.rotation ? 1.0 : model.unit.length) / (at.velocity ? model.unit.time : 1.0);
  const std::string what =
      at.velocity ? fmt::format("{} has no mass, so its velocity follows from the forces", dof.displacement)
                  : fmt::format("{} has no mass and no damper, so it follows the forces immediately",
                                dof.displacement);
  return SceneError(place, key,
                    fmt::format("the initial value {:.9g} is ignored: {}; give this degree of freedom a "
                                "mass{}, or remove the value",
                                value * unit, what, at.velocity ? "" : " or a damper"))
      .what();
}

}  // namespace

std::vector<std::string> unused_values(const Scene& scene, const assembly::DofMap& map, const Model& model) {
  const InitialSpec& spec = scene.initial;
  if (spec.saved || scene.reduction) return {};
  const std::vector<bool> begins = initial_displacement_matters(model);
  std::vector<std::string> result;
  const auto check = [&](const GivenPlace& at, double value, const SourcePlace& place,
                         const std::string& key) {
    const auto dof = static_cast<std::size_t>(at.dof);
    if (value == 0.0 || !model.dofs[dof].massless || (!at.velocity && begins[dof])) return;
    result.push_back(unused(model, at, value, place, key));
  };
  for (const auto& c : spec.components)
    if (const auto at = place_of(c, map)) check(*at, c.value, c.place, key_of(c));
  for (std::size_t i = 0; i < spec.u.size(); ++i)
    check({false, static_cast<int>(i)}, spec.u[i], spec.place, fmt::format("run.initial.u[{}]", i));
  for (std::size_t i = 0; i < spec.v.size(); ++i)
    check({true, static_cast<int>(i)}, spec.v[i], spec.place, fmt::format("run.initial.v[{}]", i));
  return result;
}

namespace {

/// Initial values of nodes are absolute; degrees of freedom relative to a moving obstacle are w = u - s.
void subtract_obstacles(const Scene& scene, const assembly::DofMap& map, InitialState& state) {
  for (const assembly::RelativeMotion& motion : assembly::relative_motions(map))
    for (const assembly::TiedTerm& term : motion.obstacle) {
      const History s =
          assembly::motion_of_support(scene, map, assembly::DofMap::support_of_code(term.number));
      state.u[motion.dof] -= term.factor * s.piece(0.0).value(0.0, 0);
      state.v[motion.dof] -= term.factor * s.piece(0.0).value(0.0, 1);
    }
}

}  // namespace

InitialState given_state(const Scene& scene, const assembly::DofMap& map) {
  const InitialSpec& spec = scene.initial;
  const int n = map.size();
  if (spec.saved) return saved_state(scene, map);
  if (map.is_matrix_scene())
    return {given_vector(spec.u, n, spec, "run.initial.u"), given_vector(spec.v, n, spec, "run.initial.v")};
  InitialState state{Vector::Zero(n), Vector::Zero(n)};
  for (const auto& c : spec.components)
    if (const auto at = place_of(c, map)) (at->velocity ? state.v : state.u)[at->dof] = c.value;
  subtract_obstacles(scene, map, state);
  return state;
}

namespace {

// Pendulum forces have converged if the equilibrium computed with them returns the same forces, within this
// multiple of the magnitudes of summed(). Chosen value.
constexpr double settled = rounding::many_operations;
constexpr int rounds = 50;  // limit of the fixed-point iterations, each of which solves with K once

bool is_pressed_pendulum(const ContactSpec& contact) {
  return contact.pendulum_surface && contact.capabilities().normal_spring;
}

/// Initial guess: the given forces, or the sum of the loads shared evenly. The values affect only the number of rounds.
/// The values must not be zero, because a structure that stands only on pendulums would then be a mechanism.
std::vector<double> first_guess(const Scene& scene, const Model& model) {
  double pushed = 0.0, bearings = 0.0;
  for (const Load& load : model.loads)
    if (load.is_static)
      for (const auto& [dof, factor] : load.direction.terms)
        pushed += std::abs(factor * load.history.value(0.0));
  for (const ContactSpec& contact : scene.contacts) bearings += is_pressed_pendulum(contact) ? 1.0 : 0.0;
  std::vector<double> forces;
  for (const ContactSpec& contact : scene.contacts)
    forces.push_back(!contact.pendulum_surface ? 0.0
                     : !is_pressed_pendulum(contact) || contact.pendulum_surface->nominal_force > 0.0
                         ? contact.pendulum_surface->nominal_force
                         : pushed / bearings);
  return forces;
}

/// For each contact, the force whose rounding error is the error of N = kn (g0 + n . u): the sum of N, of its two terms, which
/// are much larger if the structure has moved far along an inclined surface, and of the largest force K u.
std::vector<double> summed(const Scene& scene, const Model& model) {
  const Vector forces = model.stiffness.cwiseAbs() * model.u0.cwiseAbs();
  double greatest = 0.0;
  for (int i = 0; i < model.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation) greatest = std::max(greatest, forces[i]);
  std::vector<double> sizes;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const double terms = c.normal_stiffness * (std::abs(c.gap) + c.normal.magnitude(model.u0));
    sizes.push_back(std::max(0.0, model.statics.reactions[k]) + terms + greatest);
  }
  return sizes;
}

}  // namespace

bool has_pressed_pendulums(const Scene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), is_pressed_pendulum);
}

void set_pendulum_forces(const Scene& scene, const std::vector<double>& forces, Model& model) {
  std::vector<assembly::LineSpring> springs;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    if (!scene.contacts[k].pendulum_surface) continue;
    Contact& contact = model.contacts[k];
    contact.pendulum_surface->nominal_force = forces[k];
    if (const double more = contact::extra_stiffness(scene.contacts[k], contact); more != 0.0)
      springs.push_back({contact.tangent, more});
  }
  if (!springs.empty()) model.stiffness = assembly::with_springs(model.stiffness, springs);
}

void solve_pendulum_start(const Scene& scene, Model& model, const std::function<Model(Model)>& start) {
  std::vector<double> forces = first_guess(scene, model);
  for (int round = 0; round < rounds; ++round) {
    Model begun = model;
    set_pendulum_forces(scene, forces, begun);
    begun = start(std::move(begun));
    const std::vector<double> sizes = summed(scene, begun);
    bool same = true;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      if (!is_pressed_pendulum(scene.contacts[k])) continue;
      const double bears = std::max(0.0, begun.statics.reactions[k]);
      same = same && std::abs(bears - forces[k]) <= settled * sizes[k];
      forces[k] = bears;
    }
    if (!same) continue;
    model = std::move(begun);
    return;
  }
  throw SceneError(
      scene.initial.place, "run.initial",
      "the iteration for the static forces on the pendulums does not converge; give run.initial as "
      "displacements and velocities");
}

std::vector<double> saved_pendulum_forces(const Scene& scene) {
  std::vector<double> forces;
  for (const ContactSpec& contact : scene.contacts) {
    forces.push_back(contact.pendulum_surface ? contact.pendulum_surface->nominal_force : 0.0);
    if (scene.initial.saved)
      for (const auto& [name, force] : scene.initial.saved->pendulum_forces)
        if (name == contact.name) forces.back() = force;
  }
  return forces;
}

namespace {

/// Word in run.stages for all loads of this kind; empty if each load of this kind is listed by its own name.
std::string stage_word(LoadKind kind) {
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
    for (const std::string& known : {stage_word(load.kind), load.name})
      if (!known.empty() && std::find(names.begin(), names.end(), known) == names.end())
        names.push_back(known);
  throw SceneError(spec.load_places[index], key,
                   fmt::format("no load is called \"{}\"{}", name, base::suggestion(name, names)));
}

/// True if the name is a kind of load whose values are all zero, as an override may set them; a stage with this name is
/// then valid and has no effect.
bool is_zero_kind(const Scene& scene, const std::string& name) {
  const auto expands = [](const auto& part) { return part.thermal_expansion != 0.0; };
  if (name == stage_word(LoadKind::temperature))
    return std::any_of(scene.members.begin(), scene.members.end(), expands) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(), expands);
  if (name == stage_word(LoadKind::preload)) return !scene.springs.empty();
  return name == stage_word(LoadKind::base) && !scene.base_motion.empty();
}

/// True if the stage's name refers to the load, by its own name or by its kind.
bool matches_name(const Load& load, const std::string& name) {
  return name == load.name || name == stage_word(load.kind);
}

/// Sums up the loads of stage `number` (from 1). taken: for each load, the number of stages that applied it so far.
statics::Stage made(const Scene& scene, std::size_t number, const Model& model, std::vector<int>& taken) {
  const StageSpec& spec = scene.initial.stages[number - 1];
  const std::string key = fmt::format("run.stages.{}.loads", number);
  statics::Stage stage{spec.name, Vector::Zero(model.size()), spec.steps};
  for (std::size_t j = 0; j < spec.loads.size(); ++j) {
    bool any = false;
    for (std::size_t i = 0; i < model.loads.size(); ++i) {
      const Load& load = model.loads[i];
      if (!matches_name(load, spec.loads[j])) continue;
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

/// The stages of the scene; without stages, one stage with all static loads. acts (result): for each load, true if
/// some stage applies it.
std::vector<statics::Stage> stages_of(const Scene& scene, const Model& model, std::vector<bool>& acts) {
  std::vector<statics::Stage> stages;
  if (scene.initial.stages.empty()) {
    statics::Stage all{"loads", Vector::Zero(model.size()), 1};
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
          fmt::format(
              "\"{}\" acts from the beginning, but no stage lists this load; add it to the loads of a stage",
              load.name));
    acts.push_back(taken[i] > 0);
  }
  return stages;
}

/// True if a load of the stage is not zero; such a load compresses members and bodies even on fixed degrees of freedom.
bool presses(const StageSpec& spec, const Model& model) {
  return std::any_of(model.loads.begin(), model.loads.end(), [&](const Load& load) {
    return load.history.value(0.0) != 0.0 &&
           std::any_of(spec.loads.begin(), spec.loads.end(),
                       [&](const std::string& name) { return matches_name(load, name); });
  });
}

}  // namespace

void start_with_friction(const Scene& scene, assembly::DofMap& map, Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].friction.is_load_dependent())
      throw SceneError(scene.contacts[k].place, scene.contacts[k].key("friction"),
                       "initial = \"frictional\" does not support friction that depends on the normal force; "
                       "use one coefficient, "
                       "or initial = \"static\"");
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].initial_shear != 0.0)
      throw SceneError(scene.contacts[k].place, scene.contacts[k].key("initial_shear"),
                       "is not allowed with initial = \"frictional\", which computes the shear: remove it");
  std::vector<bool> acts;
  const std::vector<statics::Stage> stages = stages_of(scene, model, acts);
  statics::FrictionalEquilibrium found =
      statics::frictional_equilibrium(model.stiffness, model.contacts, stages, map, scene.initial.place);
  if (scene.run.geometric) found = second_pass_frictional(scene, acts, std::move(found), map, model);
  for (std::size_t i = 0; i < scene.initial.stages.size(); ++i)
    if (stages[i].load.isZero(0.0) && !(scene.run.geometric && presses(scene.initial.stages[i], model)))
      found.start.undetermined.push_back(fmt::format(
          "stage '{}' applies no load: all loads that it names are zero at t = 0", stages[i].name));
  model.u0 = std::move(found.u);
  model.v0 = Vector::Zero(model.size());
  model.static_start = true;
  model.statics = std::move(found.start);
  model.warnings.insert(model.warnings.end(), model.statics.undetermined.begin(),
                        model.statics.undetermined.end());
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& c = model.contacts[k];
    if (!c.tangential_stiffness || !c.has_friction()) continue;
    // Clamped: the run recomputes N with rounding errors, and |T| must not exceed the friction limit.
    const double N = c.resting_force(model.u0).value_or(-model.statics.reactions[k]);
    const double limit = contact::sticking_limit(c, N);
    c.initial_shear = std::clamp(found.shears[k], -limit, limit);
  }
}

}  // namespace signorini::model
