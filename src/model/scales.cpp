#include "model/scales.hpp"

#include <algorithm>
#include <cmath>

#include "base/history/pieces.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/springs.hpp"
#include "model/model_warnings.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/modes.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::model {
namespace {

// Fraction of the free structure's response: below this fraction, the response of the constrained structure is only
// rounding.
constexpr double only_rounding = 1e-10;

bool usable(double x) { return std::isfinite(x) && x > 0.0; }

/// The first of the candidates that is positive and finite, else 1.
template <class... Candidate>
double first_usable(const Candidate&... candidates) {
  for (double x : {candidates...})
    if (usable(x)) return x;
  return 1.0;
}

/// Force on one point for a unit of a load's history: the length of the plane vector, or in scenes with
/// matrices the largest factor.
double force_factor(const Combination& direction, const assembly::DofMap& map) {
  double greatest = 0.0, square = 0.0;
  for (const auto& [i, a] : direction.terms) {
    // The direction of a force on a rigid body has a moment term (the arm), but the force is a unit vector.
    if (map.dofs[static_cast<std::size_t>(i)].rotation) return 1.0;
    greatest = std::max(greatest, std::abs(a));
    square += a * a;
  }
  return map.is_matrix_scene() ? greatest : std::sqrt(square);
}

/// Largest distance between two nodes; independent of the scene's orientation. Inner nodes are skipped, because they lie
/// between named nodes.
double length_of(const assembly::DofMap& map) {
  const auto named = static_cast<std::size_t>(map.mesh.named);
  double squared = 0.0;
  for (std::size_t i = 0; i < named; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = map.mesh.nodes[i].x - map.mesh.nodes[j].x,
                   dy = map.mesh.nodes[i].y - map.mesh.nodes[j].y;
      squared = std::max(squared, dx * dx + dy * dy);
    }
  return std::sqrt(squared);
}

/// True for the centre of a rigid body with a free rotation and a supported translation: forces then act as
/// moments, with the length of the structure as arm.
bool turns_alone(const assembly::DofMap& map, std::size_t node) {
  const auto& n = map.number[node];
  const auto supported = [&](std::size_t c) {
    return n[c] == assembly::DofMap::fixed ||
           (map.is_tied(n[c]) && map.own_number(static_cast<int>(node), c) < 0);
  };
  return map.body[node] >= 0 && n[2] >= 0 && !map.is_tied(n[2]) && (supported(0) || supported(1));
}

/// Force on the degrees of freedom of a node. Forces on tied nodes appear at the nodes that determine their motion.
double force_at(const Vector& p, const assembly::DofMap& map, std::size_t node, double arm) {
  const auto part = [&](std::size_t c) {
    const int n = map.own_number(static_cast<int>(node), c);
    return n >= 0 ? p[n] : 0.0;
  };
  const double force = std::hypot(part(0), part(1));
  return turns_alone(map, node) && arm > 0.0 ? std::max(force, std::abs(part(2)) / arm) : force;
}

/// Sum of the forces on all nodes; independent of the scene's orientation.
double weight_of(const Vector& p, const assembly::DofMap& map) {
  if (map.is_matrix_scene()) return p.cwiseAbs().sum();
  const double arm = length_of(map);
  double weight = 0.0;
  for (std::size_t i = 0; i < map.number.size(); ++i) weight += force_at(p, map, i, arm);
  return weight;
}

/// Force on the most loaded node.
double greatest_force(const Vector& p, const assembly::DofMap& map) {
  if (map.is_matrix_scene()) return assembly::max_translation(p, map);
  const double arm = length_of(map);
  double greatest = 0.0;
  for (std::size_t i = 0; i < map.number.size(); ++i) greatest = std::max(greatest, force_at(p, map, i, arm));
  return greatest;
}

/// Largest mass of a node along any direction; independent of the scene's orientation.
double greatest_mass(const Model& model, const assembly::DofMap& map) {
  double greatest = 0.0;
  if (map.is_matrix_scene()) {
    for (int i = 0; i < model.size(); ++i) greatest = std::max(greatest, model.mass.coeff(i, i));
    return greatest;
  }
  const double arm = length_of(map);
  for (std::size_t i = 0; i < map.number.size(); ++i) {
    const int x = map.own_number(static_cast<int>(i), 0), y = map.own_number(static_cast<int>(i), 1);
    const double mx = x >= 0 ? model.mass.coeff(x, x) : 0.0, my = y >= 0 ? model.mass.coeff(y, y) : 0.0;
    const double mxy = x >= 0 && y >= 0 ? model.mass.coeff(x, y) : 0.0;
    if (const int turn = map.number[i][2]; turns_alone(map, i) && arm > 0.0)
      greatest = std::max(greatest, model.mass.coeff(turn, turn) / (arm * arm));
    const double most = mxy == 0.0 ? std::max(mx, my) : 0.5 * (mx + my) + std::hypot(0.5 * (mx - my), mxy);
    greatest = std::max(greatest, most);
  }
  return greatest;
}

double force_of(const Model& model, const assembly::DofMap& map, const EffectiveAmplitudes& effective,
                double t_end) {
  double force = 0.0;
  for (double reaction : model.statics.reactions) force = std::max(force, reaction);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (c.normal_force_given())
      force = std::max(force, effective.compressions[k] * history::magnitude(c.normal_force, t_end));
    if (const auto N = c.resting_force(model.u0)) force = std::max(force, -*N);
  }
  double held = 0.0;  // forces of constrained deformation (heat, supports), if there are no others
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const double most = effective.loads[i].share * history::magnitude(load.history, t_end);
    const Vector direction = assembly::dense_vector(load.direction, model.size());
    switch (load.kind) {
      case LoadKind::weight:
      case LoadKind::base:
      case LoadKind::distributed:
        if (load.is_static && model.static_start) continue;
        force = std::max(force, weight_of(direction, map) * most);
        break;
      case LoadKind::force:
        force = std::max(force, force_factor(load.direction, map) * most);
        break;
      case LoadKind::moment:  // equivalent couple whose arm is the length of the structure
        if (const double arm = length_of(map); arm > 0.0)
          force = std::max(force, direction.cwiseAbs().maxCoeff() * most / arm);
        break;
      case LoadKind::temperature:
      case LoadKind::initial_strain:
      case LoadKind::preload:
      case LoadKind::support:
      case LoadKind::support_rate:
        held = std::max(held, greatest_force(direction, map) * most);
        break;
    }
  }
  if (usable(force)) return force;
  if (usable(held)) return held;
  // Free vibration: elastic and damping forces of the initial state, or the inertia forces that would stop it.
  force = std::max(greatest_force(model.stiffness * model.u0, map),
                   greatest_force(model.damping * model.v0, map));
  return std::max(force, model.omega_max * greatest_force(model.mass * model.v0, map));
}

/// Largest static displacements under a single one of the given forces; 0 if the stiffness matrix is singular.
struct StaticResponse {
  double held = 0.0;
  /// Displacement with springs in place of the constraints: the scale of displacements if the constraints prevent all motion.
  /// The springs have the stiffness of the structure.
  double gripped = 0.0;
};

StaticResponse find_static_response(const std::vector<Vector>& forces, const Model& model,
                                    const assembly::DofMap& map, const modes::ContactConstraints& holding) {
  if (forces.empty()) return {};
  const SparseMatrix k = assembly::with_springs(model.stiffness, holding.springs);
  const SparseMatrix gripped = modes::with_constraint_springs(k, holding.fixed);
  if (statics::null_motions(gripped).cols() > 0) return {};
  const modes::ConstrainedStructure structure(k, holding.fixed);
  const linear::SymmetricSolver loose(gripped);
  StaticResponse result;
  for (const Vector& p : forces) {
    const double answer = assembly::max_translation(structure.solve(p), map);
    const double free = assembly::max_translation(loose.solve(p), map);
    // If the constraints fix every motion, the response is only rounding.
    if (answer > only_rounding * free) result.held = std::max(result.held, answer);
    result.gripped = std::max(result.gripped, free);
  }
  return result;
}

std::vector<Vector> amplitudes_of_loads(const Model& model, const EffectiveAmplitudes& effective,
                                        double t_end) {
  std::vector<Vector> forces;
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    forces.emplace_back(assembly::dense_vector(model.loads[i].direction, model.size()) *
                        (effective.loads[i].share * history::magnitude(model.loads[i].history, t_end)));
  return forces;
}

/// Friction limits f N of sliders, as forces along their tangents.
std::vector<Vector> limits_of_friction(const Model& model, const EffectiveAmplitudes& effective,
                                       double t_end) {
  std::vector<Vector> forces;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (const double limit = contact::static_friction(c) *
                             (effective.compressions[k] * history::magnitude(c.normal_force, t_end));
        c.normal_force_given() && limit > 0.0)
      forces.emplace_back(assembly::dense_vector(c.tangent, model.size()) * limit);
  }
  return forces;
}

/// Distance that loads and initial velocities would move the structure during the run if it had no stiffness.
double thrown(const Model& model, const assembly::DofMap& map, const EffectiveAmplitudes& effective,
              double t_end) {
  SparseMatrix mass = model.mass;
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless) mass.coeffRef(i, i) = 1.0;
  const linear::SymmetricSolver solver(mass);
  double acceleration = 0.0;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const Load& load = model.loads[k];
    Vector p = assembly::dense_vector(load.direction, model.size()) *
               (effective.loads[k].free_share * history::magnitude(load.history, t_end));
    for (int i = 0; i < model.size(); ++i)
      if (model.dofs[static_cast<std::size_t>(i)].massless) p[i] = 0.0;
    acceleration += assembly::max_translation(solver.solve(p), map);
  }
  return assembly::max_translation(model.u0, map) + assembly::max_translation(model.v0, map) * t_end +
         0.5 * acceleration * t_end * t_end;
}

/// Solver error of a displacement that contacts prevent completely: rounding of force / stiffness at the stiffest
/// degree of freedom. Rotational stiffnesses are divided by the square of the structure's length.
double min_response(const Model& model, const assembly::DofMap& map, double force) {
  const double arm = length_of(map);
  double stiffest = 0.0;
  for (int i = 0; i < model.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    const double k = std::abs(model.stiffness.coeff(i, i));
    stiffest = std::max(stiffest, turns && arm > 0.0 ? k / (arm * arm) : k);
  }
  return stiffest > 0.0 ? rounding::elimination * force / stiffest : 0.0;
}

/// Deflection of the softest contact spring under the force; 0 if no contact has a spring.
double spring_response(const Model& model, double force) {
  double softest = 0.0;
  auto consider = [&](double k) {
    if (k > 0.0 && (softest == 0.0 || k < softest)) softest = k;
  };
  for (const Contact& c : model.contacts) {
    consider(c.normal_stiffness);
    consider(c.tangential_stiffness.value_or(0.0));
  }
  return softest > 0.0 ? force / softest : 0.0;
}

}  // namespace

Scales find_scales(const Model& model, const assembly::DofMap& map, const std::vector<bool>& closed,
                   double t_end) {
  Scales scales;
  const double length = length_of(map);
  const double v0 = assembly::max_translation(model.v0, map);
  const modes::ContactConstraints holding = modes::constrain_contacts(model.contacts, closed);
  modes::ContactConstraints rested;  // closed rigid contacts without friction
  for (std::size_t k = 0; k < closed.size(); ++k)
    if (closed[k] && model.contacts[k].takes_impulses()) rested.fixed.push_back(model.contacts[k].normal);
  const double omega =
      model.omega1 > 0.0 ? model.omega1 : modes::lowest_frequency(model.mass, model.stiffness, rested);
  const EffectiveAmplitudes effective = effective_amplitudes(model, holding, omega, t_end);
  const double force = force_of(model, map, effective, t_end);

  double displacement = assembly::max_translation(model.u0, map);
  const std::vector<Vector> loads = amplitudes_of_loads(model, effective, t_end);
  const auto [held, gripped] = find_static_response(loads, model, map, holding);
  displacement =
      std::max(displacement, held > 0.0 ? held : find_static_response(loads, model, map, rested).held);
  if (displacement < only_rounding * gripped) displacement = gripped;
  const double least = min_response(model, map, force);
  const auto answers = [&](double x) { return usable(x) && x > least; };
  if (!answers(displacement)) displacement = 0.0;
  // The static response of a very soft motion is nearly unbounded, but the run is too short to reach it.
  if (const double farthest = thrown(model, map, effective, t_end); usable(farthest))
    displacement = std::min(displacement, farthest);
  // An initial velocity moves the structure at least as far as the fastest oscillation would.
  if (model.omega_max > 0.0) displacement = std::max(displacement, v0 / model.omega_max);
  // If only friction drives the motion, displacements are those of a static load equal to the friction limit.
  if (!usable(displacement))
    displacement = find_static_response(limits_of_friction(model, effective, t_end), model, map, rested).held;
  if (!answers(displacement)) displacement = spring_response(model, force);
  if (!usable(displacement) && omega > 0.0) displacement = v0 / omega;
  if (!usable(displacement))
    for (const Contact& c : model.contacts) displacement = std::max(displacement, std::abs(c.gap));
  if (!usable(displacement)) displacement = v0 * t_end;
  scales.displacement = first_usable(displacement, length);

  const double mass = greatest_mass(model, map);
  scales.force = first_usable(force, mass * omega * omega * scales.displacement,
                              mass * scales.displacement / (t_end * t_end));
  // If contacts open, the structure does not oscillate at omega1; the energy then limits the velocity.
  const double driving = std::max(scales.force, greatest_force(model.stiffness * model.u0, map));
  const double bound = std::sqrt(driving * scales.displacement / mass);
  double velocity = omega > 0.0 ? omega * scales.displacement : bound;
  if (usable(bound)) velocity = std::min(velocity, bound);
  scales.velocity =
      first_usable(std::max(usable(velocity) ? velocity : 0.0, v0), scales.displacement / t_end);
  const double arm = length > 0.0 ? length : 1.0;
  scales.rotation = scales.displacement / arm;
  scales.angular_velocity = scales.velocity / arm;
  return scales;
}

}  // namespace signorini::model
