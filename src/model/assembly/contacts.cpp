#include "model/assembly/contacts.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/history/pieces.hpp"
#include "contact/law.hpp"
#include "contact/law/law_error.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/saved_state.hpp"

namespace signorini::assembly {
namespace {

/// True if a user law acts along the tangent although the contact has no friction.
bool acts_along_tangent(const ContactLaw& law) {
  return !law.capabilities.signorini_coulomb && law.capabilities.tangents > 0;
}

Combination tangent_form(const ContactSpec& spec, const DofMap& map) {
  Direction direction;
  if (spec.tangent)
    direction = *spec.tangent;
  else if (spec.normal && !map.is_matrix_scene())
    direction = {spec.normal->node, sliding_direction(spec), {}, spec.normal->place, spec.normal->against};
  else
    return {};
  // Without friction the tangent is used for outputs only, where absent components are zero.
  const bool for_outputs_only = !spec.capabilities().normal_force_given && !spec.friction.any() &&
                                !(spec.user_law && acts_along_tangent(**spec.user_law));
  return combination(map, direction, spec.key("tangent"), true, for_outputs_only);
}

void check_gap(const ContactSpec& spec, const Contact& contact) {
  if (!spec.normal)
    throw SceneError(spec.place, spec.key("normal"),
                     fmt::format("a {} contact needs a normal", contact::to_string(spec.law)));
  if (contact.normal.terms.empty())
    throw SceneError(spec.place, spec.key("normal"),
                     "a support fixes all motion along the normal; remove the contact or the support");
  if (contact.has_friction() && contact.tangent.terms.empty())
    throw SceneError(spec.place, spec.key("tangent"),
                     "a support fixes all motion along the tangent; remove the friction or the support");
}

void check_compliant(const ContactSpec& spec, const Contact& contact) {
  if (!(spec.normal_stiffness > 0.0))
    throw SceneError(spec.place, spec.key("normal_stiffness"),
                     fmt::format("found {}, expected a number > 0", spec.normal_stiffness));
  if (!contact.has_friction()) return;
  if (!(spec.tangential_stiffness.value_or(0.0) > 0.0))
    throw SceneError(spec.place, spec.key("tangential_stiffness"),
                     "a compliant contact with friction needs a tangential stiffness > 0");
}

/// If friction depends on N, the rate p' of the sliding point follows from the rate of N. With a normal dashpot, p'
/// would depend on accelerations; this is refused.
void check_friction_by_force(const ContactSpec& spec) {
  if (!spec.friction.is_load_dependent()) return;
  const auto refuse = [&](const std::string& what) {
    throw SceneError(spec.place, spec.key("friction"), "friction that depends on the normal force " + what);
  };
  if (spec.capabilities().takes_impulses)
    refuse("is not available for rigid contacts; use law = \"compliant\"");
  if (!spec.tangential_stiffness) refuse("needs a tangential_stiffness");
  if (spec.normal_damping != 0.0) refuse("cannot be combined with normal_damping");
  if (spec.tangential_damping != 0.0) refuse("cannot be combined with tangential_damping");
}

/// Errors: SceneError for a user law with invalid rows or guards, or with keys that cannot be combined with a user law. A law
/// with the built-in states can be combined with all keys.
void check_user_law(const ContactSpec& spec, const Scene& scene, const Contact& contact) {
  const auto refuse = [&](const std::string& what) { throw SceneError(spec.place, spec.key("own"), what); };
  const ContactLaw& law = **spec.user_law;
  if (const std::string error = law_error(contact, spec.law); !error.empty()) refuse(error);
  if (law.capabilities.signorini_coulomb) return;
  if (spec.friction.any() || spec.normal_damping != 0.0 || spec.tangential_damping != 0.0)
    refuse(
        "found friction or dampers in addition to a user-defined law; remove them here, and include them in "
        "the rows of the law");
  if (scene.initial.is_static || scene.initial.is_frictional) {
    if (!law.is_named())
      refuse(
          "found a static start with a user-defined law, which has none. Give run.initial as displacements "
          "and velocities, or use law = \"compliant\" without a user-defined law");
    throw SceneError(spec.place, spec.key("law"),
                     fmt::format("found law = \"{}\" with a static start, which this law does not have. Give "
                                 "run.initial as displacements and velocities, or use law = \"compliant\"",
                                 law.name()));
  }
}

void check_slider(const ContactSpec& spec, const Contact& contact, double t_end) {
  if (!spec.tangent && !spec.normal)
    throw SceneError(spec.place, spec.key("tangent"), "a slider needs a tangent");
  if (contact.tangent.terms.empty())
    throw SceneError(spec.place, spec.key("tangent"),
                     "a support fixes all motion along the tangent; remove the contact or the support");
  if (const double t = history::find_negative_time(contact.normal_force, t_end); t >= 0.0)
    throw SceneError(spec.normal_force.place, spec.key("normal_force"),
                     fmt::format("found {:.6g} at time {:.6g}, expected a compression >= 0",
                                 contact.normal_force.value(t), t));
}

/// Removes the friction of a seam's contact if a support fixes its node along the tangent (a plane of symmetry): the node
/// cannot slip, and the support carries T.
void remove_friction_at_fixed_tangent(const Scene& scene, std::size_t k, Contact& contact) {
  const bool of_seam = std::any_of(scene.seams.begin(), scene.seams.end(), [k](const SeamSpec& seam) {
    return k >= seam.first_contact && k < seam.first_contact + seam.nodes.size();
  });
  if (!of_seam || !contact.tangent.terms.empty()) return;
  contact.friction = {};
  contact.tangential_stiffness.reset();
}

}  // namespace

std::vector<Contact> make_contacts(const Scene& scene, const DofMap& map) {
  std::vector<Contact> contacts;
  for (const ContactSpec& spec : scene.contacts) {
    Contact c;
    c.name = spec.name;
    c.law = spec.contact_law();
    c.gap = spec.gap;
    c.normal_stiffness = spec.normal_stiffness;
    c.tangential_stiffness = spec.tangential_stiffness;
    c.normal_damping = spec.normal_damping;
    c.friction = spec.friction;
    c.pendulum_surface = spec.pendulum_surface;
    c.initial_shear = spec.initial_shear;
    c.unused_forces = spec.unused_forces;
    c.unused_guards = spec.unused_guards;
    c.restitution = spec.restitution;
    c.capture_velocity = spec.capture_velocity;
    c.tangent = tangent_form(spec, map);
    remove_friction_at_fixed_tangent(scene, contacts.size(), c);
    check_friction_by_force(spec);
    if (!spec.capabilities().normal_force_given) {  // a user law must agree, see check_user_law()
      if (spec.normal) c.normal = combination(map, *spec.normal, spec.key("normal"), true);
      check_gap(spec, c);
      if (c.normal_spring()) check_compliant(spec, c);
    } else {
      c.normal_force = scene::make_history(spec.normal_force, spec.key("normal_force"));
      check_slider(spec, c, scene.run.t_end);
    }
    if (spec.user_law) check_user_law(spec, scene, c);
    c.surface_motion = scene::make_integral(spec.surface_velocity, spec.key("surface_velocity"));
    if (const auto& saved = scene.initial.saved)
      if (const auto moved = scene::saved_motion(*saved, c.name + ".surface"))
        c.surface_motion = c.surface_motion.scaled(1.0, *moved);
    contacts.push_back(std::move(c));
  }
  return contacts;
}

}  // namespace signorini::assembly
