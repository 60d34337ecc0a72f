#include "scene/quantities.hpp"

#include "scene/components.hpp"
#include "scene/saved_state.hpp"

namespace signorini::scene {
namespace {

using Visit = std::function<void(double&, const Unit&)>;

using namespace unit;

void visit_optional(std::optional<double>& x, const Unit& of, const Visit& visit) {
  if (x) visit(*x, of);
}

/// Offset and amplitude have the unit `of`; the shape is a plain number. For the history of a load `of` is
/// plain, too: the load's own amplitude has the unit.
void visit_history(HistorySpec& f, const Unit& of, const Visit& visit) {
  visit(f.offset, of);
  visit(f.amplitude, of);
  visit(f.start, time);
  visit(f.end, time);
  visit(f.omega, rate);
  visit(f.phase, plain);
  visit(f.shift, time);
  visit(f.period, time);
  for (std::size_t j = 0; j < f.coefficients.size(); ++j)
    visit(f.coefficients[j], Unit{0, 0, -static_cast<int>(j)});
  for (double& t : f.times) visit(t, time);
  for (double& x : f.values) visit(x, plain);
  if (f.in_code) visit_numbers(*f.in_code, plain, visit);
}

void visit_run(RunSpec& run, const Visit& visit) {
  visit(run.t_end, time);
  visit_optional(run.atol.displacement, length, visit);
  visit_optional(run.atol.velocity, velocity, visit);
  visit_optional(run.atol.force, force, visit);
  visit_optional(run.output_dt, time, visit);
  if (run.output_times)
    for (double& t : *run.output_times) visit(t, time);
  for (double& t : run.frames) visit(t, time);
  visit_optional(run.dt, time, visit);
}

void visit_prestress(Prestress& forces, const Visit& visit) {
  for (Prestress::Element& e : forces.elements)
    for (double* n : {&e.at_from, &e.at_to}) visit(*n, force);
  for (Prestress::Body& body : forces.bodies) visit(body.stiffness, energy);
}

void visit_initial(InitialSpec& initial, const Visit& visit) {
  for (double& u : initial.u) visit(u, length);
  for (double& v : initial.v) visit(v, velocity);
  for (InitialSpec::Component& c : initial.components) visit(c.value, motion_named(c.component).unit());
  if (!initial.saved) return;
  visit(initial.saved->t, time);
  for (auto& [name, value] : initial.saved->motions)
    visit(value, name == saved_alpha ? rate : motion_named(name).unit());
  for (auto& [name, shear] : initial.saved->shears) visit(shear, force);
  for (SavedState::UserLawMemory& own : initial.saved->user_law_states) visit(own.memory, length);
  for (auto& [name, carried] : initial.saved->pendulum_forces) visit(carried, force);
  for (SavedState::FinalContact& left : initial.saved->final_contacts) {
    visit_optional(left.gap, length, visit);
    visit(left.ut, length);
    visit(left.vt, velocity);
    visit(left.slip, length);
    visit(left.N, force);
    visit(left.T, force);
  }
  if (initial.saved->prestress) visit_prestress(*initial.saved->prestress, visit);
  if (!initial.saved->scales) return;
  const std::array units{length, plain, velocity, rate, force};
  for (std::size_t i = 0; i < units.size(); ++i) visit((*initial.saved->scales)[i], units[i]);
}

void visit_structure(Scene& scene, const Visit& visit) {
  for (Section& s : scene.sections) {
    visit(s.EA, force);
    visit(s.EI, Unit{1, 2, 0});
    visit(s.mass_per_length, Unit{1, -2, 2});
    visit(s.area, Unit{0, 2, 0});
    visit(s.modulus, Unit{0, 3, 0});
    visit(s.pipe_radius, length);
    visit(s.pipe_wall, length);
  }
  for (Node& node : scene.nodes) {
    visit(node.x, length);
    visit(node.y, length);
  }
  for (PointMass& m : scene.masses) {
    visit(m.mass, mass);
    visit(m.inertia, inertia);
  }
  for (Spring& s : scene.springs) {
    visit(s.stiffness, stiffness);
    visit(s.damping, damping);
    visit(s.rotation_stiffness, energy);
    visit(s.rotation_damping, Unit{1, 1, 1});
    visit(s.preload, force);
    visit_optional(s.hot_load, force, visit);
  }
  for (Member& m : scene.members) {  // the unit of temperature is independent of the scene's units
    visit_history(m.temperature, plain, visit);
    visit_history(m.initial_strain, plain, visit);
    if (m.bend) visit(m.bend->radius, length);
  }
  for (BodySpec& b : scene.bodies) {
    visit(b.E, Unit{1, -2, 0});
    visit(b.density, Unit{1, -4, 2});
    visit(b.thickness, length);
    visit_history(b.temperature, plain, visit);
  }
  for (SurfaceSpec& surface : scene.surfaces) visit(surface.thickness, length);
  for (SurfaceNode& node : scene.surface_nodes) {
    visit(node.x, length);
    visit(node.y, length);
  }
  for (SeamSpec& seam : scene.seams) {
    visit(seam.thickness, length);
    for (SeamNode& node : seam.nodes)
      for (double* x : {&node.length, &node.at[0], &node.at[1]}) visit(*x, length);
  }
  for (Support& s : scene.supports)
    if (s.motion) {
      const int rate = s.motion_is_acceleration ? -2 : 0;
      visit_history(*s.motion, Unit{0, s.rz ? 0 : 1, rate}, visit);
    }
  if (!scene.matrices) return;
  for (MatrixSpec::Entry& e : scene.matrices->mass.entries) visit(e.value, mass);
  for (MatrixSpec::Entry& e : scene.matrices->damping.entries) visit(e.value, damping);
  for (MatrixSpec::Entry& e : scene.matrices->stiffness.entries) visit(e.value, stiffness);
}

void visit_contact(ContactSpec& c, const Visit& visit) {
  visit(c.gap, length);
  visit(c.normal_stiffness, stiffness);
  visit_optional(c.tangential_stiffness, stiffness, visit);
  if (c.pendulum_surface) {
    visit(c.pendulum_surface->radius, length);
    visit(c.pendulum_surface->nominal_force, force);
  }
  visit(c.normal_damping, damping);
  visit(c.tangential_damping, damping);
  for (const FrictionConstant& constant : friction_constants)
    visit_optional(c.friction.*constant.value, constant.unit, visit);
  visit_history(c.normal_force, force, visit);
  visit_history(c.surface_velocity, velocity, visit);
  visit(c.initial_shear, force);
  visit_optional(c.capture_velocity, velocity, visit);
  if (!c.user_law) return;
  if (auto law = (*c.user_law)->with_constants(visit)) c.user_law = std::move(law);
}

/// Exponent of length in a load's amplitude: force times length to this power.
int lengths_of(LoadType type) {
  switch (type) {
    case LoadType::force:
      return 0;
    case LoadType::moment:
      return 1;
    case LoadType::distributed:
      return -1;
    case LoadType::traction:
      break;
  }
  return -2;
}

/// x^n. If x is a power of two, so is x^n, and products with it are exact.
double raised(double x, int n) {
  double result = 1.0;
  for (int i = 0; i < n; ++i) result *= x;
  for (int i = 0; i > n; --i) result /= x;
  return result;
}

}  // namespace

double factor_of(const Unit& of, const Factors& factors) {
  return raised(factors.force, of.force) * raised(factors.length, of.length) * raised(factors.time, of.time);
}

Factors inverse(const Factors& factors) {
  return {1.0 / factors.force, 1.0 / factors.length, 1.0 / factors.time};
}

void visit_numbers(History& history, const Unit& of, const Visit& visit) {
  std::vector<double> starts = history.starts();
  for (double& t : starts) visit(t, time);
  std::vector<Piece> pieces = history.pieces();
  for (Piece& piece : pieces) {
    visit(piece.origin, time);
    for (std::size_t j = 0; j < piece.coefficients.size(); ++j)
      visit(piece.coefficients[j], Unit{of.force, of.length, of.time - static_cast<int>(j)});
    visit(piece.amplitude, of);
    visit(piece.omega, rate);
    if (!piece.function) continue;
    visit(piece.time_scale, rate);
    for (double& b : piece.rates) visit(b, of);
  }
  history = History(std::move(starts), std::move(pieces));
}

void visit_quantities(Scene& scene, const Visit& visit) {
  for (double& g : scene.gravity) visit(g, acceleration);
  visit_run(scene.run, visit);
  visit_initial(scene.initial, visit);
  visit(scene.damping.alpha, rate);
  visit(scene.damping.beta, time);
  visit_optional(scene.damping.alpha_over_omega1, plain, visit);
  if (scene.reduction) {
    visit(scene.reduction->cutoff_omega, rate);
    visit_optional(scene.reduction->tolerance, plain, visit);
  }
  visit_structure(scene, visit);
  for (ContactSpec& c : scene.contacts) visit_contact(c, visit);
  for (LoadSpec& load : scene.loads) {
    visit(load.amplitude, Unit{1, lengths_of(load.type), 0});
    visit_history(load.history, plain, visit);
  }
  for (BaseMotionSpec& motion : scene.base_motion) visit_history(motion.acceleration, acceleration, visit);
  for (OutputSpec& output : scene.outputs)
    for (OutputTerm& term : output.terms) visit(term.factor, term.unit);
}

Scene rescaled(Scene scene, const Factors& factors) {
  visit_quantities(scene, [&](double& x, const Unit& of) { x *= factor_of(of, factors); });
  return scene;
}

RunSpec rescaled(RunSpec run, const Factors& factors) {
  visit_run(run, [&](double& x, const Unit& of) { x *= factor_of(of, factors); });
  return run;
}

}  // namespace signorini::scene
