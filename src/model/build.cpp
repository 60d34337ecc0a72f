// build_model: assembles the scene's matrices. Each step needs the results of the previous steps:
//
//   degrees of freedom -> M, K, dampers -> contacts, loads -> initial state -> omega1 -> C -> scales
//   -> warnings -> reduction, or separation of undamped massless motions -> shear elements -> outputs
//
// The assembly uses internal units (internal_units.hpp). The model is then converted to the scene's units. Results
// are therefore bitwise the same if the scene's units change by powers of two.

#include "model/build.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/history/pieces.hpp"
#include "base/rounding.hpp"
#include "contact/contact_states.hpp"
#include "contact/curved_surface.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/contacts.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/member_pieces.hpp"
#include "model/assembly/prestress.hpp"
#include "model/assembly/springs.hpp"
#include "model/assembly/ties.hpp"
#include "model/compliance_split.hpp"
#include "model/initial_state.hpp"
#include "model/internal_units.hpp"
#include "model/massless.hpp"
#include "model/model_warnings.hpp"
#include "model/modes/modes.hpp"
#include "model/outputs/make_outputs.hpp"
#include "model/outputs/reactions.hpp"
#include "model/p_delta.hpp"
#include "model/reduce/reduction.hpp"
#include "model/rigid_contacts.hpp"
#include "model/scales.hpp"
#include "model/statics/statics.hpp"
#include "scene/saved_state.hpp"

namespace signorini::model {

using assembly::assemble_matrices;
using assembly::assemble_nodes;
using assembly::Assembly;
using assembly::DofMap;
using assembly::place_of_structure;
using modes::constrain_contacts;
using modes::lowest_frequency;

namespace {

/// Takes from a saved run: the shear forces of contacts (they define the anchors), the slip directions, and the
/// states of user laws.
void take_saved_contact_states(const SavedState& saved, Model& model) {
  for (Contact& c : model.contacts) {
    for (const SavedState::UserLawMemory& own : saved.user_law_states)
      if (c.name == own.contact)
        std::tie(c.initial_law_state, c.initial_memory) = std::tie(own.state, own.memory);
    if (!c.has_friction()) continue;
    for (const auto& [name, T] : saved.shears)
      if (c.name == name && c.tangential_stiffness) c.initial_shear = T;
    for (const auto& [name, sign] : saved.slips)
      if (c.name == name) c.initial_slip = sign;
  }
}

/// Final contact states of the saved run, in the model's order; empty if the structure or the contacts differ.
std::vector<SavedState::FinalContact> final_contacts(const SavedState& saved, const Model& model) {
  if (!saved.structure_differences.empty() || saved.final_contacts.size() != model.contacts.size()) return {};
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (saved.final_contacts[k].contact != model.contacts[k].name) return {};
  return saved.final_contacts;
}

/// Sets u0, v0 and, for a static start, Model::statics. pressed: contacts that the first pass of run.geometric
/// found closed.
void set_initial_state(const Scene& scene, const std::vector<bool>& pressed, DofMap& map, Model& model) {
  if (scene.initial.is_frictional) {
    start_with_friction(scene, map, model);
    return;
  }
  if (!scene.initial.is_static) {
    const InitialState state = given_state(scene, map);
    model.u0 = state.u;
    model.v0 = state.v;
    if (!scene.initial.saved) return;
    take_saved_contact_states(*scene.initial.saved, model);
    model.saved_contacts = final_contacts(*scene.initial.saved, model);
    model.saved_time = scene.initial.saved->t;
    return;
  }
  bool loaded = false;
  for (const Load& load : model.loads) loaded = loaded || load.is_static;
  if (scene.matrices && !loaded)
    throw SceneError(scene.initial.place, "run.initial",
                     "found no load that acts from the beginning; initial = \"static\" needs one. With "
                     "[matrices], give the weight as loads with a constant history");
  statics::Equilibrium found =
      scene.run.geometric
          ? second_pass(scene, map, model, pressed)
          : statics::find_equilibrium(model.stiffness, assembly::static_load(model.loads, model.size()),
                                      model.contacts, map, scene.initial.place, scene.units);
  model.u0 = std::move(found.u);
  model.v0 = Vector::Zero(model.size());
  model.static_start = true;
  model.statics = std::move(found.start);
}

/// Contacts closed at the start: all sliders; in a static start contacts with a reaction > 0, else with a gap <= 0.
std::vector<bool> closed_at_start(const Model& model) {
  std::vector<bool> closed;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (c.normal_force_given())
      closed.push_back(true);
    else if (model.static_start)
      closed.push_back(model.statics.reactions[k] > 0.0);
    else
      closed.push_back(c.gap_at(model.u0) <= 0.0);
  }
  return closed;
}

/// The saved run that the scene continues; null if there is none, or if its structure differs.
const SavedState* continued_run(const Scene& scene) {
  const auto& saved = scene.initial.saved;
  return saved && saved->structure_differences.empty() ? &*saved : nullptr;
}

bool has_pendulums(const Scene& scene) {
  return std::any_of(scene.springs.begin(), scene.springs.end(),
                     [](const Spring& s) { return s.restoring; }) ||
         std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactSpec& c) { return c.pendulum_surface.has_value(); });
}

/// Sets alpha, beta and C. dampers: C without alpha M + beta K.
void set_damping(const Scene& scene, const SparseMatrix& dampers, Model& model) {
  const DampingSpec& spec = scene.damping;
  model.alpha = spec.alpha;
  model.beta = spec.beta;
  const SavedState* before = continued_run(scene);
  const auto saved = before ? scene::saved_motion(*before, scene::saved_alpha) : std::nullopt;
  if (spec.alpha_over_omega1 && saved) {
    model.alpha = *saved;
  } else if (spec.alpha_over_omega1) {
    if (!(model.omega1 > 0.0))
      throw SceneError(spec.place, "damping.alpha_over_omega1",
                       "the lowest frequency omega1 does not exist: with the initially closed contacts "
                       "fixed, some motion has no stiffness, or nothing can move; give alpha instead");
    model.alpha = *spec.alpha_over_omega1 * model.omega1;
  }
  model.damping = dampers;
  if (model.alpha != 0.0) model.damping = SparseMatrix(model.damping + model.alpha * model.mass);
  if (model.beta != 0.0) model.damping = SparseMatrix(model.damping + model.beta * model.stiffness);
  if (has_pendulums(scene)) model.damping.prune(0.0);  // their part of beta K is excluded, and leaves zeros
}

/// Finds the initial state; for run.geometric also the prestress, whose geometric stiffness is added to K.
void start_with_geometric_stiffness(const Scene& scene, DofMap& map, Model& model) {
  if (scene.run.geometric && scene.matrices)
    throw SceneError(scene.run.geometric_place, "run.geometric",
                     "has no effect with [matrices]: remove it, and add the geometric stiffness of the "
                     "static forces to matrices.stiffness");
  FirstPass first;
  if (scene.run.geometric && !scene.initial.is_frictional) {
    first = first_pass(scene, map, model);
    apply_prestress(scene, first.forces, map, model);
  }
  check_massless(scene, model, map);
  set_initial_state(scene, first.closed, map, model);
  if (scene.run.geometric && scene.initial.is_frictional) check_massless(scene, model, map);
}

/// Finds the initial state and the forces on pendulums together, because each depends on the other.
void start(const Scene& scene, DofMap& map, Model& model) {
  const bool stands = scene.initial.is_static || scene.initial.is_frictional;
  if (!stands || !has_pressed_pendulums(scene)) {
    if (continued_run(scene)) set_pendulum_forces(scene, saved_pendulum_forces(scene), model);
    start_with_geometric_stiffness(scene, map, model);
    return;
  }
  const DofMap before = map;
  solve_pendulum_start(scene, model, [&](Model begun) {
    map = before;
    start_with_geometric_stiffness(scene, map, begun);
    return begun;
  });
}

/// Completes the model: mapping from computed to displayed degrees of freedom, shear elements, outputs.
void add_results(const Scene& scene, const DofMap& map, const std::optional<ComplianceSplit>& split,
                 Model& model) {
  if (split) {
    check_unique_forces(scene, model);
    map_outputs(*split, model);
  }
  add_shear_elements(scene, model);
  assembly::name_tied_dofs(map, model);
  outputs::make_outputs(scene, map, model);
}

/// Sets velocities of rounding size in a saved state to zero; otherwise these velocities would decide the slip
/// direction of a contact at its friction limit. The fastest mode converts rounding errors of displacements to velocities
///     |v| <= many_operations omega_max max |u|,   for translations and rotations separately.
/// If any velocity of the model is larger, only tangential velocities of a contact are set to zero, if the contact
/// stuck at the end of the saved run and all its tangential velocities are of rounding size.
void remove_rounding(const SavedState& saved, Model& model) {
  double u[2] = {0.0, 0.0}, v[2] = {0.0, 0.0};
  for (int i = 0; i < model.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    u[turns] = std::max(u[turns], std::abs(model.u0[i]));
    v[turns] = std::max(v[turns], std::abs(model.v0[i]));
  }
  const double rate = rounding::many_operations * model.omega_max;
  if (v[0] <= rate * u[0] && v[1] <= rate * u[1]) {
    model.v0.setZero();
    return;
  }
  const auto rests = [&](const std::pair<int, double>& term) {
    const bool turns = model.dofs[static_cast<std::size_t>(term.first)].rotation;
    return std::abs(model.v0[term.first]) <= rate * u[turns];
  };
  const auto touches = [&](const Contact& c) {
    return c.normal_force_given() ||
           c.gap_at(model.u0) <= rounding::many_operations * (std::abs(c.gap) + c.normal.magnitude(model.u0));
  };
  for (const auto& [name, sign] : saved.slips)
    for (const Contact& c : model.contacts)
      if (sign == 0 && c.name == name && c.sticks_rigidly() && touches(c) &&
          std::all_of(c.tangent.terms.begin(), c.tangent.terms.end(), rests))
        for (const auto& term : c.tangent.terms) model.v0[term.first] = 0.0;
}

/// Sets u0 to zero if all displacements are of rounding size (a static start without deformation); rounding errors
/// would otherwise decide when a contact with zero gap closes.
void remove_rounding_of_statics(Model& model) {
  for (Eigen::Index i = 0; i < model.u0.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    const double scale = turns ? model.scales.rotation : model.scales.displacement;
    if (std::abs(model.u0[i]) > rounding::few_operations * scale) return;
  }
  model.u0.setZero();
}

/// Merges times of load histories and contact histories that double precision cannot separate.
void resolve_times(double t_end, Model& model) {
  for (Load& load : model.loads) load.history = history::resolved(load.history, t_end);
  for (Contact& c : model.contacts) {
    c.normal_force = history::resolved(c.normal_force, t_end);
    c.surface_motion = history::resolved(c.surface_motion, t_end);
  }
}

/// Subtracts beta K_g from the dampers, so that beta K does not damp the geometric stiffness K_g of the prestress.
void exclude_prestress_damping(const Scene& scene, const DofMap& map, Assembly& assembly) {
  assembly.dampers -= scene.damping.beta * assembly::assemble_geometric_stiffness(scene, map).matrix;
}

/// Subtracts beta times the restoring stiffness N_K / R of pendulums from the dampers, so that beta K does not damp it. This
/// stiffness is that of a contact force, as contact springs, which beta K does not contain either.
void exclude_restoring_damping(const Scene& scene, const DofMap& map, const Model& model,
                               Assembly& assembly) {
  const double beta = scene.damping.beta;
  const Assembly restoring = assembly::assemble_restoring_springs(scene, map);
  std::vector<assembly::LineSpring> more;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k)
    if (const double extra = contact::extra_stiffness(scene.contacts[k], model.contacts[k]); extra != 0.0)
      more.push_back({model.contacts[k].tangent, extra});
  assembly.dampers -= beta * assembly::with_springs(restoring.stiffness, more);
  for (std::size_t i = 0; i < assembly.moving.size(); ++i)
    assembly.moving[i].dampers -= beta * restoring.moving[i].stiffness;
}

/// Scales of the saved run that the scene continues; if there is none, scales computed from the model.
Scales scales_of(const Scene& scene, const DofMap& map, const std::vector<bool>& closed, const Model& model) {
  const Scales own = find_scales(model, map, closed, scene.run.t_end);
  const SavedState* before = continued_run(scene);
  if (!before || !before->scales) return own;
  const auto& s = *before->scales;
  return {s[0], s[1], s[2], s[3], s[4]};
}

/// Removes from C what beta adds for stiffness that is no material's: of axial forces, and of pendulums.
void exclude_geometric_damping(const Scene& scene, const DofMap& map, const Model& model,
                               Assembly& assembly) {
  if (scene.damping.beta == 0.0) return;
  if (model.geometric) exclude_prestress_damping(scene, map, assembly);
  if (has_pendulums(scene)) exclude_restoring_damping(scene, map, model, assembly);
}

enum class Extent { structure, without_warnings, all };

void refuse_empty(const Scene& scene, const DofMap& map) {
  if (map.size() == 0)
    throw SceneError(
        place_of_structure(scene), "",
        "the scene has no degree of freedom: add a member, mass, spring or contact at a free node");
}

/// Builds the model in the units of `scene`. unit: the scene's units of force, length and time, in the units of messages.
Model assembled(const Scene& scene, const Factors& unit, Extent extent = Extent::all) {
  DofMap map = scene.matrices ? assembly::number_matrices(*scene.matrices) : assembly::number_nodes(scene);
  map.message_length_factor = unit.length;
  refuse_empty(scene, map);
  if (!scene.matrices) assembly::check_stiffness_range(scene, map);
  Assembly assembly = scene.matrices ? assemble_matrices(scene, map) : assemble_nodes(scene, map);

  Model model;
  model.title = scene.title;
  model.units = scene.units;
  model.unit = unit;
  model.dofs = map.dofs;
  model.columns = map.columns;
  mark_massless(scene, map, assembly, model.dofs);
  assembly::add_ties(scene, map, model);
  model.contacts = assembly::make_contacts(scene, map);
  model.loads = assembly::make_loads(scene, map, assembly);
  model.mass = std::move(assembly.mass);
  model.stiffness = std::move(assembly.stiffness);
  if (!scene.matrices) assembly::add_drawing(scene, map, model);
  model.damping = assembly.dampers;
  const std::optional<ComplianceSplit> split = split_compliance(scene, assembly.dampers, model);
  model.layout = contact::layout_of(model.contacts);
  start(scene, map, model);
  if (split) continue_split(*split, scene, model);
  if (!scene.matrices) outputs::find_hangers(scene, map, model);
  const std::vector<bool> closed = closed_at_start(model);
  if (model.geometric && extent == Extent::all) set_load_factors(scene, map, closed, model);
  model.omega1 = lowest_frequency(model.mass, model.stiffness, constrain_contacts(model.contacts, closed));
  const SparseMatrix dashpots = assembly.dampers;
  exclude_geometric_damping(scene, map, model, assembly);
  set_damping(scene, assembly.dampers, model);
  assembly::add_support_rates(scene, map, assembly, model.alpha, model.beta, model.loads);
  model.omega_max = modes::highest_frequency(model);
  if (scene.initial.saved) remove_rounding(*scene.initial.saved, model);
  model.scales = scales_of(scene, map, closed, model);
  if (model.static_start) remove_rounding_of_statics(model);
  check_rigid_contacts(scene, model);
  if (extent == Extent::all)
    for (std::string& doubt : model_warnings(scene, map, model)) model.warnings.push_back(std::move(doubt));
  resolve_times(scene.run.t_end, model);
  if (extent == Extent::structure) {
    if (split) map_outputs(*split, model);
    return model;
  }
  if (scene.reduction && scene.reduction->cutoff_omega > 0.0) {
    reduce::reduce(scene, assembly.dampers, dashpots, model);
    check_rigid_contacts(scene, model);  // zero gaps have rounding errors after the reduction
    model.omega_max = modes::highest_frequency(model);
  } else {
    separate_undamped(model);
    if (scene.reduction)
      model.warnings.emplace_back(
          "reduction.tolerance: this command uses the full model; only run, compare, study, sweep and verify "
          "search for the cutoff");
  }
  add_results(scene, map, split, model);
  return model;
}

Model built(const Scene& scene, Extent extent) {
  const Factors machine = find_internal_units(scene);
  try {
    Model model =
        rescaled(assembled(scene::rescaled(scene, scene::inverse(machine)), machine, extent), machine);
    model.internal_units = machine;
    // All models of a scene share the scene's law object; its numbers are bitwise those of the converted copy.
    for (std::size_t k = 0; k < scene.contacts.size(); ++k)
      if (scene.contacts[k].user_law) model.contacts[k].law = *scene.contacts[k].user_law;
    return model;
  } catch (const SceneError&) {
    static_cast<void>(
        assembled(scene, {}));  // throws the same error again, with numbers in the scene's units
    throw;
  }
}

}  // namespace

}  // namespace signorini::model

namespace signorini {

Model build_model(const Scene& scene) { return model::built(scene, model::Extent::all); }

}  // namespace signorini

namespace signorini::model {
Model build_without_warnings(const Scene& scene) { return built(scene, Extent::without_warnings); }
Model build_structure(const Scene& scene) { return built(scene, Extent::structure); }

namespace {

bool same(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() && (a - b).norm() == 0.0;
}

bool same(const Contact& a, const Contact& b) {
  const auto friction = [](const Friction& f) {
    return std::tuple{f.static_, f.kinetic, f.stribeck_velocity, f.velocity, f.force};
  };
  return a.law == b.law && a.normal.terms == b.normal.terms && a.tangent.terms == b.tangent.terms &&
         a.normal_stiffness == b.normal_stiffness && a.normal_damping == b.normal_damping &&
         a.tangential_stiffness == b.tangential_stiffness && friction(a.friction) == friction(b.friction);
}

}  // namespace

bool same_contact_states(const Model& a, const Model& b) {
  return same(a.mass, b.mass) && same(a.damping, b.damping) && same(a.stiffness, b.stiffness) &&
         std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    [](const Contact& x, const Contact& y) { return same(x, y); });
}

bool same_load_directions(const Model& a, const Model& b) {
  return std::equal(a.loads.begin(), a.loads.end(), b.loads.begin(), b.loads.end(),
                    [](const Load& x, const Load& y) { return x.direction.terms == y.direction.terms; });
}

}  // namespace signorini::model
