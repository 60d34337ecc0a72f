#include "model/p_delta.hpp"

#include <fmt/core.h>

#include <cmath>

#include "model/assembly/loads.hpp"
#include "model/assembly/prestress.hpp"
#include "model/modes/stability.hpp"

namespace signorini::model {
namespace {

constexpr int shown_factors = 5;
constexpr const char* asked_by = "run.geometric";

/// Constraints by the normals of closed contacts and the tangents of sticking contacts.
modes::ContactConstraints constraints_in_states(const std::vector<Contact>& contacts,
                                                const std::vector<State>& states) {
  modes::ContactConstraints holding;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (is_open(states[k])) continue;
    holding.add_normal(c);
    if (states[k] != State::stick || c.tangent.terms.empty()) continue;
    if (c.tangential_stiffness)
      holding.springs.push_back({c.tangent, *c.tangential_stiffness});
    else
      holding.fixed.push_back(c.tangent);
  }
  return holding;
}

/// Contact states: stick for closed contacts with friction, closed for closed contacts without friction, else open.
std::vector<State> sticking(const std::vector<Contact>& contacts, const std::vector<bool>& closed) {
  std::vector<State> states;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    states.push_back(!closed[k] && !contacts[k].normal_force_given() ? State::open
                     : contacts[k].has_friction()                    ? State::stick
                                                                     : State::closed);
  return states;
}

std::vector<double> factors_at(const Scene& scene, const assembly::DofMap& map, const Model& model,
                               const std::vector<State>& states, int count) {
  const SparseMatrix geometric = assembly::assemble_geometric_stiffness(scene, map).matrix;
  const SparseMatrix elastic = model.stiffness - geometric;
  return modes::load_factors(elastic, geometric, constraints_in_states(model.contacts, states), count);
}

/// Load factors < 0, those nearest to zero first: of the forces with the other sign. A structure without stiffness of its own,
/// which only these forces hold, has none.
std::vector<double> reversed_factors_at(const Scene& scene, const assembly::DofMap& map, const Model& model,
                                        const std::vector<State>& states, int count) {
  const SparseMatrix geometric = assembly::assemble_geometric_stiffness(scene, map).matrix;
  const SparseMatrix elastic = model.stiffness - geometric, reversed = -geometric;
  std::vector<double> factors =
      modes::load_factors(elastic, reversed, constraints_in_states(model.contacts, states), count);
  std::erase(factors, 0.0);
  for (double& factor : factors) factor = -factor;
  return factors;
}

/// Errors: SceneError if the lowest load factor is at most 1, so that the start is not a stable equilibrium.
void refuse_buckled(const Scene& scene, const assembly::DofMap& map, const Model& model,
                    const std::vector<State>& states) {
  const std::vector<double> factors = factors_at(scene, map, model, states, 1);
  if (factors.empty() || factors.front() > 1.0) return;
  const std::string what = factors.front() > 0.0
                               ? fmt::format("the lowest load factor is {:.9g}", factors.front())
                               : std::string("any fraction of the loads makes it buckle (load factor 0)");
  throw SceneError(scene.run.geometric_place, asked_by,
                   fmt::format("the structure buckles under its static loads: with the contacts that are "
                               "closed at the start, {}; expected a load factor above 1",
                               what));
}

}  // namespace

FirstPass first_pass(const Scene& scene, const assembly::DofMap& map, const Model& model) {
  if (scene.initial.saved && scene.initial.saved->prestress) return {*scene.initial.saved->prestress, {}};
  std::vector<bool> acts;
  for (const Load& load : model.loads) acts.push_back(load.is_static);
  const statics::EquilibriumSearch search{asked_by, true, {}};
  const SourcePlace& place = scene.run.geometric_place;
  statics::Equilibrium found =
      statics::find_equilibrium(model.stiffness, assembly::static_load(model.loads, model.size()),
                                model.contacts, map, place, scene.units, search);
  std::vector<double> N, T(model.contacts.size(), 0.0);
  for (const double reaction : found.start.reactions) N.push_back(-reaction);
  return {assembly::prestress(scene, map, model, {found.u, std::move(N), std::move(T), std::move(acts)}),
          std::move(found.closed)};
}

void apply_prestress(const Scene& scene, Prestress forces, assembly::DofMap& map, Model& model) {
  assembly::set_prestress(forces, scene, map);
  model.geometric = Geometric{std::move(forces), {}};
  const assembly::GeometricStiffness own = assembly::assemble_geometric_stiffness(scene, map);
  if (own.matrix.nonZeros() == 0)
    model.warnings.emplace_back(
        "run.geometric has no effect: the static loads cause no axial force in members, and no force on a "
        "rigid body that can rotate");
  model.stiffness = SparseMatrix(model.stiffness + own.matrix);
  assembly::add_geometric_supports(scene, map, own.moving, model.loads);
}

statics::Equilibrium second_pass(const Scene& scene, const assembly::DofMap& map, const Model& model,
                                 const std::vector<bool>& closed) {
  refuse_buckled(scene, map, model, sticking(model.contacts, closed));
  statics::Equilibrium found = statics::find_equilibrium(
      model.stiffness, assembly::static_load(model.loads, model.size()), model.contacts, map,
      scene.initial.place, scene.units, {"run.initial", true, closed});
  if (found.closed != closed) refuse_buckled(scene, map, model, sticking(model.contacts, found.closed));
  return found;
}

statics::FrictionalEquilibrium second_pass_frictional(const Scene& scene, const std::vector<bool>& acts,
                                                      statics::FrictionalEquilibrium found,
                                                      assembly::DofMap& map, Model& model) {
  const auto load_now = [&] {
    Vector p = Vector::Zero(model.size());
    for (std::size_t i = 0; i < model.loads.size(); ++i)
      if (i < acts.size() ? acts[i] : model.loads[i].is_static)
        model.loads[i].direction.add_to(p, model.loads[i].history.value(0.0));
    return p;
  };
  std::vector<double> N, T;
  std::vector<State> states;
  for (const statics::LimitMargin& s : found.margins) {
    N.push_back(s.N);
    T.push_back(s.T);
    states.push_back(s.state);
  }
  const Vector before = load_now(), stiff = model.stiffness * found.u;
  apply_prestress(scene, assembly::prestress(scene, map, model, {found.u, std::move(N), std::move(T), acts}),
                  map, model);
  refuse_buckled(scene, map, model, states);
  const statics::Stage stage{"geometric", load_now() - before - (model.stiffness * found.u - stiff), 1};
  return statics::continue_loading(std::move(found), model.stiffness, model.contacts, stage, map,
                                   scene.initial.place);
}

void set_load_factors(const Scene& scene, const assembly::DofMap& map, const std::vector<bool>& closed,
                      Model& model) {
  const bool slid = model.statics.frictional && !model.statics.stages.empty();
  const std::vector<State> states =
      slid ? model.statics.stages.back().states : sticking(model.contacts, closed);
  std::vector<double>& factors = model.geometric->load_factors;
  factors = factors_at(scene, map, model, states, shown_factors);
  if (factors.empty()) factors = reversed_factors_at(scene, map, model, states, shown_factors);
}

}  // namespace signorini::model
